#pragma once

#include <filesystem>
#include <string_view>

namespace wheelwright {

/// Makes `content` the whole content of the file, by a temporary file beside it, synchronized to disk and
/// renamed, and the folder synchronized: whoever reads `path`, also after a crash, sees the old file or the
/// new one. Throws OutputError.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Makes the folder, and those above it, unless they are there. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

}  // namespace wheelwright
