"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { formats, reportTexts } = require("./scripts.js").load("formats", "report_texts");

const units = [{ key: "mass_kg", label: "mass", unit: "kg", factor: 1 }, { key: "mean_travel_m", label: "travel", unit: "mm", factor: 1e3 },
  { key: "nobody_has_it", label: "", unit: "", factor: 1 }];
const group = (name, ...wheels) => ({ name, units, wheels: wheels.map((numbers, k) => ({ name: `wheel ${k}`, numbers })) });
const number = (text) => Number(text.replace("\u2212", "-"));
const numbersIn = (text) => (text.replaceAll("\u2212", "-").match(/-?\d+(\.\d+)?/g) ?? []).map(Number);

test("a comparison has a value for every wheel and a change for every wheel but the first", () => {
  const { names, rows } = reportTexts.comparison([group("", { mass_kg: 4, mean_travel_m: 2e-3 }, { mass_kg: 5, mean_travel_m: 1e-3 },
    { mass_kg: 3, mean_travel_m: 2e-3 })]);
  assert.equal(names.length, 5);
  const [mass, travel] = rows;
  assert.deepEqual(mass.cells.map(({ text }) => numbersIn(text)[0]), [4, 5, 25, 3, -25]);
  assert.deepEqual(travel.cells.map(({ text }) => numbersIn(text)[0]), [2, 1, -50, 2, 0]);
  assert.deepEqual(mass.cells.map(({ key }) => key), ["mass_kg", "mass_kg", null, "mass_kg", null]);
});

test("a value is shown with its error, in the unit of the table", () => {
  const { rows: [travel] } = reportTexts.comparison([group("", { mean_travel_m: 2e-3 },
    { mean_travel_m: 1.2345e-3, errors: { mean_travel_m: 2e-5 } })]);
  assert.deepEqual(travel.cells.map(({ text }) => text).slice(0, 2), ["2", "1.23 \u00b1 0.02"]);
});

test("a change that the errors of both values may explain is marked", () => {
  const change = (value, error) => reportTexts.comparison([group("", { mean_travel_m: 2e-3, errors: { mean_travel_m: 1e-5 } },
    { mean_travel_m: value, errors: { mean_travel_m: error } })]).rows[0].cells[2].text;
  assert.ok(change(2.025e-3, 2e-5).endsWith("~"));
  assert.ok(!change(2.035e-3, 2e-5).endsWith("~"));
  assert.ok(!change(2e-3, 2e-5).endsWith("~"));
  assert.ok(!change(2.025e-3, null).endsWith("~"));
});

test("quantities that no wheel has are not compared", () => {
  assert.equal(reportTexts.comparison([group("", { mass_kg: 4 }, {})]).rows.length, 1);
});

test("a missing value is a dash; a number of the shape stands in the first group only", () => {
  const { rows: [mass, travel] } = reportTexts.comparison([group("a", { mass_kg: 4, mean_travel_m: 1e-3 }, { mass_kg: NaN, mean_travel_m: 1e-3 }),
    group("b", { mean_travel_m: 2e-3 }, { mean_travel_m: 3e-3 })]);
  assert.deepEqual(mass.cells.map(({ text }) => text), ["4", "\u2013", "\u2013", "", "", ""]);
  assert.deepEqual(travel.cells.map(({ text }) => numbersIn(text)[0]), [1, 1, 0, 2, 3, 50]);
});

test("every load case is a group of before and after, also one that the first wheel does not have", () => {
  const groups = reportTexts.beforeAndAfter({ numbers: units, summary: {
    before: { mass_kg: 4, load_cases: { kerb: { mean_travel_m: 3e-3 } } },
    after: { mass_kg: 5, load_case: "straight", load_cases: { kerb: { mean_travel_m: 2e-3 }, curve: { mean_travel_m: 1e-3 } } } } });
  assert.deepEqual(groups.map(({ name }) => name), ["straight", "kerb", "curve"]);
  assert.deepEqual(groups[2].wheels.map(({ numbers }) => numbers), [{}, { mean_travel_m: 1e-3 }]);
});

test("runs are compared under the load cases of all of them", () => {
  const run = (name, load_cases) => ({ name, numbers: units, summary: { after: { mass_kg: 4, load_case: "straight", load_cases } } });
  const groups = reportTexts.lastWheels([run("a", { kerb: { mean_travel_m: 1e-3 } }), run("b", { curve: { mean_travel_m: 2e-3 } }), run("c")]);
  assert.deepEqual(groups.map(({ name }) => name), ["straight", "kerb", "curve"]);
  for (const { wheels } of groups) assert.deepEqual(wheels.map(({ name }) => name), ["a", "b", "c"]);
  assert.deepEqual(groups[1].wheels.map(({ numbers }) => numbers.mean_travel_m), [1e-3, undefined, undefined]);
});

// A bound on a travel in mm, for an objective in J.
function boundRun(relation, value, bound, { multiplier = 0, is_kept = true, kept_within } = {}) {
  return { objective: { unit: "J", factor: 1 }, bound_units: [{ unit: "mm", factor: 1e3 }],
    history: { iteration: [0, 1, 2], "bounded mean_travel [m]": [null, 0.004, 0.003], "bounded mean_travel_2 [m]": [9, 9, 9] },
    summary: { bounds: [{ name: "mean_travel", value, bound, relation, multiplier, is_kept, kept_within }] } };
}
const columns = (row) => Object.fromEntries(reportTexts.boundTitles.map((title, k) => [title, row[k]]));
const boundOf = (...of) => columns(reportTexts.boundRow(boundRun(...of), 0));

test("the margin is positive where the bound is kept, on either side", () => {
  const below = boundOf("<", 0.003, 0.005), above = boundOf(">", 0.006, 0.005), equal = boundOf("=", 0.006, 0.005);
  assert.deepEqual([below, above, equal].map((row) => number(row.margin)), [2, 1, -1]);
  assert.deepEqual([below, above, equal].map((row) => number(row["margin [%]"])), [40, 20, -20]);
  assert.ok(number(boundOf("<", 0.006, 0.005).margin) < 0 && number(boundOf(">", 0.004, 0.005).margin) < 0);
});

test("before is the first value that the history knows, of just this bound", () => {
  assert.equal(Number(boundOf("<", 0.003, 0.005).before), 4);
  const run = boundRun("<", 0.003, 0.005);
  run.history = { iteration: [0] };
  assert.ok(Number.isNaN(Number(columns(reportTexts.boundRow(run, 0)).before)));
});

test("a bound is active if it has a multiplier or is an equation, and not kept takes precedence", () => {
  const states = [boundOf("<", 0.003, 0.005), boundOf("<", 0.005, 0.005, { multiplier: 2 }), boundOf("=", 0.005, 0.005),
    boundOf("<", 0.006, 0.005, { multiplier: 2, is_kept: false })].map(({ state }) => state);
  assert.equal(new Set([states[0], states[1], states[3]]).size, 3);
  assert.equal(states[1], states[2]);
});

test("a bound and the verdict name the tolerance without which the bound is not kept", () => {
  assert.match(boundOf("<", 0.005002, 0.005, { multiplier: 2, kept_within: 1e-3 }).state, /^active.* within 0\.1 %$/);
  assert.doesNotMatch(boundOf("<", 0.005, 0.005, { multiplier: 2 }).state, /within/);
  const run = { flags: [], summary: { before: {}, after: {}, bounds: [{ is_kept: true, kept_within: 1e-3 }, { is_kept: true }] } };
  assert.match(reportTexts.verdict(run), /both bounds are kept within 0\.1 %/i);
  assert.doesNotMatch(reportTexts.verdict({ ...run, summary: { ...run.summary, bounds: [{ is_kept: true }] } }), /within/);
});

test("a bound and the verdict tell what a finer grid says", () => {
  const stateOf = (verdict, is_kept = true) => {
    const run = boundRun("<", 0.005, 0.005, { multiplier: 2, is_kept });
    run.summary.bounds[0].on_finer_grid = { value: 0.00501, error: 2e-5, verdict };
    return columns(reportTexts.boundRow(run, 0)).state;
  };
  assert.equal(new Set(["kept", "within_error", "broken", undefined].map((verdict) => stateOf(verdict))).size, 4);
  assert.match(stateOf("broken"), /broken on a finer grid/);
  assert.equal(stateOf("broken", false), "not kept");
  const bounds = ["kept", "within_error", "broken"].map((verdict) => ({ is_kept: true, on_finer_grid: { verdict } }));
  const run = { flags: [], summary: { before: {}, after: {}, bounds } };
  assert.deepEqual(numbersIn(reportTexts.verdict(run)), [3, 2]);
});

test("the multiplier is in the units of the objective and the bound", () => {
  assert.deepEqual(numbersIn(boundOf("<", 0.005, 0.005, { multiplier: 2000 }).multiplier), [2]);  // J per mm
});

test("a bound at zero has no relative margin", () => {
  assert.ok(Number.isNaN(Number(boundOf("<", 0.003, 0)["margin [%]"])));
});

// A result with so many bounds of each kind, and remarks.
const result = (kept, broken, remarks) => ({ flags: Array(remarks).fill("remark"), summary: {
  before: { objective: 4, stiffness_N_per_m: 1e6 }, after: { objective: 3, stiffness_N_per_m: 1.2e6 },
  bounds: [...Array(kept).fill({ is_kept: true }), ...Array(broken).fill({ is_kept: false })] } });

test("the verdict tells both changes and counts broken bounds and remarks", () => {
  assert.deepEqual(numbersIn(reportTexts.verdict(result(0, 0, 0))), [-25, 20]);
  assert.deepEqual(numbersIn(reportTexts.verdict(result(3, 0, 0))), [-25, 20, 3]);
  assert.deepEqual(numbersIn(reportTexts.verdict(result(3, 2, 4))), [-25, 20, 2, 5, 4]);
});

test("the verdict is one sentence, whatever is missing", () => {
  const bare = { flags: [], summary: { before: {}, after: {} } };
  for (const run of [bare, result(1, 0, 1), result(2, 0, 1), result(0, 1, 0)]) {
    const text = reportTexts.verdict(run);
    assert.match(text, /^[A-Z].*[a-z]\.$/);
    assert.doesNotMatch(text, /undefined|NaN|^\W/);
  }
});

test("rejected trials are summed over their reasons", () => {
  assert.deepEqual(numbersIn(reportTexts.rejectedTrials({ trials: 30, rejected: { not_better: 4, no_solution: 3 } })), [30, 7, 4, 3]);
  assert.deepEqual(numbersIn(reportTexts.rejectedTrials({ trials: 30, rejected: {} })), [30, 0]);
});

const wheel = { stiffness_N_per_m: 2e6, run_out_m: 1e-4, force_variation_N: 12, volume_fraction: 0.5, peak_von_mises_Pa: 3e6,
  peak_von_mises_place: { radius_m: 0.25, azimuth_rad: Math.PI / 6 }, peak_pressure_Pa: 4e5, mean_travel_m: 2e-3, load_N: 5000,
  largest_strain: 0.07, travel_by_ring_thickness: 0.04 };
const answered = { summary: { before: { ...wheel, mean_travel_m: 4e-3 }, after: wheel }, flags: [], status: "ended", trials: 9, seconds: 30,
  inner_radius_m: 0.2, outer_radius_m: 0.3, width_m: 0.1 };
const answerTo = (run, asked) => reportTexts.answers(run).find(([id]) => id === asked)?.[2];

test("answers are in practical units", () => {
  assert.deepEqual(numbersIn(answerTo(answered, "stiffness")), [2000]);
  assert.deepEqual(numbersIn(answerTo(answered, "evenness")), [0.1, 12]);
  assert.deepEqual(numbersIn(answerTo(answered, "stress")), [3, 250, 30]);
  assert.deepEqual(numbersIn(answerTo(answered, "travel")), [2]);
  assert.deepEqual(numbersIn(answerTo(answered, "strain")), [7, 4]);
  const after = { ...wheel, linear_theory_error: 0.03 };
  assert.deepEqual(numbersIn(answerTo({ ...answered, summary: { before: wheel, after } }, "strain")), [7, 4, 3]);
  assert.equal(numbersIn(answerTo(answered, "change"))[0], -50);
});

test("the peak stress of each layer is told with its place", () => {
  const after = { ...wheel, "peak_von_mises_Pa of tyre": 1e6, "peak_von_mises_place of tyre": { radius_m: 0.3, azimuth_rad: 0 } };
  const run = { ...answered, layers: { names: ["core", "tyre"] }, summary: { before: wheel, after } };
  assert.deepEqual(numbersIn(answerTo(run, "stress")), [3, 250, 30, 1, 300, 0]);
  assert.match(answerTo(run, "stress"), /tyre: /);
});

test("the volume is that of the ring times its fraction", () => {
  const [volume, percents] = numbersIn(answerTo(answered, "volume"));
  assert.ok(Math.abs(volume - 1e6 * 0.5 * Math.PI * (0.09 - 0.04) * 0.1) < 0.1);
  assert.equal(percents, 50);
});

test("remarks are counted in the answer about trust", () => {
  assert.deepEqual(numbersIn(answerTo(answered, "trust")), []);
  assert.deepEqual(numbersIn(answerTo({ ...answered, flags: ["a", "b"] }, "trust")), [2]);
});

test("walls, edges and mass are shown only if they are known", () => {
  assert.equal(answerTo(answered, "wall"), undefined);
  assert.equal(answerTo(answered, "edges"), undefined);
  const after = { ...wheel, mass_kg: 7.5, minimum_wall_m: 4e-3, roughness_turns: 0.2, internal_corner_radius_m: 1e-3 };
  const run = { ...answered, summary: { before: wheel, after } };
  assert.deepEqual(numbersIn(answerTo(run, "wall")), [4]);
  assert.deepEqual(numbersIn(answerTo(run, "edges")), [1, 0.2]);
  assert.equal(numbersIn(answerTo(run, "volume"))[0], 7.5);
});

test("a remark is a sentence and, verbatim, lines for a case", () => {
  assert.deepEqual(reportTexts.remark("use this:\n[grid]\n  degree = 2"), ["Use this:", "[grid]\n  degree = 2"]);
  assert.deepEqual(reportTexts.remark("only this"), ["Only this", ""]);
});

test("omitted events are counted", () => {
  assert.deepEqual(numbersIn(reportTexts.eventsTitle({ events: [{}, {}], events_omitted: 5 })), [7, 2]);
  assert.deepEqual(numbersIn(reportTexts.eventsTitle({ events: [{}, {}], events_omitted: 0 })), [2]);
});

test("the numbers of a position are found by its azimuth", () => {
  const numbers = { azimuths_rad: [0, 0.1], travel_at_load_m: [1e-3, 2e-3], peak_pressure_Pa: [1e6, 3e6], peak_von_mises_Pa: [5e6, 7e6] };
  assert.deepEqual(numbersIn(reportTexts.positionNumbers(numbers, 0.1 + 1e-12)), [2, 3, 7]);
  assert.equal(reportTexts.positionNumbers(numbers, 0.05), "");
  assert.equal(reportTexts.positionNumbers(undefined, 0), "");
  assert.deepEqual(numbersIn(reportTexts.positionNumbers({ ...numbers, travel_at_load_m: null }, 0)), [1, 5]);
});

test("the peak stress is that of the load case shown", () => {
  const run = { summary: { after: { load_case: "straight", peak_von_mises_Pa: 2e6, load_cases: { kerb: { peak_von_mises_Pa: 5e6 }, ice: {} } } } };
  assert.equal(reportTexts.peakStress(run, "straight"), 2);
  assert.equal(reportTexts.peakStress(run, undefined), 2);
  assert.equal(reportTexts.peakStress(run, "kerb"), 5);
  for (const [of, loadCase] of [[run, "ice"], [run, "none"], [{}, undefined]]) assert.equal(reportTexts.peakStress(of, loadCase), undefined);
});

test("magnifications include the true scale and the best one, without repetition", () => {
  const { best, all } = reportTexts.magnifications(0.3, 1e-3);  // 9 would be right
  assert.equal(best, 5);
  assert.deepEqual(all, [1, 2.5, 5, 10]);
  assert.deepEqual(reportTexts.magnifications(0.3, 0.1).all, [1, 2]);
});
