#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The part of a shape that is of one material, as a shape of its own.
template <int dim>
struct LayerShape {
  std::string name;  ///< of the layer; "material" for what lies in none, if several "material 2" and so on
  LevelSet<dim> shape;
};

/// The layers of a case's shape from the rim to the tread; empty if there is only one material.
template <int dim>
std::vector<LayerShape<dim>> layer_shapes(const Case& c, const LevelSet<dim>& shape);

/// The radii of the circles that divide an outline, which deviates by `tolerance` [m] from the shape, into
/// its layers: those between the layers. Holes that end at what stays material would leave a skin of their
/// distance from it: there the circle lies farther on their side, by that distance and what the outline may
/// deviate.
std::vector<double> cutting_radii(const Case& c, double tolerance);

}  // namespace wheelwright
