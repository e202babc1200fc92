#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// Coordinates of the interface unknowns of a ring of equal sectors in which most of them hardly feel the
/// neighbouring sectors, so that they are eliminated once, in real numbers, and not once per harmonic.
///
/// The equations of the boundary unknowns, interface first and outer line last, are next^T x_(c-1) + link x_c
/// + next x_(c+1) = f_c. With link_ii = L L^T of the interface and the outer line y, x_i = L^-T z -
/// link_ii^-1 link_io y makes the link the identity on z. What short waves do to the next sector decays on
/// the way, so that the blocks of `next` have low rank in these coordinates: z = W s + t, with `strong` modes
/// s that span all but a small rest of their ranges, and weak modes t perpendicular to them, whose equations
/// are t + E t = g - C (s, y) with small E and C. They are eliminated to second order, C^T C; what is
/// neglected, C^T E C, is of third order. For given s and y, t itself is computed to rounding errors by the
/// series of (1 + E)^-1.
///
/// Vectors have one column per (right-hand side, sector): column = rhs * n_sectors + sector.
class InterfaceModes {
 public:
  /// Empty if the strong modes would be more than half of the interface, or if the link is not positive
  /// definite.
  static std::optional<InterfaceModes> find(const Matrix& link, const Matrix& next, int n_interface);

  int n_interface() const { return factor_.rows(); }
  int n_strong() const { return strong_.columns(); }
  int n_outer() const { return extension_.columns(); }

  /// The stiffness of (s, y) between a sector and those that are -2, -1, 0, 1 and 2 sectors ahead.
  std::vector<Matrix> release_stiffness() { return std::exchange(stiffness_, {}); }

  /// Turns loads on the boundary unknowns into loads on (s, y); returns t for s = 0 and y = 0.
  Matrix eliminate(Matrix& loads, int n_sectors) const;

  /// Displacements of the interface for those of s and y. `weak`: what eliminate() returned; empty if there
  /// was no load on the interface.
  Matrix displacements(const Matrix& strong, const Matrix& outer, const Matrix& weak, int n_sectors) const;

 private:
  InterfaceModes() = default;
  /// `next_outer`, `previous_outer`: between z and the outer line of the next sector and of the one before,
  /// in which the unknowns have these scales. False where more than half of the modes would be strong.
  bool choose_strong_modes(const Matrix& next_outer, const Matrix& previous_outer,
                           std::span<const double> scales);
  /// Eliminates the weak modes. `link_outer`: the stiffness of the outer line with free interfaces;
  /// `next_of_outer`: its coupling with that of the next sector.
  void reduce(const Matrix& link_outer, const Matrix& next_outer, const Matrix& previous_outer,
              const Matrix& next_of_outer);
  /// Solves t + E t = loads in place; the loads are perpendicular to the strong modes.
  void solve_weak(Matrix& loads, int n_sectors) const;
  /// x less its strong part.
  void subtract_strong(Matrix& x) const;

  Matrix factor_;         ///< L
  Matrix extension_;      ///< -link_ii^-1 link_io
  Matrix next_;           ///< between z of a sector (rows) and of the next one
  Matrix strong_;         ///< W, orthonormal columns
  Matrix weak_next_;      ///< C: rows t, columns (s, y) of the next sector
  Matrix weak_previous_;  ///< ... of the sector before
  std::vector<Matrix> stiffness_;
};

}  // namespace wheelwright
