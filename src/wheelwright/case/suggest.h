#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wheelwright {

/// Number of edits (insert, delete, replace, swap neighbours) that turn one word into the other.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that the word most likely misspells, if one is similar enough.
std::optional<std::string> did_you_mean(std::string_view word,
                                        const std::vector<std::string_view>& candidates);

}  // namespace wheelwright
