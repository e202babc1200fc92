#pragma once

#include <filesystem>
#include <string_view>

namespace wheelwright {

/// Makes `content` the whole content of the file, by a temporary file beside it, synchronized to disk and
/// renamed, and the folder synchronized: whoever reads `path`, also after a crash, sees the old file or the
/// new one. In a folder with a list of written files (written_files.h) nothing is replaced that is not listed
/// there. Throws OutputError.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Makes the folder, and those above it, unless they are there, and begins its list of written files. It may
/// be a symbolic link to a folder. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// The same for a folder in one that make_folder() made: if it is there already, it must be listed there, and
/// must not be a symbolic link.
void make_subfolder(const std::filesystem::path& folder);

}  // namespace wheelwright
