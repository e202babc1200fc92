#pragma once

#include <string>

namespace wheelwright {

/// The TOML number with the fewest digits that reads back as the same finite `value`. Six or more zeros at
/// the end of an integer become an exponent, e.g. "2e8".
std::string number_text(double value);

}  // namespace wheelwright
