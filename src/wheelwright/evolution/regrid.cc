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
  const LevelSet<dim> distance = sub_cell_filter(redistance(values));
  return is_mirror_symmetric(psi) ? mirror_symmetric_part(distance) : distance;
}

template LevelSet<2> regrid(const LevelSet<2>&, const Lattice<2>&);
template LevelSet<3> regrid(const LevelSet<3>&, const Lattice<3>&);

}  // namespace wheelwright
