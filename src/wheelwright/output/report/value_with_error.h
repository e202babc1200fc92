#pragma once

#include <string>

#include "wheelwright/base/units.h"

namespace wheelwright {

/// A value and its error, e.g. "0.3801 +- 0.0008": the error rounded up to one digit, or two if the first is
/// 1, and the value to the same place. An error that six digits of the value do not show is left out.
std::string text_with_error(double value, double error);

/// The same for a number of this kind. A distance is a life, which varies by powers of ten: its error is
/// value (f - 1), where f is the factor by which the exact one is at most smaller or larger. If f is more
/// than 1.1, the text is the value with this range, e.g. "130 (42 to 410)".
std::string text_with_error(double value, double error, UnitKind kind);

}  // namespace wheelwright
