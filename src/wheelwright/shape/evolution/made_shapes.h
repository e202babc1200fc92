#pragma once

#include "wheelwright/shape/evolution/followers.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The shapes of one lattice that can be made in some way, by conditions on the coefficients of their splines
/// from layer to layer.
template <int dim>
class MadeShapes {
 public:
  virtual ~MadeShapes() = default;

  /// The smallest coefficients above the given ones that are allowed. Allowed ones are not changed, up to
  /// 1e-10 of the resolution, and then to the last bit.
  virtual LevelSet<dim> keep_coefficients(LevelSet<dim> coefficients) const = 0;

  /// The same for a level set.
  virtual LevelSet<dim> keep(LevelSet<dim> psi) const = 0;

  /// Adds to `following` what follows other values while the coefficients change towards `moved`: those that
  /// are limited, and those that would be after the move and that could make less than a quarter of it.
  /// Returns whether it added any.
  virtual bool follow(const LevelSet<dim>& coefficients, const LevelSet<dim>& moved,
                      Following& following) const = 0;
};

}  // namespace wheelwright
