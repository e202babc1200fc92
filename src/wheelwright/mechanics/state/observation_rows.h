#pragma once

namespace wheelwright {

/// The observations of a displacement u by one column of the tread (one angular cell), as rows of a vector:
/// for every contact quadrature point u and the traction sigma(u)n on Gamma_C; then, for every quadrature
/// point of the annulus Gamma_C^epsilon (60), sigma(u)n with n radial; then the integral of u over the
/// column. Each of these is a vector of dim rows, Cartesian in the column's frame, whose first axis is radial
/// at the column's first azimuth. The last row, if there is one, is a number: the integral of density u . x,
/// with x the place relative to the axle, in the wheel's plane. A load on the tread is a combination of
/// observations, in the same rows.
template <int dim>
struct ObservationRows {
  int n_points = 0;          ///< contact quadrature points of a column
  int n_annulus_points = 0;  ///< quadrature points of the annulus in a column
  bool has_spin = false;     ///< whether there is the last row

  /// The first row of the displacement and of the traction at contact point q.
  constexpr int displacement(int q) const { return 2 * dim * q; }
  constexpr int traction(int q) const { return 2 * dim * q + dim; }

  /// The first row of the traction at point q of the annulus.
  constexpr int annulus_traction(int q) const { return n_contact() + dim * q; }

  /// The first row of the integral of u.
  constexpr int integral() const { return n_contact() + dim * n_annulus_points; }

  /// The rows of the contact points, which come first, and all rows.
  constexpr int n_contact() const { return 2 * dim * n_points; }
  constexpr int size() const { return n_vectors() * dim + (has_spin ? 1 : 0); }

  /// The vectors, which come before the number.
  constexpr int n_vectors() const { return integral() / dim + 1; }

  /// The row of the number: the work on u of the load that pulls every point away from the axle by density x.
  constexpr int spin() const { return integral() + dim; }
};

}  // namespace wheelwright
