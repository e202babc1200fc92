#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace wheelwright {

/// Replaces the content of the file by `content`, through a temporary file next to it that is synchronized to
/// disk and renamed; then the folder is synchronized. A reader of `path`, even after a crash, sees either the
/// old or the new file. In a folder with a list of written files (written_files.h), only listed files are
/// replaced. Throws OutputError.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for content given in consecutive parts.
void write_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts);

/// Creates the folder and its parents if needed, and starts its list of written files. It may be a symbolic
/// link to a folder. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// The same for a subfolder of a folder created by make_folder(): if it exists already, it must be listed
/// there, and must not be a symbolic link.
void make_subfolder(const std::filesystem::path& folder);

}  // namespace wheelwright
