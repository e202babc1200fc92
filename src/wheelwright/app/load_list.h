#pragma once

#include <optional>
#include <string>
#include <vector>

namespace wheelwright {

/// "P1,P2,..." or "a:b:n", n >= 2 loads evenly spaced from a to b; in ascending order, without doubles.
/// Nothing when the text is neither, a load is not positive or there are over 1000.
std::optional<std::vector<double>> parse_loads(const std::string& text);

}  // namespace wheelwright
