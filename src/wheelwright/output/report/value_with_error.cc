#include "wheelwright/output/report/value_with_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// A number in units of a power of ten, as decimals.
std::string at_place(double units, int place) {
  return fmt::format("{:.{}f}", units * std::pow(10.0, place) + 0.0, std::max(0, -place));
}

/// Without an exponent if that is short.
std::string two_digits(double positive) {
  const double unit = std::pow(10.0, std::floor(std::log10(positive)) - 1);
  return fmt::format("{:.6g}", std::round(positive / unit) * unit);
}

}  // namespace

std::string text_with_error(double value, double error) {
  constexpr double least_shown = 5e-7;  // of the value
  if (!(error > least_shown * std::abs(value)) || !std::isfinite(error)) return fmt::format("{:.6g}", value);
  constexpr double rounding = 1e-9;
  const int first = static_cast<int>(std::floor(std::log10(error)));
  const auto rounded_up = [&](int place) { return std::ceil(error / std::pow(10.0, place) - rounding); };
  const int place = rounded_up(first - 1) < 20 ? first - 1 : first;
  const double digits = rounded_up(place);
  return fmt::format("{} +- {}", at_place(std::round(value / std::pow(10.0, place)), place),
                     at_place(digits, place));
}

std::string text_with_error(double value, double error, UnitKind kind) {
  constexpr double small = 0.1;
  if (kind != UnitKind::distance || !(error > small * value) || !std::isfinite(error))
    return text_with_error(value, error);
  const double factor = 1 + error / value;
  return fmt::format("{} ({} to {})", two_digits(value), two_digits(value / factor),
                     two_digits(value * factor));
}

}  // namespace wheelwright
