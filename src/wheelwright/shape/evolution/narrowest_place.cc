#include "wheelwright/shape/evolution/narrowest_place.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "wheelwright/shape/evolution/face_walls.h"
#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/geometry/components.h"

namespace wheelwright {
namespace {

/// The smallest diameter of balls that touch the boundary at a seed and pass through the seed opposite, among
/// the balls that MedialBalls finds below a radius. (MedialBall::radius may be smaller, where a ball of a
/// round hole shrank further by the deviations of neighbouring seeds.)
template <int dim>
std::optional<NarrowestPlace<dim>> between_edges(const MedialBalls<dim>& medial, Side side, double radius) {
  constexpr double parallel = -0.95;  // the ends of a neck, unlike the sides of a corner
  const auto& lattice = medial.interpolant().lattice();
  const double outward = side == Side::material ? 1 : -1;
  std::optional<NarrowestPlace<dim>> narrowest;
  for (const auto& ball : medial.in(side, radius)) {
    const auto [seed, other] = ball.touched;
    if (dot<dim>(medial.normal(seed), medial.normal(other)) > parallel) continue;
    const Vec<dim> p = cartesian_position<dim>(lattice, medial.point(seed)),
                   across = p - cartesian_position<dim>(lattice, medial.point(other)),
                   normal = outward * medial.normal(seed);
    const double width = dot<dim>(across, across) / dot<dim>(across, normal);
    if (width > 0 && (!narrowest || width < narrowest->width)) narrowest = {width, p - 0.5 * width * normal};
  }
  return narrowest;
}

/// Searches with growing balls, because large ones take many steps to shrink.
template <int dim>
std::optional<NarrowestPlace<dim>> between_edges(const MedialBalls<dim>& medial, Side side) {
  const auto& grid = medial.interpolant().lattice().grid();
  const double largest = 0.5 * (grid.outer_radius - grid.inner_radius);
  for (double radius = std::min(grid.resolution(), largest);; radius = std::min(2 * radius, largest))
    if (const auto found = between_edges(medial, side, radius); found || radius == largest) return found;
}

/// The material between the boundary and the surfaces of the ring.
template <int dim>
std::optional<NarrowestPlace<dim>> to_surfaces(const MedialBalls<dim>& medial) {
  const auto& psi = medial.interpolant();
  const auto& [lattice, grid] = std::tie(psi.lattice(), psi.lattice().grid());
  std::optional<NarrowestPlace<dim>> narrowest;
  const auto add = [&](double width, const Vec<dim>& middle) {
    if (!narrowest || width < narrowest->width) narrowest = {width, middle};
  };
  for (const auto& wall : walls_to_faces<dim>(psi, medial.seeds(), HUGE_VAL))
    add(wall.width, cartesian_position<dim>(lattice, 0.5 * (wall.point + wall.foot)));
  for (const Vec<dim>& seed : medial.seeds()) {
    const Vec<dim> x = cartesian_position<dim>(lattice, seed), normal = normal_at<dim>(psi, seed);
    const double radius = std::hypot(x[0], x[1]);
    const Vec<2> outwards{x[0] / radius, x[1] / radius};
    const double along_radius = normal[0] * outwards[0] + normal[1] * outwards[1];
    const double width = along_radius > 0 ? radius - grid.inner_radius : grid.outer_radius - radius;
    if (std::abs(along_radius) <= parallel_to_surface) continue;
    Vec<dim> middle = x;
    for (int d = 0; d < 2; ++d) middle[d] -= std::copysign(0.5 * width, along_radius) * outwards[d];
    add(width, middle);
  }
  return narrowest;
}

}  // namespace

template <int dim>
std::optional<NarrowestPlace<dim>> narrowest_place(const MedialBalls<dim>& medial, Side side) {
  const auto inside = between_edges(medial, side);
  if (side == Side::holes) return inside;
  const auto outside = to_surfaces(medial);
  if (!inside || (outside && outside->width < inside->width)) return outside;
  return inside;
}

int closed_cavities(const LevelSet<3>& psi) {
  const auto found = components(psi);
  std::vector<bool> is_closed;
  for (const auto& component : found.all) is_closed.push_back(!component.is_material);
  const int last = found.samples.nodes()[2] - 1;
  for (int sample = 0; sample < found.samples.n_nodes(); ++sample)
    if (const int layer = found.samples.node_position(sample)[2]; layer == 0 || layer == last)
      is_closed[found.of_sample[sample]] = false;
  return static_cast<int>(std::ranges::count(is_closed, true));
}

template decltype(narrowest_place<2>) narrowest_place<2>;
template decltype(narrowest_place<3>) narrowest_place<3>;

}  // namespace wheelwright
