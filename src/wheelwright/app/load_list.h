#pragma once

#include <optional>
#include <string>
#include <vector>

namespace wheelwright {

/// The loads in a list of numbers (number_list.h), in ascending order, without duplicates. Nothing if the
/// text is not such a list, or a load is not positive.
std::optional<std::vector<double>> parse_loads(const std::string& text);

}  // namespace wheelwright
