#pragma once

#include <vector>

#include "wheelwright/base/vec.h"
#include "wheelwright/mechanics/state/observation_rows.h"

namespace wheelwright {

/// A quadrature point of the tread Gamma_C, in its column.
template <int dim>
struct TreadPoint {
  /// In the column's frame: Cartesian axes, the first radial at the column's first azimuth [m].
  Vec<dim> position;
  double weight;  ///< dS [m, or m^2 when dim = 3]
  double gamma;   ///< gamma_0 E / h_T [Pa/m], with h_T the diameter of the cell at the tread
};

/// Equal faces side by side across a column that carry the same Gauss points: one line of points of one kind
/// of observation, at one radius and one place along the axle.
struct FaceRow {
  int faces;            ///< from the column's first azimuth to its last
  int points_per_face;  ///< of the Gauss rule along the azimuth

  /// The first point's observation, and how many there are from face to face and from point to point.
  /// Observations are counted as vectors of dim rows.
  int first, per_face, per_point;

  /// The observation at a face's Gauss point.
  int observation(int face, int point) const { return first + per_face * face + per_point * point; }
};

/// The tread as the functions of the contact see it: a ring of equal columns, one per angular cell of the
/// level set's grid.
template <int dim>
struct TreadSurface {
  std::vector<TreadPoint<dim>> points;  ///< contact quadrature points of a column
  std::vector<double> annulus_weights;  ///< dx of a column's quadrature points in the annulus [m^2 or m^3]
  double annulus_thickness = 0;         ///< epsilon of (60) [m]

  /// The observation that takes the place of each one in the mirror image of a column. Observations are
  /// counted as vectors of dim rows.
  std::vector<int> mirror_images;

  /// All observations but the integrals, by their lines of points.
  std::vector<FaceRow> face_rows;
  int n_columns = 0;      ///< around the whole ring
  bool has_spin = false;  ///< whether ObservationRows::spin() is observed

  ObservationRows<dim> rows() const {
    return {static_cast<int>(points.size()), static_cast<int>(annulus_weights.size()), has_spin};
  }
};

}  // namespace wheelwright
