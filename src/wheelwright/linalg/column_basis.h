#pragma once

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// A low-rank factorization: a = basis * coordinates, up to the tolerance of column_basis().
struct ColumnBasis {
  Matrix basis;        ///< orthonormal columns
  Matrix coordinates;  ///< basis^T a
};

/// Computes an orthonormal basis of the column space of a by a blocked, truncated pivoted QR factorization:
/// no column of a - basis * coordinates is longer than `tolerance` times the longest column of a. The result
/// is deterministic. The cost is about 4 * rows * columns * rank operations, most of them in matrix products.
ColumnBasis column_basis(const Matrix& a, double tolerance);

}  // namespace wheelwright
