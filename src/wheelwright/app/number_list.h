#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace wheelwright {

/// "A,B,...", or "FROM:TO:N", N >= 2 numbers evenly spaced, or "FROM:TO:N:log", evenly spaced in their
/// logarithms and positive. Nothing if the text is none of these, or has more than 1000 numbers.
std::optional<std::vector<double>> parse_number_list(std::string_view text);

}  // namespace wheelwright
