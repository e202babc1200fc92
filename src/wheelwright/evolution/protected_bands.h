#pragma once

#include <vector>

#include "wheelwright/geometry/topology.h"

namespace wheelwright {

/// The rings along rim and tread that stay material: r < R_i + rim_band and r > R_e - tread_band.
template <int dim>
class ProtectedBands {
 public:
  /// Widths in metres.
  ProtectedBands(const Lattice<dim>& lattice, double rim_band, double tread_band);

  /// One flag a lattice node: true in a band.
  const std::vector<bool>& nodes() const { return nodes_; }

  /// The shape with every hole cut off at the edges of the bands: the smaller of psi and the distance to the
  /// nearest band, less a tenth of the resolution, so that quadratic cells between an edge node and the next
  /// do not overshoot into the band.
  LevelSet<dim> keep(LevelSet<dim> psi) const;

  /// The holes of `after` that lie at a band, to within a sample, where none of the holes of `before` that
  /// they overlap did; the place is the one at the band.
  std::vector<ShapeEvent<dim>> contacts(const Components<dim>& before, const Components<dim>& after) const;

  /// Whether a boundary point lies on the edge of a band, where keep() stops it.
  bool touches(const SurfaceSample<dim>& sample) const;

 private:
  double distance(double radius) const;

  PolarGrid<dim> grid_;
  double inner_edge_, outer_edge_;
  std::vector<bool> nodes_;
  std::vector<double> upper_bound_;
};

}  // namespace wheelwright
