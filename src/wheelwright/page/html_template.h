#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wheelwright {

/// JSON that can stand in a script element whatever its texts hold.
std::string json_in_script(const nlohmann::ordered_json& json);

/// A template with contents in the place of marks, in the order in which they stand there.
std::string filled_template(std::string_view page,
                            const std::vector<std::pair<std::string_view, std::string>>& contents);

}  // namespace wheelwright
