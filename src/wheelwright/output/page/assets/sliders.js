"use strict";
// From values to the positions 0..1000 of a slider, and back.
const sliders = (() => {
  const linear = (low, high) => ({ toSlider: (v) => 1000 * (v - low) / (high - low),
    fromSlider: (s) => low + (high - low) * s / 1000 });

  // 0, and then powers from low to high.
  const powers = (low, high) => ({
    toSlider: (v) => v <= 0 ? 0 : Math.min(1000, Math.max(1, 1000 * Math.log(v / low) / Math.log(high / low))),
    fromSlider: (s) => s === 0 ? 0 : low * (high / low) ** (s / 1000) });

  // The range of a component of the load whose value in the case is `first`: three times as much, and the reverse of a
  // negative one.
  const aroundLoad = (first) => first > 0 ? linear(0.1 * first, 3 * first) : linear(3 * first, -3 * first);

  // The range of a bound that is `first` in the case.
  const aroundBound = (first) => first > 0 ? powers(0.2 * first, 5 * first) : linear(-1, 1);

  const rounded = (value, digits) => Number(value.toPrecision(digits));

  // A value as the text of a number field.
  const entry = (value) => Math.abs(value) >= 1e5 ? value.toExponential().replace("e+", "e") : String(value);

  return { linear, powers, aroundLoad, aroundBound, rounded, entry };
})();
