#pragma once

#include <memory>

#include "wheelwright/mechanics/elasticity/isotropic_law.h"

namespace wheelwright {

/// The material law at every place of the ring, one per radial row of cells, counted from the rim. Laws are
/// always looked up by place: no other code assumes that all rows have the same one, as they do today.
template <int dim>
class Materials {
 public:
  Materials() : Materials(Material()) {}

  /// The same material everywhere.
  Materials(const Material& everywhere) : Materials(std::make_shared<IsotropicLaw<dim>>(everywhere)) {}
  Materials(std::shared_ptr<const MaterialLaw<dim>> everywhere) : everywhere_(std::move(everywhere)) {}

  /// The law of the cells of a radial row.
  const MaterialLaw<dim>& in_row(int) const { return *everywhere_; }

  /// The law at the tread, which meets the ground.
  const MaterialLaw<dim>& at_tread() const { return *everywhere_; }

 private:
  std::shared_ptr<const MaterialLaw<dim>> everywhere_;
};

}  // namespace wheelwright
