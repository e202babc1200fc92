#pragma once

#include "wheelwright/elasticity/material.h"

namespace wheelwright {

/// The material at every place of the ring, one per radial row of cells, counted from the rim. Materials are
/// always looked up by place: no other code assumes that all rows have the same one, as they do today.
class Materials {
 public:
  Materials() = default;

  /// The same material everywhere.
  Materials(const Material& everywhere) : everywhere_(everywhere) {}

  /// The material of the cells of a radial row.
  const Material& in_row(int) const { return everywhere_; }

  /// The material at the tread, which meets the ground.
  const Material& at_tread() const { return everywhere_; }

 private:
  Material everywhere_;
};

}  // namespace wheelwright
