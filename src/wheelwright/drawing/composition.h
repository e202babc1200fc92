#pragma once

#include <memory>
#include <vector>

#include "wheelwright/drawing/outline.h"
#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// What an outline adds to a shape.
enum class Fill { material, hole };

/// Equal outlines that are drawn together, e.g. the spokes of a wheel: their union is filled.
struct Figure {
  Fill fill;
  std::vector<Outline> outlines;
};

/// A shape in the plane: material everywhere, over which figures are drawn in their order, each one over
/// those before it.
class Composition {
 public:
  explicit Composition(const std::vector<Figure>& figures);

  bool is_hole(const Point& x) const;

  /// The exact curves between material and holes; what other figures cover is cut away.
  const std::vector<Curve>& boundary() const { return boundary_->curves(); }

  /// Distance [m] from x to the boundary, if that is below `bound`, else `bound`.
  double distance(const Point& x, double bound) const;

 private:
  struct Owner {
    int figure, outline;
    auto operator<=>(const Owner&) const = default;
  };

  std::vector<Fill> fills_;
  std::vector<Owner> owners_;  ///< of each curve
  std::unique_ptr<const CurveTree> curves_, boundary_;
};

/// Signed distance [m] to the boundary at the nodes, positive in the holes; without a boundary minus the
/// thickness of the ring. The composition must be the same in all sectors. When dim = 3 the shape is a
/// cylinder along the axle.
template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, const Composition& composition);

}  // namespace wheelwright
