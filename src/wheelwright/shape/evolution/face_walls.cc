#include "wheelwright/shape/evolution/face_walls.h"

#include <cmath>

#include "wheelwright/shape/evolution/closest_point.h"
#include "wheelwright/shape/evolution/medial_balls.h"

namespace wheelwright {

template <int dim>
std::vector<FaceWall<dim>> walls_to_faces(const CubicInterpolant<dim>& psi, std::span<const Vec<dim>> seeds,
                                          double width) {
  std::vector<FaceWall<dim>> walls;
  if constexpr (dim == 3) {
    const auto& lattice = psi.lattice();
    const double last = lattice.nodes()[2] - 1, spacing = lattice.grid().width / last;
    for (const Vec<3>& seed : seeds)
      for (const double face : {0.0, last}) {
        const double thickness = std::abs(seed[2] - face) * spacing, towards_face = face == 0 ? -1 : 1;
        if (thickness < width && -towards_face * normal_at<3>(psi, seed)[2] > parallel_to_surface)
          walls.push_back({seed, {seed[0], seed[1], face}, thickness});
      }
  }
  return walls;
}

template <int dim>
FaceWall<dim> thinnest_near(const CubicInterpolant<dim>& psi, FaceWall<dim> wall) {
  constexpr int turns = 4;
  for (int turn = 0; turn < turns; ++turn) {
    const auto nearest = closest_zero<dim>(psi, wall.foot, wall.point);
    if (!nearest) break;
    wall.point = *nearest;
    for (int d = 0; d < dim - 1; ++d) wall.foot[d] = wall.point[d];
    wall.width = physical_distance<dim>(psi.lattice(), wall.point, wall.foot);
  }
  return wall;
}

template decltype(walls_to_faces<2>) walls_to_faces<2>;
template decltype(walls_to_faces<3>) walls_to_faces<3>;
template decltype(thinnest_near<2>) thinnest_near<2>;
template decltype(thinnest_near<3>) thinnest_near<3>;

}  // namespace wheelwright
