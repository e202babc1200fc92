"use strict";
// What the page of a run derives from a view ("frame") of the run, from the numbers of a shape, and from pictures of the
// loaded wheel, as the server sends them.
const frameChanges = (() => {
  const { shown, short, rowText, words, sentence, within, minutes } = formats;

  const labels = { objective_J_per_m: "objective", objective_J: "objective", volume_fraction: "material",
    mass_kg: "mass", mean_travel_m: "travel", stiffness_N_per_m: "stiffness",
    run_out_m: "run-out", force_variation_N: "force variation", peak_pressure_Pa: "peak pressure",
    patch_length_m: "patch length", peak_von_mises_Pa: "peak stress", largest_strain: "largest strain",
    minimum_wall_m: "thinnest wall", minimum_gap_m: "narrowest gap" };
  const ids = { volume_fraction: "volume", mean_travel_m: "travel", run_out_m: "run-out", peak_pressure_Pa: "pressure" };

  // The label of a number by its key, also of one of a layer, as "mass_kg of tyre"; undefined if the page does not show it.
  function labelOf(key) {
    const [of, layer] = key.split(/ of (.*)/);
    return layer && labels[of] ? `${labels[of]} of ${layer}` : labels[key];
  }

  // The numbers of an estimate of errors under a load case, by name: values by their keys, `errors` and `missing_errors`.
  const estimateUnder = (estimate, name) => ({ ...estimate, ...estimate?.load_cases?.[name] });

  // Whether an estimate is of the shape, and the load, of a frame.
  const isOf = (estimate, frame) => estimate?.shape_version === frame.shape_version;

  const caseName = (frame, loadCase) => frame.settings?.load_cases[loadCase]?.name;

  // The rows of the table of numbers that both sides know: { id, name, unit, before, now, error, isLate }. The frame is newer
  // than the numbers: what it knows itself replaces theirs; the rest is late if it is of an earlier shape. `error` is NaN
  // unless there is an estimate of this shape.
  function numberRows(frame, numbers, loadCase, estimate = null) {
    const { errors = {}, ...estimated } = isOf(estimate, frame) ? estimateUnder(estimate, caseName(frame, loadCase)) : {};
    const now = { ...numbers.now, ...estimated, volume_fraction: frame.numbers.volume_fraction,
      ...(frame.load_case === loadCase ? frame.contact_numbers : {}) };
    return numbers.rows
      .filter(({ key }) => labelOf(key) && (numbers.now[key] !== undefined || numbers.before[key] !== undefined))
      .map(({ key, unit, factor }) => ({ id: ids[key] ?? key.replaceAll(" ", "_"), name: labelOf(key), unit,
        before: numbers.before[key] * factor, now: now[key] * factor, error: (errors[key] ?? NaN) * factor,
        isLate: numbers.shape_version !== frame.shape_version && now[key] === numbers.now[key]
          && !(key in estimated) && key !== "volume_fraction" }));
  }

  // The error of the objective at a frame; NaN if it is not known.
  function objectiveError(frame, estimate) {
    const { errors = {} } = isOf(estimate, frame) ? estimate : {};
    return errors.objective_J_per_m ?? errors.objective_J ?? NaN;
  }

  // The numbers of an estimate under a load case with their errors, or why these are missing: { name, unit, text }.
  function errorRows(estimate, name) {
    const { rows = [], errors = {}, missing_errors: missing = {}, ...values } = estimateUnder(estimate, name);
    const objective = [["objective_J_per_m", "J/m"], ["objective_J", "J"]].map(([key, unit]) => ({ key, unit, factor: 1 }));
    return [...objective, ...rows].filter(({ key }) => labelOf(key) && (errors[key] !== undefined || missing[key] !== undefined))
      .map(({ key, unit, factor }) => ({ name: labelOf(key), unit, text: missing[key] === undefined
        ? rowText({ unit, factor }, values[key], errors[key])
        : `${shown(values[key] * factor)}; ${missing[key]}` }));
  }

  // What is said about errors: that a shape is being solved, or of which shape they are, and whether that is still the newest.
  function errorsText({ busy, estimate }, frame) {
    if (busy) return `Solving shape ${busy.shape} on a finer grid: ${minutes(busy.seconds)} so far`;
    const of = `of shape ${estimate.shape}`;
    if (estimate.failure) return `No errors ${of}: ${estimate.failure}`;
    const reasons = new Set(Object.values(estimate.missing_errors ?? {}));
    if (!Object.values(estimate.errors).some(Number.isFinite)) return `No errors ${of}: ${[...reasons].join("; ")}`;
    return `Errors \u00b1 ${of}, estimated in ${minutes(estimate.seconds)}`
      + (isOf(estimate, frame) ? "" : `. The wheel or its load has changed since.`);
  }

  // The row of a bound: { name, unit, value, limit, isKept, state }.
  function boundRow({ name, shown: { unit, factor }, value, relation, limit, is_kept: isKept, kept_within: tolerance }) {
    const sign = { "<": "\u2264", ">": "\u2265", "=": "=" }[relation];
    return { name: words(name), unit, value: short(value * factor), limit: `${sign} ${short(limit * factor)}`, isKept,
      state: isKept ? `met${within(tolerance)}` : "not met" };
  }

  // A warning as its first clause and the rest, which is "" if there is but one clause.
  function clauses(text) {
    const told = sentence(text), end = told.search(/[.;] /) + 1;
    return end === 0 ? [told, ""] : [told.slice(0, end - 1), sentence(told.slice(end).trim())];
  }

  // A new list: at most `most` entries, the newest ones.
  const newest = (list, added, most) => [...list, ...added].slice(-most);

  // The newest points of the curve of shapes whose objectives can be compared: those since the initial shape has the same
  // objective as at the last point, so since the last change of load, weights or grid.
  function comparable(curve) {
    const first = ([, , , , , objective]) => objective, now = first(curve.at(-1) ?? []);
    const isSame = (point) => first(point) === now || Math.abs(first(point) / now - 1) < 1e-9;
    let from = curve.length;
    while (from > 0 && isSame(curve[from - 1])) --from;
    return curve.slice(from);
  }

  // What identifies a picture of the loaded wheel.
  const pictureKey = ({ shape_version: version, load_case: loadCase, position }) => `${version} ${loadCase} ${position}`;

  // Whether two pictures show the same shape in the same load case.
  const isSameShape = (a, b) => a.shape_version === b.shape_version && a.load_case === b.load_case;

  const sameOutline = (a, b) => a === b || JSON.stringify(a) === JSON.stringify(b);

  // The travel over one sector [degrees, mm], closed.
  const travelCurve = (travel_m, sectors) => ({ x: [...travel_m, 0].map((_, k) => k * 360 / sectors / travel_m.length),
    y: [...travel_m, travel_m[0]].map((t) => t * 1e3) });

  return { estimateUnder, isOf, caseName, numberRows, objectiveError, errorRows, errorsText, boundRow, clauses, newest, comparable, pictureKey, isSameShape, sameOutline, travelCurve };
})();
