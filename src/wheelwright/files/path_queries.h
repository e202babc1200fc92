#pragma once

#include <filesystem>

namespace wheelwright {

// Queries about paths that do not throw: what cannot be inspected, e.g. for lack of permission or because its
// name is too long, counts as absent. A later read or write reports the reason.

/// Whether something has this name; links are followed.
inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// The same, without following links.
inline bool has_entry(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

inline bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

inline bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

}  // namespace wheelwright
