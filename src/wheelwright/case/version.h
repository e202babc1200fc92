#pragma once

#include <string_view>

namespace wheelwright {

/// Version of this program, e.g. "0.1.0".
std::string_view version();

/// The commit that this program was built from, e.g. "0a0c10b4c3d2"; followed by "+" if the sources had
/// changed since. Empty if it was not built in a git repository.
std::string_view commit();

/// The compiler, e.g. "GCC 12.2.0".
std::string_view compiler();

}  // namespace wheelwright
