"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const page = document.getElementById("page");
  const { colour, element, wheelPainter, layerPainter, surfacePainter, drawGround, chart, wheelPath, paintWheel } = parts;
  const { degree, shown, minutes, layersText } = formats, { curveColours, gradient } = colours;

  // Missing values are null in the data and NaN in sums, and are shown as a dash.
  for (const { summary } of data.runs) for (const numbers of summary ? [summary.before, summary.after] : [])
    for (const key of Object.keys(numbers)) numbers[key] ??= NaN;

  // --- Numbers ----------------------------------------------------------------------------------------

  const tableHead = (titles) => element("tr", {}, ...titles.map((title) => element("th", { scope: "col" }, title)));

  function comparison(groups) {
    const { names, rows } = reportTexts.comparison(groups);
    const above = element("tr", {}, element("td"), ...groups.map(({ name, wheels }) =>
      element("th", { scope: "colgroup", colspan: 2 * wheels.length - 1 }, name)));
    const head = element("thead", {}, ...(groups.length > 1 ? [above] : []), tableHead(["quantity", ...names]));
    const body = element("tbody", {}, ...rows.map(({ title, cells }) => element("tr", {}, element("th", { scope: "row" }, title),
      ...cells.map(({ key, text }) => element("td", key === null ? {} : { "data-key": key }, text)))));
    const table = element("div", { class: "wide" }, element("table", {}, head, body));
    return rows.some(({ cells }) => cells.some(({ text }) => text.endsWith("~"))) ?
      element("div", {}, table, element("p", { class: "quiet" }, "~ the change is smaller than the discretization errors")) : table;
  }

  function bounds(run) {
    const body = element("tbody", {}, ...run.summary.bounds.map(({ name, is_kept }, k) => {
      const [title, ...texts] = reportTexts.boundRow(run, k);
      return element("tr", { "data-bound": name, ...(is_kept ? {} : { class: "broken" }) },
        element("th", { scope: "row" }, title), ...texts.map((text) => element("td", {}, text)));
    }));
    const table = element("table", { id: `${run.id}-bounds` }, element("thead", {}, tableHead(reportTexts.boundTitles)), body);
    return element("div", {}, element("div", { class: "wide" }, table), element("p", { class: "quiet" },
      "The margin is the distance to the limit; negative beyond it. The multiplier of an active bound is the decrease of the " +
      "objective per unit by which the bound is relaxed."));
  }

  const verdict = (run) => element("p", {
    class: run.summary.bounds?.some(({ is_kept }) => !is_kept) ? "verdict broken" : "verdict", id: `${run.id}-verdict` },
  reportTexts.verdict(run));

  const answers = (run) => element("dl", { class: "answers" }, ...reportTexts.answers(run).map(([id, question, text]) =>
    element("div", {}, element("dt", {}, question), element("dd", { id: `${run.id}-${id}` }, text))));

  // A sentence, followed by lines for a case file in verbatim form.
  function remark(text) {
    const [told, lines] = reportTexts.remark(text);
    return lines ? [told, element("pre", {}, lines)] : [told];
  }

  function flags(run) {
    const list = element("ul", { class: "flags", id: `${run.id}-flags` });
    for (const text of run.flags) list.append(element("li", {}, ...remark(text)));
    if (run.flags.length === 0 && !run.is_running) list.append(element("li", { class: "fine" }, "No remarks: strains are small and the " +
      "contact is resolved."));
    return list;
  }

  // The limitations of the numbers.
  const limits = (run) => element("ul", { class: "quiet", id: `${run.id}-limits` },
    ...run.limits.map((text) => element("li", {}, text)));

  // Holes that merged, vanished or reached a band during the run.
  const events = (run) => element("details", { id: `${run.id}-events` },
    element("summary", {}, reportTexts.eventsTitle(run)),
    element("ul", {}, ...run.events.map(({ shape, text }) => element("li", {}, `Shape ${shape}: ` +
      text.replaceAll("_", " ")))));

  // --- The wheel rolling ------------------------------------------------------------------------------

  // Under one of its loads; the names of its controls start with `id`.
  function rolling(run, { id, loadCase, fields, numbersOfPositions }) {
    run = { ...run, fields };
    const is_surface = run.dimension === 3;
    const picture = element("canvas", { role: "img", "aria-label": is_surface ?
      "The loaded wheel as a lit surface; arrow keys turn it, plus and minus change its size" :
      "The loaded wheel, coloured by von Mises stress" });
    const ground = element("canvas", { "aria-hidden": "true", style: "position:absolute;inset:0" });
    const n = run.fields.positions.length, peak = reportTexts.peakStress(run, loadCase);
    const slider = element("input", { type: "range", min: 0, max: n - 1, value: 0, id: `${id}-position` });
    const button = element("button", { type: "button", id: `${id}-roll` }, "Roll");
    const { best, all } = reportTexts.magnifications(run.outer_radius_m, run.fields.full_displacement_m);
    const choice = element("select", { id: `${id}-magnified`, "aria-label": "Displacement" });
    for (const m of all)
      choice.append(element("option", { value: m, ...(m === best ? { selected: "" } : {}) }, `displacement \u00d7 ${m}`));
    const kind = element("select", { id: `${id}-colours`, "aria-label": "Colours" },
      element("option", { value: "stress" }, "stress"), element("option", { value: "displacement" }, "displacement"));
    const caption = element("figcaption", { id: `${id}-position-text`, "aria-live": "polite" });
    const labels = element("div", { class: "scale-labels" }), scaleName = element("p", { class: "quiet" });
    const frame = element("div", { class: "picture", style: "position:relative" }, picture,
      ...(is_surface ? [] : [ground]));
    const rollable = n > 1 ? [button, element("label", {}, "load position", slider)] : [];
    const figure = element("figure", {}, frame, element("div", { class: "scale", style: `background:${gradient}` }), labels,
      scaleName, element("div", { class: "controls" }, ...rollable, choice, ...(is_surface ? [kind] : [])), caption);
    let paint = null, paintLayers = null, timer = null;
    const scale = (colouring) => {
      labels.replaceChildren(...formats.scaleLabels([0, 0.25, 0.5, 0.75, 1], colouring).map((text) => element("span", {}, text)));
      scaleName.textContent = colouring.name;
    };
    const draw = () => {
      const i = Number(slider.value), magnified = Number(choice.value);
      if (paint) paint(i, magnified, kind.value);
      scale({ ...(paint?.kinds?.[kind.value] ?? { name: "von Mises stress, on a scale of square roots",
        end: run.fields.full_stress_Pa * 1e-6, unit: "MPa", power: 2 }), ...(kind.value === "stress" ? { peak } : {}) });
      if (!is_surface) {
        drawGround(ground, run);
        if (paint) paintLayers(i, magnified);
      }
      const azimuth = run.fields.positions[i].azimuth_rad, numbers = reportTexts.positionNumbers(numbersOfPositions, azimuth);
      caption.textContent = `${loadCase ? `Load case ${loadCase}. ` : ""}Ground at azimuth ${shown(azimuth * degree)}\u00b0${numbers}. ` +
        `Displacements are drawn ${magnified === 1 ? "at true scale" : `${magnified} times as large`}.${is_surface ? " Drag the wheel to turn it." : ""}${layersText(run.layers)}`;
    };
    const roll = (on) => {
      clearInterval(timer);
      timer = on ? setInterval(() => { slider.value = (Number(slider.value) + 1) % n; draw(); }, 120) : null;
      button.textContent = on ? "Stop" : "Roll";
      button.setAttribute("aria-pressed", String(on));
    };
    button.addEventListener("click", () => roll(timer === null));
    slider.addEventListener("input", () => { roll(false); draw(); });
    for (const control of [choice, kind]) control.addEventListener("change", draw);
    const start = () => {
      paint = (is_surface ? surfacePainter : wheelPainter)(picture, run);
      if (!is_surface) paintLayers = layerPainter(ground, run);
      draw();
    };
    // In print, an overlay hides a canvas even where it is transparent, so one canvas shows both.
    const print = () => {
      const copy = element("canvas", { class: "print-copy", "aria-hidden": "true", style: "position:absolute;inset:0" });
      [copy.width, copy.height] = [picture.width, picture.height];
      const context = copy.getContext("2d", { willReadFrequently: true });
      context.drawImage(picture, 0, 0);
      if (!is_surface) context.drawImage(ground, 0, 0, copy.width, copy.height);
      frame.append(copy);
      return () => copy.remove();
    };
    return { figure, start, draw, print };
  }

  // --- The shapes of the run --------------------------------------------------------------------------

  function shapes(run) {
    const canvas = element("canvas", { role: "img", "aria-label": "The outline of the wheel, shape by shape" });
    const last = run.outlines.length - 1;
    const slider = element("input", { type: "range", min: 0, max: last, value: last, id: `${run.id}-shape` });
    const caption = element("figcaption", { id: `${run.id}-shape-text`, "aria-live": "polite" });
    const draw = () => {
      const size = canvas.width = canvas.height = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1)) || 600;
      const context = canvas.getContext("2d"), unit = 0.48 * size / run.outline_units;
      context.setTransform(1, 0, 0, 1, 0.5 * size, 0.5 * size);
      context.clearRect(-size, -size, 2 * size, 2 * size);
      const i = Number(slider.value);
      const outer = run.outline_units * unit, inner = outer * run.inner_radius_m / run.outer_radius_m;
      const edges = (outline) => wheelPath(outline.contours.map((contour) => contour.flat()), 1, unit);
      const layers = (run.layers?.radii_m ?? []).map((radius) => outer * radius / run.outer_radius_m);
      paintWheel(context, edges(run.outlines[i]), inner, outer, layers);
      context.setLineDash([6, 4]);
      context.strokeStyle = colour("--bad");
      context.stroke(edges({ contours: run.given_contours ?? run.outlines[0].contours }));
      context.setLineDash([]);
      const value = run.outlines[i].objective * run.objective.factor;
      caption.textContent = `Shape ${run.outlines[i].shape} of ${run.outlines[last].shape}: objective [${run.objective.unit}] ${shown(value)}; ` +
        `dashed: the edges of the initial holes.${run.dimension === 3 ? " Section in the middle of the width." : ""}${layersText(run.layers)}`;
    };
    slider.addEventListener("input", draw);
    const figure = element("figure", {}, element("div", { class: "picture" }, canvas),
      element("div", { class: "controls" }, element("label", {}, "shape", slider)), caption);
    return { figure, start: draw, draw };
  }

  // The last shapes of several runs, overlaid to scale.
  function overlay(runs) {
    const drawn = runs.filter((run) => run.outlines.length);
    const canvas = element("canvas", { role: "img", "aria-label": `The outlines of ${drawn.map(({ name }) => name).join(", ")}` });
    const ink = (k) => curveColours[k % curveColours.length];
    const legend = element("ul", { class: "legend" }, ...drawn.map(({ name }, k) =>
      element("li", {}, element("span", { style: `background:${ink(k)}`, "aria-hidden": "true" }), name)));
    const draw = () => {
      const size = canvas.width = canvas.height = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1)) || 600;
      const context = canvas.getContext("2d"), largest = Math.max(...drawn.map((run) => run.outer_radius_m));
      context.setTransform(1, 0, 0, 1, 0.5 * size, 0.5 * size);
      context.clearRect(-size, -size, 2 * size, 2 * size);
      drawn.forEach((run, k) => {
        const radius = 0.48 * size * run.outer_radius_m / largest, unit = radius / run.outline_units;
        context.strokeStyle = ink(k);
        context.lineWidth = Math.max(1.5, size / 400);
        context.stroke(wheelPath(run.outlines.at(-1).contours.map((contour) => contour.flat()), 1, unit));
        for (const r of [radius, radius * run.inner_radius_m / run.outer_radius_m]) {
          context.beginPath();
          context.arc(0, 0, r, 0, 2 * Math.PI);
          context.stroke();
        }
      });
    };
    const figure = element("figure", { class: "overlay" }, element("div", { class: "picture" }, canvas), legend,
      element("figcaption", {}, "The last shapes of the runs, overlaid to scale."));
    return { figure, start: draw, draw };
  }

  // --- The page ---------------------------------------------------------------------------------------

  function provenance(run) {
    const commands = `wheelwright run case.toml            # computes this run again\n` +
      `wheelwright analyze ${run.name}            # its last wheel at 64 load positions per sector\n` +
      `wheelwright resume ${run.name} --iterations N   # continues`;
    return element("section", {}, element("h2", {}, "How it was made"),
      element("p", { class: "quiet" }, `${run.program}; ${reportTexts.rejectedTrials(run)}; ${minutes(run.seconds)}`),
      element("pre", {}, commands),
      element("details", {}, element("summary", {}, "The case"), element("pre", {}, run.case)));
  }

  function article(run, later) {
    const section = (title, ...children) => element("section", {}, element("h2", {}, title), ...children);
    const made = element("article", { id: run.id }, element("h1", {}, run.title),
      element("p", { class: "quiet", id: `${run.id}-status` }, `${data.runs.length > 1 ? `run ${run.name}; ` : ""}${run.status}; load ${run.load}`));
    if (run.made) made.append(element("p", { class: "quiet", id: `${run.id}-made` }, run.made));
    if (run.summary) made.append(verdict(run));
    const pictures = element("div", { class: "pictures wheels" });
    const picture = (part) => {
      later.push(part);
      pictures.append(part.figure);
    };
    if (run.fields)
      picture(rolling(run, { id: run.id, loadCase: run.summary?.after.load_case, fields: run.fields,
        numbersOfPositions: run.rolling?.after }));
    if (run.outlines.length) picture(shapes(run));
    for (const [k, { load_case, fields }] of (run.other_fields ?? []).entries())
      picture(rolling(run, { id: `${run.id}-load${k + 1}`, loadCase: load_case, fields: { ...run.fields, ...fields } }));
    if (pictures.childElementCount) made.append(section("The wheel under load, and its shapes", pictures));
    made.append(flags(run));
    if (run.summary) made.append(section("Before and after, in brief", answers(run)));
    if (run.summary?.bounds?.length) made.append(section("Bounds", bounds(run)));
    const charts = reportCurves.all(run).map(({ title, x, y, curves, options }) => chart(title, x, y, curves, options));
    later.push(...charts);
    if (charts.length)
      made.append(section("Curves", element("div", { class: "pictures" }, ...charts.map(({ figure }) => figure))));
    if (run.summary) made.append(section("All numbers", comparison(reportTexts.beforeAndAfter(run))));
    if (run.events.length) made.append(events(run));
    if (run.limits.length) made.append(section("What was not checked", limits(run)));
    made.append(provenance(run));
    return made;
  }

  const later = [];
  data.runs.forEach((run, k) => { run.id = `run${k}`; });
  // Energies in 2D are per metre of width, so wheels are compared only with those of the same dimension.
  const compared = [2, 3].map((dimension) => data.runs.filter((run) => run.summary && run.dimension === dimension))
    .filter((runs) => runs.length > 1);
  if (compared.length) page.append(element("h1", {}, "Wheels compared"), ...compared.flatMap((runs) => {
    later.push(overlay(runs));
    return [later.at(-1).figure, comparison(reportTexts.lastWheels(runs))];
  }));
  page.append(element("div", { class: "runs" }, ...data.runs.map((run) => article(run, later))));
  for (const part of later) part.start();
  const redraw = () => later.forEach((part) => part.draw?.());
  const recolour = () => {
    later.forEach((part) => part.recolour?.());
    redraw();
  };
  addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  // Paper is white: redraws what has the colours of a dark page.
  let printed = [];
  addEventListener("beforeprint", () => {
    document.documentElement.classList.add("printed");
    recolour();
    printed = later.flatMap((part) => part.print ? [part.print()] : []);
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printed");
    printed.forEach((remove) => remove());
    recolour();
  });
  if (data.runs.some((run) => run.is_running)) setTimeout(() => location.reload(), 5000);
})();
