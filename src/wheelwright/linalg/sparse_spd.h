#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wheelwright/base/expected.h"

namespace wheelwright {

/// The Cholesky factor of a real sparse symmetric positive definite matrix, computed once for many solves.
/// One object must not solve on several threads at a time.
class SparseSpd {
 public:
  /// One contribution to the lower triangle (row >= column). Contributions to the same position add up.
  struct Entry {
    int row, column;
    double value;
  };

  /// Factors the matrix with this lower triangle. Fails with not_positive_definite.
  static Expected<SparseSpd> factor(int size, std::span<const Entry> lower_triangle);

  std::vector<double> solve(std::span<const double> right_hand_side) const;

  SparseSpd(SparseSpd&&) noexcept;
  SparseSpd& operator=(SparseSpd&&) noexcept;
  ~SparseSpd();

 private:
  struct Factor;
  explicit SparseSpd(std::unique_ptr<Factor> factor);
  std::unique_ptr<Factor> factor_;
};

}  // namespace wheelwright
