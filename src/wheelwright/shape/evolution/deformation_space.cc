#include "wheelwright/shape/evolution/deformation_space.h"

#include "wheelwright/shape/evolution/multilinear.h"

namespace wheelwright {

template <int dim>
DeformationSpace<dim>::DeformationSpace(const Lattice<dim>& lattice, std::vector<bool> fixed, double length,
                                        DeformationKind kind, Invariance invariance)
    : lattice_(lattice),
      fixed_(std::move(fixed)),
      kind_(kind),
      invariance_(invariance),
      form_(with_fixed_nodes(multilinear_form<dim>(lattice, 1, length * length), fixed_)),
      factor_(*SparseSpd::factor(lattice.n_nodes(), form_)) {}

template <int dim>
std::vector<double> DeformationSpace<dim>::representative(std::span<const double> load) const {
  // The form is that of the lines times that along them, of which constants have the shares of the nodes. The
  // representative of such a load is therefore constant, up to rounding.
  return by_component(load, [&](const auto& part) {
    const auto on_lines = invariant_load<dim>(lattice_, part, invariance_);
    return invariant_part<dim>(lattice_, factor_.solve(restricted(on_lines)), invariance_);
  });
}

template <int dim>
std::vector<double> DeformationSpace<dim>::load(std::span<const double> deformation) const {
  const std::size_t n_nodes = fixed_.size();
  const int n = n_components();
  std::vector<Vec<dim>> at_node(n_nodes);  // all components, so that the form is read once
  for (int k = 0; k < n; ++k)
    for (std::size_t node = 0; node < n_nodes; ++node)
      at_node[node][k] = fixed_[node] ? 0 : deformation[k * n_nodes + node];
  const auto product = symmetric_product<dim>(form_, at_node);
  std::vector<double> result(n * n_nodes);
  for (int k = 0; k < n; ++k)
    for (std::size_t node = 0; node < n_nodes; ++node) result[k * n_nodes + node] = product[node][k];
  return result;
}

template <int dim>
std::vector<double> DeformationSpace<dim>::speeds(const LevelSet<dim>& psi,
                                                  std::span<const double> deformation) const {
  return restricted(motion_of(psi, {}).speeds_at_nodes(deformation));
}

/// The values with zeros at the fixed nodes.
template <int dim>
std::vector<double> DeformationSpace<dim>::restricted(std::span<const double> component) const {
  std::vector<double> result(component.begin(), component.end());
  for (std::size_t node = 0; node < result.size(); ++node)
    if (fixed_[node]) result[node] = 0;
  return result;
}

template <int dim>
template <class Function>
std::vector<double> DeformationSpace<dim>::by_component(std::span<const double> vector,
                                                        Function function) const {
  std::vector<double> result;
  for (int k = 0; k < n_components(); ++k) {
    const auto part = function(vector.subspan(k * fixed_.size(), fixed_.size()));
    result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

template class DeformationSpace<2>;
template class DeformationSpace<3>;

}  // namespace wheelwright
