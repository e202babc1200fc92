#pragma once

#include "wheelwright/ring/tread.h"
#include "wheelwright/ring/cyclic_stiffness.h"

namespace wheelwright {

/// How the tread's surface answers tractions on it, core and tread together: what every load position's
/// contact operator is cut from.
template <int dim>
class SurfaceCompliance {
 public:
  /// Of columns up to `width` apart.
  SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width);

  int width() const { return width_; }

  /// The sample z = tau sigma(u)n - gamma u on ring column from + difference for a unit traction (times dS)
  /// on column `from`, applied as the weak form (28) does, with theta; |difference| <= width(). dim rows and
  /// columns a point, column frames.
  const Matrix& block(int from, int difference) const {
    return blocks_[(2 * width_ + 1) * (from % columns_per_sector_) + difference + width_];
  }

 private:
  int columns_per_sector_, width_;
  std::vector<Matrix> blocks_;
};

}  // namespace wheelwright
