#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace wheelwright {

/// The number after a name at the start of a line.
inline std::optional<double> number_of(const std::filesystem::path& file, std::string_view name) {
  std::ifstream in(file);
  std::string first;
  double value;
  for (std::string line; std::getline(in, line);)
    if (std::istringstream words(line); words >> first && first == name && words >> value) return value;
  return {};
}

}  // namespace wheelwright
