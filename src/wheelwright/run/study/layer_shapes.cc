#include "wheelwright/run/study/layer_shapes.h"

#include <algorithm>

#include "wheelwright/case/layers.h"
#include "wheelwright/shape/geometry/annulus.h"

namespace wheelwright {

template <int dim>
std::vector<LayerShape<dim>> layer_shapes(const Case& c, const LevelSet<dim>& shape) {
  std::vector<LayerShape<dim>> result;
  if (c.layers.empty()) return result;
  const PolarGrid<dim>& grid = shape.lattice.grid();
  for (const auto& [name, inner, outer, material, layer] : placed_materials(c)) {
    LevelSet<dim> part = in_rows(shape, grid.nearest_line(inner).line, grid.nearest_line(outer).line);
    // Holes end a thousandth of a cell before it.
    if (layer && c.layers[*layer].holes == LayerHoles::none)
      for (double& value : part.values) value = std::min(value, -grid.resolution());
    result.push_back({name, std::move(part)});
  }
  return result;
}

template decltype(layer_shapes<2>) layer_shapes<2>;
template decltype(layer_shapes<3>) layer_shapes<3>;

}  // namespace wheelwright
