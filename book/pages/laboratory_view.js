// The laboratory's controls: what a reader asks for, computed in slices of a frame and drawn.
"use strict";

(function () {
  const find = (name) => document.getElementById(`laboratory-${name}`);
  const root = document.getElementById("laboratory"), given = JSON.parse(find("data").textContent);
  const Motion = duffingIntegrator(given.table), Run = laboratoryRun(Motion);
  const pictures = laboratoryPictures(find, given.scan, given.threshold);
  const { FIELDS, checked, fragment, linked } = laboratoryValues(given.least_p, given.most_p);
  const SHOWN = Object.keys(FIELDS).filter((name) => !FIELDS[name].linked);
  const BUDGET = 8; // milliseconds of a frame for the integration: half of it at 60 frames a second
  const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 20, 50, Infinity]; // forcing periods a second
  const MOST = 50000; // periods whose points are kept
  const less = matchMedia("(prefers-reduced-motion: reduce)");

  let values, run; // what is set, and its motion
  let wanted = false, visible = true, failed = ""; // asked to run; in sight; why the run cannot go on
  let goal = Infinity, queue = [], scanned = 0; // a period to run to at full speed; values of mu yet to be run; all of them
  let exponents = { key: "", mu: [], lambda: [] }; // of finished runs that differ in mu alone
  let request = 0, last = 0, drawnAt = 0;
  const frames = []; // how long the last frames took, in milliseconds

  // ---- running

  // Take up values from t = 0 on, running at the speed chosen, or at full speed to a period, or for each mu.
  function begin(changes, to = Infinity, mus = []) {
    values = { ...values, ...changes };
    [queue, scanned] = [mus.slice(1), mus.length];
    start(mus.length ? { mu: mus[0] } : {}, to);
    [wanted, failed] = [to > 0, ""];
    say("");
    wake();
    draw(true);
  }

  function start(changes, to) {
    values = { ...values, ...changes };
    [run, goal] = [new Run(values), to];
    const { mu, ...rest } = values, key = JSON.stringify(rest);
    if (key !== exponents.key) exponents = { key, mu: [], lambda: [] };
    for (const name of SHOWN) {
      find(name).value = values[name];
      find(name).removeAttribute("aria-invalid");
    }
  }

  function stop(words) {
    [wanted, queue, scanned] = [false, [], 0];
    say(words);
    wake();
  }

  function fail(words) {
    stop(words);
    failed = words;
    say(words, true);
  }

  // One step; what the end of a period brings.
  function advance() {
    try {
      if (!run.advance()) return;
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      fail(`After ${run.time.toFixed(2)} periods ${error.message}: the computation ends here.`);
      return;
    }
    if (run.periods === given.periods && run.lambda !== undefined) {
      exponents.mu.push(values.mu);
      exponents.lambda.push(run.lambda);
    }
    if (run.periods === goal && queue.length) start({ mu: queue.shift() }, goal);
    else if (run.periods === goal) stop(scanned ? `The scan is finished: ${scanned} values of μ.` : `Paused after ${run.periods} periods.`);
    else if (run.periods === MOST) fail(`${MOST} periods are computed: no more are kept.`);
  }

  // What a frame of so many seconds may compute: to where the clock is, and no longer than its budget.
  function compute(seconds) {
    const from = performance.now(), full = goal < Infinity, until = run.time + seconds * SPEEDS[find("speed").value];
    while (wanted && (full || run.time < until) && performance.now() - from < BUDGET) advance();
  }

  const goes = () => wanted && visible && !document.hidden;

  function wake() {
    find("run").textContent = wanted ? "Pause" : "Run";
    if (request || !goes()) return;
    last = performance.now();
    request = requestAnimationFrame(frame);
  }

  function frame(now) {
    request = 0;
    if (!goes()) return;
    const from = performance.now();
    compute(Math.min(Math.max(now - last, 0), 100) / 1000);
    last = now;
    // Who asks for less motion sees a new picture once a second.
    if (!less.matches || !wanted || now - drawnAt > 1000) draw();
    frames.push(performance.now() - from);
    if (frames.length > 240) frames.shift();
    if (goes()) request = requestAnimationFrame(frame);
  }

  // ---- showing

  function say(words, wrong = false) {
    find("says").textContent = words;
    find("says").classList.toggle("wrong", wrong);
  }

  function draw(anew = false) {
    drawnAt = performance.now();
    if (anew) pictures.forget();
    pictures.draw(run, values, exponents, wanted);
    const { motion, lambda } = run, number = (value, digits) => value.toFixed(digits).replace("-", "−");
    find("periods").textContent = run.periods;
    find("t").textContent = number(run.time * motion.duration, 1);
    find("x-now").textContent = number(motion.x, 4);
    find("v-now").textContent = number(motion.v, 4);
    find("exponent").textContent = lambda === undefined ? "–" : number(lambda, 4);
  }

  // ---- controls

  // All fields as they stand, or null after the sentence that says which of them is wrong.
  function read() {
    const found = {};
    let wrong = "";
    for (const name of SHOWN) {
      try {
        found[name] = checked(name, find(name).value);
        find(name).removeAttribute("aria-invalid");
      } catch (error) {
        wrong ||= error.message;
        find(name).setAttribute("aria-invalid", "true");
      }
    }
    if (wrong) fail(`${wrong}.`);
    return wrong ? null : found;
  }

  function take(changes = {}, to = Infinity, mus = []) {
    const found = read();
    if (found) begin({ ...found, ...changes }, to, mus);
  }

  function nudge(event) {
    const steps = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key], value = Number(event.target.value);
    if (event.key === "Enter") take();
    if (!steps || !Number.isFinite(value)) return;
    event.preventDefault();
    event.target.value = +(value + steps * FIELDS[event.target.name].step).toFixed(6);
    take();
  }

  for (const name of SHOWN) {
    const { sign, words, step } = FIELDS[name], label = document.createElement("label");
    // A telephone's keyboard of digits has no minus sign: only for what is never negative.
    const keys = step === 1 ? "numeric" : ["alpha", "p", "omega"].includes(name) ? "decimal" : "text";
    label.innerHTML = `<span><i>${sign}</i> ${words}</span><input id="laboratory-${name}" name="${name}" inputmode="${keys}" aria-describedby="laboratory-says">`;
    find(["x", "v", "transient"].includes(name) ? "initial" : "parameters").append(label);
    find(name).addEventListener("change", () => take());
    find(name).addEventListener("keydown", nudge);
  }
  find("form").addEventListener("submit", (event) => event.preventDefault());

  for (const { name, values: wished, periods, scan } of given.presets) {
    const button = document.createElement("button");
    [button.type, button.textContent] = ["button", name];
    button.addEventListener("click", () => begin(wished, periods, scan ? given.scan : []));
    find("presets").append(button);
  }

  find("run").addEventListener("click", () => {
    if (wanted) stop("Paused.");
    else if (failed) read() && fail(failed);
    else {
      [wanted, goal] = [true, Infinity];
      say("");
    }
    wake();
    draw();
  });
  find("period").addEventListener("click", () => {
    if (failed) return;
    stop("");
    for (const end = run.periods + 1; run.periods < end && !failed;) advance();
    draw();
  });
  find("restart").addEventListener("click", () => take());
  find("adopt").addEventListener("click", () => {
    // At the end of a period the forcing is where it was at t = 0: from there on the motion is the same.
    stop("");
    while (!Number.isInteger(run.time) && !failed) advance();
    if (!failed) take({ x: run.motion.x, v: run.motion.v });
  });
  find("scan").addEventListener("click", () => take({}, given.periods, given.scan));
  find("link").addEventListener("click", async () => {
    history.replaceState(null, "", fragment({ ...values, periods: run.periods }));
    say("The address of this page now carries this state.");
    await navigator.clipboard?.writeText(location.href).then(() => say("The address of this page now carries this state, and is copied."), () => null);
  });

  for (const plane of pictures.planes) {
    plane.canvas.addEventListener("click", (event) => {
      const at = plane.under(event);
      if (at) take({ x: +at[0].toFixed(3), v: +at[1].toFixed(3) });
    });
  }

  const speed = find("speed");
  function pace() {
    const chosen = SPEEDS[speed.value];
    find("pace").textContent = chosen === Infinity ? "as fast as it goes" : `${chosen} ${chosen === 1 ? "period" : "periods"} a second`;
    speed.setAttribute("aria-valuetext", find("pace").textContent);
    goal = queue.length ? goal : Infinity; // a scan keeps its own pace
  }
  [speed.max, speed.value] = [SPEEDS.length - 1, 3];
  speed.addEventListener("input", pace);
  pace();

  // ---- the link, what is in sight, widths and colours

  function load() {
    const [{ values: first, periods: most }] = given.presets, carried = location.hash.includes("=");
    const { found, wrong } = carried ? linked(location.hash, { ...first, transient: 0, periods: 0 }) : { found: { ...first, periods: most }, wrong: "" };
    const { periods, ...rest } = found;
    begin(rest, periods);
    if (wrong) fail(`The link is not taken as it stands. ${wrong}.`);
    if (carried) root.scrollIntoView();
  }

  new IntersectionObserver((entries) => {
    visible = entries.at(-1).isIntersecting;
    wake();
  }).observe(root);
  document.addEventListener("visibilitychange", wake);
  addEventListener("hashchange", () => location.hash.includes("=") && load());
  load();
  new ResizeObserver(() => draw(true)).observe(root);
  new MutationObserver(() => draw(true)).observe(document.documentElement, { attributeFilter: ["data-theme"] });

  // For tests, and for whoever looks at it from the console.
  window.laboratory = { Motion, frames, get run() { return run; }, get exponents() { return exponents; }, get goes() { return goes(); } };
})();
