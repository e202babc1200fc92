"use strict";
// Numbers as the pages show them. Without a browser, as the other files of pure functions: tests/pages/*.test.js.
const formats = (() => {
  const degree = 180 / Math.PI;

  // At most five digits, without unusual exponents.
  function shown(value) {
    if (!Number.isFinite(value)) return "\u2013";
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-4 || size >= 1e7) ? value.toExponential(3) : String(Number(value.toPrecision(5)));
    return text.replace(/^-/, "\u2212");
  }

  // With its error, in the same digits: the error rounded up to one digit, or two if the first is 1.
  function withError(value, error) {
    if (!(error > 5e-7 * Math.abs(value)) || !Number.isFinite(error) || !Number.isFinite(value)) return shown(value);
    const first = Math.floor(Math.log10(error)), upTo = (place) => Math.ceil(error / 10 ** place - 1e-9);
    const place = upTo(first - 1) < 20 ? first - 1 : first;
    const at = (units) => (units * 10 ** place).toFixed(Math.max(0, -place)).replace(/^-/, "\u2212");
    return `${at(Math.round(value / 10 ** place))} \u00b1 ${at(upTo(place))}`;
  }

  // The same for a number of a row of shown_numbers(): a life, which varies by powers of ten, with the range of its error,
  // value (f - 1), by the factor f.
  function rowText({ unit, factor }, value, error) {
    if (unit !== "km" || !(error > 0.1 * value) || !Number.isFinite(error)) return withError(value * factor, error * factor);
    const two = (number) => shown(Number((number * factor).toPrecision(2))), f = 1 + error / value;
    return `${two(value)} (${two(value / f)} to ${two(value * f)})`;
  }

  // At most four digits.
  const short = (value) => Number.isFinite(value) ? shown(Number(value.toPrecision(4))) : "\u2013";

  // The relative change in percent, with its sign.
  function change(before, after) {
    const percents = 100 * (after / before - 1);
    if (!(Math.abs(percents) < 1e5)) return "";  // before is negligible
    return Math.abs(percents) < 0.005 ? "0 %" : `${percents > 0 ? "+" : "\u2212"}${Math.abs(percents).toFixed(2)} %`;
  }

  // The same with one decimal.
  const briefChange = (before, after) => change(before, after).replace(/(\.\d)\d* %/, "$1\u2009%");

  // The tolerance due to which a bound counts as kept, after that word; "" if none is needed.
  const within = (tolerance) => tolerance ? ` within ${Number((100 * tolerance).toPrecision(2))} %` : "";

  const minutes = (seconds) => seconds < 100 ? `${seconds.toFixed(1)} s` : `${(seconds / 60).toFixed(1)} min`;

  // The largest of 1, 2 and 5 times a power of ten that is not above the wanted magnification, at least 1.
  function roundMagnification(wanted) {
    const power = 10 ** Math.floor(Math.log10(wanted));
    return Math.max(1, [1, 2, 5, 10].map((m) => m * power).filter((m) => m <= wanted * 1.0001).pop());
  }

  // The magnification at which displacements of this size [m] show: the current one while it is about right, so that it
  // seldom changes.
  function steadyMagnification(current, travel, outerRadius) {
    const wanted = 0.03 * outerRadius / Math.max(travel, 1e-12);
    return current > 0.4 * wanted && current < 1.25 * wanted ? current : roundMagnification(wanted);
  }

  // The labels of a colour scale at the given shares of its length. The last one has the unit, and names the peak if that
  // is above the end of the colours.
  function scaleLabels(shares, { end, unit, power = 1, peak = end }) {
    const digits = (value) => String(Number(value.toPrecision(3)));
    const beyond = Number(digits(peak)) > Number(digits(end)) ? `, up to ${digits(peak)}` : "";
    return shares.map((t) => digits(t ** power * end) + (t === 1 ? `${beyond} ${unit}` : ""));
  }

  // What the lines in a picture are; "" for a wheel of one material, which has no layers.
  const layersText = (layers) => layers ? ` Lines lie between layers, from the rim: ${layers.names.join(", ")}.` : "";

  const sentence = (text) => text[0].toUpperCase() + text.slice(1);
  const words = (identifier) => identifier.replaceAll("_", " ");

  return { degree, shown, withError, rowText, short, change, briefChange, within, minutes, roundMagnification, steadyMagnification,
    scaleLabels, layersText, sentence, words };
})();
