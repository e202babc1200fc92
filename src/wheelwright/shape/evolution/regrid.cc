#include "wheelwright/shape/evolution/regrid.h"

#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/evolution/sub_cell_filter.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/values_on.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> regrid(const LevelSet<dim>& psi, const Lattice<dim>& lattice) {
  LevelSet<dim> values = values_on(psi, lattice);
  if (have_same_nodes(psi.lattice, lattice)) return values;
  return with_symmetries_of(psi, sub_cell_filter(redistance(values)));
}

template decltype(regrid<2>) regrid<2>;
template decltype(regrid<3>) regrid<3>;

}  // namespace wheelwright
