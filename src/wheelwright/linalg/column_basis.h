#pragma once

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// A matrix of low rank: a = basis coordinates.
struct ColumnBasis {
  Matrix basis;        ///< orthonormal columns
  Matrix coordinates;  ///< basis^T a
};

/// An orthonormal basis of a's columns, up to a remainder in which no column is longer than `tolerance` times
/// the longest column of a. Deterministic; about 4 rows columns rank operations, most of them matrix
/// products.
ColumnBasis column_basis(const Matrix& a, double tolerance);

}  // namespace wheelwright
