#pragma once

#include <vector>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// One connected piece of the material, or one hole. Its images in the other sectors belong to the same
/// component.
template <int dim>
struct Component {
  bool is_material;
  /// Area of one image [m^2], or volume [m^3] when dim = 3; the error is about one sample's area per sample
  /// on the edge of the component.
  double measure;
  Vec<dim> centre;        ///< mean (radius, azimuth[, axial]) of one image, with the azimuth in the sector
  Vec<dim> innermost;     ///< sample nearest to the rim, (radius, azimuth[, axial])
  Vec<dim> outermost;     ///< sample nearest to the tread
  bool at_rim, at_tread;  ///< whether the component reaches the inner or outer radius
};

/// The connected components of {psi < 0} and of {psi >= 0} in the full ring.
template <int dim>
struct Components {
  Lattice<dim> samples;        ///< the points where psi was sampled
  std::vector<int> of_sample;  ///< one index into `all` per sample
  std::vector<Component<dim>> all;
};

/// Number of samples of psi per cell and axis. A piece thinner than the distance of two samples may be lost,
/// and pieces closer to each other than that may be merged.
constexpr int component_samples = 4;

/// Finds the components by a flood fill over samples of the polynomial of each cell, periodic in azimuth: a
/// piece may cross a face of the sector, or be attached to the rim only in a neighbouring sector. Two samples
/// on a diagonal of a square are connected if psi has their sign at the centre of the square, as in
/// material_contours(). psi must be finite.
template <int dim>
Components<dim> components(const LevelSet<dim>& psi, int samples_per_cell = component_samples);

}  // namespace wheelwright
