#pragma once

#include <memory>
#include <vector>

#include "wheelwright/cad/drawing/drawn_outline.h"
#include "wheelwright/cad/drawing/fill.h"

namespace wheelwright {

/// Equal outlines that are drawn together, e.g. the spokes of a wheel: their union is filled.
struct Figure {
  Fill fill;
  std::vector<DrawnOutline> outlines;
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

}  // namespace wheelwright
