"use strict";
// The tables and sentences of a report, as plain texts.
const reportTexts = (() => {
  const { degree, shown, rowText, change, within, minutes, sentence, words } = formats;
  const none = "\u2013";

  // Whether two values differ, but by no more than the errors that are known of them.
  function isWithinErrors(first, other, key) {
    const difference = Math.abs(other[key] - first[key]);
    return difference > 0 && difference <= (first.errors?.[key] ?? 0) + (other.errors?.[key] ?? 0);
  }

  // Columns of wheels with their change relative to the first one, in groups that may have a name: `names`, those of the
  // columns after the first; `rows`: { title, cells: [{ text, key }] }, without the quantities that no wheel has. `key` is
  // that of the quantity in the summary, or null for a change; a change that the errors of the two values may explain is marked
  // with "~".
  function comparison(groups) {
    const columns = (of) => groups.flatMap(({ wheels }) => wheels.flatMap((wheel, k) => of(wheel, k, wheels)));
    const rows = groups[0].units
      .filter(({ key }) => groups.some(({ wheels }) => wheels.some(({ numbers }) => Number.isFinite(numbers[key]))))
      .map(({ key, label, ...row }) => ({ title: `${label} [${row.unit}]`, cells: columns(({ numbers }, k, wheels) => {
        const isOfShape = !wheels.some((wheel) => key in wheel.numbers);  // so it is in the first group
        const missing = isOfShape ? "" : none, both = [wheels[0].numbers[key], numbers[key]];
        const value = { key, text: Number.isFinite(numbers[key]) ?
          rowText(row, numbers[key], numbers.errors?.[key] ?? NaN) : missing };
        const mark = isWithinErrors(wheels[0].numbers, numbers, key) ? " ~" : "";
        return k === 0 ? [value] : [value, { key: null, text: both.every(Number.isFinite) ? change(...both) + mark : missing }];
      }) }));
    return { names: columns(({ name }, k) => k === 0 ? [name] : [name, "change"]), rows };
  }

  // The groups of a run: before and after, under each load case.
  function beforeAndAfter(run) {
    const { before, after } = run.summary;
    const group = (name, first, last) => ({ name, units: run.numbers,
      wheels: [{ name: "before", numbers: first ?? {} }, { name: "after", numbers: last }] });
    return [group(after.load_case ?? "", before, after), ...Object.entries(after.load_cases ?? {})
      .map(([name, numbers]) => group(name, before.load_cases?.[name], numbers))];
  }

  // The groups of several runs: their last wheels, under each load case that one of them has.
  function lastWheels(runs) {
    const others = [...new Set(runs.flatMap((run) => Object.keys(run.summary.after.load_cases ?? {})))];
    const group = (name, numbersOf) => ({ name, units: runs[0].numbers, wheels: runs.map((run) =>
      ({ name: run.name, numbers: numbersOf(run.summary.after) ?? {} })) });
    return [group(runs[0].summary.after.load_case ?? "", (numbers) => numbers),
      ...others.map((name) => group(name, (numbers) => numbers.load_cases?.[name]))];
  }

  const boundTitles = ["bound", "limit", "before", "after", "margin", "margin [%]", "state", "multiplier"];

  // What a finer grid says about a bound that is kept, after that word.
  const finerVerdicts = { kept: ", on a finer grid too", within_error: ", but not within the error on a finer grid",
    broken: ", but broken on a finer grid" };

  // A bound at the last shape that the run computed, in the units of tables: the texts of its row, below boundTitles.
  function boundRow(run, k) {
    const { name, value: last, bound: limit, relation, multiplier, is_kept: isKept, kept_within: tolerance,
      on_finer_grid: finer } = run.summary.bounds[k];
    const column = Object.keys(run.history).find((one) => one.startsWith(`bounded ${name} [`));
    const before = (run.history[column] ?? []).find((value) => value !== null);
    const { unit, factor } = run.bound_units[k];
    const [value, bound] = [last * factor, limit * factor], price = multiplier * run.objective.factor / factor;
    const margin = relation === "<" ? bound - value : relation === ">" ? value - bound : -Math.abs(value - bound);
    return [`${words(name)} [${unit}]`, `${{ "<": "at most", ">": "at least", "=": "equal to" }[relation]} ${shown(bound)}`,
      before === undefined ? none : shown(before * factor), shown(value), shown(margin),
      bound ? shown(100 * margin / Math.abs(bound)) : none,
      !isKept ? "not kept" : (relation === "=" || multiplier !== 0 ? "active" : "not active") +
        (tolerance ? `, kept${within(tolerance)}` : "") + (finerVerdicts[finer?.verdict] ?? ""),
      `${shown(price)}${price ? ` ${run.objective.unit} per ${unit}` : ""}`];
  }

  // The result in one sentence.
  function verdict(run) {
    const { before, after, bounds: all = [] } = run.summary;
    const key = ["objective", "objective_J_per_m", "objective_J"].find((name) => Number.isFinite(after[name]));
    const facts = [];
    if (key && Number.isFinite(before[key])) facts.push(`the objective changed by ${change(before[key], after[key])}`);
    if (Number.isFinite(before.stiffness_N_per_m) && Number.isFinite(after.stiffness_N_per_m))
      facts.push(`the stiffness by ${change(before.stiffness_N_per_m, after.stiffness_N_per_m)}`);
    const broken = all.filter(({ is_kept }) => !is_kept).length;
    const doubtful = all.filter(({ on_finer_grid: finer }) => finer?.verdict && finer.verdict !== "kept").length;
    const tolerance = within(Math.max(0, ...all.map(({ kept_within: one }) => one ?? 0)));
    if (all.length) facts.push(broken ? `${broken} of ${all.length} bounds ${broken > 1 ? "are" : "is"} not kept` :
      (all.length > 2 ? `all ${all.length} bounds are kept` : all.length > 1 ? "both bounds are kept" : "the bound is kept") +
        tolerance + (doubtful ? `, ${doubtful} of them not within the error on a finer grid` : ""));
    facts.push(run.flags.length === 0 ? "there are no remarks" :
      `there ${run.flags.length > 1 ? `are ${run.flags.length} remarks` : "is a remark"} below`);
    return sentence(`${facts.slice(0, -1).join(", ")}${facts.length > 1 ? "; " : ""}${facts.at(-1)}.`);
  }

  function rejectedTrials(run) {
    const reasons = Object.entries(run.rejected), n = reasons.reduce((sum, [, count]) => sum + count, 0);
    const why = n ? ` (${reasons.map(([reason, count]) => `${words(reason)}: ${count}`).join(", ")})` : "";
    return `${run.trials} trial shapes, ${n} rejected${why}`;
  }

  // A buyer's questions, with answers: [name, question, answer].
  function answers(run) {
    const list = [], answer = (...one) => list.push(one);
    const { before, after } = run.summary;
    const peak = (of) => {
      const place = after[`peak_von_mises_place${of}`];
      return `${shown(after[`peak_von_mises_Pa${of}`] * 1e-6)} MPa at radius ${shown(place.radius_m * 1e3)} mm, azimuth ` +
        `${shown(place.azimuth_rad * degree)}\u00b0`;
    };
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
    const layers = (run.layers?.names ?? []).filter((layer) => after[`peak_von_mises_place of ${layer}`]);
    answer("stress", "What peak stress, and where?",
      [peak(""), ...layers.map((layer) => `${layer}: ${peak(` of ${layer}`)}`)].join("; "));
    answer("pressure", "What pressure on the ground?", `${shown(after.peak_pressure_Pa * 1e-6)} MPa`);
    answer("travel", "How far does it sink?", `${shown(after.mean_travel_m * 1e3)} mm`);
    answer("load", "For which load?", `${shown(after.load_N)} N`);
    answer("strain", "Is it suited to this load?", `largest strain ${shown(100 * after.largest_strain)} %, travel ` +
      `${shown(100 * after.travel_by_ring_thickness)} % of the ring` + (Number.isFinite(after.linear_theory_error) ?
        `; linear theory errs by about ${shown(100 * after.linear_theory_error)} % in travel and stiffness` : ""));
    answer("change", "What changed?", `travel ${change(before.mean_travel_m, after.mean_travel_m)}, run-out ` +
      `${change(before.run_out_m, after.run_out_m)}, peak stress ` +
      `${change(before.peak_von_mises_Pa, after.peak_von_mises_Pa)}`);
    answer("trust", "Can I trust it?", run.flags.length === 0 ? "no remarks; its limitations are listed below" :
      `${run.flags.length} remark${run.flags.length > 1 ? "s" : ""} and the limitations below`);
    answer("making", "How was it made?", `${run.status}; ${run.trials} trial shapes, ${minutes(run.seconds)}`);
    return list;
  }

  // A remark as a sentence and lines for a case file, "" if it has none.
  function remark(text) {
    const [told, ...lines] = sentence(text).split("\n");
    return [told, lines.join("\n")];
  }

  const eventsTitle = ({ events, events_omitted: omitted }) =>
    `What happened to the holes: ${events.length + omitted} shape${events.length > 1 ? "s" : ""}` +
      (omitted ? `, of which the last ${events.length}` : "");

  // What is known about a load position besides its picture.
  function positionNumbers(numbers, azimuth_rad) {
    const k = (numbers?.azimuths_rad ?? []).findIndex((azimuth) => Math.abs(azimuth - azimuth_rad) < 1e-9);
    return k < 0 ? "" : `: travel ${shown((numbers.travel_at_load_m?.[k] ?? NaN) * 1e3)} mm, peak pressure ` +
      `${shown(numbers.peak_pressure_Pa[k] * 1e-6)} MPa, peak stress ${shown(numbers.peak_von_mises_Pa[k] * 1e-6)} MPa`;
  }

  // The largest stress of all load positions under a load case, in MPa; undefined if the run has no such number.
  function peakStress({ summary }, loadCase) {
    const after = summary?.after, numbers = !loadCase || loadCase === after?.load_case ? after : after?.load_cases?.[loadCase];
    return Number.isFinite(numbers?.peak_von_mises_Pa) ? numbers.peak_von_mises_Pa * 1e-6 : undefined;
  }

  // The magnifications to choose from, and the best one of them.
  function magnifications(outerRadius, displacement) {
    const best = formats.roundMagnification(0.03 * outerRadius / displacement);
    return { best, all: [...new Set([1, best / 5, best / 2, best, 2 * best].filter((m) => m >= 1))] };
  }

  return { comparison, beforeAndAfter, lastWheels, boundTitles, boundRow, verdict, rejectedTrials, answers, remark, eventsTitle,
    positionNumbers, peakStress, magnifications };
})();
