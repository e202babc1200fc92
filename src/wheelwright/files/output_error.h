#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace wheelwright {

/// A file could not be written. Thrown by everything in this folder that writes.
class OutputError : public std::runtime_error {
 public:
  /// `error` is the errno of the call that failed.
  OutputError(std::filesystem::path path, int error)
      : std::runtime_error("cannot write " + path.string() + ": " + std::generic_category().message(error)),
        path_(std::move(path)),
        error_(error) {}

  /// The file must not be written: `reason` says why, and what to do.
  OutputError(std::filesystem::path path, const std::string& reason)
      : std::runtime_error("cannot write " + path.string() + ": " + reason),
        path_(std::move(path)),
        error_(EEXIST) {}

  const std::filesystem::path& path() const { return path_; }
  int error() const { return error_; }

 private:
  std::filesystem::path path_;
  int error_;
};

}  // namespace wheelwright
