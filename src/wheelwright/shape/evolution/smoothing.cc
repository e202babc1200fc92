#include "wheelwright/shape/evolution/smoothing.h"

#include "wheelwright/shape/evolution/multilinear.h"

namespace wheelwright {

template <int dim>
Smoother<dim>::Smoother(const Lattice<dim>& lattice, double length)
    : mass_(multilinear_form<dim>(lattice, 1, 0)),
      factor_(*SparseSpd::factor(lattice.n_nodes(), multilinear_form<dim>(lattice, 1, length * length))) {}

template <int dim>
LevelSet<dim> Smoother<dim>::operator()(const LevelSet<dim>& psi) const {
  return {psi.lattice, factor_.solve(symmetric_product(mass_, psi.values))};
}

template class Smoother<2>;
template class Smoother<3>;

}  // namespace wheelwright
