#pragma once

#include "wheelwright/ring/cyclic_stiffness.h"
#include "wheelwright/ring/tread.h"

namespace wheelwright {

/// The response of the tread's surface to tractions on it, with core and tread. The contact operators of all
/// load positions consist of its blocks.
template <int dim>
class SurfaceCompliance {
 public:
  /// For columns up to `width` apart, and tractions on some columns of a sector (and of all others): the ring
  /// is solved for each of their tractions.
  SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width,
                    const std::vector<bool>& loaded);

  /// For tractions anywhere.
  SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width)
      : SurfaceCompliance(ring, tread, width, std::vector<bool>(tread.columns_per_sector(), true)) {}

  int width() const { return width_; }

  /// The first components of the column frame, those that the tread traces.
  int components() const { return components_; }

  /// The sample z = tau sigma(u)n - gamma u on ring column from + difference for a unit traction (times dS)
  /// on the loaded column `from`, applied as the weak form (28) does, with theta; |difference| <= width().
  /// components() rows and columns per point, column frames.
  const Matrix& block(int from, int difference) const {
    return blocks_[(2 * width_ + 1) * (from % columns_per_sector_) + difference + width_];
  }

 private:
  int columns_per_sector_, components_, width_;
  std::vector<Matrix> blocks_;
};

}  // namespace wheelwright
