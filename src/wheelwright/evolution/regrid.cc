#include "wheelwright/evolution/regrid.h"

#include "wheelwright/evolution/redistance.h"
#include "wheelwright/evolution/sub_cell_filter.h"
#include "wheelwright/geometry/mirror.h"
#include "wheelwright/geometry/values_on.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> regrid(const LevelSet<dim>& psi, const Lattice<dim>& lattice) {
  const LevelSet<dim> values = values_on(psi, lattice);
  if (have_same_nodes(psi.lattice, lattice)) return values;
  return with_symmetries_of(psi, sub_cell_filter(redistance(values)));
}

template LevelSet<2> regrid(const LevelSet<2>&, const Lattice<2>&);
template LevelSet<3> regrid(const LevelSet<3>&, const Lattice<3>&);

}  // namespace wheelwright
