#pragma once

#include <cstddef>
#include <vector>

namespace wheelwright {

/// to += factor a; both have the size of `to`.
inline void add_scaled(double factor, const std::vector<double>& a, std::vector<double>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * a[i];
}

}  // namespace wheelwright
