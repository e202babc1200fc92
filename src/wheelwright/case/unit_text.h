#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/base/units.h"

namespace wheelwright {

// Values with a unit, as a case file may give them in quotes: "300 mm", "25 MPa", "50 N/mm".

struct ValueWithUnit {
  double value;
  std::string unit;
};

/// A number and the unit after it, without surrounding spaces; nothing if the text does not start with a
/// number or has nothing after it.
std::optional<ValueWithUnit> value_with_unit(std::string_view text);

/// The value in another unit of the same kind; nothing if the two are not known units of one kind.
std::optional<double> converted(const ValueWithUnit& value, std::string_view unit);

/// Converts a value of a quantity with a unit to that of a case: in SI units and in 2D per metre of width.
/// Without "/m" it applies to the whole wheel. Nothing if the unit does not fit.
std::optional<double> in_file_unit(const ValueWithUnit& value, UnitKind kind, int dimension, double width);

/// The units of the same kind, including this one; empty if it is unknown.
std::vector<std::string_view> units_like(std::string_view unit);

}  // namespace wheelwright
