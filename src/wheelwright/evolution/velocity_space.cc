#include "wheelwright/evolution/velocity_space.h"

#include <algorithm>

#include "wheelwright/evolution/multilinear.h"

namespace wheelwright {

template <int dim>
VelocitySpace<dim>::VelocitySpace(const Lattice<dim>& lattice, std::vector<bool> fixed, double length)
    : lattice_(lattice),
      fixed_(std::move(fixed)),
      length_(length),
      form_(with_fixed_nodes(multilinear_form<dim>(lattice, 1, length * length), fixed_)),
      factor_(*SparseSpd::factor(lattice.n_nodes(), form_)) {}

template <int dim>
std::vector<double> VelocitySpace<dim>::representative(std::span<const double> load) const {
  return factor_.solve(restricted({load.begin(), load.end()}));
}

template <int dim>
std::vector<double> VelocitySpace<dim>::load(std::span<const double> velocity) const {
  return symmetric_product(form_, restricted({velocity.begin(), velocity.end()}));
}

template <int dim>
std::vector<double> VelocitySpace<dim>::restricted(std::vector<double> nodal) const {
  for (std::size_t node = 0; node < nodal.size(); ++node)
    if (fixed_[node]) nodal[node] = 0;
  return nodal;
}

template <int dim>
VelocitySpace<dim> VelocitySpace<dim>::with_held(const std::vector<bool>& held) const {
  std::vector<bool> fixed = fixed_;
  for (std::size_t node = 0; node < fixed.size(); ++node) fixed[node] = fixed[node] || held[node];
  return {lattice_, std::move(fixed), length_};
}

template class VelocitySpace<2>;
template class VelocitySpace<3>;

}  // namespace wheelwright
