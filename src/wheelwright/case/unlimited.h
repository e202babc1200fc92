#pragma once

namespace wheelwright {

/// Practically unlimited: the maximum of optimizer.iterations.
inline constexpr int unlimited_iterations = 1'000'000;

}  // namespace wheelwright
