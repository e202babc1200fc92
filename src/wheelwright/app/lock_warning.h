#pragma once

#include <filesystem>

namespace wheelwright {

/// Warns if the file system of a folder, which need not exist yet, has locks that do not reach other
/// machines: then two of them could run the same design.
void warn_of_local_locks(const std::filesystem::path& folder);

}  // namespace wheelwright
