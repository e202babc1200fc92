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
    if (!frame.outline) return;
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
    paintEdit(context, unit);
  }

  // --- Editing ----------------------------------------------------------------------------------------

  const tools = [["look", "look", "Choose what to do with the holes. All sectors change alike."],
    ["move", "move", "Drag a hole. With the keys: arrows, Enter to take it, arrows, Enter to drop it."],
    ["resize", "resize", "Drag away from a hole's centre or towards it. With the keys: arrows, Enter, arrows, Enter."],
    ["add", "add", "Drag from the centre of the new hole outwards, or click. With the keys: arrows, Enter, Enter."],
    ["fill", "delete", "Click into a hole to fill it. With the keys: arrows, Enter, or Delete with any tool."],
    ["paint", "paint material", "Draw with the mouse. With the keys: arrows, Enter, arrows, Enter."],
    ["erase", "erase material", "Draw with the mouse. With the keys: arrows, Enter, arrows, Enter."]];
  const brushes = { paint: "material", erase: "hole" };
  for (const [id, label] of tools)
    at("tools").append(element("label", {}, element("input",
      { type: "radio", name: "tool", value: id, id: `tool-${id}`, ...(id === "look" ? { checked: "" } : {}) }), label));
  const tip = element("input", { type: "range", id: "tip", min: 2, max: 40, value: 10 });
  at("tools").append(element("label", { class: "size" }, "tip", tip));
  const tool = () => document.querySelector("input[name=tool]:checked").value;
  const help = () => { at("wheel-help").textContent = tools.find(([id]) => id === tool())[2]; };
  at("tools").addEventListener("change", help);
  help();

  let edit = null;    // { tool, from, to, path, hole } while the user draws, in metres
  let cursor = null;  // where the keys point

  const turned = ([x, y], angle) => [Math.cos(angle) * x - Math.sin(angle) * y, Math.sin(angle) * x + Math.cos(angle) * y];
  const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

  function isInside(points, [x, y]) {
    let inside = false;
    for (let i = 0, j = points.length - 1; i < points.length; j = i++)
      if ((points[i][1] > y) !== (points[j][1] > y) &&
          x < (points[j][0] - points[i][0]) * (y - points[i][1]) / (points[j][1] - points[i][1]) + points[i][0])
        inside = !inside;
    return inside;
  }

  // The edge of the hole round a point, with its centre.
  function holeAt(point) {
    for (const { in_every_sector, points_um } of frame.outline) {
      const n = in_every_sector ? frame.wheel.sectors : 1;
      for (let s = 0; s < n; ++s) {
        const angle = 2 * Math.PI * s / n, edge = [];
        for (let k = 0; k < points_um.length; k += 2)
          edge.push(turned([points_um[k] * micrometre, points_um[k + 1] * micrometre], angle));
        if (!isInside(edge, point) || isInside(edge, [0, 0])) continue;
        const sum = edge.reduce(([a, b], [x, y]) => [a + x, b + y], [0, 0]);
        return { edge, centre: sum.map((v) => v / edge.length) };
      }
    }
    return null;
  }

  const holeTools = ["move", "resize", "fill"];
  const tipRadius = () => Number(tip.value) * 1e-3;
  const factorOf = ({ from, to, hole }) =>
    Math.min(5, Math.max(0.2, distance(to, hole.centre) / Math.max(1e-3, distance(from, hole.centre))));
  const addedRadius = ({ from, to }) => Math.max(tipRadius(), distance(from, to));

  function begin(point) {
    const kind = tool();
    if (kind === "look" || !frame?.outline) return;
    const hole = holeTools.includes(kind) ? holeAt(point) : null;
    if (holeTools.includes(kind) && !hole) {
      tell("there is no hole here", true);
      return;
    }
    edit = { tool: kind, from: point, to: point, path: [point], hole };
    if (kind === "fill") finish();
    else paint();
  }

  function go(point) {
    if (edit.isGiven) return;
    edit.to = point;
    const least = Math.max(0.3 * tipRadius(), 1e-3);
    if (edit.tool in brushes && distance(point, edit.path.at(-1)) > least && edit.path.length < 200) edit.path.push(point);
    paint();
  }

  // Gives the command of what was drawn. It stays on the picture until the shape has it.
  async function finish() {
    const done = edit, { from, to } = done;
    const by = [to[0] - from[0], to[1] - from[1]];
    const command = {
      move: () => ({ do: "move_hole", at_m: from, by_m: by, scale: 1 }),
      resize: () => ({ do: "move_hole", at_m: from, by_m: [0, 0], scale: factorOf(done) }),
      add: () => ({ do: "paint", as: "hole", path_m: [from], radius_m: addedRadius(done) }),
      fill: () => ({ do: "fill_hole", at_m: from }),
      paint: () => ({ do: "paint", as: "material", path_m: done.path, radius_m: tipRadius() }),
      erase: () => ({ do: "paint", as: "hole", path_m: done.path, radius_m: tipRadius() }),
    }[done.tool]();
    done.isGiven = true;
    await give(command);
    if (edit === done) edit = null;
    paint();
  }

  function editPath({ tool: kind, from, to, hole }, unit) {
    const pixels = ([x, y]) => [x * unit, -y * unit], path = new Path2D();
    const loop = (points) => {
      points.map(pixels).forEach(([x, y], k) => k ? path.lineTo(x, y) : path.moveTo(x, y));
      path.closePath();
    };
    if (kind === "move") loop(hole.edge.map(([x, y]) => [x + to[0] - from[0], y + to[1] - from[1]]));
    if (kind === "resize") {
      const f = factorOf(edit), [cx, cy] = hole.centre;
      loop(hole.edge.map(([x, y]) => [cx + f * (x - cx), cy + f * (y - cy)]));
    }
    if (kind === "add") path.arc(...pixels(from), addedRadius(edit) * unit, 0, 2 * Math.PI);
    return path;
  }

  function paintEdit(context, unit) {
    const { sectors } = frame.wheel;
    context.save();
    context.strokeStyle = colour("--bad");
    context.lineWidth = wheel.width / 400;
    if (edit) {
      const isBrush = edit.tool in brushes, path = isBrush ? new Path2D() : editPath(edit, unit);
      if (isBrush) {
        edit.path.forEach(([x, y], k) => k ? path.lineTo(x * unit, -y * unit) : path.moveTo(x * unit, -y * unit));
        path.lineTo(edit.path[0][0] * unit + (edit.path.length === 1 ? 0.01 : 0), -edit.path[0][1] * unit);
        context.lineWidth = 2 * tipRadius() * unit;
        context.lineCap = context.lineJoin = "round";
        context.strokeStyle = colour(edit.tool === "paint" ? "--accent" : "--bad");
        context.globalAlpha = 0.5;
      } else {
        context.setLineDash([6, 4]);
      }
      for (let s = 0; s < sectors; ++s) {
        context.stroke(path);
        context.rotate(2 * Math.PI / sectors);
      }
    }
    context.restore();
    if (!cursor || document.activeElement !== wheel) return;
    context.save();
    context.strokeStyle = colour("--ink");
    context.lineWidth = wheel.width / 300;
    const [x, y] = [cursor[0] * unit, -cursor[1] * unit], size = wheel.width / 60;
    context.stroke(new Path2D(`M${x - size} ${y}H${x + size}M${x} ${y - size}V${y + size}`));
    context.restore();
  }

  function pointOf(event) {
    const box = wheel.getBoundingClientRect(), unit = scale() * box.width / wheel.width;
    return [(event.clientX - box.left - box.width / 2) / unit, -(event.clientY - box.top - box.height / 2) / unit];
  }

  wheel.addEventListener("pointerdown", (event) => {
    if (!frame?.outline || edit) return;
    wheel.setPointerCapture(event.pointerId);
    cursor = null;
    begin(pointOf(event));
  });
  wheel.addEventListener("pointermove", (event) => {
    if (edit && event.buttons) go(pointOf(event));
  });
  wheel.addEventListener("pointerup", (event) => {
    if (!edit || edit.isGiven) return;
    go(pointOf(event));
    finish();
  });
  wheel.addEventListener("pointercancel", () => { edit = null; });

  wheel.addEventListener("keydown", (event) => {
    if (!frame?.outline) return;
    const step = event.shiftKey ? 0.01 : 0.002;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const { inner_radius_m, outer_radius_m } = frame.wheel;
    if (event.key in moves) {
      const middle = (inner_radius_m + outer_radius_m) / 2, first = Math.PI / frame.wheel.sectors;
      cursor = cursor ? [cursor[0] + moves[event.key][0], cursor[1] + moves[event.key][1]]
        : [middle * Math.cos(first), middle * Math.sin(first)];
      if (edit) go(cursor);
    } else if (event.key === "Enter" || event.key === " ") {
      if (edit && !edit.isGiven) finish();
      else if (!edit && cursor) begin(cursor);
    } else if (event.key === "Escape") {
      edit = null;
    } else if (event.key === "Delete" && cursor) {
      give({ do: "fill_hole", at_m: cursor });
    } else {
      return;
    }
    event.preventDefault();
    paint();
  });

  // --- The loaded wheel -------------------------------------------------------------------------------

  let loaded = null;  // { version, paint, drawGround, lose, positions }
  let rolling = null, isLoading = false;
  const loadedEvery = 1500;  // ms

  async function loadWheel() {
    if (isLoading || !frame?.wheel) return;
    isLoading = true;
    const version = frame.version;
    try {
      const fields = await (await ask("/loaded")).json();
      const picture = element("canvas", { role: "img", "aria-label": "The loaded wheel, coloured by von Mises stress" });
      const ground = element("canvas", { "aria-hidden": "true" });
      const run = { fields, sectors: frame.wheel.sectors, outer_radius_m: frame.wheel.outer_radius_m };
      at("loaded").hidden = false;
      const old = loaded;
      at("loaded-wheel").replaceChildren(picture, ground);
      const paint = parts.wheelPainter(picture, run);
      old?.lose();
      const magnified = parts.roundMagnification(0.03 * run.outer_radius_m / fields.full_displacement_m);
      loaded = { version, run, ground, paint, magnified, n: fields.positions.length, at: performance.now(),
        lose: () => picture.getContext("webgl")?.getExtension("WEBGL_lose_context")?.loseContext(), picture };
      at("roll").disabled = false;
      showLoaded();
    } catch {
      tell("the loaded wheel cannot be shown", true);
    }
    isLoading = false;
  }

  function showLoaded() {
    const i = Number(at("position").value) % loaded.n;
    loaded.paint?.(i, loaded.magnified);
    parts.drawGround(loaded.ground, loaded.run);
    at("loaded-wheel").dataset.position = String(i);
    at("loaded-text").textContent = `Von Mises stress up to ${shown(loaded.run.fields.full_stress_Pa * 1e-6)} MPa; ` +
      `displacements are drawn ${loaded.magnified} times as large.`;
  }

  // --- A wheel in 3D ----------------------------------------------------------------------------------

  let solid = null;  // { paint, fields, isLoaded }: the lit surface, in place of the plane wheel
  const isSolid = () => frame?.wheel?.dimension === 3;

  const drawnWith = (address) => new Promise((done, failed) => {
    const script = element("script", { src: address });
    script.addEventListener("load", done);
    script.addEventListener("error", failed);
    document.body.append(script);
  });

  // Shows the surface of the newest shape.
  async function showSolid() {
    const shape = frame.shape, fields = await (await ask("/loaded")).json();
    if (solid) {
      solid.paint?.take(fields);
      solid.fields = fields;
    } else {
      await drawnWith("/three.js");
      const canvas = element("canvas", { id: "solid", role: "img", "aria-label":
        "The wheel as a lit surface, coloured by von Mises stress; arrow keys turn it, plus and minus change its size" });
      wheel.hidden = at("tools").hidden = true;
      at("stage").append(canvas);
      at("wheel-help").textContent = "Drag the wheel to turn it. With the keys: arrows, plus and minus.";
      const { outer_radius_m, width_m, sectors } = frame.wheel;
      solid = { paint: parts.surfacePainter(canvas, { fields, outer_radius_m, width_m, sectors }), fields, isLoaded: false };
      if (!solid.paint) tell("this browser cannot draw in three dimensions", true);
      at("roll").disabled = fields.positions.length < 2;
    }
    drawSolid();
    at("stage").dataset.solid = String(shape);
  }

  function drawSolid() {
    const { fields, paint: paintSolid, isLoaded } = solid;
    const magnified = parts.roundMagnification(0.03 * frame.wheel.outer_radius_m / fields.full_displacement_m);
    paintSolid?.(Number(at("position").value) % fields.positions.length, isLoaded ? magnified : 0, "stress");
    at("loaded").hidden = false;
    at("loaded-text").textContent = `Von Mises stress up to ${shown(fields.full_stress_Pa * 1e-6)} MPa` +
      (isLoaded ? `; displacements are drawn ${magnified} times as large.` : ".");
  }

  function loadOrUnload() {
    if (!isSolid()) return loadWheel();
    if (!solid) return null;
    solid.isLoaded = !solid.isLoaded;
    at("load").setAttribute("aria-pressed", String(solid.isLoaded));
    return drawSolid();
  }

  // --- Rolling ----------------------------------------------------------------------------------------

  const showPosition = () => solid ? drawSolid() : loaded && showLoaded();

  // One position after the other. Where painting takes long, it leaves as much time for everything else.
  function roll(on) {
    const betweenPositions = 150;
    clearTimeout(rolling);
    const advance = () => {
      const start = performance.now(), n = solid ? solid.fields.positions.length : loaded.n;
      at("position").value = (Number(at("position").value) + 1) % n;
      showPosition();
      if (start - curvesDrawn > 4 * betweenCurves) look();
      const painting = performance.now() - start;
      rolling = setTimeout(advance, Math.max(betweenPositions - painting, painting));
    };
    rolling = on ? setTimeout(advance, betweenPositions) : null;
    at("roll").textContent = on ? "Stop" : "Roll";
    at("roll").setAttribute("aria-pressed", String(on));
  }

  at("load").addEventListener("click", loadOrUnload);
  at("roll").addEventListener("click", () => roll(rolling === null));
  setInterval(() => { if (loaded && frame && loaded.version !== frame.version) loadWheel(); }, loadedEvery);

  // --- To take away -----------------------------------------------------------------------------------

  function download(name, blob) {
    const link = element("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  async function takeAway(address, name) {
    try {
      const response = await ask(address);
      if (!response.ok) return tell((await response.json()).text, true);
      download(name, await response.blob());
      return tell(`${name} is downloaded`, false);
    } catch {
      return tell("the program does not answer", true);
    }
  }

  function offerFormats() {
    for (const format of isSolid() ? ["stl", "3mf", "vtu", "vtp", "png"] : ["step", "dxf", "svg", "stl", "3mf", "png", "vtu"])
      at("format").append(element("option", { value: format }, format.toUpperCase()));
  }
  at("export").addEventListener("click", () =>
    takeAway(`/export?format=${at("format").value}`, `${at("name").value}.${at("format").value}`));
  at("report").addEventListener("click", () => takeAway("/report", `${at("name").value}.html`));
  at("save").addEventListener("click", async () => {
    try {
      const answer = await (await ask("/save", { method: "POST", body: at("name").value })).json();
      tell(answer.obeyed ? `saved: ${answer.text}` : answer.text, !answer.obeyed);
    } catch {
      tell("the program does not answer", true);
    }
  });

  // --- Designs of an exploration or a sweep -----------------------------------------------------------

  async function offerDesigns() {
    const { quantities, designs } = await (await ask("/designs")).json();
    const [across, up] = [quantities[0], quantities[1] ?? quantities[0]];
    const solved = designs.filter(({ numbers: n }) => quantities.length > 0 && n[across.key] !== null && n[up.key] !== null);
    if (solved.length === 0) return;
    for (const { name, start, front } of solved)
      at("design").append(element("option", { value: name }, `${name}${front === 1 ? "*" : ""} ${start}`));
    at("designs").hidden = false;
    const points = solved.map(({ numbers: n }) => ({ x: n[across.key], y: n[up.key] }));
    const isChosen = (k) => solved[k]?.name === at("design").value;
    const axis = (text) => ({ title: { display: true, text, color: colour("--quiet") }, ticks: { color: colour("--quiet") },
      grid: { color: colour("--line") } });
    const front = new Chart(at("front"), { type: "scatter", data: { datasets: [{ data: points,
      pointRadius: ({ dataIndex: k }) => isChosen(k) ? 9 : solved[k]?.front === 1 ? 6 : 4,
      backgroundColor: ({ dataIndex: k }) => colour(isChosen(k) ? "--bad" : solved[k]?.front === 1 ? "--accent" : "--quiet") }] },
    options: { animation: false, responsive: true, maintainAspectRatio: false, scales: { x: axis(across.key), y: axis(up.key) },
      plugins: { legend: { display: false }, tooltip: { callbacks: { label: ({ dataIndex: k }) => solved[k].name } } },
      onClick: (event, [hit]) => {
        if (!hit) return;
        at("design").value = solved[hit.index].name;
        takeDesign();
      } } });
    const takeDesign = async () => {
      front.update("none");
      const answer = await (await ask("/take", { method: "POST", body: at("design").value })).json();
      tell(answer.text, !answer.obeyed);
    };
    at("design").addEventListener("change", () => front.update("none"));
    at("take").addEventListener("click", takeDesign);
  }
  offerDesigns().catch(() => {});

  // --- Numbers ----------------------------------------------------------------------------------------

  // The numbers: id, label, unit, factor from SI, key of the frame's numbers.
  const numbers = [["objective", "objective", "J/m", 1, "objective_J_per_m"], ["objective", "objective", "J", 1, "objective_J"],
    ["volume", "volume", "% of the ring", 100, "volume_fraction"],
    ["travel", "mean travel", "mm", 1e3, "mean_travel"], ["run-out", "run-out", "mm", 1e3, "run_out"],
    ["pressure", "peak pressure", "MPa", 1e-6, "peak_pressure"]];
  for (const [id, label] of new Map([...numbers, ["shape", "shape"]].map((number) => [number[0], number])).values())
    at("numbers").append(element("div", {}, element("dt", {}, label), element("dd", { id: `number-${id}` }, "-")));

  function showNumbers() {
    for (const [id, , unit, factor, key] of numbers.filter((number) => number[4] in frame.numbers))
      at(`number-${id}`).textContent = `${shown(frame.numbers[key] * factor)} ${unit}`;
    at("number-shape").textContent = String(frame.shape);
  }

  function showState() {
    at("state").textContent = states[frame.activity] ?? frame.activity;
    at("go").textContent = frame.activity === "paused" ? "Go on" : "Pause";
    at("undo").disabled = !frame.can_undo;
    for (const id of ["go", "step", "reset"]) at(id).disabled = frame.activity === "ended";
  }

  // --- Curves -----------------------------------------------------------------------------------------

  const charts = {
    objective: chart("Objective, shape by shape", "shape", "[J/m, in 3D J]", [{ name: "objective", x: [], y: [] }]),
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
    // Widths of which 0 allows any.
    const ring = frame.wheel.outer_radius_m - frame.wheel.inner_radius_m;
    const width = (id, label, key) => setting(id, label, { ...linear(0, 250 * ring), digits: 3,
      value: () => 1e3 * frame.settings[key], command: (v) => ({ do: "widths", [key]: v * 1e-3 }) });
    const relations = { at_least: "at least", at_most: "at most", equals: "equal to" };
    const limit = (k, bound, relation) => {
      const first = bound[relation], range = first > 0 ? powers(0.2 * first, 5 * first) : linear(-1, 1);
      return setting(`bound-${k}-${relation}`, `${bound.quantity.replaceAll("_", " ")} ${relations[relation]} [SI]`, {
        ...range, digits: 4, value: () => frame.settings.bounds[k][relation],
        command: (v) => ({ do: "bound", constraint: k, [relation]: v }) });
    };
    settings = [
      setting("force", "load [N]", { ...linear(0.1 * force, 3 * force), digits: 4,
        value: () => frame.settings.load.force_N,
        command: (v) => ({ do: "load", ...present(frame.settings.load), force_N: v }) }),
      setting("volume", "volume [% of the ring]", { ...linear(20, 95), digits: 3,
        value: () => 100 * frame.settings.volume_target, command: (v) => ({ do: "volume", target: v / 100 }) }),
      weight("stiff", "weight of stiffness", "strain_energy", 0.01, 100),
      weight("even", "weight of even rolling", "uniformity_dual", 1, 1e5),
      width("wall", "thinnest wall [mm]", "minimum_wall_m"), width("gap", "narrowest gap [mm]", "minimum_gap_m"),
      ...frame.settings.bounds.flatMap((bound, k) => Object.keys(relations).filter((relation) => relation in bound)
        .map((relation) => limit(k, bound, relation))),
    ];
  }
  const present = (members) => Object.fromEntries(Object.entries(members).filter(([, v]) => v !== null));

  // --- The run ----------------------------------------------------------------------------------------

  // A run that settled can be paused too: it then waits through several changes.
  at("go").addEventListener("click", () => give({ do: frame?.activity === "paused" ? "continue" : "pause" }));
  at("step").addEventListener("click", () => give({ do: "step" }));
  at("undo").addEventListener("click", () => give({ do: "undo" }));
  at("reset").addEventListener("click", () => give({ do: "reset" }));
  at("position").addEventListener("input", () => {
    showPosition();
    look();
  });

  let version = 0, curveVersion = 0, painted = 0, shapesPainted = 0, framed = 0;
  let waiting = new AbortController();

  // Asks at once for what is there, e.g. when another load position is to be shown.
  function look() {
    version = curvesDrawn = 0;
    waiting.abort();
  }

  // The curves of the last shape, when no other follows.
  setInterval(() => {
    const isQuiet = frame?.wheel && performance.now() - framed > betweenCurves;
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

  async function take(news) {
    const isNew = news.version !== frame?.version;
    frame = news;
    framed = performance.now();
    version = curveVersion = news.version;
    curve.push(...news.curve);
    if (curve.length > mostPoints) curve.splice(0, curve.length - mostPoints);
    showState();
    if (!frame.wheel) return;
    if (!settings) {
      makeSettings();
      offerFormats();
    }
    for (const follow of settings) follow();
    // An edge that a command drew replaces what the user drew; its numbers come with its solution.
    if (frame.is_proposed && edit?.isGiven) edit = null;
    paint();
    if (isSolid() && isNew) await showSolid();
    if (isNew) wheel.dataset.painted = String(++painted);
    if (frame.is_proposed) return;
    showNumbers();
    if ("force_curve" in frame) showCurves();
    if (news.curve.length > 0) wheel.dataset.shapes = String(++shapesPainted);
    wheel.dataset.shape = String(frame.shape);
    wheel.dataset.version = String(frame.version);
  }

  async function follow() {
    while (frame?.activity !== "ended") {
      try {
        const news = await next();
        await painting();
        await take(news);
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
