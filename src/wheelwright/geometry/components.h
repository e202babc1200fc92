#pragma once

#include <vector>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// One connected piece of the material, or one hole. Its copies in the other sectors are the same component.
template <int dim>
struct Component {
  bool is_material;
  double measure;  ///< of one copy [m^2, or m^3 when dim = 3], to about a sample's share a sample on its edge
  Vec<dim> centre;        ///< of one copy, mean (radius, azimuth[, axial]) with the azimuth in the sector
  Vec<dim> innermost;     ///< sample next to the rim, (radius, azimuth[, axial])
  Vec<dim> outermost;     ///< sample next to the tread
  bool at_rim, at_tread;  ///< reaches the inner or outer radius
};

/// The pieces of {psi < 0} and of {psi >= 0} in the ring that repeats psi's sector.
template <int dim>
struct Components {
  Lattice<dim> samples;        ///< where psi was sampled
  std::vector<int> of_sample;  ///< index into `all`, one a sample
  std::vector<Component<dim>> all;
};

/// Samples of psi a cell and axis that tell components apart. What is thinner than a sample's distance may be
/// lost, and pieces that come closer than that may be taken for one.
constexpr int component_samples = 4;

/// Flood fill over samples of every cell's polynomial, periodic in azimuth: a piece may cross the sector's
/// face, or hold on to the rim in a neighbouring sector only. Two samples across the diagonal of a square are
/// joined where psi at its centre has their sign, as in material_contours(). psi must be finite.
template <int dim>
Components<dim> components(const LevelSet<dim>& psi, int samples_per_cell = component_samples);

}  // namespace wheelwright
