// One step of a creep: Radau's method with five stages in time, the damping force Y = sign(v) |v|^p as the unknown.
//
// Where |F| < alpha the damping force relaxes to F / alpha and friction time can diverge. The integrated equations
//
//     x(t) = x0 + integral of v(Y) dt,    v(Y(t)) = v(Y0) + integral of (F(x, t) - alpha Y) dt
//
// hold no singular coefficient. As in the package (radau), which says where the method and its estimate come from.
"use strict";

function duffingCreep(table) {
  const A = table.implicit, STAGES = A.length, SLOW = 0.3; // near the slow branch |F - alpha Y| < SLOW |F|

  // From the state [t, x, w, xi, eta], whose damping force is Y0, a step of h: the state there (its w is left 0), the
  // damping force, the estimated error (1 = just tolerable, infinite: the iteration failed) and the passages of Y
  // through zero (-1 if the force is not zero there: a turn, no creep).
  return function creepStep(osc, [t0, x0, , xi0, eta0], Y0, h) {
    const r = 1 / osc.p, n = STAGES + 1;
    const [Y, v, phi, x, F, spring] = Array.from({ length: 6 }, () => new Float64Array(n));
    [Y[0], x[0], F[0]] = [Y0, x0, osc.force(x0, t0)];

    // Entries 1 to 5 of all but Y from the damping force at the stages.
    function stages() {
      for (let i = 0; i < n; i++) {
        phi[i] = r * Math.abs(Y[i]) ** (r - 1);
        v[i] = phi[i] * Y[i] / r;
      }
      for (let i = 1; i < n; i++) {
        x[i] = x0 + h * dot(A[i - 1], v);
        F[i] = osc.force(x[i], t0 + h * table.nodes[i - 1]);
        spring[i] = osc.stiffness(x[i]);
      }
    }

    // What the integrated equation for v leaves over, and its derivative by Y at the stages.
    function residual() {
      const net = F.map((force, i) => force - osc.alpha * Y[i]);
      return A.map((row, i) => v[0] - v[i + 1] + h * dot(row, net));
    }
    function jacobian() {
      return A.map((row, i) => row.map((weight, j) => {
        let mixed = 0;
        for (let k = 0; k < STAGES; k++) mixed += row[k] * spring[k + 1] * A[k][j];
        return (i === j ? phi[i + 1] : 0) + h * osc.alpha * weight - h * h * mixed * phi[j + 1];
      }));
    }

    const v0 = Math.sign(Y0) * Math.abs(Y0) ** r;
    for (let i = 1; i < n; i++) {
      const c = h * table.nodes[i - 1];
      Y[i] = Y0 + (osc.force(x0 + c * v0, t0 + c) - F[0]) / osc.alpha;
    }
    let J, converged = false;
    for (let iteration = 0; iteration < 30 && !converged; iteration++) {
      stages();
      J = jacobian();
      const change = solve(J, residual());
      const largest = Math.max(...Y.subarray(1).map(Math.abs));
      change.forEach((value, i) => { Y[i + 1] += value; });
      converged = Math.max(...change.map(Math.abs)) <= 1e-10 * largest;
    }
    if (!converged) return { state: null, Y: Y0, error: Infinity, passages: 0 };
    stages();

    const tangent = solve(J, A.map((row) => eta0 + h * xi0 * dot(row, spring)));
    const flow = Float64Array.from(phi, (value, i) => i && value * tangent[i - 1]);
    const state = [t0 + h, x[STAGES], 0, xi0 + h * dot(A[STAGES - 1], flow), flow[STAGES]];

    let passages = signChanges(Y);
    const slow = osc.p < 0.5 ? SLOW : 1; // at p = 1/2 the passage is never nearer to the slow branch than its start
    if (passages > 0 && (passages !== signChanges(F) || Math.abs(F[0] - osc.alpha * Y0) > slow * Math.abs(F[0]))) passages = -1;

    const ex = h * dot(table.difference, v, 0), net = F.map((force, i) => force - osc.alpha * Y[i]);
    // The relaxation damps what the estimate sees of an error in v.
    const ev = h * dot(table.difference, net, 0) * phi[STAGES] / (phi[STAGES] + 0.1 * h * osc.alpha);
    return { state, Y: Y[STAGES], error: Math.hypot(ex, ev) / (osc.atol + osc.rtol * Math.hypot(x0, v[0])), passages };
  };

  // The sum of weights times values, by default of the stages (entries 1 to 5).
  function dot(weights, values, first = 1) {
    let total = 0;
    for (let i = 0; i < weights.length; i++) total += weights[i] * values[i + first];
    return total;
  }

  // Sign changes over a step of the polynomial with these values at its start and its stages.
  function signChanges(values) {
    const along = [values[0], ...table.fine.map((row) => dot(row, values, 0)), values[STAGES]];
    return along.filter((value, i) => i > 0 && value * along[i - 1] < 0).length;
  }

  // The solution of J y = b by elimination with exchange of rows; J is kept.
  function solve(J, b) {
    const rows = J.map((row, i) => [...row, b[i]]), size = b.length;
    for (let k = 0; k < size; k++) {
      let best = k;
      for (let i = k + 1; i < size; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
      [rows[k], rows[best]] = [rows[best], rows[k]];
      for (let i = k + 1; i < size; i++) {
        const factor = rows[i][k] / rows[k][k];
        for (let j = k; j <= size; j++) rows[i][j] -= factor * rows[k][j];
      }
    }
    for (let k = size - 1; k >= 0; k--) {
      for (let j = k + 1; j < size; j++) rows[k][size] -= rows[k][j] * rows[j][size];
      rows[k][size] /= rows[k][k];
    }
    return rows.map((row) => row[size]);
  }
}
