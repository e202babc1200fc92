#pragma once

#include <string>

namespace wheelwright {

/// A value and its error, e.g. "0.3801 +- 0.0008": the error rounded up to one digit, or two if the first is
/// 1, and the value to the same place. An error that six digits of the value do not show is left out.
std::string text_with_error(double value, double error);

}  // namespace wheelwright
