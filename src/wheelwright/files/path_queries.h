#pragma once

#include <filesystem>

namespace wheelwright {

// Questions about paths, which throw nothing: what cannot be looked at, e.g. for lack of permission or since
// its name is too long, is not there. Whoever then reads or writes it learns why not.

/// Whether something has this name; a link counts as what it leads to.
inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// The same of a link itself.
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
