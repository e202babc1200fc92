#pragma once

#include <string>
#include <vector>

#include "wheelwright/mechanics/elasticity/materials.h"

namespace wheelwright {

/// The circles between the layers of a wheel, as pictures show them. Empty for a wheel of one material.
struct LayerCircles {
  std::vector<double> radii;       ///< from the rim to the tread [m]
  std::vector<std::string> names;  ///< of the layers, one more than radii

  bool empty() const { return radii.empty(); }
};

template <int dim>
LayerCircles layer_circles(const Materials<dim>& materials) {
  LayerCircles circles{materials.interfaces(), {}};
  if (!circles.empty())
    for (const auto& layer : materials.layers()) circles.names.push_back(layer.name);
  return circles;
}

/// E.g. "layers from the rim: core, material, tyre".
std::string text(const LayerCircles& circles);

/// The same as lines of SVG below each other, with the line that marks the circles; from (x, y) [pixels].
std::string layer_legend(const LayerCircles& circles, double x, double y);

/// How pictures in SVG draw paths along the circles, visible on light and dark colours. `pixel`: of the
/// path's units. Empty for an empty path.
std::string layer_lines(const std::string& path, double pixel);

}  // namespace wheelwright
