"use strict";
// What the page of a run derives from a view ("frame") of the run, from the numbers of a shape, and from pictures of the
// loaded wheel, as the server sends them.
const frameChanges = (() => {
  const { short, words, sentence, within } = formats;

  const labels = { volume_fraction: "material", mass_kg: "mass", mean_travel_m: "travel", stiffness_N_per_m: "stiffness",
    run_out_m: "run-out", force_variation_N: "force variation", peak_pressure_Pa: "peak pressure",
    patch_length_m: "patch length", peak_von_mises_Pa: "peak stress", largest_strain: "largest strain",
    minimum_wall_m: "thinnest wall", minimum_gap_m: "narrowest gap" };
  const ids = { volume_fraction: "volume", mean_travel_m: "travel", run_out_m: "run-out", peak_pressure_Pa: "pressure" };

  // The rows of the table of numbers that both sides know: { id, name, unit, before, now, isLate }. The frame is newer than
  // the numbers: what it knows itself replaces theirs; the rest is late if it is of an earlier shape.
  function numberRows(frame, numbers, loadCase) {
    const now = { ...numbers.now, volume_fraction: frame.numbers.volume_fraction,
      ...(frame.load_case === loadCase ? frame.contact_numbers : {}) };
    return numbers.rows
      .filter(({ key }) => key in labels && (numbers.now[key] !== undefined || numbers.before[key] !== undefined))
      .map(({ key, unit, factor }) => ({ id: ids[key] ?? key, name: labels[key], unit,
        before: numbers.before[key] * factor, now: now[key] * factor,
        isLate: numbers.shape_version !== frame.shape_version && now[key] === numbers.now[key] && key !== "volume_fraction" }));
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

  return { numberRows, boundRow, clauses, newest, comparable, pictureKey, isSameShape, sameOutline, travelCurve };
})();
