#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/evolution/cubic_interpolant.h"

namespace wheelwright {

/// A place of the boundary {psi = 0} that is parallel, to 20 degrees, to the side face behind it: material
/// lies between them.
template <int dim>
struct FaceWall {
  Vec<dim> point;  ///< on the boundary, in units of the node spacing
  Vec<dim> foot;   ///< on the side face, in the same units
  double width;    ///< [m]
};

/// The walls to side faces that are thinner than this width, at most one per seed and side face: none when
/// dim = 2.
template <int dim>
std::vector<FaceWall<dim>> walls_to_faces(const CubicInterpolant<dim>& psi, std::span<const Vec<dim>> seeds,
                                          double width);

/// The same wall where it is thinnest: the boundary is parallel to the face there.
template <int dim>
FaceWall<dim> thinnest_near(const CubicInterpolant<dim>& psi, FaceWall<dim> wall);

}  // namespace wheelwright
