#pragma once

#include <string>

#include "wheelwright/base/units.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// The display unit for values of the quantity in a case or history, which in 2D are per metre of width.
ShownUnit shown_unit(const Quantity& quantity, const Wheel& wheel);

/// Such a value with its unit.
std::string shown_text(double value, const ShownUnit& shown);

/// The same for a quantity, and in the quoted form of case files: "6000 N/mm".
std::string shown_text(const Quantity& quantity, double value, const Wheel& wheel);

}  // namespace wheelwright
