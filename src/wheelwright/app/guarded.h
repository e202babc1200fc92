#pragma once

#include <functional>
#include <string>

namespace wheelwright {

/// The ExitCode that the work returns, or that of the exception that it throws, which is told in the name of
/// `who`. Throws nothing.
int guarded(const std::string& who, const std::function<int()>& work);

}  // namespace wheelwright
