#pragma once

#include <string>

namespace wheelwright {

/// The shortest decimal that reads back as the same number; large ones with an exponent, e.g. "200e6".
std::string number_text(double value);

}  // namespace wheelwright
