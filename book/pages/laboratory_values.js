// What can be set in the laboratory, what is allowed, and the link that carries it.
"use strict";

function laboratoryValues(leastP, mostP) {
  const finite = { holds: () => true, allowed: "a finite number" };
  const whole = { holds: (value) => Number.isInteger(value) && value >= 0 && value <= 10000, allowed: "a whole number from 0 to 10000" };
  // By name, as in the package and in the link: the paper's sign, words, the step of an arrow key.
  const FIELDS = {
    alpha: { sign: "α", words: "damping coefficient", step: 0.01, holds: (value) => value >= 0, allowed: "a finite number ≥ 0" },
    p: { sign: "p", words: "damping exponent", step: 0.1, holds: (value) => value >= leastP && value <= mostP, allowed: `a number from ${leastP} to ${mostP}` },
    mu: { sign: "μ", words: "forcing amplitude", step: 0.01, ...finite },
    omega: { sign: "ω", words: "forcing frequency", step: 0.01, holds: (value) => value > 0, allowed: "a finite number > 0" },
    delta: { sign: "δ", words: "linear stiffness", step: 0.1, ...finite },
    gamma: { sign: "γ", words: "cubic stiffness", step: 0.1, ...finite },
    x: { sign: "x₀", words: "position", step: 0.01, ...finite },
    v: { sign: "v₀", words: "velocity", step: 0.01, ...finite },
    transient: { sign: "", words: "transient, in periods", step: 1, ...whole },
    periods: { linked: true, ...whole }, // how far the motion has been computed: only a link carries it
  };

  // The number that a text means; else an error whose message names the value and says what is allowed.
  function checked(name, text) {
    const field = Object.hasOwn(FIELDS, name) ? FIELDS[name] : null;
    if (!field) throw new RangeError(`${name} = ${text}: the name must be one of ${Object.keys(FIELDS).join(", ")}`);
    const written = text.trim().replace("−", "-"), value = written === "" ? NaN : Number(written);
    if (!Number.isFinite(value) || !field.holds(value)) throw new RangeError(`${name} = ${written || "(nothing)"}: must be ${field.allowed}`);
    return value;
  }

  const fragment = (values) => `#${new URLSearchParams(values)}`;

  // What a link carries, over the values given, and the sentence on the first of it that is wrong ("" if none is).
  function linked(hash, values) {
    const found = { ...values };
    let wrong = "";
    for (const [name, text] of new URLSearchParams(hash.slice(1))) {
      try {
        found[name] = checked(name, text);
      } catch (error) {
        wrong ||= error.message;
      }
    }
    return { found, wrong };
  }

  return { FIELDS, checked, fragment, linked };
}
