#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace wheelwright {

/// Why locks in a folder keep away only the processes of this machine, although other machines may see the
/// folder, e.g. "nfs, mounted with nolock". Nothing if they reach the others, or if nothing tells that they
/// do not. `mounts` has the form of /proc/self/mountinfo (man 5 proc); `folder` is absolute.
std::optional<std::string> why_locks_are_local(const std::string& mounts,
                                               const std::filesystem::path& folder);

}  // namespace wheelwright
