// A motion from its initial condition on, and what the laboratory shows of it: trail, stroboscopic points, lambda_1.
"use strict";

function laboratoryRun(Motion) {
  const KEPT = 30000; // steps of the trail, some 200 periods

  return class Run {
    constructor({ x, v, transient, ...parameters }) {
      this.motion = new Motion(parameters, x, v);
      this.transient = transient;
      this.trail = { t: [0], x: [x], v: [v] }; // at the end of each step, t in forcing periods
      this.points = { x: [], v: [] }; // at the end of each period after the transient
      this.running = { period: [], lambda: [] }; // mean growth rate of the tangent from the transient's end to there
      this.left = 0; // logarithm of the tangent's growth over the transient
      const { delta, gamma } = parameters, wells = delta < 0 && gamma > 0;
      const width = wells ? Math.sqrt(-delta / gamma) : 1;
      this.reach = { x: 2 * width, v: 1.6 * width * (wells ? Math.sqrt(-delta) : 1) }; // |x| and |v| that axes show
      this.grow(x, v);
    }

    get periods() { return this.motion.periods; }
    get time() { return this.motion.time; }
    get lambda() { return this.running.lambda.at(-1); }

    // Axes that hold what has been reached: a few sizes, so that they seldom change.
    grow(x, v) {
      for (const [name, value] of [["x", Math.abs(x)], ["v", Math.abs(v)]]) {
        while (value > this.reach[name] && value < 1e30) this.reach[name] *= 1.5;
      }
    }

    // One step of the integrator; true if a forcing period ends with it. Throws a RangeError where a solution ends.
    advance() {
      const { motion, trail } = this, t = motion.step(motion.duration);
      trail.t.push(motion.periods + t / motion.duration);
      trail.x.push(motion.x);
      trail.v.push(motion.v);
      this.grow(motion.x, motion.v);
      if (trail.t.length > KEPT) for (const row of Object.values(trail)) row.splice(0, KEPT / 4);
      if (t < motion.duration) return false;
      motion.closePeriod();
      const gone = motion.periods - this.transient;
      if (gone <= 0) this.left = motion.stretching;
      else {
        this.points.x.push(motion.x);
        this.points.v.push(motion.v);
        this.running.period.push(motion.periods);
        this.running.lambda.push((motion.stretching - this.left) / (gone * motion.duration));
      }
      return true;
    }

    // Number of the first step of the trail that is not before t.
    since(t) {
      let low = 0, high = this.trail.t.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (this.trail.t[middle] < t) low = middle + 1;
        else high = middle;
      }
      return low;
    }
  };
}
