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

/// The dependence of the level set at points on the coefficients of its spline, if some of its control points
/// follow others.
template <int dim>
class FollowingDependences {
 public:
  FollowingDependences(const Lattice<dim>& lattice, const Followers& following)
      : lattice_(lattice),
        following_(following),
        of_control_point_(following.size()),
        sums_(following.size()) {}

  bool follows_in(int cell) const {
    return !following_.empty() &&
           std::ranges::any_of(nodes_of(cell), [&](int node) { return !following_[node].empty(); });
  }

  void add(int cell, const Vec<dim>& xi, std::vector<Dependence>& to) {
    const auto nodes = nodes_of(cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      double weight = 1;
      const auto place = local_node_position<dim>(lattice_.degree(), static_cast<int>(a));
      for (int d = 0; d < dim; ++d) weight *= bernstein(place[d], xi[d]);
      if (following_[nodes[a]].empty()) {
        sum(nodes[a], weight);
      } else {
        for (const auto& [root, share] : following_[nodes[a]]) sum(root, weight * share);
      }
    }
    std::ranges::sort(touched_);
    for (const int node : touched_) {
      if (sums_[node] != 0) to.push_back({node, sums_[node]});
      sums_[node] = 0;
    }
    touched_.clear();
  }

 private:
  std::vector<int> nodes_of(int cell) const {
    const auto position = lattice_.grid().cell_position(cell);
    std::vector<int> nodes;
    for (int a = 0; a < nodes_per_cell<dim>(lattice_.degree()); ++a)
      nodes.push_back(lattice_.node_index(lattice_.cell_node(position, a)));
    return nodes;
  }

  /// The polynomial of a control point on [0, 1].
  double bernstein(int point, double x) const {
    if (lattice_.degree() == 1) return point == 0 ? 1 - x : x;
    return point == 0 ? (1 - x) * (1 - x) : point == 1 ? 2 * x * (1 - x) : x * x;
  }

  /// Adds the dependence of a control point.
  void sum(int control_point, double factor) {
    auto& dependence = of_control_point_[control_point];
    if (dependence.empty()) dependence = control_point_dependence(lattice_, control_point);
    for (const auto& [node, weight] : dependence) {
      if (sums_[node] == 0) touched_.push_back(node);
      sums_[node] += factor * weight;
    }
  }

  const Lattice<dim>& lattice_;
  const Followers& following_;
  std::vector<std::vector<Dependence>> of_control_point_;  ///< those that were needed
  std::vector<double> sums_;
  std::vector<int> touched_;
};

}  // namespace

template <int dim>
std::vector<Vec<dim>> gradients_at_nodes(const LevelSet<dim>& psi) {
  std::vector<Vec<dim>> result;
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) result.push_back(gradient_at<dim>(psi, node));
  return result;
}

template <int dim>
typename BoundaryMotion<dim>::Boundary BoundaryMotion<dim>::boundary_of(
    const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> points, const Followers& following) {
  FollowingDependences<dim> of_followers(psi.lattice, following);
  Boundary result;
  result.places.reserve(points.size());
  result.dependences.reserve(power(4, dim) * points.size());
  for (const auto& point : points) {
    const std::size_t first = result.dependences.size();
    if (of_followers.follows_in(point.cell))
      of_followers.add(point.cell, point.xi, result.dependences);
    else
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
      following_(std::make_shared<const Following>()),
      boundary_(std::make_shared<Boundary>(boundary_of(psi, boundary, following_->control_points))) {
  if (kind == DeformationKind::normal_speed)
    for (auto& rate : rates_) rate = {norm<dim>(rate)};
}

template <int dim>
BoundaryMotion<dim> BoundaryMotion<dim>::on(const LevelSet<dim>& psi,
                                            std::span<const SurfacePoint<dim>> points) const {
  BoundaryMotion result = *this;
  result.boundary_ = std::make_shared<const Boundary>(boundary_of(psi, points, following_->control_points));
  return result;
}

template <int dim>
BoundaryMotion<dim> BoundaryMotion<dim>::following(const LevelSet<dim>& psi,
                                                   std::span<const SurfacePoint<dim>> points,
                                                   Following following) const {
  BoundaryMotion result = *this;
  result.following_ = std::make_shared<const Following>(std::move(following));
  return result.on(psi, points);
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
  constexpr double least_slope = 0.3;  // below it the value is near a kink and a speed says little
  std::vector<double> rates;
  for (std::size_t node = 0; node < following_->coefficients.size(); ++node) {
    if (following_->coefficients[node].empty()) continue;
    if (rates.empty()) rates = rates_at_nodes(deformation);
    const double slope = norm<dim>(gradients_[node]);
    if (slope > least_slope) result[node] = rates[node] / slope;
  }
  return result;
}

/// -dc/dt at the nodes.
template <int dim>
std::vector<double> BoundaryMotion<dim>::rates_at_nodes(std::span<const double> deformation) const {
  const std::size_t n_nodes = rates_.size();
  std::vector<double> rate(n_nodes);
  for (int component = 0; component < n_components(); ++component)
    for (std::size_t node = 0; node < n_nodes; ++node)
      rate[node] += rates_[node][component] * deformation[component * n_nodes + node];
  for (std::size_t node = 0; node < following_->coefficients.size(); ++node) {
    const auto& of_others = following_->coefficients[node];
    if (of_others.empty()) continue;
    rate[node] = 0;
    for (const auto& [other, weight] : of_others) rate[node] += weight * rate[other];
  }
  return rate;
}

template <int dim>
std::vector<double> BoundaryMotion<dim>::speeds(std::span<const double> deformation) const {
  const std::vector<double> rate = rates_at_nodes(deformation);
  std::vector<double> result;
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
  return load_at_nodes(std::move(at_node));
}

template <int dim>
std::vector<double> BoundaryMotion<dim>::load(std::span<const Dependence> function) const {
  std::vector<double> at_node(rates_.size());
  for (const auto& [node, weight] : function) at_node[node] -= weight;
  return load_at_nodes(std::move(at_node));
}

/// The load of the sum over the nodes of a value times -dc/dt.
template <int dim>
std::vector<double> BoundaryMotion<dim>::load_at_nodes(std::vector<double> value) const {
  for (std::size_t node = 0; node < following_->coefficients.size(); ++node) {
    const auto& of_others = following_->coefficients[node];
    for (const auto& [other, weight] : of_others) value[other] += weight * value[node];
    if (!of_others.empty()) value[node] = 0;
  }
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
