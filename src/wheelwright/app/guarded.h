#pragma once

#include <functional>
#include <string>

namespace wheelwright {

/// The ExitCode that `work` returns, or that of the exception that it throws, which is printed on behalf of
/// `who`. Does not throw.
int guarded(const std::string& who, const std::function<int()>& work);

}  // namespace wheelwright
