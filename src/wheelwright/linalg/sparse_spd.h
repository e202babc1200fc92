#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wheelwright/base/expected.h"

namespace wheelwright {

/// The Cholesky factor of a real sparse symmetric positive definite matrix: factored once, solved many times.
/// Not safe for concurrent solves with one object.
class SparseSpd {
 public:
  /// One contribution to the lower triangle (row >= column); contributions to the same place add up.
  struct Entry {
    int row, column;
    double value;
  };

  /// Fails with not_positive_definite.
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
