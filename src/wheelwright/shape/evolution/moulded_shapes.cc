#include "wheelwright/shape/evolution/moulded_shapes.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/geometry/control_points.h"

namespace wheelwright {

template <int dim>
MouldedShapes<dim>::MouldedShapes(const Lattice<dim>& lattice, const Mould& mould,
                                  std::span<const double> ceiling)
    : lattice_(lattice),
      slope_(mould.slope),
      start_(0),
      spacing_(0),
      unchanged_(1e-10 * lattice.grid().resolution()),
      ceiling_(ceiling.begin(), ceiling.end()) {
  if constexpr (dim == 3) {
    start_ = lattice.degree() * parting_plane_of(mould, lattice.grid());
    spacing_ = lattice.grid().axial_size() / lattice.degree();
    // The ceiling is lower in the first layer, so that both sides rise as much as they must.
    if (is_beside_start(start_ + lattice.degree()))
      for (int node = 0; node < lattice.n_nodes(); ++node)
        if (lattice.node_position(node)[2] == start_)
          ceiling_[node] -= 2 * slope_ * lattice.degree() * spacing_ / 3;
  }
  ceiling_of_points_ = control_points(spline_level_set(LevelSet<dim>{lattice, ceiling_}));
  ceiling_of_points_ = limited_points(ceiling_of_points_);
}

/// The least value that is allowed at a place `to` layers after another one of the same column.
template <int dim>
typename MouldedShapes<dim>::Bound MouldedShapes<dim>::bound_in_column(std::span<const double> points,
                                                                       const Place& place, int to) const {
  Place other = place;
  other[dim - 1] -= to;
  const int node = lattice_.node_index(other);
  const bool is_outwards = to * outwards(place[dim - 1]) > 0;
  return {points[node] + (is_outwards ? 1 : -1) * slope_ * std::abs(to) * spacing_, {{node, 1}}};
}

/// Whether both sides rise from the layer beside this one.
template <int dim>
bool MouldedShapes<dim>::is_beside_start(int layer) const {
  return start_ > 0 && start_ + 1 < lattice_.nodes()[dim - 1] &&
         std::abs(layer - start_) == lattice_.degree();
}

/// The least value that a coefficient may have.
template <int dim>
typename MouldedShapes<dim>::Bound MouldedShapes<dim>::bound(std::span<const double> values,
                                                             const Place& place, Limit limit) const {
  const int degree = lattice_.degree(), to = degree * outwards(place[dim - 1]);
  Place before = place;
  before[dim - 1] -= to;
  Bound result = bound_in_column(values, place, to);
  if (!is_beside_start(place[dim - 1])) return result;
  const int first = lattice_.node_index(before);
  const double rise = slope_ * degree * spacing_;
  if (limit == Limit::before) {
    result.value = values[first] + 5 * rise / 3;
    return result;
  }
  Place opposite = before;
  opposite[dim - 1] -= to;
  const int node = lattice_.node_index(opposite);
  return {0.75 * values[first] + 0.25 * values[node] + 1.25 * rise, {{first, 0.75}, {node, 0.25}}};
}

/// Calls visit(node, place, limit) for all limits of vertices, each after those that limit it.
template <int dim>
template <class Visit>
void MouldedShapes<dim>::for_each_vertex_outwards(Visit visit) const {
  const int degree = lattice_.degree();
  const auto visit_layer = [&](int layer, Limit limit) {
    for (int azimuthal = 0; azimuthal < lattice_.nodes()[1]; azimuthal += degree)
      for (int radial = 0; radial < lattice_.nodes()[0]; radial += degree) {
        Place place{radial, azimuthal};
        place[dim - 1] = layer;
        visit(lattice_.node_index(place), place, limit);
      }
  };
  if (is_beside_start(start_ + degree))
    for (const Limit limit : {Limit::before, Limit::other_side})
      for (const int layer : {start_ + degree, start_ - degree}) visit_layer(layer, limit);
  for (int side : {1, -1})
    for (int layer = start_ + side * degree; layer >= 0 && layer < lattice_.nodes()[dim - 1];
         layer += side * degree)
      if (!is_beside_start(layer)) visit_layer(layer, Limit::before);
}

template <int dim>
bool MouldedShapes<dim>::is_vertex_of_column(const Place& place) const {
  return place[0] % lattice_.degree() == 0 && place[1] % lattice_.degree() == 0;
}

/// Calls visit(node, place, is_between_layers) for all control points that are no vertices: first those in
/// layers of vertices, each after the one before it, then those between these layers.
template <int dim>
template <class Visit>
void MouldedShapes<dim>::for_each_middle(Visit visit) const {
  if (lattice_.degree() == 1) return;
  const auto visit_layer = [&](int layer, bool is_between) {
    for (int azimuthal = 0; azimuthal < lattice_.nodes()[1]; ++azimuthal)
      for (int radial = 0; radial < lattice_.nodes()[0]; ++radial) {
        Place place{radial, azimuthal};
        place[dim - 1] = layer;
        if (is_between || !is_vertex_of_column(place)) visit(lattice_.node_index(place), place, is_between);
      }
  };
  for (int layer = start_ + 2; layer < lattice_.nodes()[dim - 1]; layer += 2) visit_layer(layer, false);
  for (int layer = start_ - 2; layer >= 0; layer -= 2) visit_layer(layer, false);
  for (int layer = 1; layer < lattice_.nodes()[dim - 1]; layer += 2) visit_layer(layer, true);
}

template <int dim>
LevelSet<dim> MouldedShapes<dim>::keep_coefficients(LevelSet<dim> coefficients) const {
  auto& c = coefficients.values;
  for (std::size_t i = 0; i < c.size(); ++i)
    if (c[i] > ceiling_[i] + unchanged_) c[i] = ceiling_[i];
  for_each_vertex_outwards([&](int node, const Place& place, Limit limit) {
    const double least = bound(c, place, limit).value;
    if (c[node] < least - unchanged_) c[node] = least;
  });
  return coefficients;
}

/// Control points that rise at the vertices.
template <int dim>
std::vector<double> MouldedShapes<dim>::limited_vertices(std::vector<double> values) const {
  const int degree = lattice_.degree();
  for_each_vertex_outwards([&](int node, const Place& place, Limit) {
    const double least = bound_in_column(values, place, degree * outwards(place[dim - 1])).value;
    if (values[node] < least - unchanged_) values[node] = least;
  });
  return values;
}

/// The control points with those between the vertices limited, for allowed vertices.
template <int dim>
std::vector<double> MouldedShapes<dim>::limited_points(std::vector<double> points) const {
  for_each_middle([&](int node, const Place& place, bool is_between) {
    const int out = outwards(place[dim - 1]);
    const double least = bound_in_column(points, place, is_between ? out : 2 * out).value;
    if (points[node] < least - unchanged_) points[node] = least;
    if (!is_between) return;
    const double most = bound_in_column(points, place, -out).value;
    if (points[node] > most + unchanged_) points[node] = most;
  });
  return points;
}

template <int dim>
LevelSet<dim> MouldedShapes<dim>::keep(LevelSet<dim> psi) const {
  const auto points = control_points(psi);
  auto allowed = points;
  for (std::size_t i = 0; i < allowed.size(); ++i)
    if (allowed[i] > ceiling_of_points_[i] + unchanged_) allowed[i] = ceiling_of_points_[i];
  allowed = limited_points(limited_vertices(std::move(allowed)));
  return allowed == points ? psi : of_control_points(lattice_, std::move(allowed));
}

template <int dim>
bool MouldedShapes<dim>::follow(const LevelSet<dim>& coefficients, const LevelSet<dim>& moved,
                                Following& following) const {
  const double cell = lattice_.grid().resolution();
  const std::size_t n = coefficients.values.size();
  bool is_more = false;
  const auto follows = [&](Followers& followers, int node, const Bound& bound) {
    auto dependence = on_roots(bound.of, followers);
    if (std::ranges::count(dependence, node, &Dependence::node) > 0) return;  // it is followed itself
    followers[node] = std::move(dependence);
    is_more = true;
  };
  following.coefficients.resize(n);
  const LevelSet<dim> now = keep_coefficients(coefficients);
  std::vector<double> change(n);
  for (std::size_t i = 0; i < n; ++i) change[i] = moved.values[i] - coefficients.values[i];
  for_each_vertex_outwards([&](int node, const Place& place, Limit limit) {
    auto& followers = following.coefficients;
    if (!followers[node].empty()) {
      followers[node] = on_roots(followers[node], followers);  // which may follow others by now
      change[node] = sum(followers[node], change);
    }
    const Bound least = bound(now.values, place, limit);
    const bool follows_another = !followers[node].empty();
    const double room = (follows_another ? now : coefficients).values[node] - least.value,
                 approach = sum(least.of, change) - change[node];
    if (follows_another ? room > unchanged_ || approach <= unchanged_
                        : !is_stopped(room, approach, cell, unchanged_))
      return;
    follows(followers, node, least);
    change[node] = sum(followers[node], change);
  });
  following.control_points.resize(n);
  LevelSet<dim> then = now;
  for (std::size_t i = 0; i < n; ++i) then.values[i] += change[i];
  const auto given = control_points(spline_level_set(now)), limited = limited_points(given),
             after = control_points(spline_level_set(then));
  for (std::size_t i = 0; i < n; ++i) change[i] = after[i] - given[i];
  for_each_middle([&](int node, const Place& place, bool is_between) {
    auto& followers = following.control_points;
    const int out = outwards(place[dim - 1]);
    if (followers[node].empty()) {
      const Bound least = bound_in_column(limited, place, is_between ? out : 2 * out);
      if (is_stopped(given[node] - least.value, sum(least.of, change) - change[node], cell, unchanged_)) {
        follows(followers, node, least);
      } else if (is_between) {
        const Bound most = bound_in_column(limited, place, -out);
        if (is_stopped(most.value - given[node], change[node] - sum(most.of, change), cell, unchanged_))
          follows(followers, node, most);
      }
    }
    if (followers[node].empty()) return;
    followers[node] = on_roots(followers[node], followers);
    change[node] = sum(followers[node], change);
  });
  return is_more;
}

template class MouldedShapes<2>;
template class MouldedShapes<3>;

}  // namespace wheelwright
