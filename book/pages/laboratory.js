// One solution of  x'' + alpha x'|x'|^(p-1) + delta x + gamma x^3 = mu cos(omega t)  and one tangent vector.
//
// The method is the package's, for a single trajectory forward in time: Dormand and Prince's pair of order 8 in
// friction time (equations, dop853, step_control there), Radau's of order 9 in a creep (laboratory_creep.js). The
// coefficients come from SciPy and the package as `table` (laboratory.py): no digit of them stands here.
//
//     v = sign(w) |w|^m,    dt/ds = phi = m |w|^(m-1),    m = n / p,    ds = dsigma / (m + phi)
//     dx/ds = phi v,        dw/ds = F(x, t) - alpha w^n,  F = -delta x - gamma x^3 + mu cos(omega t)
//     dxi/ds = phi eta,     deta/ds = phi F_x xi - alpha n |w|^(n-1) eta
"use strict";

function duffingIntegrator(table) {
  const T = 0, X = 1, W = 2, XI = 3, ETA = 4, SIZE = 5; // rows of a state: time within the period, x, w, tangent
  const LAST = table.explicit.length; // stages of an explicit step; its last row leads to the new point
  const creepStep = duffingCreep(table);
  const SWITCH = 0.6, LEAVE = 1 / 3, SLOW = 0.3, FRESH = 0.7, SMOOTHNESS = 8, ALONG = 0.01; // as in the package
  const MOST_STEPS = 100000, ESCAPED = 1e30;

  class Motion {
    // parameters: {alpha, p, mu, omega, delta, gamma}; (x, v): the initial condition at t = 0, the tangent (1, 0).
    constructor(parameters, x, v, rtol = 1e-12, atol = 1e-14) {
      Object.assign(this, parameters, { rtol, atol });
      this.duration = 2 * Math.PI / this.omega;
      const resting = this.p > 1 && this.atRest(x, this.force(x, 0), v); // w would stay what it is for ever
      const smooth = this.alpha === 0 || this.p % 2 === 1 || resting;
      this.n = this.alpha === 0 ? 1 : smooth ? this.p : 2 * Math.ceil(Math.max((SMOOTHNESS + 1) * this.p - 1, 0) / 2) + 1;
      this.m = smooth ? 1 : this.n / this.p; // m - 1 is the number of derivatives of phi at w = 0
      this.state = Float64Array.of(0, x, Math.sign(v) * Math.abs(v) ** (1 / this.m), 1, 0);
      this.next = new Float64Array(SIZE);
      this.slopes = Array.from({ length: LAST + 1 }, () => new Float64Array(SIZE));
      this.periods = 0; // whole forcing periods gone
      this.stretching = 0; // logarithm of the tangent's growth up to its last normalisation
      this.h = 0.05 / this.omega; // the next step in sigma
      this.creep = 0; // the next step in time while the mass creeps, else 0
      this.rejected = false;
      this.steps = 0; // attempted since the last target
      this.slope(this.state, this.slopes[0]);
    }

    get x() { return this.state[X]; }
    get v() { return this.velocity(this.state[W]); }
    get time() { return this.periods + this.state[T] / this.duration; } // in forcing periods

    velocity(w) { return Math.abs(w) ** (this.m - 1) * w; }
    force(x, t) { return -x * (this.gamma * x * x + this.delta) + this.mu * Math.cos(this.omega * t); }
    stiffness(x) { return -(3 * this.gamma * x * x + this.delta); }

    // Whether force and damping (divided by alpha: Y) are both below the rounding error of the force.
    atRest(x, F, Y) {
      const noise = 1e-13 * (Math.abs(this.delta * x) + Math.abs(this.gamma * x * x * x) + Math.abs(this.mu));
      return this.alpha > 0 && Math.abs(F) <= noise && this.alpha * Math.abs(Y) <= noise;
    }

    // To the end of the forcing period: exactly, and the tangent vector is normalised there.
    toPeriod() {
      while (this.step(this.duration) < this.duration);
      this.closePeriod();
    }

    closePeriod() {
      this.periods += 1;
      this.state[T] = 0;
      this.normalise();
      this.slope(this.state, this.slopes[0]);
      this.steps = 0;
    }

    normalise() {
      const size = Math.hypot(this.state[XI], this.state[ETA]);
      this.stretching += Math.log(size);
      this.state[XI] /= size;
      this.state[ETA] /= size;
    }

    // One accepted step, ended at the time `end` of this period; returns the time reached.
    step(end) {
      do {
        if (this.steps >= MOST_STEPS) throw new RangeError("more steps are needed than are allowed for one forcing period");
      } while (!(this.creep > 0 ? this.creepStep(end) : this.explicitStep(end)));
      if (!(Math.abs(this.x) < ESCAPED)) throw new RangeError("the solution leaves every bound");
      return this.state[T];
    }

    // ---- explicit steps: friction time where v is small, time where it is large

    slope(y, k) {
      const size = Math.abs(y[W]), speed = size ** (this.m - 1), damping = size ** (this.n - 1);
      const phi = this.m * speed, pace = this.m === 1 ? 1 : 1 / (this.m + phi);
      k[T] = phi * pace;
      k[X] = k[T] * speed * y[W];
      k[W] = (this.force(y[X], y[T]) - this.alpha * damping * y[W]) * pace;
      k[XI] = k[T] * y[ETA];
      k[ETA] = k[T] * this.stiffness(y[X]) * y[XI] - this.relaxation(y[W]) * y[ETA];
    }

    // Rate at which the damping force relaxes, per sigma.
    relaxation(w) {
      const size = Math.abs(w), pace = this.m === 1 ? 1 : 1 / (this.m + this.m * size ** (this.m - 1));
      return this.alpha * this.n * size ** (this.n - 1) * pace;
    }

    // `next` = the state after a step of h in sigma, the last of the slopes = those there.
    attempt(h) {
      for (let stage = 1; stage <= LAST; stage++) {
        const row = table.explicit[stage - 1];
        for (let i = 0; i < SIZE; i++) {
          let total = 0;
          for (let j = 0; j < stage; j++) total += row[j] * this.slopes[j][i];
          this.next[i] = this.state[i] + h * total;
        }
        this.slope(this.next, this.slopes[stage]);
      }
      this.steps += 1;
    }

    // Estimated error of the attempt, 1 = just tolerable: of x and v at fixed time, relative to the state's length.
    error(h) {
      const end = this.slopes[LAST], v = this.velocity(this.next[W]);
      const phi = this.m * Math.abs(this.next[W]) ** (this.m - 1);
      const acceleration = this.m === 1 ? 0 : end[W] * (this.m + phi);
      const squares = (weights) => {
        const sum = (i) => weights.reduce((total, weight, j) => total + weight * this.slopes[j][i], 0);
        const t = this.m === 1 ? 0 : sum(T), w = sum(W);
        // An error of w alone displaces the point along its orbit where time hardly runs: it counts less.
        return (sum(X) - v * t) ** 2 + (phi * w - acceleration * t) ** 2 + (ALONG * w) ** 2;
      };
      const fifth = squares(table.error5), both = fifth + 0.01 * squares(table.error3);
      const scale = this.atol + this.rtol * Math.hypot(this.x, this.v);
      if (!(both < Infinity)) return Infinity;
      return both === 0 ? 0 : Math.abs(h) * fifth / (scale * Math.sqrt(both));
    }

    explicitStep(end) {
      const smooth = this.m === 1, h = smooth ? Math.min(this.h, end - this.state[T]) : this.h;
      this.attempt(h);
      const e = this.error(h), factor = 0.9 * e ** (-1 / 8);
      if (!(e <= 1)) {
        this.h = h * Math.max(0.2, factor);
        this.rejected = true;
        return false;
      }
      const arrives = this.next[T] >= end - slack(end), k = this.slopes[LAST];
      const rate = this.relaxation(this.next[W]);
      // The tangent vector has no estimate of its own: a step is at most part of the linearised motion's fastest time.
      const fresh = FRESH / (Math.sqrt(Math.abs(this.stiffness(this.next[X]))) * k[T] + rate);
      if (!arrives) this.h = Math.min(h * Math.min(factor, this.rejected ? 1 : 6), fresh);
      this.rejected = false;
      if (arrives) this.land(end, h);
      this.state.set(this.next);
      if (arrives) this.slope(this.state, this.slopes[0]);
      else this.slopes[0].set(k);
      if (!arrives && this.p < 1 && this.alpha > 0 && this.creeps(rate, k)) {
        this.creep = Math.max(this.h * k[T], 1e-6 / this.omega);
      }
      return true;
    }

    // The step that passes `end` is repeated with the length that ends there: Newton's iteration inside a bracket.
    land(end, h) {
      const k = this.slopes[LAST], small = 1e-9 * h;
      let near = 0, far = h;
      for (;;) {
        const miss = end - this.next[T], correction = miss / k[T];
        if (Math.abs(miss) <= slack(end) || far - near <= 1e-14 * far) break;
        if (Math.abs(correction) <= small) {
          for (let i = 0; i < SIZE; i++) this.next[i] += correction * k[i];
          break;
        }
        if (miss > 0) near = h;
        else far = h;
        h += correction;
        if (!(near < h && h < far)) h = (near + far) / 2;
        this.attempt(h);
      }
      this.next[T] = end;
    }

    // ---- creep: |F| < alpha, the damping force Y follows F / alpha, and friction time would diverge

    creeps(rate, k) {
      const w = this.state[W], slow = Math.abs(k[W]) < SLOW * rate * Math.abs(w) / this.n;
      return (slow && rate * this.h > SWITCH) || this.restsNow();
    }

    restsNow() {
      const F = this.force(this.x, this.state[T]);
      return this.atRest(this.x, F, this.dampingForce());
    }

    dampingForce() { return Math.abs(this.state[W]) ** (this.n - 1) * this.state[W]; }

    creepStep(end) {
      const Y = this.dampingForce(), left = end - this.state[T], resting = this.restsNow();
      const h = Math.min(this.creep, left, this.duration / 16); // no passage of F through zero is overlooked
      let { error, state, Y: reached, passages } = creepStep(this, this.state, Y, h);
      this.steps += 1;
      // A turn, or a passage in finite friction time: for explicit steps to resolve.
      if (!(resting && this.p > 0.5) && (passages < 0 || (passages > 0 && this.p > 0.5))) error = Infinity;
      const accepted = error <= 1, factor = error > 0 ? Math.min(4, 0.9 * error ** (-1 / 6)) : 4;
      if (accepted) {
        this.state.set(state);
        this.state[W] = Math.sign(reached) * Math.abs(reached) ** (1 / this.n);
        this.normalise();
        this.creep = factor < 1 ? h * factor : Math.max(this.creep, h * factor); // h may have been cut
        if (h === left) this.state[T] = end;
      } else this.creep = h * Math.max(0.2, factor);
      const phi = this.m * Math.abs(this.state[W]) ** (this.m - 1);
      const rate = this.alpha * this.n * Math.abs(this.state[W]) ** (this.n - 1); // times the step in time: over phi
      if (this.creep * rate < LEAVE * SWITCH * phi && !resting) {
        this.h = this.creep / phi * (this.m + phi);
        this.creep = 0;
        this.slope(this.state, this.slopes[0]);
      }
      return accepted;
    }
  }

  const slack = (target) => 4e-16 * Math.max(1, Math.abs(target));

  return Motion;
}
