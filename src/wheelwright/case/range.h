#pragma once

#include <string>

namespace wheelwright {

/// The values that a key accepts, in the unit of the case file.
struct Range {
  enum class End { open, closed };

  double low, high;
  End low_end = End::closed, high_end = End::closed;

  /// False for NaN and infinity.
  bool contains(double value) const;
  /// E.g. "0 < value <= 20".
  std::string text() const;
  /// E.g. "; use for example 0.4995" if the value is 0.5, the high end, which does not belong to the range.
  std::string advice_at_open_end(double value) const;
};

constexpr Range any_number{-1e9, 1e9};
constexpr Range between(double low, double high) { return {low, high}; }
constexpr Range above(double low, double high) { return {low, high, Range::End::open}; }
constexpr Range at_least_and_below(double low, double high) {
  return {.low = low, .high = high, .low_end = Range::End::closed, .high_end = Range::End::open};
}

}  // namespace wheelwright
