#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wheelwright {

/// JSON that is safe inside a script element whatever its texts contain.
std::string json_in_script(const nlohmann::ordered_json& json);

/// A template with its marks replaced by contents, in the order of the marks.
std::string filled_template(std::string_view page,
                            const std::vector<std::pair<std::string_view, std::string>>& contents);

}  // namespace wheelwright
