#include "wheelwright/shape/evolution/narrowest_place.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/geometry/components.h"

namespace wheelwright {
namespace {

/// The width between opposite parts of the boundary: the smallest diameter of balls that touch it at a seed
/// and pass through the seed opposite. (MedialBall::radius may be smaller, where a ball of a round hole
/// shrank further by the deviations of neighbouring seeds.)
template <int dim>
std::optional<NarrowestPlace<dim>> between_edges(const LevelSet<dim>& psi, Side side) {
  const auto& grid = psi.lattice.grid();
  const double outward = side == Side::material ? 1 : -1;
  const MedialBalls<dim> medial(psi);
  const double largest = 0.5 * (grid.outer_radius - grid.inner_radius);
  double radius = grid.resolution();
  auto balls = medial.in(side, radius);
  while (balls.empty() && radius < largest) {  // large balls take many steps to shrink
    radius = std::min(2 * radius, largest);
    balls = medial.in(side, radius);
  }
  constexpr double parallel = -0.9;  // the ends of a neck, unlike the sides of a corner
  std::optional<NarrowestPlace<dim>> narrowest;
  for (const auto& ball : balls) {
    const auto [seed, other] = ball.touched;
    const Vec<dim> p = cartesian_position<dim>(psi.lattice, medial.point(seed)),
                   across = p - cartesian_position<dim>(psi.lattice, medial.point(other)),
                   normal = outward * medial.normal(seed);
    if (dot<dim>(medial.normal(seed), medial.normal(other)) > parallel) continue;
    const double width = dot<dim>(across, across) / dot<dim>(across, normal);
    if (width > 0 && (!narrowest || width < narrowest->width)) narrowest = {width, p - 0.5 * width * normal};
  }
  return narrowest;
}

/// A surface of the ring as seen from a point: the direction to it, and its distance.
template <int dim>
struct RingSurface {
  Vec<dim> direction;
  double distance;
};

template <int dim>
std::vector<RingSurface<dim>> surfaces_of_ring(const PolarGrid<dim>& grid, const Vec<dim>& x) {
  const double radius = std::hypot(x[0], x[1]);
  Vec<dim> outwards{};
  for (int d = 0; d < 2; ++d) outwards[d] = x[d] / radius;
  std::vector<RingSurface<dim>> result{{-1.0 * outwards, radius - grid.inner_radius},
                                       {outwards, grid.outer_radius - radius}};
  if constexpr (dim == 3) {
    result.push_back({{0, 0, -1}, x[2]});
    result.push_back({{0, 0, 1}, grid.width - x[2]});
  }
  return result;
}

template <int dim>
std::optional<NarrowestPlace<dim>> to_surfaces(const LevelSet<dim>& psi) {
  constexpr double parallel = 0.94;  // cosine of 20 degrees
  const CubicInterpolant<dim> interpolant(psi);
  std::optional<NarrowestPlace<dim>> narrowest;
  for (const Vec<dim>& seed : zero_seeds<dim>(interpolant)) {
    const Vec<dim> x = cartesian_position<dim>(psi.lattice, seed), normal = normal_at<dim>(interpolant, seed);
    for (const auto& [direction, distance] : surfaces_of_ring<dim>(psi.lattice.grid(), x))
      if (-dot<dim>(normal, direction) > parallel && (!narrowest || distance < narrowest->width))
        narrowest = {distance, x + 0.5 * distance * direction};
  }
  return narrowest;
}

}  // namespace

template <int dim>
std::optional<NarrowestPlace<dim>> narrowest_place(const LevelSet<dim>& psi, Side side) {
  const auto inside = between_edges(psi, side);
  if (side == Side::holes) return inside;
  const auto outside = to_surfaces(psi);
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
