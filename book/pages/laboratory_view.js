// The laboratory's controls and pictures: what a reader asks for, computed in slices of a frame and drawn.
"use strict";

(function () {
  const find = (name) => document.getElementById(`laboratory-${name}`);
  const root = document.getElementById("laboratory"), given = JSON.parse(find("data").textContent);
  const Motion = duffingIntegrator(given.table);
  const BUDGET = 8; // milliseconds of a frame for the integration: at 60 frames a second half of it
  const TRAIL = 12, SETTLED_TRAIL = 48, SHOWN = 24, MOST_STEPS_KEPT = 30000, MOST_POINTS = 50000;
  const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 20, 50, Infinity]; // forcing periods a second
  const still = matchMedia("(prefers-reduced-motion: reduce)");

  // ---- what can be set: name, sign, words, step of an arrow key, what is allowed
  const finite = [(value) => true, "a finite number"];
  const FIELDS = {
    alpha: ["α", "damping coefficient", 0.01, (value) => value >= 0, "a finite number ≥ 0"],
    p: ["p", "damping exponent", 0.1, (value) => value >= given.least_p && value <= given.most_p, `a number from ${given.least_p} to ${given.most_p}`],
    mu: ["μ", "forcing amplitude", 0.01, ...finite],
    omega: ["ω", "forcing frequency", 0.01, (value) => value > 0, "a finite number > 0"],
    delta: ["δ", "linear stiffness", 0.1, ...finite],
    gamma: ["γ", "cubic stiffness", 0.1, ...finite],
    x: ["x₀", "position at t = 0", 0.01, ...finite],
    v: ["v₀", "velocity at t = 0", 0.01, ...finite],
    transient: ["transient", "periods left out", 1, (value) => Number.isInteger(value) && value >= 0 && value <= 10000, "a whole number from 0 to 10000"],
    periods: ["", "", 1, (value) => Number.isInteger(value) && value >= 0 && value <= 10000, "a whole number from 0 to 10000"],
  };
  const SHOWN_FIELDS = Object.keys(FIELDS).filter((name) => name !== "periods"); // that one only a link carries

  function checked(name, text) {
    const field = FIELDS[name];
    if (!field) throw new RangeError(`${name} = ${text}: is no value of the laboratory; it takes ${Object.keys(FIELDS).join(", ")}`);
    const value = text.trim() === "" ? NaN : Number(text.trim().replace("−", "-"));
    if (!Number.isFinite(value) || !field[3](value)) throw new RangeError(`${name} = ${text.trim() || "(nothing)"}: must be ${field[4]}`);
    return value;
  }

  // ---- the run
  let values = {}, motion, failed = "", wanted = false, visible = true, clock = 0, goal = Infinity;
  let trail, points, stretchings, running, reach, drawn = { points: 0, at: 0 };
  let queue = [], exponents = { key: "", mu: [], lambda: [] };
  const frames = []; // what the last frames took, in milliseconds, for who wants to know

  function restart() {
    const { x, v, ...parameters } = values;
    motion = new Motion(parameters, x, v);
    trail = { t: [0], x: [x], v: [v] };
    points = { x: [], v: [] };
    stretchings = [0];
    running = { period: [], lambda: [] };
    const wells = values.delta < 0 && values.gamma > 0 ? Math.sqrt(-values.delta / values.gamma) : 1;
    reach = { x: 2 * wells, v: 1.6 * wells * Math.sqrt(Math.abs(values.delta) || 1) };
    grow(x, v);
    [clock, failed, goal] = [0, "", Infinity];
    const { alpha, p, omega, delta, gamma, transient } = values, key = [alpha, p, omega, delta, gamma, x, v, transient].join();
    if (key !== exponents.key) exponents = { key, mu: [], lambda: [] };
  }

  // The axes hold what has been reached.
  function grow(x, v) {
    for (const [name, value] of [["x", Math.abs(x)], ["v", Math.abs(v)]]) {
      while (value > reach[name] && value < 1e12) {
        reach[name] *= 1.5;
        drawn.points = -1;
      }
    }
  }

  function advance() {
    const t = motion.step(motion.duration);
    trail.t.push(motion.periods + t / motion.duration);
    trail.x.push(motion.x);
    trail.v.push(motion.v);
    grow(motion.x, motion.v);
    if (trail.t.length > MOST_STEPS_KEPT) for (const row of Object.values(trail)) row.splice(0, MOST_STEPS_KEPT / 4);
    if (t < motion.duration) return;
    motion.closePeriod();
    stretchings.push(motion.stretching);
    const gone = motion.periods - values.transient;
    if (gone <= 0) return;
    points.x.push(motion.x);
    points.v.push(motion.v);
    running.period.push(motion.periods);
    running.lambda.push((motion.stretching - stretchings[values.transient]) / (gone * motion.duration));
    if (motion.periods === given.periods) {
      exponents.mu.push(values.mu);
      exponents.lambda.push(running.lambda.at(-1));
    }
    if (motion.periods === MOST_POINTS) stop(`${MOST_POINTS} periods are computed: the laboratory keeps no more.`);
  }

  function stop(words, wrong = false) {
    [wanted, failed] = [false, wrong ? words : ""];
    queue = [];
    say(words, wrong);
  }

  // What a frame (of so many seconds) may compute: to where the clock is, and no longer than its budget.
  function compute(seconds) {
    const began = performance.now(), speed = queue.length || goal < Infinity ? Infinity : SPEEDS[find("speed").value];
    clock = Math.min(motion.time + speed * seconds, goal);
    try {
      while (wanted && motion.time < clock && performance.now() - began < BUDGET) {
        advance();
        if (motion.periods < goal) continue;
        if (queue.length) next();
        else stop(`Paused after ${motion.periods} periods.`);
      }
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      stop(`After ${motion.time.toFixed(2)} periods ${error.message}: the computation has ended there.`, true);
    }
  }

  // The next run of a scan.
  function next() {
    const mu = queue.shift();
    values.mu = mu;
    find("mu").value = mu;
    restart();
    goal = given.periods;
  }

  let request = 0, last = 0;
  const goes = () => wanted && visible && !document.hidden && !failed;
  function wake() {
    if (goes() && !request) {
      last = performance.now();
      request = requestAnimationFrame(frame);
    }
    find("run").textContent = wanted ? "Pause" : "Run";
  }
  function frame(now) {
    request = 0;
    if (!goes()) return;
    const began = performance.now();
    compute(Math.min(Math.max(now - last, 0), 100) / 1000);
    last = now;
    // Who wants less motion sees a new picture once a second.
    if (!still.matches || !wanted || now - drawn.at > 1000) draw(now);
    frames.push(performance.now() - began);
    if (frames.length > 240) frames.shift();
    wake();
  }

  // ---- the pictures
  const panels = {
    phase: laboratoryPanel(find("phase"), "position x", "velocity v"),
    strobe: laboratoryPanel(find("strobe"), "position x", "velocity v"),
    history: laboratoryPanel(find("history"), "time in forcing periods, ωt / 2π", "position x"),
    running: laboratoryPanel(find("running"), "forcing periods", "λ₁"),
    against: laboratoryPanel(find("against"), "forcing amplitude μ", "λ₁"),
  };

  // Number of the first step kept that is not before the time t.
  function since(t) {
    let low = 0, high = trail.t.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (trail.t[middle] < t) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  function draw(now = performance.now()) {
    drawn.at = now;
    const time = motion.time, plane = [[-reach.x, reach.x], [-reach.v, reach.v]];
    panels.phase.axes(...plane);
    panels.phase.curve(trail.x, trail.v, since(Math.max(time - (wanted ? TRAIL : SETTLED_TRAIL), Math.min(values.transient, time - 2))), wanted ? 1.2 : 0.8);
    panels.phase.ring(values.x, values.v);
    panels.phase.dots([motion.x], [motion.v], 0, 4);

    if (drawn.points < 0 || drawn.points > points.x.length || !points.x.length) {
      panels.strobe.axes(...plane);
      panels.strobe.ring(values.x, values.v);
      drawn.points = 0;
    }
    panels.strobe.dots(points.x, points.v, drawn.points);
    drawn.points = points.x.length;

    const begin = Math.max(0, time - SHOWN);
    panels.history.axes([begin, begin + SHOWN], plane[0]);
    panels.history.curve(trail.t, trail.x, since(begin));

    drawRunning();
    const all = [...exponents.lambda, -0.3, 0.25], mus = [...exponents.mu, 0, given.scan.at(-1)];
    panels.against.axes([Math.min(...mus), Math.max(...mus)], [1.1 * Math.min(...all), 1.1 * Math.max(...all)]);
    panels.against.rules([], [0, given.threshold]);
    panels.against.dots(exponents.mu, exponents.lambda, 0, 2.5);
    tell();
  }

  function drawRunning() {
    const { period, lambda } = running, stride = Math.ceil(lambda.length / 600) || 1;
    const some = (row) => row.filter((_, i) => i % stride === 0 || i === row.length - 1);
    // The first few means are those of a handful of periods: they do not rule the axis.
    const late = some(lambda.slice(Math.min(lambda.length - 1, 5 + Math.floor(lambda.length / 20)))), [low, high] = [Math.min(0, ...late), Math.max(0, ...late)];
    const space = 0.15 * (high - low) || 0.1, end = Math.max(motion.periods, values.transient + 20);
    panels.running.axes([values.transient, end], [low - space, high + space]);
    panels.running.rules([], [0]);
    panels.running.curve(some(period), some(lambda));
  }

  // Numbers with a true minus.
  const number = (value, digits) => value.toFixed(digits).replace("-", "−");
  function tell() {
    find("periods").textContent = Math.floor(motion.time);
    find("t").textContent = number(motion.time * motion.duration, 1);
    find("x-now").textContent = number(motion.x, 4);
    find("v-now").textContent = number(motion.v, 4);
    const lambda = running.lambda.at(-1);
    find("exponent").textContent = lambda === undefined ? "–" : number(lambda, 4);
    find("link").href = `#${fragment()}`;
    const set = `p = ${values.p}, mu = ${values.mu}`, after = `after ${motion.periods} periods`;
    const labels = {
      phase: `Phase portrait for ${set}; ${after} x = ${motion.x.toFixed(3)}, v = ${motion.v.toFixed(3)}`,
      strobe: `${points.x.length} stroboscopic points for ${set}`,
      history: `Position against time for ${set}, the last periods up to ${motion.periods}`,
      running: lambda === undefined ? "Running Lyapunov exponent: no period after the transient yet" : `Running Lyapunov exponent for ${set}: ${lambda.toFixed(4)} ${after}`,
      against: `Largest Lyapunov exponent against mu: ${exponents.mu.length} runs so far`,
    };
    for (const [name, label] of Object.entries(labels)) find(name).setAttribute("aria-label", label);
  }

  function say(words, wrong = false) {
    find("says").textContent = words;
    find("says").classList.toggle("wrong", wrong);
  }

  function redraw() {
    drawn.points = -1;
    draw();
  }

  // ---- the controls
  const fragment = () => new URLSearchParams({ ...values, periods: motion.periods }).toString();

  function show() {
    for (const name of SHOWN_FIELDS) {
      find(name).value = values[name];
      find(name).removeAttribute("aria-invalid");
    }
  }

  // Take up new values from t = 0 on: run on at the chosen speed, or (until given) at full speed as far as that.
  function begin(changes, until = Infinity, mus = []) {
    values = { ...values, ...changes };
    queue = mus.slice();
    restart();
    show();
    say("");
    wanted = true;
    goal = until;
    if (queue.length) next();
    redraw();
    wake();
  }

  // All fields as they stand, or null after the sentence that says which of them is wrong.
  function read() {
    const found = {};
    let wrong = "";
    for (const name of SHOWN_FIELDS) {
      try {
        found[name] = checked(name, find(name).value);
        find(name).removeAttribute("aria-invalid");
      } catch (error) {
        wrong ||= error.message;
        find(name).setAttribute("aria-invalid", "true");
      }
    }
    if (!wrong) return found;
    stop(wrong, true);
    wake();
    return null;
  }

  function changed() {
    const found = read();
    if (found) begin(found);
  }

  function nudge(event, name) {
    const many = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    const value = Number(event.target.value);
    if (event.key === "Enter") changed();
    if (!many || !Number.isFinite(value)) return;
    event.preventDefault();
    event.target.value = +(value + many * FIELDS[name][2]).toFixed(6);
    changed();
  }

  for (const name of SHOWN_FIELDS) {
    const [sign, words] = FIELDS[name], label = document.createElement("label");
    label.innerHTML = `<i>${sign}</i> ${words}<input id="laboratory-${name}" type="text" inputmode="${sign === "transient" ? "numeric" : "text"}" aria-describedby="laboratory-says">`;
    label.htmlFor = `laboratory-${name}`;
    find(["x", "v", "transient"].includes(name) ? "initial" : "parameters").append(label);
    find(name).addEventListener("change", changed);
    find(name).addEventListener("keydown", (event) => nudge(event, name));
  }
  find("form").addEventListener("submit", (event) => event.preventDefault());

  for (const preset of given.presets) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = preset.name;
    button.addEventListener("click", () => begin(preset.values, preset.periods, preset.scan ? given.scan : []));
    find("presets").append(button);
  }

  find("run").addEventListener("click", () => {
    if (wanted) {
      stop("Paused.");
      redraw();
    } else if (read()) {
      [wanted, goal] = [!failed, Infinity];
      say(failed, Boolean(failed));
    }
    wake();
  });
  find("period").addEventListener("click", () => {
    if (!read() || failed) return;
    stop("");
    const until = motion.periods + 1;
    try {
      while (motion.periods < until) advance();
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      stop(error.message, true);
    }
    draw();
    wake();
  });
  find("restart").addEventListener("click", changed);
  find("adopt").addEventListener("click", () => {
    // The forcing has its phase 0 at the end of a period: from there on the motion is the same.
    if (!read() || failed) return;
    while (motion.state[0] > 0) advance();
    begin({ x: motion.x, v: motion.v });
  });
  find("scan").addEventListener("click", () => {
    const found = read();
    if (found) begin(found, given.periods, given.scan);
  });

  for (const panel of [panels.phase, panels.strobe]) {
    panel.canvas.addEventListener("click", (event) => {
      const found = read(), at = panel.under(event);
      if (found && at) begin({ ...found, x: +at[0].toFixed(3), v: +at[1].toFixed(3) });
    });
  }

  const speed = find("speed");
  function pace() {
    const chosen = SPEEDS[speed.value];
    const words = chosen === Infinity ? "as fast as it goes" : chosen === 1 ? "1 period a second" : `${chosen} periods a second`;
    find("pace").textContent = words;
    speed.setAttribute("aria-valuetext", words);
  }
  [speed.max, speed.value] = [SPEEDS.length - 1, 3];
  speed.addEventListener("input", pace);
  pace();

  // ---- a link, what is in sight, how wide and which colours
  function load() {
    const wished = { ...given.presets[0].values, periods: given.presets[0].periods };
    const text = location.hash.slice(1), linked = text.includes("=");
    let wrong = "";
    if (linked) {
      for (const [name, value] of new URLSearchParams(text)) {
        try {
          wished[name] = checked(name, value);
        } catch (error) {
          wrong ||= error.message;
        }
      }
    }
    const { periods, ...rest } = wished;
    begin(rest, periods);
    if (linked) root.scrollIntoView();
    if (wrong) stop(`The link is not taken as it stands: ${wrong}.`, true);
    if (periods === 0) stop("");
    wake();
  }

  new IntersectionObserver((entries) => {
    visible = entries.at(-1).isIntersecting;
    wake();
  }).observe(root);
  document.addEventListener("visibilitychange", wake);
  addEventListener("hashchange", () => location.hash.includes("=") && load());
  load();
  new ResizeObserver(redraw).observe(root);
  new MutationObserver(redraw).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);

  // For the tests, and for who looks at it from the console.
  window.laboratory = { Motion, frames, get motion() { return motion; }, get running() { return goes(); } };
})();
