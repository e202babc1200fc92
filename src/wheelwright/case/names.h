#pragma once

#include <algorithm>
#include <string_view>

namespace wheelwright {

/// Whether a name is one word of letters, digits, - and _, as those must be that are parts of names of files
/// or of columns.
inline bool is_word(std::string_view name) {
  constexpr std::size_t longest = 60;
  return !name.empty() && name.size() <= longest && std::ranges::all_of(name, [](char x) {
    return (x >= 'a' && x <= 'z') || (x >= 'A' && x <= 'Z') || (x >= '0' && x <= '9') || x == '-' || x == '_';
  });
}

}  // namespace wheelwright
