#pragma once

#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// A move of the boundary, as a deformation, and the Riesz representative of the change of a derivative along
/// it (shape/evolution/deformation_space.h).
struct CurvaturePair {
  std::vector<double> move, change;
};

/// The pairs that a quasi-Newton method remembers, the oldest first.
using CurvatureMemory = std::vector<CurvaturePair>;

inline constexpr size_t max_curvature_pairs = 8;

/// Adds a pair if it has positive curvature: (move, change) > least * |move| |change| in the inner product in
/// which the products are given. Drops the oldest pair if the memory is full.
void remember(CurvaturePair pair, double move_square, double move_change, double change_square,
              CurvatureMemory& memory);

/// B + shift * identity with the compact L-BFGS matrix B of Byrd, Nocedal and Schnabel (1994), in the span of
/// some vectors of an inner product space. A vector is given by its coefficients; the span holds the pairs.
class ShiftedHessian {
 public:
  /// `products`: inner products of the vectors of the span. The moves of the n_pairs pairs are its vectors
  /// from `first_move` on, followed by the changes. Without pairs B is zero.
  ShiftedHessian(const Matrix& products, int first_move, int n_pairs, double shift);

  /// (B + shift)^-1 of a vector.
  std::vector<double> solve(const std::vector<double>& coefficients) const;

  /// The eigenvalue of B on the orthogonal complement of all pairs: the minimum curvature of the pairs,
  /// (change, change) / (move, change).
  static double scale(const Matrix& products, int first_move, int n_pairs);

 private:
  const Matrix& products_;
  int first_move_, n_pairs_;
  double scale_, diagonal_;
  Matrix inverse_;  ///< of the small matrix of Woodbury's formula
};

}  // namespace wheelwright
