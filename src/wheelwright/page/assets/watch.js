"use strict";
(() => {
  const { colour, degree, element, shown, wheelPath, paintWheel, chart } = parts;
  const at = (id) => document.getElementById(id);
  const micrometre = 1e-6;

  // --- The server -------------------------------------------------------------------------------------

  // The token came behind the # of the address. It stays in this tab and leaves the address bar.
  const handedOver = location.hash.slice(1);
  if (/^[0-9a-f]{64}$/.test(handedOver)) {
    sessionStorage.setItem("token", handedOver);
    history.replaceState(null, "", "/");
  }
  const authorization = { Authorization: `Bearer ${sessionStorage.getItem("token") ?? ""}` };

  class NotAllowed extends Error {}

  async function ask(address, options = {}) {
    const response = await fetch(address, { ...options, headers: authorization, cache: "no-store" });
    if (response.status === 401) throw new NotAllowed();
    return response;
  }

  // Gives the run a command; what became of it comes with the answer.
  async function give(command) {
    try {
      const answer = await (await ask("/command", { method: "POST", body: JSON.stringify(command) })).json();
      tell(answer.text, !answer.obeyed);
      return answer.obeyed;
    } catch {
      tell("the program does not answer", true);
      return false;
    }
  }

  function tell(text, isRefusal) {
    at("message").textContent = text;
    at("message").classList.toggle("refused", isRefusal);
  }

  // --- What is shown ----------------------------------------------------------------------------------

  let frame = null;   // the newest view of the run
  const curve = [];   // [shape, objective, mean travel, run-out, volume fraction] of the shapes so far
  const mostPoints = 4000;

  const states = { starting: "computing the first shape", computing: "optimizing", paused: "paused",
    settled: "no better shape is near; any change goes on from here", ended: "the run has ended" };

  const wheel = at("wheel");

  function scale() {
    const { outer_radius_m } = frame.wheel;
    return 0.47 * wheel.width / outer_radius_m;  // pixels per metre
  }

  function paint() {
    const size = Math.round(wheel.clientWidth * (devicePixelRatio || 1)) || 600;
    if (wheel.width !== size) wheel.width = wheel.height = size;
    const context = wheel.getContext("2d"), unit = scale();
    context.setTransform(1, 0, 0, 1, size / 2, size / 2);
    context.clearRect(-size, -size, 2 * size, 2 * size);
    const edges = new Path2D();
    for (const { in_every_sector, points_um } of frame.outline)
      edges.addPath(wheelPath([points_um], in_every_sector ? frame.wheel.sectors : 1, unit * micrometre));
    context.lineWidth = size / 900;
    paintWheel(context, edges, frame.wheel.inner_radius_m * unit, frame.wheel.outer_radius_m * unit);
  }

  // The numbers: id, label, unit, factor from SI, key of the frame's numbers.
  const numbers = [["objective", "objective", "J/m", 1, "objective_J_per_m"],
    ["volume", "volume", "% of the ring", 100, "volume_fraction"],
    ["travel", "mean travel", "mm", 1e3, "mean_travel"], ["run-out", "run-out", "mm", 1e3, "run_out"],
    ["pressure", "peak pressure", "MPa", 1e-6, "peak_pressure"]];
  for (const [id, label] of [...numbers, ["shape", "shape"]])
    at("numbers").append(element("div", {}, element("dt", {}, label), element("dd", { id: `number-${id}` }, "-")));

  function showNumbers() {
    for (const [id, , unit, factor, key] of numbers)
      at(`number-${id}`).textContent = `${shown(frame.numbers[key] * factor)} ${unit}`;
    at("number-shape").textContent = String(frame.shape);
  }

  function showState() {
    at("state").textContent = states[frame.activity] ?? frame.activity;
    const goes = frame.activity === "computing" || frame.activity === "starting";
    at("go").textContent = goes ? "Pause" : "Go on";
    at("undo").disabled = !frame.can_undo;
    for (const id of ["go", "step", "reset"]) at(id).disabled = frame.activity === "ended";
  }

  // --- Curves -----------------------------------------------------------------------------------------

  const charts = {
    objective: chart("Objective, shape by shape", "shape", "[J/m]", [{ name: "objective", x: [], y: [] }]),
    travel: chart("Travel at this load, round one sector", "azimuth [\u00b0]", "[mm]", [{ name: "travel", x: [], y: [] }]),
    pressure: chart("Contact pressure", "along the ground [mm]", "[MPa]", [{ name: "pressure", x: [], y: [] }]),
    force: chart("Force and travel", "mean travel [mm]", "[N]", [{ name: "force", x: [], y: [] }]),
  };
  for (const { figure, start } of Object.values(charts)) {
    at("charts").append(figure);
    start();
  }

  // Drawing curves takes longer than drawing the wheel: a few times per second is enough.
  const betweenCurves = 250;
  let curvesDrawn = 0, curvesOf = 0;  // when, and of which view
  function showCurves() {
    const { sectors } = frame.wheel, n = frame.travel_m.length;
    charts.objective.update([{ name: "objective", x: curve.map((p) => p[0]), y: curve.map((p) => p[1]) }]);
    charts.travel.update([{ name: "travel", x: [...frame.travel_m, 0].map((_, k) => k * 360 / sectors / n),
      y: [...frame.travel_m, frame.travel_m[0]].map((t) => t * 1e3) }]);
    charts.pressure.update([{ name: "pressure", x: frame.pressure.x_m.map((x) => x * 1e3),
      y: frame.pressure.pressure_Pa.map((p) => p * 1e-6) }]);
    if (frame.force_curve)
      charts.force.update([{ name: "force", x: frame.force_curve.travel_m.map((t) => t * 1e3),
        y: frame.force_curve.force_N }]);
    const position = at("position");
    position.max = n - 1;
    at("position-text").textContent = `ground at ${shown(Number(position.value) * 360 / sectors / n)}\u00b0`;
    curvesDrawn = performance.now();
    curvesOf = frame.version;
  }

  // --- Settings ---------------------------------------------------------------------------------------

  // A slider and a number for the same value. `toSlider` and back map it to 0..1000. What is dragged is sent
  // as soon as the value before it is obeyed.
  function setting(id, label, { toSlider, fromSlider, value, command, digits }) {
    const slider = element("input", { type: "range", min: 0, max: 1000, id, "aria-describedby": `${id}-number` });
    const number = element("input", { type: "number", id: `${id}-number`, step: "any", "aria-label": `${label}, as a number` });
    at("sliders").append(element("div", { class: "setting" }, element("label", { for: id }, label), slider, number));
    let wanted = null, isSending = false, sent = null;
    const send = async () => {
      if (isSending) return;
      isSending = true;
      while (wanted !== null) {
        sent = wanted;
        wanted = null;
        await give(command(sent));
      }
      isSending = false;
    };
    const want = (v) => {
      if (!Number.isFinite(v)) return;
      wanted = v;
      send();
    };
    const rounded = (v) => Number(v.toPrecision(digits));
    slider.addEventListener("input", () => {
      const v = rounded(fromSlider(Number(slider.value)));
      number.value = v;
      want(v);
    });
    number.addEventListener("change", () => {
      if (number.value === "") return;
      slider.value = toSlider(Number(number.value));
      want(Number(number.value));
    });
    // What the run has, unless the user is about to change it.
    return () => {
      if (isSending || document.activeElement === number) return;
      const v = value();
      number.value = rounded(v);
      slider.value = toSlider(v);
    };
  }

  const linear = (low, high) => ({ toSlider: (v) => 1000 * (v - low) / (high - low),
    fromSlider: (s) => low + (high - low) * s / 1000 });
  // 0, and then powers from low to high.
  const powers = (low, high) => ({
    toSlider: (v) => v <= 0 ? 0 : Math.min(1000, Math.max(1, 1000 * Math.log(v / low) / Math.log(high / low))),
    fromSlider: (s) => s === 0 ? 0 : low * (high / low) ** (s / 1000) });

  let settings = null;
  function makeSettings() {
    const force = frame.settings.load.force_N;
    const weight = (id, label, key, low, high) => setting(id, label, { ...powers(low, high), digits: 3,
      value: () => frame.settings.weights[key], command: (v) => ({ do: "weights", [key]: v }) });
    settings = [
      setting("force", "load [N]", { ...linear(0.1 * force, 3 * force), digits: 4,
        value: () => frame.settings.load.force_N,
        command: (v) => ({ do: "load", ...present(frame.settings.load), force_N: v }) }),
      setting("volume", "volume [% of the ring]", { ...linear(20, 95), digits: 3,
        value: () => 100 * frame.settings.volume_target, command: (v) => ({ do: "volume", target: v / 100 }) }),
      weight("stiff", "weight of stiffness", "strain_energy", 0.01, 100),
      weight("even", "weight of even rolling", "uniformity_dual", 1, 1e5),
    ];
  }
  const present = (members) => Object.fromEntries(Object.entries(members).filter(([, v]) => v !== null));

  // --- The run ----------------------------------------------------------------------------------------

  at("go").addEventListener("click", () =>
    give({ do: frame && (frame.activity === "computing" || frame.activity === "starting") ? "pause" : "continue" }));
  at("step").addEventListener("click", () => give({ do: "step" }));
  at("undo").addEventListener("click", () => give({ do: "undo" }));
  at("reset").addEventListener("click", () => give({ do: "reset" }));
  at("position").addEventListener("input", () => look());

  let version = 0, curveVersion = 0, painted = 0, framed = 0;
  let waiting = new AbortController();

  // Asks at once for what is there, e.g. when another load position is to be shown.
  function look() {
    version = curvesDrawn = 0;
    waiting.abort();
  }

  // The curves of the last shape, when no other follows.
  setInterval(() => {
    const isQuiet = frame?.outline && performance.now() - framed > betweenCurves;
    if (isQuiet && curvesOf !== frame.version) look();
  }, betweenCurves);

  async function next() {
    waiting = new AbortController();
    const wantsForces = performance.now() - curvesDrawn > betweenCurves ? 1 : 0;
    const address = `/frame?after=${version}&curve=${curveVersion}&position=${at("position").value}&force_curve=${wantsForces}`;
    const response = await ask(address, { signal: waiting.signal });
    return response.json();
  }

  const painting = () => new Promise((done) => requestAnimationFrame(done));

  function take(news) {
    const isNew = news.version !== frame?.version;
    frame = news;
    framed = performance.now();
    version = curveVersion = news.version;
    curve.push(...news.curve);
    if (curve.length > mostPoints) curve.splice(0, curve.length - mostPoints);
    showState();
    if (!frame.outline) return;
    if (!settings) makeSettings();
    for (const follow of settings) follow();
    paint();
    showNumbers();
    if (frame.force_curve) showCurves();
    if (isNew) wheel.dataset.painted = String(++painted);
    wheel.dataset.shape = String(frame.shape);
    wheel.dataset.version = String(frame.version);
  }

  async function follow() {
    while (frame?.activity !== "ended") {
      try {
        const news = await next();
        await painting();
        take(news);
      } catch (error) {
        if (error instanceof NotAllowed) {
          at("state").textContent = "open the address that the program printed";
          return;
        }
        if (error.name === "AbortError") continue;
        at("state").textContent = "the program does not answer; trying again";
        await new Promise((done) => setTimeout(done, 1000));
      }
    }
  }

  addEventListener("resize", () => { if (frame?.outline) paint(); });
  follow();
})();
