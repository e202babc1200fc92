#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace wheelwright {

/// A file that leads a browser to an address, readable by this user alone and removed with this object: the
/// address stands in no process list and no log.
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

/// Shows the file in the user's browser, where there is a desktop with one; whether that was tried.
bool open_browser(const std::filesystem::path& file);

}  // namespace wheelwright
