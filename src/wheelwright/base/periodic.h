#pragma once

namespace wheelwright {

/// The index in [0, period) that is equivalent to `index` in a periodic sequence.
constexpr int wrap(int index, int period) { return (index % period + period) % period; }

}  // namespace wheelwright
