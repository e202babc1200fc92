#include "wheelwright/shape/evolution/boundary_motion.h"

#include <algorithm>
#include <array>

#include "wheelwright/shape/evolution/spline_level_set.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

/// |grad psi| at a point of a cell, with the cell's map of the same degree.
template <int dim>
double steepness_at(const LevelSet<dim>& psi, const SurfacePoint<dim>& point) {
  const auto& grid = psi.lattice.grid();
  const int degree = psi.lattice.degree();
  const auto values = psi.cell_values(point.cell);
  const ShapeFunctions<dim> shape(degree, point.xi);
  Vec<dim> gradient{};
  for (std::size_t a = 0; a < values.size(); ++a) gradient += values[a] * shape.gradient[a];
  const CellMap<dim> map(grid, degree, grid.cell_position(point.cell));
  return norm<dim>(transpose_times<dim>(inverse<dim>(map.jacobian(shape)), gradient));
}

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
    const double rise = psi.values[lattice.node_index(after)] - psi.values[lattice.node_index(before)],
                 below = lattice.spacing(lattice.row_of(before[0]))[axis];
    gradient[axis] = rise / ((after[axis] - before[axis]) * below * (is_periodic ? radius : 1));
    const double above = lattice.spacing(lattice.row_of(position[0]))[axis];
    if (below == above) continue;
    // Rows of unequal height meet: the parabola through the three values.
    const double first_rise = psi.values[node] - psi.values[lattice.node_index(before)];
    gradient[axis] = (first_rise * above / below + (rise - first_rise) * below / above) / (below + above);
  }
  return gradient;
}

}  // namespace

template <int dim>
std::vector<Vec<dim>> gradients_at_nodes(const LevelSet<dim>& psi) {
  std::vector<Vec<dim>> result;
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) result.push_back(gradient_at<dim>(psi, node));
  return result;
}

template <int dim>
typename BoundaryMotion<dim>::Boundary BoundaryMotion<dim>::boundary_of(
    const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> points) {
  Boundary result;
  result.places.reserve(points.size());
  result.dependences.reserve(power(4, dim) * points.size());
  for (const auto& point : points) {
    const std::size_t first = result.dependences.size();
    add_dependences<dim>(psi.lattice, psi.lattice.grid().cell_position(point.cell), point.xi, 1,
                         result.dependences);
    result.places.push_back({.first = first,
                             .last = result.dependences.size(),
                             .steepness = steepness_at<dim>(psi, point),
                             .measure = point.weight});
  }
  return result;
}

template <int dim>
BoundaryMotion<dim>::BoundaryMotion(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> boundary,
                                    DeformationKind kind)
    : coefficients_(spline_coefficients(psi)),
      kind_(kind),
      gradients_(gradients_at_nodes<dim>(coefficients_)),
      held_(gradients_.size(), false),
      rates_(gradients_),
      boundary_(std::make_shared<Boundary>(boundary_of(psi, boundary))) {
  if (kind == DeformationKind::normal_speed)
    for (auto& rate : rates_) rate = {norm<dim>(rate)};
}

template <int dim>
BoundaryMotion<dim> BoundaryMotion<dim>::on(const LevelSet<dim>& psi,
                                            std::span<const SurfacePoint<dim>> points) const {
  BoundaryMotion result = *this;
  result.boundary_ = std::make_shared<const Boundary>(boundary_of(psi, points));
  return result;
}

template <int dim>
BoundaryMotion<dim> BoundaryMotion<dim>::holding(const std::vector<bool>& held) const {
  BoundaryMotion result = *this;
  for (std::size_t node = 0; node < held.size(); ++node)
    if (held[node]) {
      result.held_[node] = true;
      result.rates_[node] = {};
    }
  return result;
}

template <int dim>
std::vector<double> BoundaryMotion<dim>::speeds_at_nodes(std::span<const double> deformation) const {
  std::vector<double> result(held_.size(), 0.0);
  for (std::size_t node = 0; node < result.size(); ++node) {
    if (held_[node]) continue;
    Vec<dim> factor{1};
    if (kind_ == DeformationKind::vector_field) {
      factor = gradients_[node];
      const double length = norm<dim>(factor);
      for (double& x : factor) x = length > 0 ? x / length : 0;
    }
    for (int k = 0; k < n_components(); ++k)
      result[node] += factor[k] * deformation[k * result.size() + node];
  }
  return result;
}

template <int dim>
std::vector<double> BoundaryMotion<dim>::speeds(std::span<const double> deformation) const {
  const std::size_t n_nodes = rates_.size();
  std::vector<double> rate(n_nodes), result;
  for (int component = 0; component < n_components(); ++component)
    for (std::size_t node = 0; node < n_nodes; ++node)
      rate[node] += rates_[node][component] * deformation[component * n_nodes + node];
  result.reserve(boundary_->places.size());
  for (const Place& place : boundary_->places) {
    double sum = 0;
    for (std::size_t k = place.first; k < place.last; ++k) {
      const auto& [node, weight] = boundary_->dependences[k];
      sum += weight * rate[node];
    }
    result.push_back(sum / place.steepness);
  }
  return result;
}

template <int dim>
std::vector<double> BoundaryMotion<dim>::load(std::span<const double> density) const {
  std::vector<double> at_node(rates_.size());
  for (std::size_t q = 0; q < boundary_->places.size(); ++q) {
    const Place& place = boundary_->places[q];
    const double value = place.measure * density[q] / place.steepness;
    for (std::size_t k = place.first; k < place.last; ++k) {
      const auto& [node, weight] = boundary_->dependences[k];
      at_node[node] += weight * value;
    }
  }
  return load_at_nodes(at_node);
}

template <int dim>
std::vector<double> BoundaryMotion<dim>::load(std::span<const Dependence> function) const {
  std::vector<double> at_node(rates_.size());
  for (const auto& [node, weight] : function) at_node[node] -= weight;
  return load_at_nodes(at_node);
}

/// The load of the sum over the nodes of a value times -dc/dt.
template <int dim>
std::vector<double> BoundaryMotion<dim>::load_at_nodes(std::span<const double> value) const {
  const std::size_t n_nodes = rates_.size();
  std::vector<double> result(n_components() * n_nodes);
  for (int component = 0; component < n_components(); ++component)
    for (std::size_t node = 0; node < n_nodes; ++node)
      result[component * n_nodes + node] = rates_[node][component] * value[node];
  return result;
}

template <int dim>
std::vector<Dependence> displacement(const CubicInterpolant<dim>& psi, const Vec<dim>& point) {
  const Lattice<dim>& lattice = psi.lattice();
  const double steepness = norm<dim>(psi(point).gradient);
  std::vector<Dependence> result;
  for (const auto& [node, weight] : psi.weights(point)) {
    const auto position = lattice.node_position(node);
    std::array<int, dim> cell;
    Vec<dim> xi;
    for (int d = 0; d < dim; ++d) {
      cell[d] = std::min(position[d] / lattice.degree(), lattice.grid().cells[d] - 1);
      xi[d] = static_cast<double>(position[d] - lattice.degree() * cell[d]) / lattice.degree();
    }
    add_dependences<dim>(lattice, cell, xi, -weight / steepness, result);
  }
  return result;
}

template std::vector<Dependence> displacement<2>(const CubicInterpolant<2>&, const Vec<2>&);
template std::vector<Dependence> displacement<3>(const CubicInterpolant<3>&, const Vec<3>&);
template class BoundaryMotion<2>;
template class BoundaryMotion<3>;
template decltype(gradients_at_nodes<2>) gradients_at_nodes<2>;
template decltype(gradients_at_nodes<3>) gradients_at_nodes<3>;

}  // namespace wheelwright
