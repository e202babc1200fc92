#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wheelwright {

// The program replaces and removes only what it wrote. A folder that it writes to contains a list of the
// names that it wrote there; a name is listed before its file is written. A listed name that is now a
// symbolic link or a folder belongs to somebody else.

/// Name of the list in a folder.
inline constexpr const char* list_of_written_files = "written-by-wheelwright.txt";

/// The list of one folder, as it is on the disk.
class WrittenFiles {
 public:
  explicit WrittenFiles(std::filesystem::path folder);

  /// Whether the folder has a list. A file of that name with another first line is not a list.
  bool exists() const { return exists_; }

  /// Whether the name, or "NAME.tmp" of a listed name, is a file or a folder that the program wrote.
  bool is_own(std::string_view name) const;

  /// Those of the names that exist in the folder, also as temporary files; and the list itself if something
  /// else has its name.
  std::vector<std::string> standing(std::span<const std::string_view> names) const;

  /// Those of them that the program did not write.
  std::vector<std::string> foreign(std::span<const std::string_view> names) const;

  /// Starts the list if there is none. Throws OutputError.
  void begin();

  /// To be called before a file or a folder of that name is written: adds it to the list. Throws OutputError
  /// if something that the program did not write has the name. They do nothing in a folder without a list.
  void claim_file(std::string_view name) { claim(name, std::string(name)); }
  void claim_folder(std::string_view name) { claim(name, std::string(name) + '/'); }
  /// Adds a line to the list unconditionally, for something known to be the program's. Folders end in a
  /// slash.
  void list(const std::string& line);

 private:
  void claim(std::string_view name, const std::string& line);
  void append(std::string_view line) const;

  std::filesystem::path folder_;
  bool exists_;
  bool ends_with_newline_ = true;
  std::set<std::string, std::less<>> names_;
};

/// WrittenFiles::claim_file() and claim_folder() for the last name of a path.
void claim_file(const std::filesystem::path& path);
void claim_folder(const std::filesystem::path& path);

}  // namespace wheelwright
