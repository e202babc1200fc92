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
};

constexpr Range any_number{-1e9, 1e9};
constexpr Range between(double low, double high) { return {low, high}; }
constexpr Range above(double low, double high) { return {low, high, Range::End::open}; }
constexpr Range at_least_and_below(double low, double high) {
  return {.low = low, .high = high, .low_end = Range::End::closed, .high_end = Range::End::open};
}

}  // namespace wheelwright
