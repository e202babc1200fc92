#pragma once

#include <optional>
#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// The LU factors of a square matrix, with partial pivoting.
class LuFactor {
 public:
  /// Empty when a is singular.
  static std::optional<LuFactor> factor(Matrix a);

  /// Returns a^-1 * b.
  Matrix solve(Matrix b) const;

 private:
  Matrix lu_;
  std::vector<int> pivots_;
};

}  // namespace wheelwright
