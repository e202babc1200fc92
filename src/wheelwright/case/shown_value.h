#pragma once

#include <string>

#include "wheelwright/base/quantity.h"
#include "wheelwright/base/units.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// The unit in which values of the quantity are shown that stand in a case or a history: in 2D per metre of
/// width.
ShownUnit shown_unit(Quantity quantity, const Wheel& wheel);

/// Such a value with its unit.
std::string shown_text(double value, const ShownUnit& shown);

/// The same of a quantity, and as a case file may give it in quotes: "6000 N/mm".
std::string shown_text(Quantity quantity, double value, const Wheel& wheel);

}  // namespace wheelwright
