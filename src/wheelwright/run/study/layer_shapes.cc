#include "wheelwright/run/study/layer_shapes.h"

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/shape/geometry/annulus.h"

namespace wheelwright {

template <int dim>
std::vector<LayerShape<dim>> layer_shapes(const Case& c, const LevelSet<dim>& shape) {
  std::vector<LayerShape<dim>> result;
  if (c.layers.empty()) return result;
  const PolarGrid<dim>& grid = shape.lattice.grid();
  for (const auto& [name, inner, outer, material, layer, large] : placed_materials(c)) {
    LevelSet<dim> part = in_rows(shape, grid.nearest_line(inner).line, grid.nearest_line(outer).line);
    // Holes end a thousandth of a cell before it.
    if (layer && c.layers[*layer].holes == LayerHoles::none)
      for (double& value : part.values) value = std::min(value, -grid.resolution());
    result.push_back({name, std::move(part)});
  }
  return result;
}

namespace {

/// Whether what lies at a radius stays material.
bool stays_material(const Case& c, double radius) {
  const Bands solid = bands(c);
  return radius < c.wheel.inner_radius + solid.rim.thickness ||
         radius > c.wheel.outer_radius - solid.tread.thickness ||
         std::ranges::any_of(solid.between, [&](const SolidAnnulus& annulus) {
           return annulus.inner < radius && radius < annulus.outer;
         });
}

}  // namespace

std::vector<double> cutting_radii(const Case& c, double tolerance) {
  const double h = polar_grid<2>(c).resolution(), beside = 1e-6 * h, apart = 0.001 * h + 2 * tolerance;
  std::vector<double> radii;
  for (const double radius : materials<2>(c).interfaces()) {
    const bool is_solid_inside = stays_material(c, radius - beside),
               is_solid_outside = stays_material(c, radius + beside);
    radii.push_back(radius + (is_solid_inside ? apart : 0) - (is_solid_outside ? apart : 0));
  }
  return radii;
}

template decltype(layer_shapes<2>) layer_shapes<2>;
template decltype(layer_shapes<3>) layer_shapes<3>;

}  // namespace wheelwright
