#pragma once

#include <memory>
#include <vector>

#include "wheelwright/shape/evolution/made_shapes.h"
#include "wheelwright/shape/geometry/bands.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright {

/// The bands along the rim and the tread, and the annuli between them, that stay material, and how the
/// wheel is made if that limits its shapes.
template <int dim>
class ProtectedBands {
 public:
  ProtectedBands(const Lattice<dim>& lattice, const Bands& bands);

  /// One flag per lattice node, true in a band.
  const std::vector<bool>& nodes() const { return nodes_; }

  /// Clips holes at the edges of hole_range(): returns the minimum of psi and of the distance to the nearest
  /// edge. A signed distance whose holes lie within the range is not changed.
  LevelSet<dim> clip(LevelSet<dim> psi) const;

  /// The same for the coefficients of splines, which stay below the edges with their splines.
  LevelSet<dim> clip_design(LevelSet<dim> coefficients) const;

  /// The same for shapes that can be made, if that limits them, and for the coefficients of their splines.
  LevelSet<dim> keep(LevelSet<dim> psi) const;
  LevelSet<dim> keep_design(LevelSet<dim> coefficients) const;

  /// Null if all shapes can be made.
  const MadeShapes<dim>* made() const { return made_.get(); }

  /// One event for each hole of `after` that reaches a band, up to about one sample spacing, if no
  /// overlapping hole of `before` did. The place of the event is at the band.
  std::vector<ShapeEvent<dim>> contacts(const Components<dim>& before, const Components<dim>& after) const;

  /// Whether keep_design() would clip the coefficient of a node, or its value is within `margin` [m] of that.
  bool is_clipped(int node, double coefficient, double margin) const {
    return coefficient > bound_of_coefficients_[node] - margin;
  }

  /// Whether a boundary point lies where clip() stops the boundary, up to a tenth of the resolution.
  bool touches(const SurfacePoint<dim>& point) const;

 private:
  double distance(const Vec<dim>& polar) const;

  PolarGrid<dim> grid_;
  HoleRange range_;
  std::vector<SolidAnnulus> between_;
  std::vector<bool> nodes_;
  std::optional<Mould> mould_;
  std::vector<double> upper_bound_, bound_of_coefficients_;
  std::shared_ptr<const MadeShapes<dim>> made_;
};

}  // namespace wheelwright
