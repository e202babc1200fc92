"use strict";
// The axes of the plot of all designs.
const plotAxes = (() => {
  const known = (value) => value !== null && value !== undefined;

  // A value of a quantity in its unit with its error, if that is known, or else at most five digits; "" if it is not known.
  const shown = (value, { factor }, error) => !known(value) ? "" : known(error) ? formats.withError(value * factor, error * factor) :
    Number((value * factor).toPrecision(5)).toString();

  // A design's value of a quantity less its error, and with it, in the unit of the quantity; twice the value if the error is not
  // known.
  const ends = ({ values, errors }, { key, factor }) =>
    [-1, 1].map((sign) => (values[key] + sign * (errors[key] ?? 0)) * factor);

  // The multiples of 1, 2 or 5 times a power of ten between two values, about `n` of them.
  function ticks(low, high, n) {
    const smallest = (high - low) / n, power = 10 ** Math.floor(Math.log10(smallest));
    const step = [1, 2, 5, 10].map((f) => f * power).find((s) => s >= smallest * (1 - 1e-9));
    const all = [];
    for (let k = Math.ceil(low / step); k * step <= high; ++k) all.push(Number((k * step).toPrecision(12)));
    return all;
  }

  // An axis from one coordinate to another that holds all values with some room beyond: `of` maps a value.
  function scale(values, from, to) {
    let low = Math.min(...values), high = Math.max(...values);
    const more = high > low ? 0.06 * (high - low) : 0.01 * Math.abs(high) || 1;
    low -= more;
    high += more;
    return { of: (value) => from + (value - low) / (high - low) * (to - from), ticks: ticks(low, high, 6) };
  }

  return { known, shown, ends, ticks, scale };
})();
