#pragma once

namespace wheelwright {

/// So many iterations are no end of their own: the maximum of optimizer.iterations.
inline constexpr int unlimited_iterations = 1'000'000;

}  // namespace wheelwright
