#pragma once

#include <span>
#include <string>

namespace wheelwright {

/// A prefix of an SI unit.
struct SiPrefix {
  double factor;
  const char* symbol;
};

/// The usual prefix for stresses and lengths: 0.8 MPa, 0.58 mm; none for 0.
SiPrefix si_prefix(double value);
/// None for degrees either.
SiPrefix si_prefix(double value, const std::string& unit);

/// Three digits and the unit with its prefix, e.g. "2.46 MPa".
std::string value_text(double value, const std::string& unit);

/// The values that the colours of a picture represent. Values beyond the ends have the colours of the ends.
struct ColourScale {
  double lower, upper;
  double smallest = lower, largest = upper;  ///< of the values

  bool is_cut_below() const { return smallest < lower; }
  bool is_cut_above() const { return largest > upper; }

  static constexpr int levels = 32;
  double level(int k) const { return lower + (upper - lower) * k / levels; }
  double fraction(double value) const { return upper > lower ? (value - lower) / (upper - lower) : 0.5; }
};

/// The usual share of values beyond a scale without tail.
inline constexpr double usual_outliers = 0.01;

/// Spans the finite values, except for that fraction of them at each end.
ColourScale colour_scale(std::span<const double> values, double outliers);

/// The same for values that are never negative: it starts at 0 and ends at a round number.
ColourScale colour_scale_from_zero(std::span<const double> values, double outliers);

/// Colour of what lies between two levels, from 0.
std::string level_colour(int level);

/// The scale as a bar with round numbers beside it, its lower left corner at (x, y) [pixels]. An end beyond
/// which there are values has a tip; the upper one names the largest of them.
std::string colour_bar(const ColourScale& scale, const std::string& name, const std::string& unit, double x,
                       double y);

}  // namespace wheelwright
