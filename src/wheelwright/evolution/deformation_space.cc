#include "wheelwright/evolution/deformation_space.h"

#include "wheelwright/evolution/multilinear.h"
#include "wheelwright/geometry/cell_map.h"

namespace wheelwright {
namespace {

/// The gradient at a node by central differences, one-sided at the ends of the lattice, in polar directions.
template <int dim>
Vec<dim> gradient_at(const LevelSet<dim>& psi, int node) {
  const Lattice<dim>& lattice = psi.lattice;
  const auto position = lattice.node_position(node);
  const double radius = lattice.polar_point(position)[0];
  Vec<dim> gradient;
  for (int axis = 0; axis < dim; ++axis) {
    auto before = position, after = position;
    const bool is_periodic = axis == 1;
    if (is_periodic || position[axis] > 0) --before[axis];
    if (is_periodic || position[axis] + 1 < lattice.nodes()[axis]) ++after[axis];
    const double distance =
        (after[axis] - before[axis]) * lattice.spacing()[axis] * (is_periodic ? radius : 1);
    gradient[axis] =
        (psi.values[lattice.node_index(after)] - psi.values[lattice.node_index(before)]) / distance;
  }
  return gradient;
}

}  // namespace

template <int dim>
DeformationSpace<dim>::DeformationSpace(const Lattice<dim>& lattice, std::vector<bool> fixed, double length,
                                        DeformationKind kind)
    : lattice_(lattice),
      fixed_(std::move(fixed)),
      kind_(kind),
      form_(with_fixed_nodes(multilinear_form<dim>(lattice, 1, length * length), fixed_)),
      factor_(*SparseSpd::factor(lattice.n_nodes(), form_)) {}

template <int dim>
std::vector<double> DeformationSpace<dim>::representative(std::span<const double> load) const {
  return by_component(load, [&](const auto& part) { return factor_.solve(restricted(part)); });
}

template <int dim>
std::vector<double> DeformationSpace<dim>::load(std::span<const double> deformation) const {
  return by_component(deformation,
                      [&](const auto& part) { return symmetric_product(form_, restricted(part)); });
}

template <int dim>
std::vector<double> DeformationSpace<dim>::normal_load(std::span<const SurfaceSample<dim>> density) const {
  std::vector<Vec<dim>> factors;
  for (const auto& sample : density) factors.push_back(factors_at(sample));
  std::vector<double> result;
  for (int k = 0; k < n_components(); ++k) {
    std::vector<SurfaceSample<dim>> part(density.begin(), density.end());
    for (std::size_t q = 0; q < part.size(); ++q) part[q].value *= factors[q][k];
    const auto load = restricted(boundary_load<dim>(lattice_, part));
    result.insert(result.end(), load.begin(), load.end());
  }
  return result;
}

template <int dim>
std::vector<double> DeformationSpace<dim>::speeds_at(std::span<const SurfacePoint<dim>> boundary,
                                                     std::span<const double> deformation) const {
  std::vector<double> result;
  for (const auto& point : boundary) {
    const auto at = node_weights<dim>(lattice_, point.cell, point.xi);
    const auto factor = factors_at(point);
    double speed = 0;
    for (int k = 0; k < n_components(); ++k)
      speed += factor[k] * interpolate(at, deformation.subspan(k * fixed_.size(), fixed_.size()));
    result.push_back(speed);
  }
  return result;
}

template <int dim>
std::vector<double> DeformationSpace<dim>::speeds(const LevelSet<dim>& psi,
                                                  std::span<const double> deformation) const {
  std::vector<double> result(fixed_.size(), 0.0);
  for (std::size_t node = 0; node < result.size(); ++node) {
    if (fixed_[node]) continue;
    Vec<dim> normal = gradient_at(psi, static_cast<int>(node));
    const double length = norm<dim>(normal);
    for (double& x : normal) x = length > 0 ? x / length : 0;
    const auto factor = factors(normal);
    for (int k = 0; k < n_components(); ++k)
      result[node] += factor[k] * deformation[k * fixed_.size() + node];
  }
  return result;
}

/// How far each component moves a boundary with this normal, given in polar directions.
template <int dim>
Vec<dim> DeformationSpace<dim>::factors(const Vec<dim>& normal) const {
  return kind_ == DeformationKind::vector_field ? normal : Vec<dim>{1};
}

template <int dim>
Vec<dim> DeformationSpace<dim>::factors_at(const SurfacePoint<dim>& point) const {
  const auto& grid = lattice_.grid();
  const double azimuth = (grid.cell_position(point.cell)[1] + point.xi[1]) * grid.cell_size()[1];
  return factors(rotated<dim>(point.normal, -azimuth));
}

/// With zeros at the fixed nodes.
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
