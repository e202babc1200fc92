#pragma once

#include <vector>

namespace wheelwright {

/// The lower triangle of a real symmetric sparse matrix in compressed columns with ascending rows.
struct SparseSymmetric {
  int size = 0;
  std::vector<int> column_start;  ///< size + 1 entries
  std::vector<int> rows;
  std::vector<double> values;

  /// Computes y += a * x for one vector, with a the whole symmetric matrix.
  void add_product(const double* x, double* y) const {
    for (int j = 0; j < size; ++j) {
      double sum = 0;
      for (int k = column_start[j]; k < column_start[j + 1]; ++k) {
        const int i = rows[k];
        sum += values[k] * x[i];
        if (i != j) y[i] += values[k] * x[j];
      }
      y[j] += sum;
    }
  }
};

}  // namespace wheelwright
