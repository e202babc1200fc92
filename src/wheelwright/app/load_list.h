#pragma once

#include <optional>
#include <string>
#include <vector>

namespace wheelwright {

/// The loads of a list of numbers (number_list.h), in ascending order, without doubles. Nothing when the text
/// is none, or a load is not positive.
std::optional<std::vector<double>> parse_loads(const std::string& text);

}  // namespace wheelwright
