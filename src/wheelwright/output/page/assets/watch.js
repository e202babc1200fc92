"use strict";
(() => {
  const { colour, element, chart } = parts, { shown, short, withError, briefChange, layersText, words } = formats;
  const { isOf, caseName, numberRows, objectiveError, errorRows, errorsText, boundRow, clauses, newest, comparable, pictureKey, isSameShape, sameOutline, travelCurve } = frameChanges;
  const at = (id) => document.getElementById(id);

  // --- The server -------------------------------------------------------------------------------------

  // The token comes after the # of the address. It is kept in this tab and removed from the address bar.
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

  // Sends a command to the run; the answer contains its result.
  async function give(command) {
    try {
      const answer = await (await ask("/command", { method: "POST", body: JSON.stringify(command) })).json();
      tell(answer.text, !answer.executed);
      return answer.executed;
    } catch {
      tell("the program does not respond", true);
      return false;
    }
  }

  function tell(text, isRefusal) {
    at("message").textContent = at("message").title = text;
    at("message").classList.toggle("refused", isRefusal);
  }

  // --- What is shown ----------------------------------------------------------------------------------

  let frame = null;   // the newest view of the run
  let curve = [];     // of the shapes so far: [shape, objective, mean travel, run-out, volume fraction, objective of the
                      // initial shape]
  const mostPoints = 4000;
  const wheel = at("wheel");
  const isSolid = () => frame?.wheel?.dimension === 3;
  const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
  const pressed = (id) => at(id).getAttribute("aria-pressed") === "true";
  const press = (id, on) => at(id).setAttribute("aria-pressed", String(on));

  const icons = {
    go: "M7 5v14M17 5v14", continue: "M7 4l12 8-12 8z", step: "M6 5l9 7-9 7zM18 5v14",
    undo: "M9 7L4 12l5 5M4 12h10a6 6 0 0 1 0 8", reset: "M5 12a7 7 0 1 0 2-5M5 3v5h5",
    load: "M12 3v11M7 10l5 5 5-5M4 20h16", roll: "M12 5a8 8 0 1 1-7 4M5 4v5h5", ghost: "M12 4a8 8 0 1 0 0 16a8 8 0 1 0 0-16",
    fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
    look: "M2 12s4-7 10-7 10 7 10 7-4 7-10 7S2 12 2 12zM12 9a3 3 0 1 0 0 6a3 3 0 1 0 0-6",
    move: "M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3",
    resize: "M14 4h6v6M20 4l-7 7M10 20H4v-6M4 20l7-7", add: "M12 3a9 9 0 1 0 0 18a9 9 0 1 0 0-18M12 8v8M8 12h8",
    fill: "M12 3a9 9 0 1 0 0 18a9 9 0 1 0 0-18M9 9l6 6M15 9l-6 6",
    paint: "M4 20c4 0 5-2 5-4M9 16L19 4l2 2L11 17z", erase: "M5 15l9-10 6 6-8 9H8zM9 10l6 6",
  };
  function icon(name) {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("viewBox", "0 0 24 24");
    svg.setAttribute("aria-hidden", "true");
    const path = document.createElementNS(svg.namespaceURI, "path");
    path.setAttribute("d", icons[name]);
    svg.append(path);
    return svg;
  }
  function label(id, iconName, text) {
    if (at(id).dataset.icon === iconName) return;
    at(id).dataset.icon = iconName;
    at(id).replaceChildren(icon(iconName), element("span", {}, text));
  }
  for (const [id, text] of [["step", "Step"], ["undo", "Undo"], ["reset", "Reset"], ["load", "Load"], ["roll", "Roll"],
    ["ghost", "Before"], ["fit", "Fit"]]) label(id, id, text);

  // --- The wheel --------------------------------------------------------------------------------------

  // The page requests the loaded wheel as fast as it can show it, at most ten times a second: the newest shape, at the
  // next load position while it rolls. Edges are painted with every shape.
  const betweenPictures = 100;  // ms
  let scene = null;      // the stage of a plane wheel
  let solid = null;      // the painter of a wheel in 3D
  let picture = null;    // the displayed loaded wheel, as received from the server
  let pictures = new Map();  // the load positions of the displayed shape
  let first = null;      // the edges of the initial shape
  let picturesPainted = 0;
  let held = false;      // whether the wheel stands still because the user points at it
  let loadCase = 0;
  let peaks = [];        // the stress peaks of the last load positions, for a scale that does not flicker

  const position = () => Number(at("position").value);
  const brightest = () => Math.max(...peaks, 1e-9);

  async function nextPicture() {
    if (!frame?.wheel || document.hidden || frame.activity === "ended") return;
    const n = frame.travel_m.length;
    at("position").max = n - 1;
    if (picture && pressed("roll") && !held && !edit) at("position").value = (position() + 1) % n;
    const key = pictureKey({ shape_version: frame.shape_version, load_case: loadCase, position: position() });
    if (picture?.key === key) return;
    if (!pictures.has(key)) {
      const loaded = await (await ask(`/loaded?position=${position()}&case=${loadCase}`)).json();
      if (!loaded.fields) return;
      loaded.key = pictureKey(loaded);
      if (pictures.size > 0 && !isSameShape(loaded, picture)) pictures = new Map();
      pictures.set(loaded.key, loaded);
      if (held && picture && loaded.position !== picture.position) at("position").value = picture.position;
      else await showPicture(loaded);
    } else {
      await showPicture(pictures.get(key));
    }
  }

  async function showPicture(loaded) {
    picture = loaded;
    peaks = newest(peaks, [loaded.fields.full_stress_Pa], loaded.n_positions);
    if (isSolid()) await takeSolid(loaded);
    else scene.take(loaded);
    paint();
    const azimuth = loaded.position * 360 / frame.wheel.sectors / loaded.n_positions;
    at("position-text").textContent = `ground at ${azimuth.toFixed(1)}\u00b0`;
    at("loaded-wheel").dataset.pictures = String(++picturesPainted);
    at("loaded-wheel").dataset.position = String(loaded.position);
    at("loaded-wheel").dataset.shape = String(loaded.shape);
    at("loaded-wheel").dataset.case = String(loaded.load_case);
    showLegend();
  }

  function showLegend() {
    at("legend").hidden = false;
    at("scale-labels").replaceChildren(...formats.scaleLabels([0, 0.25, 1], { end: brightest() * 1e-6, unit: "MPa" })
      .map((text) => element("span", {}, text)));
    const magnified = isSolid() ? solid?.magnified : scene.magnified;
    at("loaded-text").textContent = `von Mises stress${magnified ? `; displacements \u00d7 ${magnified}` : "; not deformed"}.` +
      layersText(frame.wheel.layers);
  }
  document.querySelector(".legend .scale").style.background = colours.gradient;

  function paint() {
    if (isSolid()) return solid?.draw?.();
    if (!scene || !frame.outline) return null;
    const coloured = picture?.outline && !sameOutline(picture.outline, frame.outline) ? picture.outline : null;
    const ghost = pressed("ghost") && first && !sameOutline(first, frame.outline) ? first : null;
    const context = scene.paint({ outline: frame.outline, coloured, ghost, brightest: brightest() });
    paintEdit(context);
    at("zoom-text").textContent = `${Math.round(100 * scene.zoomed)} %`;
    return null;
  }

  async function animate() {
    for (;;) {
      const start = performance.now();
      try {
        await nextPicture();
      } catch (error) {
        if (error instanceof NotAllowed || frame?.activity === "ended") return;
      }
      const spent = performance.now() - start;
      await pause(Math.max(betweenPictures - spent, spent, 20));
    }
  }

  // --- A wheel in 3D ----------------------------------------------------------------------------------

  const drawnWith = (address) => new Promise((done, failed) => {
    const script = element("script", { src: address });
    script.addEventListener("load", done);
    script.addEventListener("error", failed);
    document.body.append(script);
  });

  async function takeSolid(loaded) {
    const { outer_radius_m, width_m, sectors } = frame.wheel, { fields } = loaded;
    if (!solid) {
      solid = { paint: null };
      await drawnWith("/three.js");
      const canvas = element("canvas", { id: "solid", role: "img", "aria-label":
        "The loaded wheel as a lit surface, coloured by von Mises stress; arrow keys turn it, plus and minus change its size" });
      at("stage").prepend(canvas);
      at("wheel-help").textContent = "Drag the wheel to turn it; with the keys: arrows, plus and minus.";
      solid.paint = parts.surfacePainter(canvas, { fields, outer_radius_m, width_m, sectors });
      solid.draw = () => solid.paint?.draw();
      if (!solid.paint) tell("this browser does not support 3D graphics", true);
      else solid.paint.takeGhost((await (await ask("/loaded?initial=1")).json()).fields);
      solid.paint?.showGhost(pressed("ghost"));
    } else {
      solid.paint?.take(fields);
    }
    paintSolid(loaded);
    at("stage").dataset.solid = String(loaded.shape);
  }

  function paintSolid({ fields, travel_m: travel }) {
    solid.factor = formats.steadyMagnification(solid.factor, travel, frame.wheel.outer_radius_m);
    solid.magnified = pressed("load") ? solid.factor : 0;
    solid.paint?.(0, solid.magnified, "stress", Math.sqrt(fields.full_stress_Pa / brightest()));
  }

  // --- The view ---------------------------------------------------------------------------------------

  function zoom(factor, x, y) {
    if (isSolid()) solid?.paint?.resize(factor);
    else scene?.zoom(factor, x, y);
    paint();
  }
  function fit() {
    if (isSolid()) solid?.paint?.fit();
    else scene?.fit();
    paint();
  }
  at("zoom-in").addEventListener("click", () => zoom(1.5));
  at("zoom-out").addEventListener("click", () => zoom(1 / 1.5));
  at("fit").addEventListener("click", fit);
  at("ghost").addEventListener("click", () => {
    press("ghost", !pressed("ghost"));
    solid?.paint?.showGhost(pressed("ghost"));
    paint();
  });
  at("roll").addEventListener("click", () => press("roll", !pressed("roll")));
  at("load").addEventListener("click", () => {
    press("load", !pressed("load"));
    scene?.load(pressed("load"));
    if (isSolid() && picture) paintSolid(picture);
    paint();
    showLegend();
  });
  at("position").addEventListener("input", () => {
    press("roll", false);
    look();
  });

  // --- Editing ----------------------------------------------------------------------------------------

  const tools = [["look", "Look", "Drag to move the picture, turn the mouse wheel to zoom. With the keys: arrows, plus, minus, 0."],
    ["move", "Move", "Moves a hole: drag it. With the keys: arrows, Enter to pick it up, arrows, Enter to drop it."],
    ["resize", "Resize", "Enlarges a hole if you drag away from its centre, and shrinks it if you drag towards it. With the keys: arrows, Enter, arrows, Enter."],
    ["add", "Add", "Adds a round hole: drag from its centre outwards, or click. With the keys: arrows, Enter, Enter."],
    ["fill", "Delete", "Fills a hole with material: click it. With the keys: arrows, Enter, or Delete with any tool."],
    ["paint", "Paint", "Adds material along the line that you draw. With the keys: arrows, Enter, arrows, Enter."],
    ["erase", "Erase", "Removes material along the line that you draw. With the keys: arrows, Enter, arrows, Enter."]];
  const brushes = { paint: "material", erase: "hole" }, usingTip = ["add", "paint", "erase"];
  for (const [id, text, title] of tools) {
    const button = element("button", { type: "button", id: `tool-${id}`, "aria-pressed": String(id === "look"), title },
      icon(id), element("span", {}, text));
    button.addEventListener("click", () => choose(id));
    at("tools").append(button);
  }
  const tip = element("input", { type: "range", id: "tip", min: 2, max: 40, value: 10 });
  const tipText = element("output", { for: "tip" });
  at("tools").append(element("label", { class: "tip", id: "tip-label" }, tipText, tip));
  const tool = () => tools.find(([id]) => pressed(`tool-${id}`))[0];
  function choose(chosen) {
    for (const [id] of tools) press(`tool-${id}`, id === chosen);
    showTool();
  }
  function showTool() {
    at("wheel-help").textContent = tools.find(([id]) => id === tool())[2];
    at("tip-label").hidden = !usingTip.includes(tool());
    tipText.textContent = `tip ${tip.value} mm`;
    wheel.style.cursor = tool() === "look" ? "grab" : "crosshair";
  }
  // The arrows choose another tool.
  at("tools").addEventListener("keydown", (event) => {
    const by = { ArrowUp: -1, ArrowLeft: -1, ArrowDown: 1, ArrowRight: 1 }[event.key];
    const k = tools.findIndex(([id]) => `tool-${id}` === event.target.id);
    if (!by || k < 0) return;
    event.preventDefault();
    const [id] = tools[(k + by + tools.length) % tools.length];
    at(`tool-${id}`).focus();
    choose(id);
  });
  tip.addEventListener("input", showTool);
  showTool();

  let edit = null;    // { tool, from, to, path, hole } while the user draws, in metres of the body
  let cursor = null;  // position of the keyboard cursor

  const holeTools = ["move", "resize", "fill"];
  const tipRadius = () => Number(tip.value) * 1e-3;

  function begin(point) {
    const kind = tool();
    if (kind === "look" || !frame?.outline) return;
    const hole = holeTools.includes(kind) ? edits.holeAt(point, frame.outline, frame.wheel.sectors) : null;
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
    if (edit.tool in brushes && edits.extendsPath(edit, point, tipRadius())) edit.path.push(point);
    paint();
  }

  // Sends the command for what was drawn. It remains on the picture until the shape includes it.
  async function finish() {
    const done = edit;
    done.isGiven = true;
    await give(edits.commandOf(done, tipRadius()));
    if (edit === done) edit = null;
    paint();
  }

  function paintEdit(context) {
    const { sectors } = frame.wheel, ratio = Math.min(2, devicePixelRatio || 1);
    context.save();
    context.lineCap = context.lineJoin = "round";
    if (edit && edit.tool in brushes) {
      const points = edit.path.length > 1 ? edit.path : [edit.path[0], [edit.path[0][0] + 1e-6, edit.path[0][1]]];
      context.lineWidth = 2 * scene.pixels(tipRadius());
      context.strokeStyle = colour(edit.tool === "paint" ? "--material" : "--paper");
      context.globalAlpha = 0.8;
      context.stroke(scene.addStroke(new Path2D(), points, sectors));
    } else if (edit && edit.tool !== "fill") {
      // The hole at its new place, and material at its old one.
      if (edit.hole) {
        context.fillStyle = colour("--material");
        context.fill(scene.addLine(new Path2D(), edit.hole.edge, sectors));
      }
      const path = scene.addLoose(new Path2D(), edits.edgeOf(edit, tipRadius()), sectors);
      context.fillStyle = colour("--paper");
      context.fill(path);
      context.strokeStyle = colour("--accent");
      context.lineWidth = 2 * ratio;
      context.stroke(path);
    }
    context.restore();
    if (!cursor || document.activeElement !== wheel) return;
    const [x, y] = scene.drawn(cursor), size = 10 * ratio;
    context.strokeStyle = colour("--ink");
    context.lineWidth = 2 * ratio;
    context.stroke(new Path2D(`M${x - size} ${y}H${x + size}M${x} ${y - size}V${y + size}`));
  }

  const pointers = new Map();  // on the wheel: [x, y] of the page
  const span = () => {
    const [[a, b], [c, d]] = [...pointers.values()];
    return { size: Math.hypot(a - c, b - d), x: (a + c) / 2, y: (b + d) / 2 };
  };
  wheel.addEventListener("pointerdown", (event) => {
    if (!frame?.outline || edit) return;
    wheel.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    cursor = null;
    if (tool() !== "look" && event.button === 0 && pointers.size === 1) begin(scene.bodyPoint(event.clientX, event.clientY));
    else wheel.style.cursor = "grabbing";
  });
  wheel.addEventListener("pointermove", (event) => {
    if (edit && event.buttons) return go(scene.bodyPoint(event.clientX, event.clientY));
    const last = pointers.get(event.pointerId);
    if (!last) return null;
    const before = pointers.size === 2 ? span() : null;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (before) zoom(span().size / Math.max(1, before.size), span().x, span().y);
    if (pointers.size === 1) scene.pan(event.clientX - last[0], event.clientY - last[1]);
    return paint();
  });
  wheel.addEventListener("pointerup", (event) => {
    pointers.delete(event.pointerId);
    showTool();
    if (!edit || edit.isGiven) return;
    go(scene.bodyPoint(event.clientX, event.clientY));
    finish();
  });
  wheel.addEventListener("pointercancel", (event) => {
    pointers.delete(event.pointerId);
    edit = null;
  });
  // The wheel stands still while it is edited.
  wheel.addEventListener("pointerenter", () => { held = tool() !== "look"; });
  wheel.addEventListener("pointerleave", () => { held = false; });
  wheel.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-0.0015 * event.deltaY), event.clientX, event.clientY);
  }, { passive: false });

  function pointByKeys([dx, dy], isLarge) {
    const step = isLarge ? 0.01 : 0.002, { inner_radius_m, outer_radius_m } = frame.wheel;
    const middle = (inner_radius_m + outer_radius_m) / 2, angle = Math.PI / frame.wheel.sectors;
    cursor = cursor ? [cursor[0] + step * dx, cursor[1] + step * dy] : [middle * Math.cos(angle), middle * Math.sin(angle)];
    held = true;
    if (edit) go(cursor);
  }
  wheel.addEventListener("blur", () => { held = false; });
  wheel.addEventListener("keydown", (event) => {
    if (!frame?.outline) return;
    const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (event.key in moves && tool() === "look") scene.pan(-40 * moves[event.key][0], 40 * moves[event.key][1]);
    else if (event.key in moves) pointByKeys(moves[event.key], event.shiftKey);
    else if (event.key === "+" || event.key === "=") zoom(1.25);
    else if (event.key === "-") zoom(1 / 1.25);
    else if (event.key === "0") fit();
    else if (event.key === "Enter" || event.key === " ") {
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

  // --- Saving and exporting ---------------------------------------------------------------------------

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
      return tell("the program does not respond", true);
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
      tell(answer.executed ? `saved: ${answer.text}` : answer.text, !answer.executed);
    } catch {
      tell("the program does not respond", true);
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
      tell(answer.text, !answer.executed);
    };
    at("design").addEventListener("change", () => front.update("none"));
    at("take").addEventListener("click", takeDesign);
  }
  offerDesigns().catch(() => {});

  // --- Numbers ----------------------------------------------------------------------------------------

  // Numbers that take longer than a shape are requested at the page's pace: the whole table of the newest shape, a few
  // times a second. Those of the contact come with every shape.
  const betweenNumbers = 400;  // ms
  let numbers = null, numbersOf = "", numbersAsked = 0;

  function numberRow({ id, name, unit, before, now, error, text = short }) {
    let row = at(`row-${id}`);
    if (!row) {
      row = element("tr", { id: `row-${id}` }, element("th", { scope: "row" }, `${name} `, element("span", { class: "unit" }, unit)),
        element("td"), element("td", { class: "now", id: `number-${id}` }), element("td"));
      at("numbers").tBodies[0].append(row);
    }
    const [, first, last, difference] = row.children;
    first.textContent = text(before);
    // An error that the usual digits do not show is left out.
    const [value, stated] = error > 5e-5 * Math.abs(now) ? withError(now, error).split(/(?= \u00b1)/) : [text(now), ""];
    last.replaceChildren(value, element("span", { class: "error" }, stated ?? ""));
    difference.textContent = briefChange(before, now);
  }

  function showNumbers() {
    const objective = frame.numbers.objective_J_per_m ?? frame.numbers.objective_J;
    numberRow({ id: "objective", name: "objective", unit: isSolid() ? "J" : "J/m", before: frame.numbers.initial_objective,
      now: objective, error: objectiveError(frame, errors.estimate), text: shown });
    at("numbers-of").replaceChildren("of shape ", element("span", { id: "number-shape" }, String(frame.shape)),
      frame.settings.load_cases.length > 0 ? ` in ${caseName(frame, loadCase)}` : "");
    if (!numbers || numbers.load_case !== loadCase) return;
    for (const row of numberRows(frame, numbers, loadCase, errors.estimate)) {
      numberRow(row);
      at(`number-${row.id}`).classList.toggle("late", row.isLate);  // grey
    }
    at("numbers").classList.toggle("with-errors", isOf(errors.estimate, frame) && !errors.estimate.failure);
  }

  function showBounds() {
    at("bounds").hidden = frame.bounds.length === 0;
    at("bound-rows").replaceChildren(...frame.bounds.map(boundRow).map(({ name, unit, value, limit, isKept, state }) =>
      element("tr", {}, element("th", { scope: "row" }, `${name} `, element("span", { class: "unit" }, unit)),
        element("td", { class: "now" }, value), element("td", {}, limit),
        element("td", { class: isKept ? "good" : "bad" }, state))));
  }

  // --- Errors on demand -------------------------------------------------------------------------------

  let errors = { busy: null, estimate: null }, errorsOf = "";

  function showErrors() {
    const { busy, estimate } = errors, key = `${estimate?.shape_version} ${loadCase}`;
    at("errors").hidden = !busy && !estimate;
    if (busy || estimate) at("errors-text").textContent = errorsText(errors, frame);
    if (key === errorsOf) return;
    errorsOf = key;
    at("error-rows").replaceChildren(...errorRows(estimate, caseName(frame, loadCase)).map(({ name, unit, text }) =>
      element("tr", {}, element("th", { scope: "row" }, `${name} `, element("span", { class: "unit" }, unit)),
        element("td", {}, text))));
  }

  // Each answer comes after a second at the latest. Errors of a shape that the run has left are shown at once, in their own
  // table; the others stand beside the numbers.
  async function followErrors() {
    do {
      errors = await (await ask("/errors")).json();
      showErrors();
    } while (errors.busy);
    if (!errors.estimate) return;
    at("errors").open = !isOf(errors.estimate, frame);
    showNumbers();
  }
  at("estimate").addEventListener("click", async () => {
    try {
      const answer = await (await ask("/errors", { method: "POST" })).json();
      if (answer.executed) await followErrors();
      else tell(answer.text, true);
    } catch {
      tell("the program does not respond", true);
    }
  });

  function showWarnings() {
    at("warnings").hidden = numbers.warnings.length === 0;
    // The rest after the first clause is shown on demand.
    at("warnings").replaceChildren(...numbers.warnings.map(clauses).map(([told, rest]) =>
      element("li", {}, ...(rest === "" ? [told] : [element("details", {}, element("summary", {}, told), rest)]))));
  }

  async function followNumbers() {
    for (;;) {
      const start = performance.now(), key = frame?.wheel && !frame.is_proposed ? `${frame.shape_version} ${loadCase}` : "";
      if (key && key !== numbersOf && !document.hidden) {
        try {
          const response = await ask(`/numbers?case=${loadCase}`);
          if (response.ok) {
            numbers = await response.json();
            numbersOf = `${numbers.shape_version} ${numbers.load_case}`;
            at("numbers").dataset.version = String(numbers.shape_version);
            showNumbers();
            showWarnings();
          } else {
            numbersOf = key;
          }
        } catch (error) {
          if (error instanceof NotAllowed || frame?.activity === "ended") return;
        }
      }
      const spent = performance.now() - start, asked = numbersAsked;
      for (let waited = 0; waited < Math.max(betweenNumbers, 3 * spent) && asked === numbersAsked; waited += 25) await pause(25);
    }
  }

  // --- Load cases -------------------------------------------------------------------------------------

  function showLoadCases() {
    const names = frame.settings.load_cases.map(({ name }) => name);
    at("loads").hidden = names.length < 2;
    if (at("loads").children.length === names.length) return;
    at("loads").replaceChildren(...names.map((name, k) => {
      const tab = element("button", { type: "button", role: "tab", id: `case-${k}`, "aria-selected": String(k === loadCase) }, name);
      tab.addEventListener("click", () => chooseLoadCase(k));
      return tab;
    }));
  }

  function chooseLoadCase(chosen) {
    loadCase = chosen;
    [...at("loads").children].forEach((tab, k) => tab.setAttribute("aria-selected", String(k === chosen)));
    for (const follow of settings) follow();
    ++numbersAsked;
    look();
  }

  const loadOf = () => frame.settings.load_cases[loadCase]?.load ?? frame.settings.load;
  const newLoad = (changes) => ({ do: "load", ...loadOf(), ...changes,
    ...(frame.settings.load_cases.length > 0 ? { load_case: frame.settings.load_cases[loadCase].name } : {}) });

  // --- The run ----------------------------------------------------------------------------------------

  const states = { starting: "computing the first shape", computing: "optimizing", paused: "paused",
    settled: "no better shape nearby: change anything to continue", ended: "the run has ended" };

  function showState() {
    at("state").textContent = states[frame.activity] ?? frame.activity;
    at("state").dataset.activity = frame.activity;
    if (frame.title) at("title").textContent = frame.title;
    if (frame.activity === "paused") label("go", "continue", "Continue");
    else label("go", "go", "Pause");
    at("undo").disabled = !frame.can_undo;
    for (const id of ["go", "step", "reset"]) at(id).disabled = frame.activity === "ended";
  }

  // A settled run can be paused too: it then waits through several changes.
  at("go").addEventListener("click", () => give({ do: frame?.activity === "paused" ? "continue" : "pause" }));
  at("step").addEventListener("click", () => give({ do: "step" }));
  at("undo").addEventListener("click", () => give({ do: "undo" }));
  at("reset").addEventListener("click", () => give({ do: "reset" }));

  // --- Curves -----------------------------------------------------------------------------------------

  const compact = { compact: true };
  const charts = {
    objective: chart("Objective by shape", "", "", [{ name: "objective", x: [], y: [] }], compact),
    travel: chart("Travel [mm] over one sector [\u00b0]", "", "", [{ name: "travel", x: [], y: [] }], compact),
    pressure: chart("Pressure [MPa] along ground [mm]", "", "", [{ name: "pressure", x: [], y: [] }], compact),
    force: chart("Force [N] by travel [mm]", "", "", [{ name: "force", x: [], y: [] }], compact),
  };
  for (const { figure, start } of Object.values(charts)) {
    at("charts").append(figure);
    start();
  }

  // Drawing curves takes longer than drawing the wheel: a few times per second is enough.
  const betweenCurves = 250;
  let curvesDrawn = 0, curvesOf = 0;  // when, and of which view
  function showCurves() {
    const since = comparable(curve);
    charts.objective.update([{ name: "objective", x: since.map((p) => p[0]), y: since.map((p) => p[1]) }]);
    charts.objective.figure.firstChild.textContent =
      `Objective by shape${since.length < curve.length ? ", since the last change" : ""}`;
    charts.travel.update([{ name: "travel", ...travelCurve(frame.travel_m, frame.wheel.sectors) }]);
    charts.pressure.update([{ name: "pressure", x: frame.pressure.x_m.map((x) => x * 1e3),
      y: frame.pressure.pressure_Pa.map((p) => p * 1e-6) }]);
    if (frame.force_curve)
      charts.force.update([{ name: "force", x: frame.force_curve.travel_m.map((t) => t * 1e3),
        y: frame.force_curve.force_N }]);
    curvesDrawn = performance.now();
    curvesOf = frame.version;
  }

  // --- Settings ---------------------------------------------------------------------------------------

  // A slider and a number for the same value. `toSlider` and back map it to 0..1000. While dragging, a value is sent as
  // soon as the previous one has been executed.
  function setting(id, label, { toSlider, fromSlider, value, command, digits }) {
    const slider = element("input", { type: "range", min: 0, max: 1000, id, "aria-describedby": `${id}-number` });
    const number = element("input", { type: "number", id: `${id}-number`, step: "any", "aria-label": `${label}, as a number` });
    at("sliders").append(element("div", { class: "setting" }, element("label", { for: id }, label), slider, number));
    let wanted = null, isSending = false, sent = null;
    const showValue = () => {
      const v = value();
      number.value = sliders.entry(sliders.rounded(v, digits));
      slider.value = toSlider(v);
    };
    const send = async () => {
      if (isSending) return;
      isSending = true;
      while (wanted !== null) {
        sent = wanted;
        wanted = null;
        if (!await give(command(sent)) && wanted === null) showValue();
      }
      isSending = false;
    };
    const want = (v) => {
      if (!Number.isFinite(v)) return;
      wanted = v;
      send();
    };
    slider.addEventListener("input", () => {
      const v = sliders.rounded(fromSlider(Number(slider.value)), digits);
      number.value = sliders.entry(v);
      want(v);
    });
    number.addEventListener("change", () => {
      if (number.value === "") return;
      slider.value = toSlider(Number(number.value));
      want(Number(number.value));
    });
    // Shows the value of the run, unless the user is changing it. After a refusal the run's value returns at once.
    return () => {
      if (!isSending && document.activeElement !== number) showValue();
    };
  }

  let settings = null;
  // The load of the chosen load case.
  function loadSettings() {
    const one = (id, text, key, factor, first) => setting(id, text, {
      ...sliders.aroundLoad(first * factor),
      digits: 4, value: () => loadOf()[key] * factor, command: (v) => newLoad({ [key]: v / factor }) });
    const load = loadOf();
    // Of force and travel the one in force; of the others those that act.
    return frame.settings.load_keys.filter(({ key }) => load[key] && !(key === "force_N" && load.travel_m !== undefined))
      .map(({ id, text, key, factor }) => one(id, text, key, factor, load[key]));
  }

  function makeSettings() {
    const weight = (id, text, key, low, high) => setting(id, text, { ...sliders.powers(low, high), digits: 3,
      value: () => frame.settings.weights[key], command: (v) => ({ do: "weights", [key]: v }) });
    // Minimum widths; 0 allows any.
    const ring = frame.wheel.outer_radius_m - frame.wheel.inner_radius_m;
    const width = (id, text, key) => setting(id, text, { ...sliders.linear(0, 250 * ring), digits: 3,
      value: () => 1e3 * frame.settings[key], command: (v) => ({ do: "widths", [key]: v * 1e-3 }) });
    const relations = { at_least: "\u2265", at_most: "\u2264", equals: "=" };
    const limit = (k, bound, relation) => {
      const { unit, factor } = bound.shown;
      return setting(`bound-${k}-${relation}`, `${words(bound.quantity)} ${relations[relation]} [${unit}]`, {
        ...sliders.aroundBound(bound[relation] * factor), digits: 4,
        value: () => frame.settings.bounds[k][relation] * factor,
        command: (v) => ({ do: "bound", constraint: k, [relation]: v / factor }) });
    };
    settings = [
      ...loadSettings(),
      setting("volume", "material [%]", { ...sliders.linear(20, 95), digits: 3,
        value: () => 100 * frame.settings.volume_target, command: (v) => ({ do: "volume", target: v / 100 }) }),
      weight("stiff", "weight: stiff", "strain_energy", 0.01, 100),
      weight("even", "weight: even", "uniformity_dual", 1, 1e5),
      width("wall", "thinnest wall [mm]", "minimum_wall_m"), width("gap", "narrowest gap [mm]", "minimum_gap_m"),
      width("radius", "radius of corners [mm]", "minimum_radius_m"),
      ...frame.settings.bounds.flatMap((bound, k) => Object.keys(relations).filter((relation) => relation in bound)
        .map((relation) => limit(k, bound, relation))),
    ];
  }

  // --- The loop ---------------------------------------------------------------------------------------

  let version = 0, curveVersion = 0, painted = 0, shapesPainted = 0, framed = 0;
  let waiting = new AbortController();

  // Requests the current state at once, e.g. to show another load position.
  function look() {
    version = curvesDrawn = 0;
    waiting.abort();
  }

  // The curves of the last shape, if no other follows, and the contact pressure at the current position of a rolling
  // wheel.
  setInterval(() => {
    const isQuiet = frame?.wheel && performance.now() - framed > betweenCurves;
    if (isQuiet && (curvesOf !== frame.version || (pressed("roll") && frame.pressure.position !== position()))) look();
  }, 2 * betweenCurves);

  async function next() {
    waiting = new AbortController();
    const wantsForces = performance.now() - curvesDrawn > betweenCurves ? 1 : 0;
    const address = `/frame?after=${version}&curve=${curveVersion}&position=${at("position").value}&case=${loadCase}&force_curve=${wantsForces}`;
    const response = await ask(address, { signal: waiting.signal });
    return response.json();
  }

  const painting = () => new Promise((done) => requestAnimationFrame(done));

  function startWheel() {
    makeSettings();
    offerFormats();
    if (isSolid()) {
      for (const id of ["wheel", "loaded-wheel", "tools"]) at(id).hidden = true;
      document.querySelector("main").classList.add("solid");
      at("zoom-text").hidden = true;
    } else {
      scene = stage.make(wheel, at("loaded-wheel"), frame.wheel);
    }
    animate();
    followNumbers();
    followErrors().catch(() => {});
  }

  async function take(news) {
    const isNew = news.version !== frame?.version, before = frame;
    frame = news;
    framed = performance.now();
    version = news.version;
    curveVersion = news.wheel ? version : 0;  // the first shape includes the edges of the initial one
    curve = newest(curve, news.curve, mostPoints);
    showState();
    if (!frame.wheel) return;
    if (!settings) startWheel();
    if (frame.initial_outline) first = frame.initial_outline;
    for (const follow of settings) follow();
    showLoadCases();
    // An edge drawn by a command replaces what the user drew; its numbers come with its solution.
    if (frame.is_proposed && edit?.isGiven) edit = null;
    paint();
    if (isNew) wheel.dataset.painted = String(++painted);
    if (frame.is_proposed) return;
    if (frame.message !== before?.message && frame.shape_version !== before?.shape_version) ++numbersAsked;
    showNumbers();
    showErrors();
    showBounds();
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
        at("state").textContent = "the program does not respond; trying again";
        await pause(1000);
      }
    }
  }

  addEventListener("resize", () => { if (frame?.wheel) paint(); });
  follow();
})();
