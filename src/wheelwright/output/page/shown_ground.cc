#include "wheelwright/output/page/shown_ground.h"

#include "wheelwright/output/report/ground_outline.h"

namespace wheelwright {

template <int dim>
std::optional<ShownGround> shown_ground(const PositionFields<dim>& fields) {
  // In outer radii. A plane picture may be much wider than the wheel, and its contact magnified 200 times.
  constexpr double reach = dim == 2 ? 4 : 1.1, near = 0.25, far_deviation = 1e-3, near_deviation = 1e-6;
  if (fields.is_bonded) return ShownGround{};
  if (fields.ground.is_flat() && fields.camber == 0) return {};
  const PolarGrid<dim>& grid = fields.lattice.grid();
  const double radius = grid.outer_radius;
  ShownGround shown{.outline = {}, .camber = fields.camber};
  const auto add = [&](double from, double to, double deviation) {
    const auto part =
        ground_outline(grid, fields.ground, fields.camber, {from * radius, to * radius}, deviation * radius);
    shown.outline.insert(shown.outline.end(), part.begin(), part.end());
  };
  add(-reach, -near, far_deviation);
  add(-near, near, dim == 2 ? near_deviation : far_deviation);
  add(near, reach, far_deviation);
  return shown;
}

template decltype(shown_ground<2>) shown_ground<2>;
template decltype(shown_ground<3>) shown_ground<3>;

}  // namespace wheelwright
