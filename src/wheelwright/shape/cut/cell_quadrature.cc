#include "wheelwright/shape/cut/cell_quadrature.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/cut/columns.h"
#include "wheelwright/shape/cut/slabs.h"

namespace wheelwright {
namespace {

template <int dim>
CellKind kind_of(const BernsteinForm<dim>& psi) {
  if (psi.largest() < 0) return CellKind::inside;
  if (psi.smallest() > 0) return CellKind::outside;
  return CellKind::cut;
}

/// Whether the zero set is certain to be a graph over the other axes.
template <int dim>
bool is_monotone(const BernsteinForm<dim>& psi, int axis) {
  const auto [low, high] = psi.derivative_bounds(axis);
  return low > 0 || high < 0;
}

/// A later axis is preferred to an earlier one only if its variation is larger by this factor. With 1,
/// rounding would choose between equal ones, and differently for the mirror image.
constexpr double preference = 1.05;

/// All axes, those along which psi varies most first.
template <int dim>
std::array<int, dim> by_variation(const BernsteinForm<dim>& psi) {
  std::array<int, dim> axes;
  for (int d = 0; d < dim; ++d) axes[d] = d;
  for (int k = 0; k < dim; ++k)
    for (int j = k + 1; j < dim; ++j)
      if (psi.variation(axes[j]) > (axes[j] > axes[k] ? preference : 1 / preference) * psi.variation(axes[k]))
        std::swap(axes[j], axes[k]);
  return axes;
}

Slice slice(const BernsteinForm<2>& psi, int base) {
  Slice result{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) result.psi[i][k] = psi[base == 0 ? std::array{i, k} : std::array{k, i}];
  return result;
}

/// The axes along which a cell is reflected.
template <int dim>
using Reflection = std::array<bool, dim>;

template <int dim>
std::vector<double> reflected(int degree, std::span<const double> nodal_values,
                              const Reflection<dim>& reflection) {
  std::vector<double> result;
  for (int a = 0; a < static_cast<int>(nodal_values.size()); ++a) {
    auto node = local_node_position<dim>(degree, a);
    int b = 0;
    for (int d = dim - 1; d >= 0; --d) b = b * (degree + 1) + (reflection[d] ? degree - node[d] : node[d]);
    result.push_back(nodal_values[b]);
  }
  return result;
}

/// The reflection to the representative of a cell's mirror images. Results computed for it and reflected back
/// do not depend on the given image.
template <int dim>
Reflection<dim> to_standard(int degree, std::span<const double> nodal_values) {
  Reflection<dim> best{};
  std::vector<double> smallest(nodal_values.begin(), nodal_values.end());
  for (int image = 1; image < power(2, dim); ++image) {
    Reflection<dim> reflection;
    for (int d = 0; d < dim; ++d) reflection[d] = (image >> d) % 2 == 1;
    auto values = reflected<dim>(degree, nodal_values, reflection);
    if (values >= smallest) continue;
    smallest = std::move(values);
    best = reflection;
  }
  return best;
}

template <int dim>
void reflect(CutCell<dim>& cell, const Reflection<dim>& reflection) {
  for (int d = 0; d < dim; ++d) {
    if (!reflection[d]) continue;
    for (auto& q : cell.material) q.xi[d] = 1 - q.xi[d];
    for (auto& q : cell.boundary) {
      q.xi[d] = 1 - q.xi[d];
      q.normal[d] = -q.normal[d];
    }
  }
}

/// The nodal values on the face of a cell at an end, 0 or 1, of an axis.
template <int dim>
std::vector<double> on_face(int degree, std::span<const double> nodal_values, int axis, int end) {
  std::vector<double> values;
  for (int a = 0; a < static_cast<int>(nodal_values.size()); ++a)
    if (local_node_position<dim>(degree, a)[axis] == end * degree) values.push_back(nodal_values[a]);
  return values;
}

/// An axis along which a cell's nodal values do not change at all, that about the axle first.
std::optional<int> unchanged_axis(int degree, std::span<const double> nodal_values) {
  for (const int axis : {1, 2, 0}) {
    const int stride = power(degree + 1, axis);
    bool changes = false;
    for (int a = 0; a < static_cast<int>(nodal_values.size()); ++a) {
      const int first = a - local_node_position<3>(degree, a)[axis] * stride;
      changes = changes || nodal_values[a] != nodal_values[first];
    }
    if (!changes) return axis;
  }
  return {};
}

/// The quadrature of a prism from that of its section, with Gauss points along its axis.
CutCell<3> prism(const CutCell<2>& section, int axis, const GaussRule& along) {
  const auto in_space = [axis](const Vec<2>& of_section, double of_axis) {
    Vec<3> result{};
    for (int d = 0, k = 0; d < 3; ++d) result[d] = d == axis ? of_axis : of_section[k++];
    return result;
  };
  CutCell<3> result{section.cell, {}, {}, {}};
  for (std::size_t k = 0; k < along.points.size(); ++k) {
    const double place = along.points[k], weight = along.weights[k];
    for (const auto& q : section.material)
      result.material.push_back({in_space(q.xi, place), weight * q.weight});
    for (const auto& q : section.boundary)
      result.boundary.push_back({in_space(q.xi, place), in_space(q.normal, 0), weight * q.weight});
  }
  return result;
}

/// The tolerance of the divergence theorem: far above the error of the rule on a smooth piece.
double largest_defect(int points) { return 1e-3 + std::min(0.1, 1000 * std::pow(25.0, -points)); }

/// Measure of {psi < 0} on a face, from its nodal values.
template <int dim>
struct FaceMeasure {
  int degree, points;

  double operator()(std::span<const double> nodal_values) const {
    const CellQuadrature<dim> quadrature(degree, points);
    const CellKind kind = quadrature.classify(nodal_values);
    if (kind != CellKind::cut) return kind == CellKind::inside ? 1 : 0;
    const auto cell = quadrature.split(0, nodal_values);
    if (!cell) return NAN;
    double sum = 0;
    for (const auto& q : cell->material) sum += q.weight;
    return sum;
  }
};

template <>
struct FaceMeasure<1> {
  int degree, points;

  double operator()(std::span<const double> v) const {
    const double middle = degree == 1 ? 0.5 * (v[0] + v[1]) : 2 * v[1] - 0.5 * (v[0] + v[2]);
    const Quadratic psi{v.front(), middle, v.back()};
    std::vector<double> ends = sign_changes(psi);
    ends.insert(ends.begin(), 0);
    ends.push_back(1);
    double sum = 0;
    for (size_t i = 1; i < ends.size(); ++i)
      if (value(psi, 0.5 * (ends[i - 1] + ends[i])) < 0) sum += ends[i] - ends[i - 1];
    return sum;
  }
};

}  // namespace

template <int dim>
CellQuadrature<dim>::CellQuadrature(int degree, int points)
    : degree_(degree), rule_(gauss_rule(points)), base_rule_(gauss_rule(points + 2)) {
  if (degree == 2) inner_nodes_ = {0.5};
}

template <int dim>
CellKind CellQuadrature<dim>::classify(std::span<const double> nodal_values) const {
  return kind_of<dim>(BernsteinForm<dim>(degree_, nodal_values));
}

template <int dim>
std::optional<CutCell<dim>> CellQuadrature<dim>::split(int cell, std::span<const double> nodal_values) const {
  const auto reflection = to_standard<dim>(degree_, nodal_values);
  const auto standard = reflected<dim>(degree_, nodal_values, reflection);
  if (!std::isfinite(BernsteinForm<dim>(degree_, standard).variation(0))) return {};
  CutCell<dim> result{cell, {}, {}, {}};
  append(standard, result);
  reflect<dim>(result, reflection);
  if (!(divergence_defect(result, nodal_values) <= largest_defect(static_cast<int>(rule_.points.size()))))
    return {};
  return result;
}

template <int dim>
double CellQuadrature<dim>::divergence_defect(const CutCell<dim>& cell,
                                              std::span<const double> nodal_values) const {
  Vec<dim> normals{};           // over the whole surface of the material
  double volume = 0, flux = 0;  // of the position from the cell's centre
  for (const auto& q : cell.material) volume += q.weight;
  for (const auto& q : cell.boundary)
    for (int d = 0; d < dim; ++d) {
      normals[d] += q.weight * q.normal[d];
      flux += q.weight * (q.xi[d] - 0.5) * q.normal[d];
    }
  for (int d = 0; d < dim; ++d) {
    const double first = face_measure(nodal_values, d, 0), last = face_measure(nodal_values, d, 1);
    normals[d] += last - first;
    flux += 0.5 * (first + last);
  }
  double defect = std::abs(dim * volume - flux);
  for (const double x : normals) defect = std::max(defect, std::abs(x));
  return std::isfinite(volume + flux + norm<dim>(normals)) ? defect : NAN;
}

template <int dim>
double CellQuadrature<dim>::face_measure(std::span<const double> nodal_values, int axis, int end) const {
  return FaceMeasure<dim - 1>{
      degree_, static_cast<int>(rule_.points.size())}(on_face<dim>(degree_, nodal_values, axis, end));
}

template <>
void CellQuadrature<2>::append(std::span<const double> nodal_values, CutCell<2>& result) const {
  const BernsteinForm<2> psi(degree_, nodal_values);
  const auto axes = by_variation<2>(psi);
  int height = axes[0];
  Columns columns(slice(psi, 1 - height));
  if (!is_monotone<2>(psi, height)) {
    Columns other(slice(psi, height));
    if (other.cost() < columns.cost()) {
      columns = std::move(other);
      height = axes[1];
    }
  }
  for (const auto& point : columns.material(rule_, base_rule_)) {
    Vec<2> xi;
    xi[1 - height] = point.xi[0];
    xi[height] = point.xi[1];
    result.material.push_back({xi, point.weight});
  }
  for (const auto& point : columns.boundary(base_rule_, inner_nodes_)) {
    Vec<2> xi, normal;
    const double slope = std::hypot(point.gradient[0], point.gradient[1]);
    xi[1 - height] = point.base;
    xi[height] = point.height;
    normal[1 - height] = point.gradient[0] / slope;
    normal[height] = point.gradient[1] / slope;
    result.boundary.push_back({xi, normal, point.weight});
  }
}

template <>
void CellQuadrature<3>::append(std::span<const double> nodal_values, CutCell<3>& result) const {
  if (const auto axis = unchanged_axis(degree_, nodal_values)) {
    CutCell<2> section{result.cell, {}, {}, {}};
    const int points = static_cast<int>(rule_.points.size());
    CellQuadrature<2>(degree_, points).append(on_face<3>(degree_, nodal_values, *axis, 0), section);
    result = prism(section, *axis, rule_);
    return;
  }
  const BernsteinForm<3> psi(degree_, nodal_values);
  const auto axes = by_variation<3>(psi);
  const Slabs slabs(psi, {axes[1], axes[0], axes[2]});
  result.material = slabs.material(rule_);
  result.boundary = slabs.boundary(rule_);
}

template class CellQuadrature<2>;
template class CellQuadrature<3>;

}  // namespace wheelwright
