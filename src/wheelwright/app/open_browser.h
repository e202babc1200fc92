#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace wheelwright {

/// A file that redirects a browser to an address, readable only by this user and removed with this object, so
/// that the address appears in no process list and no log.
class AddressFile {
 public:
  /// Throws std::system_error.
  explicit AddressFile(const std::string& address);
  AddressFile(const AddressFile&) = delete;
  AddressFile& operator=(const AddressFile&) = delete;
  ~AddressFile();

  const std::filesystem::path& path() const { return file_; }

 private:
  std::filesystem::path folder_, file_;
};

/// Opens the file in the user's browser if there is a desktop; returns whether it tried.
bool open_browser(const std::filesystem::path& file);

}  // namespace wheelwright
