#pragma once

#include "wheelwright/mechanics/ring/tread.h"
#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/mechanics/state/ground_frame.h"
#include "wheelwright/mechanics/state/load_positions.h"

namespace wheelwright {

/// The point of the tread on which a rotating wheel without load stands.
template <int dim>
struct StandingPoint {
  int column;         ///< of the ring
  int point;          ///< of the column
  GroundFrame frame;  ///< turns components in the column's frame into those of ground and contact
  double growth;      ///< (ContactPatch) [m]
};

/// `observed`: of the displacement by rotation alone on the tread, one column per ring column. The wheel
/// stands upright, on even ground.
template <int dim>
StandingPoint<dim> standing_point(const Tread<dim>& tread, const PolarGrid<dim>& grid, GroundPosition ground,
                                  const Ground& shape, const Matrix& observed);

}  // namespace wheelwright
