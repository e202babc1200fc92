#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/evolution/cubic_interpolant.h"

namespace wheelwright {

/// Least cosine between the normals of a part of the boundary and of a surface of the ring that count as
/// parallel: 20 degrees.
inline constexpr double parallel_to_surface = 0.94;

/// A place of the boundary {psi = 0} that is parallel (parallel_to_surface) to the side face behind it:
/// material lies between them.
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
