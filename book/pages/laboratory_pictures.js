// The laboratory's five pictures of a run, and what each says to a screen reader.
"use strict";

function laboratoryPictures(find, scan, threshold) {
  const TRAIL = 12, PAUSED_TRAIL = 48, SHOWN = 24; // forcing periods in the phase portrait, and in the time history
  const panels = {
    phase: laboratoryPanel(find("phase"), "position x", "velocity v"),
    strobe: laboratoryPanel(find("strobe"), "position x", "velocity v"),
    history: laboratoryPanel(find("history"), "time in forcing periods, ωt / 2π", "position x"),
    running: laboratoryPanel(find("running"), "forcing periods", "λ₁"),
    against: laboratoryPanel(find("against"), "forcing amplitude μ", "λ₁"),
  };
  let strobe = { run: null, points: 0, reach: "" }; // what the stroboscopic panel holds: points are added to it

  function drawPlane(run, values, moving) {
    const { reach, time, trail, motion, points } = run, plane = [[-reach.x, reach.x], [-reach.v, reach.v]];
    const earliest = Math.max(time - (moving ? TRAIL : PAUSED_TRAIL), Math.min(run.transient, time - 2));
    panels.phase.axes(...plane);
    panels.phase.curve(trail.x, trail.v, run.since(earliest), moving ? 1.2 : 0.8);
    panels.phase.ring(values.x, values.v);
    panels.phase.dots([motion.x], [motion.v], 0, 4);
    if (strobe.run !== run || strobe.reach !== plane.join()) {
      panels.strobe.axes(...plane);
      panels.strobe.ring(values.x, values.v);
      strobe = { run, points: 0, reach: plane.join() };
    }
    panels.strobe.dots(points.x, points.v, strobe.points);
    strobe.points = points.x.length;
  }

  function drawHistory({ time, trail, reach }, first) {
    const begin = Math.max(0, time - SHOWN);
    panels.history.axes([begin, begin + SHOWN], [-reach.x, reach.x]);
    panels.history.curve(trail.t, trail.x, first(begin));
  }

  function drawRunning({ running: { period, lambda }, transient, periods }) {
    const stride = Math.ceil(lambda.length / 600) || 1, some = (row) => row.filter((_, i) => i % stride === 0 || i === row.length - 1);
    // The first means are those of a handful of periods: they do not rule the axis.
    const late = some(lambda.slice(Math.min(lambda.length - 1, 5 + Math.floor(lambda.length / 20))));
    const low = Math.min(0, ...late), high = Math.max(0, ...late), space = 0.15 * (high - low) || 0.1;
    panels.running.axes([transient, Math.max(periods, transient + 20)], [low - space, high + space]);
    panels.running.rules([0]);
    panels.running.curve(some(period), some(lambda));
  }

  function drawAgainst({ mu, lambda }) {
    panels.against.axes([Math.min(0, ...mu), Math.max(scan.at(-1), ...mu)], [1.1 * Math.min(-0.3, ...lambda), 1.1 * Math.max(0.25, ...lambda)]);
    panels.against.rules([0, threshold]);
    panels.against.dots(mu, lambda, 0, 2.5);
  }

  function describe(run, values, exponents) {
    const set = `p = ${values.p}, mu = ${values.mu}`, { motion, points, lambda } = run;
    const labels = {
      phase: `Phase portrait for ${set}: after ${run.periods} periods x = ${motion.x.toFixed(3)}, v = ${motion.v.toFixed(3)}`,
      strobe: `${points.x.length} stroboscopic points for ${set}`,
      history: `Position against time for ${set}: the last periods up to number ${run.periods}`,
      running: lambda === undefined ? "Running Lyapunov exponent: no period after the transient yet"
        : `Running Lyapunov exponent for ${set}: ${lambda.toFixed(4)} after ${run.periods} periods`,
      against: `Largest Lyapunov exponent against mu: ${exponents.mu.length} finished runs`,
    };
    for (const [name, label] of Object.entries(labels)) panels[name].canvas.setAttribute("aria-label", label);
  }

  return {
    planes: [panels.phase, panels.strobe],
    forget() { strobe.run = null; },
    draw(run, values, exponents, moving) {
      drawPlane(run, values, moving);
      drawHistory(run, (t) => run.since(t));
      drawRunning(run);
      drawAgainst(exponents);
      describe(run, values, exponents);
    },
  };
}
