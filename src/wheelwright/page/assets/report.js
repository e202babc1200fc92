"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const page = document.getElementById("page");
  const { colour, curveColours, degree, element, shown, change, minutes, gradient, wheelPainter,
    surfacePainter, drawGround, roundMagnification, chart, wheelPath, paintWheel } = parts;

  // Missing values are null in the data and NaN in sums, and are shown as a dash.
  for (const { summary } of data.runs) for (const numbers of summary ? [summary.before, summary.after] : [])
    for (const key of Object.keys(numbers)) numbers[key] ??= NaN;

  // --- Numbers ----------------------------------------------------------------------------------------

  // Columns of wheels with their change relative to the first one, in groups that may have a name.
  function table(groups) {
    const names = element("tr", {}, element("th", { scope: "col" }, "quantity")), above = element("tr", {}, element("td"));
    for (const { name, wheels } of groups) {
      above.append(element("th", { scope: "colgroup", colspan: 2 * wheels.length - 1 }, name));
      wheels.forEach((wheel, k) => {
        names.append(element("th", { scope: "col" }, wheel.name));
        if (k > 0) names.append(element("th", { scope: "col" }, "change"));
      });
    }
    const body = element("tbody");
    for (const { key, label, unit, factor } of groups[0].units) {
      if (!groups.some(({ wheels }) => wheels.some(({ numbers }) => Number.isFinite(numbers[key])))) continue;
      const row = element("tr", {}, element("th", { scope: "row" }, `${label} [${unit}]`));
      for (const { wheels } of groups) {
        const isOfShape = !wheels.some(({ numbers }) => key in numbers);  // so it is in the first group
        wheels.forEach(({ numbers }, k) => {
          row.append(element("td", { "data-key": key }, Number.isFinite(numbers[key]) ? shown(numbers[key] * factor) :
            isOfShape ? "" : "\u2013"));
          const both = [wheels[0].numbers[key], numbers[key]];
          if (k > 0) row.append(element("td", {}, both.every(Number.isFinite) ? change(...both) : isOfShape ? "" : "\u2013"));
        });
      }
      body.append(row);
    }
    const head = element("thead", {}, ...(groups.length > 1 ? [above] : []), names);
    return element("div", { class: "wide" }, element("table", {}, head, body));
  }

  // Before and after, under each load case.
  function beforeAndAfter(run) {
    const { before, after } = run.summary;
    const group = (name, first, last) => ({ name, units: run.numbers,
      wheels: [{ name: "before", numbers: first ?? {} }, { name: "after", numbers: last }] });
    return table([group(after.load_case ?? "", before, after), ...Object.entries(after.load_cases ?? {})
      .map(([name, numbers]) => group(name, before.load_cases?.[name], numbers))]);
  }

  // The bounds at the last shape that the run computed, in the units of tables.
  function bounds(run) {
    const first = (words) => (run.history[Object.keys(run.history).find((column) => column.startsWith(`${words} [`))] ?? [])
      .find((value) => value !== null);
    const words = { "<": "at most", ">": "at least", "=": "equal to" };
    const titles = ["bound", "limit", "before", "after", "margin", "margin [%]", "state", "multiplier"];
    const head = element("tr", {}, ...titles.map((title) => element("th", { scope: "col" }, title)));
    const body = element("tbody");
    for (const [k, { name, value: last, bound: limit, relation, multiplier, is_kept }] of run.summary.bounds.entries()) {
      const { unit, factor } = run.bound_units[k], before = first(`bounded ${name}`);
      const [value, bound] = [last * factor, limit * factor], price = multiplier * run.objective.factor / factor;
      const margin = relation === "<" ? bound - value : relation === ">" ? value - bound : -Math.abs(value - bound);
      const state = !is_kept ? "not kept" : relation === "=" || multiplier !== 0 ? "active" : "not active";
      body.append(element("tr", { "data-bound": name, ...(is_kept ? {} : { class: "broken" }) },
        element("th", { scope: "row" }, `${name.replaceAll("_", " ")} [${unit}]`),
        ...[`${words[relation]} ${shown(bound)}`, before === undefined ? "\u2013" : shown(before * factor), shown(value), shown(margin),
          bound ? shown(100 * margin / Math.abs(bound)) : "\u2013", state,
          `${shown(price)}${price ? ` ${run.objective.unit} per ${unit}` : ""}`].map((text) => element("td", {}, text))));
    }
    return element("div", {}, element("div", { class: "wide" }, element("table", { id: `${run.id}-bounds` },
      element("thead", {}, head), body)), element("p", { class: "quiet" }, "The margin is the distance to the limit; negative " + "beyond it. The multiplier of an active bound is the decrease of the objective per unit by which " + "the bound is relaxed."));
  }

  // The result in one sentence.
  function verdict(run) {
    const { before, after, bounds: all = [] } = run.summary;
    const key = ["objective", "objective_J_per_m", "objective_J"].find((name) => Number.isFinite(after[name]));
    const parts_of_it = [];
    if (key && Number.isFinite(before[key])) parts_of_it.push(`the objective changed by ${change(before[key], after[key])}`);
    if (Number.isFinite(before.stiffness_N_per_m) && Number.isFinite(after.stiffness_N_per_m))
      parts_of_it.push(`the stiffness by ${change(before.stiffness_N_per_m, after.stiffness_N_per_m)}`);
    const broken = all.filter(({ is_kept }) => !is_kept).length;
    if (all.length) parts_of_it.push(broken ? `${broken} of ${all.length} bounds ${broken > 1 ? "are" : "is"} not kept` :
      all.length > 2 ? `all ${all.length} bounds are kept` : all.length > 1 ? "both bounds are kept" : "the bound is kept");
    parts_of_it.push(run.flags.length === 0 ? "there are no remarks" :
      `there ${run.flags.length > 1 ? `are ${run.flags.length} remarks` : "is a remark"} below`);
    const text = `${parts_of_it.slice(0, -1).join(", ")}${parts_of_it.length > 1 ? "; " : ""}${parts_of_it.at(-1)}.`;
    return element("p", { class: broken ? "verdict broken" : "verdict", id: `${run.id}-verdict` },
      text[0].toUpperCase() + text.slice(1));
  }

  function rejectedText(run) {
    const reasons = Object.entries(run.rejected), n = reasons.reduce((sum, [, count]) => sum + count, 0);
    const why = n ? ` (${reasons.map(([reason, count]) => `${reason.replaceAll("_", " ")}: ${count}`).join(", ")})` : "";
    return `${run.trials} trial shapes, ${n} rejected${why}`;
  }

  // A buyer's questions, with answers.
  function answers(run) {
    const list = element("dl", { class: "answers" });
    const answer = (id, question, text) =>
      list.append(element("div", {}, element("dt", {}, question), element("dd", { id: `${run.id}-${id}` }, text)));
    const { before, after } = run.summary;
    const place = after.peak_von_mises_place;
    const volume = Math.PI * (run.outer_radius_m ** 2 - run.inner_radius_m ** 2) * run.width_m * after.volume_fraction;
    answer("stiffness", "How stiff?", `${shown(after.stiffness_N_per_m * 1e-3)} N/mm`);
    answer("evenness", "How even does it roll?", `run-out ${shown(after.run_out_m * 1e3)} mm, force varies by ` +
      `${shown(after.force_variation_N)} N`);
    answer("volume", "How heavy?", `${"mass_kg" in after ? `${shown(after.mass_kg)} kg, ` : ""}` +
      `${shown(volume * 1e6)} cm\u00b3, ${shown(100 * after.volume_fraction)} % of the ring`);
    if (Number.isFinite(after.minimum_wall_m))
      answer("wall", "How thick is the thinnest wall?", `${shown(after.minimum_wall_m * 1e3)} mm`);
    if (Number.isFinite(after.roughness_turns))
      answer("edges", "Can its edges be cut?", `${run.has_rough_edges ? "No" : "Yes"}: internal corners of radius ` +
        `${shown(after.internal_corner_radius_m * 1e3)} mm; ${shown(after.roughness_turns)} turns of an edge below a cell`);
    answer("stress", "What peak stress, and where?", `${shown(after.peak_von_mises_Pa * 1e-6)} MPa at radius ` +
      `${shown(place.radius_m * 1e3)} mm, azimuth ${shown(place.azimuth_rad * degree)}\u00b0`);
    answer("pressure", "What pressure on the ground?", `${shown(after.peak_pressure_Pa * 1e-6)} MPa`);
    answer("travel", "How far does it sink?", `${shown(after.mean_travel_m * 1e3)} mm`);
    answer("load", "For which load?", `${shown(after.load_N)} N`);
    answer("strain", "Is it suited to this load?", `largest strain ${shown(100 * after.largest_strain)} %, travel ` +
      `${shown(100 * after.travel_by_ring_thickness)} % of the ring`);
    answer("change", "What changed?", `travel ${change(before.mean_travel_m, after.mean_travel_m)}, run-out ` +
      `${change(before.run_out_m, after.run_out_m)}, peak stress ` +
      `${change(before.peak_von_mises_Pa, after.peak_von_mises_Pa)}`);
    answer("trust", "Can I trust it?", run.flags.length === 0 ? "no remarks; its limitations are listed below" :
      `${run.flags.length} remark${run.flags.length > 1 ? "s" : ""} and the limitations below`);
    answer("making", "How was it made?", `${run.status}; ${run.trials} trial shapes, ${minutes(run.seconds)}`);
    return list;
  }

  // A sentence, followed by lines for a case file in verbatim form.
  function remark(text) {
    const [sentence, ...lines] = (text[0].toUpperCase() + text.slice(1)).split("\n");
    return lines.length ? [sentence, element("pre", {}, lines.join("\n"))] : [sentence];
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
    element("summary", {}, `What happened to the holes: ${run.events.length + run.events_omitted} shape` +
      (run.events.length > 1 ? "s" : "") + (run.events_omitted ? `, of which the last ${run.events.length}` : "")),
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
    const n = run.fields.positions.length;
    const slider = element("input", { type: "range", min: 0, max: n - 1, value: 0, id: `${id}-position` });
    const button = element("button", { type: "button", id: `${id}-roll` }, "Roll");
    const best = roundMagnification(0.03 * run.outer_radius_m / run.fields.full_displacement_m);
    const choice = element("select", { id: `${id}-magnified`, "aria-label": "Displacement" });
    for (const m of [...new Set([1, best / 5, best / 2, best, 2 * best].filter((m) => m >= 1))])
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
    let paint = null, timer = null;
    const scale = ({ name, end, unit, power }) => {
      labels.replaceChildren(...[0, 0.25, 0.5, 0.75, 1].map((t) => element("span", {},
        `${Number((t ** power * end).toPrecision(3))}${t === 1 ? ` ${unit}` : ""}`)));
      scaleName.textContent = name;
    };
    const draw = () => {
      const i = Number(slider.value), magnified = Number(choice.value);
      if (paint) paint(i, magnified, kind.value);
      scale(paint?.kinds?.[kind.value] ?? { name: "von Mises stress, on a scale of square roots",
        end: run.fields.full_stress_Pa * 1e-6, unit: "MPa", power: 2 });
      if (!is_surface) drawGround(ground, run);
      const at = numbersOfPositions, shown_azimuth = run.fields.positions[i].azimuth_rad;
      const k = (at?.azimuths_rad ?? []).findIndex((azimuth) => Math.abs(azimuth - shown_azimuth) < 1e-9);
      const numbers = k < 0 ? "" : `: travel ${shown((at.travel_at_load_m?.[k] ?? NaN) * 1e3)} mm, peak pressure ` +
        `${shown(at.peak_pressure_Pa[k] * 1e-6)} MPa, peak stress ${shown(at.peak_von_mises_Pa[k] * 1e-6)} MPa`;
      caption.textContent = `${loadCase ? `Load case ${loadCase}. ` : ""}Ground at azimuth ${shown(shown_azimuth * degree)}\u00b0${numbers}. ` +
        `Displacements are drawn ${magnified === 1 ? "at true scale" : `${magnified} times as large`}.${is_surface ? " Drag the wheel to turn it." : ""}`;
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
    const start = () => { paint = (is_surface ? surfacePainter : wheelPainter)(picture, run); draw(); };
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
      paintWheel(context, edges(run.outlines[i]), inner, outer);
      context.setLineDash([6, 4]);
      context.strokeStyle = colour("--bad");
      context.stroke(edges({ contours: run.given_contours ?? run.outlines[0].contours }));
      context.setLineDash([]);
      const value = run.outlines[i].objective * run.objective.factor;
      caption.textContent = `Shape ${run.outlines[i].shape} of ${run.outlines[last].shape}: objective [${run.objective.unit}] ${shown(value)}; ` +
        "dashed: the edges of the initial holes.";
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

  // --- Curves -----------------------------------------------------------------------------------------

  function curves(run) {
    const charts = [], column = (word) => Object.keys(run.history).find((name) => name.startsWith(word));
    const iterations = run.history.iteration ?? [];
    const course = (title, words, factor, yTitle, y) => {
      const found = words.map(column).filter((name) => name && run.history[name].some((v) => v !== null))
        .filter((name, k, all) => k === 0 || String(run.history[name]) !== String(run.history[all[0]]));
      if (found.length)
        charts.push(chart(title, "shape", yTitle, found.map((name) => ({ name: name.split(" [")[0].replaceAll("_", " "),
          x: iterations, y: run.history[name].map((v) => v === null ? null : v * factor) })), { y }));
    };
    course("Objective and its terms", ["objective", "strain_energy", "uniformity_annulus", "uniformity_dual",
      "uniformity_l2"], run.objective.factor, `[${run.objective.unit}]`);
    course("Mean travel and run-out", ["mean_travel", "run_out"], 1e3, "[mm]");
    course("Peaks of pressure and stress", ["peak_pressure", "peak_von_mises ["], 1e-6, "[MPa]");
    course("Volume", ["volume fraction"], 100, "[% of the ring]", { grace: 0.05 });
    if (run.rolling?.after) {
      const turn = ({ azimuths_rad }, values, factor) => {  // one sector, closed
        const x = azimuths_rad.map((a) => a * degree), sector = 360 / run.sectors;
        return { x: [...x, x[0] + sector], y: [...values, values[0]].map((v) => v * factor) };
      };
      const known = (key) => Object.entries(run.rolling).filter(([, of]) => of?.[key]?.length);
      const both = (title, key, factor, unit) => {
        const found = known(key).map(([name, of]) => ({ name, ...turn(of, of[key], factor) }));
        if (found.length) charts.push(chart(title, "azimuth [\u00b0]", unit, found));
      };
      both("Travel at fixed load, over one sector", "travel_at_load_m", 1e3, "[mm]");
      both("Radial force at fixed travel, over one sector", "force_at_travel_N", 1, "[N]");
      const spectrum = (title, key, factor, unit) => {
        const found = known(key).map(([name, of]) => ({ name, y: of[key].map((v) => v * factor) }));
        if (found.length) charts.push(chart(title, "waves per revolution", unit, found,
          { bars: true, labels: found[0].y.map((_, k) => `${(k + 1) * run.sectors}`) }));
      };
      spectrum("Spectrum of the travel", "travel_harmonics_m", 1e6, "[\u00b5m]");
      spectrum("Spectrum of the radial force", "force_harmonics_N", 1, "[N]");
      const stress = run.rolling.after.peak_von_mises_Pa, most = Math.max(...stress);
      charts.push(chart("Peak von Mises stress by load position; the largest is marked", "azimuth [\u00b0]", "[MPa]",
        [{ name: "after", y: stress.map((v) => v * 1e-6) }], { bars: true,
          labels: run.rolling.after.azimuths_rad.map((a) => shown(a * degree)),
          colours: stress.map((v) => v === most ? curveColours[1] : curveColours[0]) }));
    }
    if (run.pressures)
      charts.push(chart(run.dimension === 3 ? "Contact pressure in the middle of the width, all load positions" :
        "Contact pressure of all load positions", "along the ground [mm]", "[MPa]",
        run.pressures.map((p, k) => ({ name: `position ${k + 1}`, x: p.x_m.map((v) => v * 1e3),
          y: p.pressure_Pa.map((v) => v * 1e-6) }))));
    return charts;
  }

  // --- The page ---------------------------------------------------------------------------------------

  function provenance(run) {
    const commands = `wheelwright run case.toml            # computes this run again\n` +
      `wheelwright analyze ${run.name}            # its last wheel at 64 load positions per sector\n` +
      `wheelwright resume ${run.name} --iterations N   # continues`;
    return element("section", {}, element("h2", {}, "How it was made"),
      element("p", { class: "quiet" }, `${run.program}; ${rejectedText(run)}; ${minutes(run.seconds)}`),
      element("pre", {}, commands),
      element("details", {}, element("summary", {}, "The case"), element("pre", {}, run.case)));
  }

  function article(run, later) {
    const section = (title, ...children) => element("section", {}, element("h2", {}, title), ...children);
    const made = element("article", { id: run.id }, element("h1", {}, run.title),
      element("p", { class: "quiet", id: `${run.id}-status` }, `${data.runs.length > 1 ? `run ${run.name}; ` : ""}${run.status}; load ${run.load}`));
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
    const charts = curves(run);
    later.push(...charts);
    if (charts.length)
      made.append(section("Curves", element("div", { class: "pictures" }, ...charts.map(({ figure }) => figure))));
    if (run.summary) made.append(section("All numbers", beforeAndAfter(run)));
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
    const others = [...new Set(runs.flatMap((run) => Object.keys(run.summary.after.load_cases ?? {})))];
    const group = (name, numbersOf) => ({ name, units: runs[0].numbers, wheels: runs.map((run) =>
      ({ name: run.name, numbers: numbersOf(run.summary.after) ?? {} })) });
    return [later.at(-1).figure, table([group(runs[0].summary.after.load_case ?? "", (numbers) => numbers),
      ...others.map((name) => group(name, (numbers) => numbers.load_cases?.[name]))])];
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
