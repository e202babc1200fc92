"use strict";
// The curves of a report: { title, x, y, curves: [{ name, x, y, errors }], options }, where x and y are the titles of the axes, as
// parts.chart() takes them.
const reportCurves = (() => {
  const { degree, shown, words } = formats, { curveColours } = colours;

  // A course over the shapes: the columns of the history that begin with these words, without empty ones and without copies
  // of the first.
  function course(run, title, starts, factor, unit, axis) {
    const column = (word) => Object.keys(run.history).find((name) => name.startsWith(word));
    const found = starts.map(column).filter((name) => name && run.history[name].some((v) => v !== null))
      .filter((name, k, all) => k === 0 || String(run.history[name]) !== String(run.history[all[0]]));
    const curves = found.map((name) => ({ name: words(name.split(" [")[0]), x: run.history.iteration ?? [],
      y: run.history[name].map((v) => v === null ? null : v * factor) }));
    return { title, x: "shape", y: unit, curves, options: { y: axis } };
  }

  // Values at the load positions of one sector, closed.
  function overOneSector({ azimuths_rad }, values, factor, sectors) {
    const x = azimuths_rad.map((a) => a * degree);
    return { x: [...x, x[0] + 360 / sectors], y: [...values, values[0]].map((v) => v * factor) };
  }

  const wheelsWith = (run, key) => Object.entries(run.rolling).filter(([, of]) => of?.[key]?.length);

  // With bands of their errors, as far as they are known.
  const rollingCurve = (run, title, key, factor, unit) => ({ title, x: "azimuth [\u00b0]", y: unit, options: {},
    curves: wheelsWith(run, key).map(([name, of]) => ({ name, ...overOneSector(of, of[key], factor, run.sectors),
      ...(of.errors?.[key]?.length ? { errors: overOneSector(of, of.errors[key], factor, run.sectors).y } : {}) })) });

  function spectrum(run, title, key, factor, unit) {
    const curves = wheelsWith(run, key).map(([name, of]) => ({ name, y: of[key].map((v) => v * factor) }));
    return { title, x: "waves per revolution", y: unit, curves,
      options: { bars: true, labels: (curves[0]?.y ?? []).map((_, k) => `${(k + 1) * run.sectors}`) } };
  }

  function stressByPosition({ peak_von_mises_Pa: stress, azimuths_rad }) {
    const most = Math.max(...stress);
    return { title: "Peak von Mises stress by load position; the largest is marked", x: "azimuth [\u00b0]", y: "[MPa]",
      curves: [{ name: "after", y: stress.map((v) => v * 1e-6) }], options: { bars: true,
        labels: azimuths_rad.map((a) => shown(a * degree)),
        colours: stress.map((v) => v === most ? curveColours[1] : curveColours[0]) } };
  }

  const pressures = (run) => ({ x: "along the ground [mm]", y: "[MPa]", options: {},
    title: `Contact pressure${run.dimension === 3 ? " in the middle of the width" : ""} of all load positions, means of cells`,
    curves: run.pressures.map((p, k) => ({ name: `position ${k + 1}`, x: p.x_m.map((v) => v * 1e3),
      y: p.pressure_Pa.map((v) => v * 1e-6) })) });

  // The terms of the objective are the columns between it and the first measure; those of its unit share its chart.
  function terms(run) {
    const names = Object.keys(run.history), place = (word) => names.findIndex((name) => name.startsWith(word));
    const from = place("objective"), to = place("mean_travel"), unit = names[from]?.split(" [")[1];
    return names.slice(from + 1, to < 0 ? names.length : to)
      .filter((name) => name.endsWith(` [${unit}`) && !name.includes(" in "));
  }

  // All that a run has data for.
  function all(run) {
    const charts = [
      course(run, "Objective and its terms", ["objective", ...terms(run)], run.objective.factor, `[${run.objective.unit}]`),
      course(run, "Mean travel and run-out", ["mean_travel", "run_out"], 1e3, "[mm]"),
      course(run, "Peaks of pressure and stress", ["peak_pressure", "peak_von_mises ["], 1e-6, "[MPa]"),
      course(run, "Volume", ["volume fraction"], 100, "[% of the ring]", { grace: 0.05 }),
    ];
    if (run.rolling?.after) charts.push(
      rollingCurve(run, "Travel at fixed load, over one sector", "travel_at_load_m", 1e3, "[mm]"),
      rollingCurve(run, "Radial force at fixed travel, over one sector", "force_at_travel_N", 1, "[N]"),
      spectrum(run, "Spectrum of the travel", "travel_harmonics_m", 1e6, "[\u00b5m]"),
      spectrum(run, "Spectrum of the radial force", "force_harmonics_N", 1, "[N]"),
      stressByPosition(run.rolling.after));
    if (run.pressures) charts.push(pressures(run));
    return charts.filter(({ curves }) => curves.length > 0);
  }

  return { all };
})();
