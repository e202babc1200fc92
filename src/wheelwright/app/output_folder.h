#pragma once

#include <span>
#include <string>
#include <string_view>

namespace wheelwright {

/// To be called by a command before it computes what it writes to a folder of the user's choice under these
/// names. If any of them stands there already, tells all that do and returns false: the command ends with
/// exit_refused. The files of a run are as good as the user's own.
bool may_write_to(const std::string& folder, std::span<const std::string_view> names);

}  // namespace wheelwright
