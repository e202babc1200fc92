#pragma once

#include <vector>

#include "wheelwright/geometry/topology.h"

namespace wheelwright {

/// The bands along the rim and the tread that stay material: r < R_i + rim_band and r > R_e - tread_band.
template <int dim>
class ProtectedBands {
 public:
  /// The widths are in metres.
  ProtectedBands(const Lattice<dim>& lattice, double rim_band, double tread_band);

  /// One flag per lattice node, true in a band.
  const std::vector<bool>& nodes() const { return nodes_; }

  /// Clips holes at the edges of the bands: returns the minimum of psi and of the distance to the nearest
  /// band minus a tenth of the resolution. This margin keeps quadratic level sets from overshooting into the
  /// band between a node on its edge and the next node.
  LevelSet<dim> keep(LevelSet<dim> psi) const;

  /// One event for each hole of `after` that reaches a band, up to about one sample spacing, if no
  /// overlapping hole of `before` did. The place of the event is at the band.
  std::vector<ShapeEvent<dim>> contacts(const Components<dim>& before, const Components<dim>& after) const;

  /// Whether a boundary point lies on the edge of a band, where keep() stops the boundary.
  bool touches(const SurfaceSample<dim>& sample) const;

 private:
  double distance(double radius) const;

  PolarGrid<dim> grid_;
  double inner_edge_, outer_edge_;
  std::vector<bool> nodes_;
  std::vector<double> upper_bound_;
};

}  // namespace wheelwright
