#pragma once

#include <span>
#include <string>
#include <string_view>

namespace wheelwright {

/// To be called by a command before it computes the files that it writes under these names to a folder of the
/// user's choice. If any of them exist, prints all of those and returns false: the command ends with
/// exit_refused. Files of a run are protected like the user's own.
bool may_write_to(const std::string& folder, std::span<const std::string_view> names);

}  // namespace wheelwright
