#include "wheelwright/mechanics/elasticity/element.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/mechanics/elasticity/voigt_indices.h"

namespace wheelwright {
namespace {

/// Variance of the linear functions, in units of h_T^2, below which a part of a cell is too thin to determine
/// the slope of div u across it. Rounding of the variance is 1e-16.
constexpr double smallest_variance = 1e-12;

/// The part of lambda that works on the projected dilatation in isotropic elements of degree 2 [Pa]; div u
/// itself keeps the rest. By default it keeps all of it up to nu = 0.4 in plane strain or 3D, where peak
/// stresses at edges of holes gain more than the travel loses; -0.6 mu from 0.48 on; and in between what lies
/// between, so that no result jumps with nu. Were -2 / dim mu kept, nothing of the bulk modulus worked on
/// div u: the travel would be a little more accurate, and the peak stress at holes less (docs/method.md). The
/// same number in 2D and 3D lets both have the same plane strain.
double projected_part_of_lambda(DilatationKind dilatation, const Material& material) {
  if (dilatation == DilatationKind::pointwise) return 0;
  constexpr double from = 0.4, to = 0.48, kept_at_first = 4, kept_at_last = -0.6;  // [mu]; 4 is all at 0.4
  const double nu = material.plane_strain_equivalent().poissons_ratio;
  const double progress = dilatation == DilatationKind::projected ? 1 : (nu - from) / (to - from);
  if (progress <= 0) return 0;
  return material.lambda() - std::lerp(kept_at_first, kept_at_last, std::min(progress, 1.0)) * material.mu();
}

/// The shape functions in the middle of the unit cell.
template <int dim>
const ShapeFunctions<dim>& in_the_middle(int degree) {
  constexpr auto at = [](int of_degree) {
    Vec<dim> middle;
    middle.fill(0.5);
    return ShapeFunctions<dim>(of_degree, middle);
  };
  static const std::array<ShapeFunctions<dim>, 2> of_degrees{at(1), at(2)};
  return of_degrees[degree - 1];
}

/// Adds the products of the linear functions with each other, and with a number, times a weight.
template <int dim>
void add_to_mass(const std::array<double, dim + 1>& linear, double weight, Matrix& mass) {
  for (int b = 0; b <= dim; ++b)
    for (int a = 0; a <= dim; ++a) mass(a, b) += weight * linear[a] * linear[b];
}
template <int dim>
void add_moments(const std::array<double, dim + 1>& linear, double weighted_number, double* moments) {
  for (int a = 0; a <= dim; ++a) moments[a] += weighted_number * linear[a];
}

/// Strains or stresses on the dofs of a cell, [component][dof].
template <int dim>
using OnDofs = std::array<std::array<double, ElasticElement<dim>::max_dofs>, n_strains<dim>>;

template <int dim>
StrainRows<dim> rows(const OnDofs<dim>& strains, int n_dofs) {
  StrainRows<dim> result;
  for (int s = 0; s < n_strains<dim>; ++s) result[s] = std::span(strains[s]).first(n_dofs);
  return result;
}
template <int dim>
StressRows<dim> rows(OnDofs<dim>& stresses, int n_dofs) {
  StressRows<dim> result;
  for (int s = 0; s < n_strains<dim>; ++s) result[s] = std::span(stresses[s]).first(n_dofs);
  return result;
}

/// The constants of sigma = lambda tr(eps) I + 2 mu eps.
struct Lame {
  double lambda, mu;
};

/// Those of a law whose tangent has exactly this form; empty for other laws. All such laws give the same
/// elements to the last bit, with fewer products.
template <int dim>
std::optional<Lame> lame_constants(const MaterialLaw<dim>& law) {
  constexpr int n = n_strains<dim>;
  std::array<Voigt<dim>, n> d;
  TangentRows<dim> rows;
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) rows[k][l] = {&d[k][l], 1};
  law.tangent(one_strain<dim>({}), rows);
  const Lame lame{d[0][1], d[n - 1][n - 1]};
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) {
      const double shared = k < dim && l < dim ? lame.lambda : 0;
      if (d[k][l] != shared + (k != l ? 0 : k < dim ? 2 * lame.mu : lame.mu)) return {};
    }
  return lame;
}

template <int dim>
Voigt<dim> stress(const Lame& lame, const Voigt<dim>& strain) {
  double trace = 0;
  for (int d = 0; d < dim; ++d) trace += strain[d];
  Voigt<dim> result;
  for (int s = 0; s < n_strains<dim>; ++s)
    result[s] = s < dim ? lame.lambda * trace + 2 * lame.mu * strain[s] : lame.mu * strain[s];
  return result;
}

/// The stresses of the strains of all dofs, times a weight.
template <int dim>
void weighted_stresses(const Lame& lame, const OnDofs<dim>& strains, int n_dofs, double weight,
                       OnDofs<dim>& result) {
  const double lambda = lame.lambda, mu = lame.mu;
  for (int dof = 0; dof < n_dofs; ++dof) {
    double trace = 0;
    for (int d = 0; d < dim; ++d) trace += strains[d][dof];
    for (int s = 0; s < n_strains<dim>; ++s)
      result[s][dof] = weight * (s < dim ? lambda * trace + 2 * mu * strains[s][dof] : mu * strains[s][dof]);
  }
}
template <int dim>
void weighted_stresses(const MaterialLaw<dim>& law, const OnDofs<dim>& strains, int n_dofs, double weight,
                       OnDofs<dim>& result) {
  law.stress(rows<dim>(strains, n_dofs), rows<dim>(result, n_dofs));
  for (auto& component : result)
    for (int dof = 0; dof < n_dofs; ++dof) component[dof] *= weight;
}

/// Turns strains on dofs to axes whose first one lies at the azimuth of a place.
template <int dim>
void turn_to_polar_axes(const Vec<dim>& place, int n_dofs, OnDofs<dim>& strain) {
  const double radius = std::hypot(place[0], place[1]), c = place[0] / radius, s = place[1] / radius;
  auto &first = strain[0], &second = strain[1], &shear = strain[n_strains<dim> - 1];
  for (int dof = 0; dof < n_dofs; ++dof) {
    const double a = first[dof], b = second[dof], g = shear[dof], half = c * s * g;
    first[dof] = c * c * a + s * s * b + half;
    second[dof] = s * s * a + c * c * b - half;
    shear[dof] = 2 * c * s * (b - a) + (c * c - s * s) * g;
  }
  if constexpr (dim == 3)
    for (int dof = 0; dof < n_dofs; ++dof) {
      const double of_second = strain[3][dof], of_first = strain[4][dof];
      strain[3][dof] = c * of_second - s * of_first;
      strain[4][dof] = s * of_second + c * of_first;
    }
}

}  // namespace

template <int dim>
Vec<dim> traction(const Voigt<dim>& stress, const Vec<dim>& normal) {
  Vec<dim> t{};
  constexpr auto indices = voigt_indices<dim>();
  for (int s = 0; s < n_strains<dim>; ++s) {
    const auto [i, j] = indices[s];
    t[i] += stress[s] * normal[j];
    if (i != j) t[j] += stress[s] * normal[i];
  }
  return t;
}

template <int dim>
ElasticElement<dim>::ElasticElement(const PolarGrid<dim>& grid, int degree, const std::array<int, dim>& cell,
                                    const MaterialLaw<dim>& law, DilatationKind dilatation)
    : degree_(degree), has_polar_strains_(law.has_polar_axes()), map_(grid, degree, cell) {
  const double spacing = grid.column_angle() / degree;
  for (int a = 0; a < n_nodes(); ++a) {
    const double angle = local_node_position<dim>(degree, a)[1] * spacing;
    frames_[a] = {};
    for (int d = 0; d < dim; ++d) frames_[a][d][d] = 1;
    frames_[a][0][0] = frames_[a][1][1] = std::cos(angle);
    frames_[a][0][1] = -std::sin(angle);
    frames_[a][1][0] = std::sin(angle);
  }
  std::array<Vec<dim>, power(2, dim)> corners;
  for (int k = 0; k < power(2, dim); ++k) {
    const auto p = local_node_position<dim>(1, k);
    Vec<dim> xi;
    std::copy(p.begin(), p.end(), xi.begin());
    corners[k] = map_.position(ShapeFunctions<dim>(degree, xi));
  }
  plane_diameter_ = 0;
  for (const auto& a : corners)
    for (const auto& b : corners)
      plane_diameter_ = std::max(plane_diameter_, norm<2>({a[0] - b[0], a[1] - b[1]}));
  if constexpr (dim == 3) axial_length_ = grid.axial_size();
  const Material* material = law.isotropic();
  if (material && degree == 2) projected_lambda_ = projected_part_of_lambda(dilatation, *material);
  if (projects_dilatation()) {
    projected_share_ = projected_lambda_ / (material->lambda() + 2 * material->mu() / dim);
    dilatation_ = project_dilatation(unit_cell_rule<dim>(degree + 2));
  }
}

template <int dim>
std::array<double, dim + 1> ElasticElement<dim>::linear_functions(const Vec<dim>& x) const {
  const Vec<dim> centre = map_.position(in_the_middle<dim>(degree_));
  std::array<double, dim + 1> values{1};
  for (int d = 0; d < dim; ++d) values[d + 1] = (x[d] - centre[d]) / plane_diameter_;
  return values;
}

template <int dim>
void DilatationMoments<dim>::add(const ElasticElement<dim>& element,
                                 const typename ElasticElement<dim>::Point& point, double weight) {
  const auto linear = element.linear_functions(point.position);
  add_to_mass<dim>(linear, weight, mass);
  for (int dof = 0; dof < of_dofs.columns(); ++dof)
    add_moments<dim>(linear, weight * point.dilatation[dof], of_dofs.column(dof));
}

template <int dim>
Matrix DilatationMoments<dim>::coefficients() const {
  Matrix factor = mass;
  for (int a = 1; a <= dim; ++a) factor(a, a) += smallest_variance * mass(0, 0);
  if (!cholesky(factor)) return Matrix(dim + 1, of_dofs.columns());  // no volume
  Matrix result = of_dofs;
  cholesky_solve(factor, result);
  return result;
}

template <int dim>
Matrix ElasticElement<dim>::project_dilatation(std::span<const ReferencePoint<dim>> part) const {
  DilatationMoments<dim> moments(n_dofs());
  for (const auto& q : part) {
    const ShapeFunctions<dim> shape(degree_, q.xi);
    const Mat<dim> jacobian = map_.jacobian(shape), inverse_jacobian = inverse<dim>(jacobian);
    const double weight = q.weight * determinant<dim>(jacobian);
    const auto linear = linear_functions(map_.position(shape));
    add_to_mass<dim>(linear, weight, moments.mass);
    for (int a = 0; a < n_nodes(); ++a) {
      const Vec<dim> gradient = transpose_times<dim>(inverse_jacobian, shape.gradient[a]);
      for (int c = 0; c < dim; ++c) {
        double dilatation = 0;
        for (int i = 0; i < dim; ++i) dilatation += frames_[a][i][c] * gradient[i];
        add_moments<dim>(linear, weight * dilatation, moments.of_dofs.column(dof(a, c)));
      }
    }
  }
  return moments.coefficients();
}

template <int dim>
auto ElasticElement<dim>::at(const Vec<dim>& xi) const -> Point {
  Point point = with_own_strain(xi);
  if (!projects_dilatation()) return point;
  const auto linear = linear_functions(point.position);
  for (int dof = 0; dof < n_dofs(); ++dof) {
    double dilatation = 0;
    for (int a = 0; a <= dim; ++a) dilatation += dilatation_(a, dof) * linear[a];
    const double change = projected_share_ * (dilatation - point.dilatation[dof]) / dim;
    for (int d = 0; d < dim; ++d) point.strain[d][dof] += change;
  }
  return point;
}

namespace {

/// With the strain of u itself in the frame of the cell. A function of its own, so that a test for polar axes
/// after it does not change how the compiler rounds.
template <int dim>
[[gnu::noinline]] typename ElasticElement<dim>::Point in_frame_of_cell(
    const CellMap<dim>& map, int degree, const std::array<Mat<dim>, ElasticElement<dim>::max_nodes>& frames,
    const Vec<dim>& xi) {
  const ShapeFunctions<dim> shape(degree, xi);
  const Mat<dim> jacobian = map.jacobian(shape);
  typename ElasticElement<dim>::Point point{.position = map.position(shape),
                                            .jacobian = jacobian,
                                            .determinant = determinant<dim>(jacobian),
                                            .strain = {},
                                            .displacement = {},
                                            .dilatation = {}};
  const Mat<dim> inverse_jacobian = inverse<dim>(jacobian);
  constexpr auto indices = voigt_indices<dim>();
  for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
    const Vec<dim> gradient = transpose_times<dim>(inverse_jacobian, shape.gradient[a]);
    for (int c = 0; c < dim; ++c) {
      const int k = ElasticElement<dim>::dof(a, c);
      for (int i = 0; i < dim; ++i) point.displacement[i][k] = frames[a][i][c] * shape.value[a];
      for (int s = 0; s < n_strains<dim>; ++s) {
        const auto [i, j] = indices[s];
        point.strain[s][k] = frames[a][i][c] * gradient[j];
        if (i != j) point.strain[s][k] += frames[a][j][c] * gradient[i];
      }
      for (int d = 0; d < dim; ++d) point.dilatation[k] += point.strain[d][k];
    }
  }
  return point;
}

}  // namespace

template <int dim>
auto ElasticElement<dim>::with_own_strain(const Vec<dim>& xi) const -> Point {
  Point point = in_frame_of_cell<dim>(map_, degree_, frames_, xi);
  if (has_polar_strains_) turn_to_polar_axes<dim>(point.position, n_dofs(), point.strain);
  return point;
}

template <int dim>
auto ElasticElement<dim>::gradient(const Vec<dim>& xi) const
    -> std::array<std::array<double, max_dofs>, dim * dim> {
  const ShapeFunctions<dim> shape(degree_, xi);
  const Mat<dim> inverse_jacobian = inverse<dim>(map_.jacobian(shape));
  std::array<std::array<double, max_dofs>, dim * dim> result{};
  for (int a = 0; a < n_nodes(); ++a) {
    const Vec<dim> gradient = transpose_times<dim>(inverse_jacobian, shape.gradient[a]);
    for (int c = 0; c < dim; ++c)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) result[dim * i + j][dof(a, c)] = frames_[a][i][c] * gradient[j];
  }
  return result;
}

template <int dim>
auto ElasticElement<dim>::second_derivative(const Vec<dim>& xi, int axis, const Vec<dim>& n) const
    -> std::array<std::array<double, max_dofs>, dim> {
  const ShapeFunctions<dim> shape(degree_, xi);
  const Mat<dim> inverse_jacobian = inverse<dim>(map_.jacobian(shape));
  Vec<dim> m{};  // in the coordinates of the unit cell
  for (int j = 0; j < dim; ++j) m[axis] += inverse_jacobian[axis][j] * n[j];
  const auto curvature = map_.second_derivative(xi, m);  // d^2 x / dm^2

  std::array<std::array<double, max_dofs>, dim> result{};
  for (int a = 0; a < n_nodes(); ++a) {
    const Vec<dim> gradient = transpose_times<dim>(inverse_jacobian, shape.gradient[a]);
    const double value = shape_second_derivative<dim>(degree_, a, xi, m) - dot<dim>(gradient, curvature);
    for (int c = 0; c < dim; ++c)
      for (int i = 0; i < dim; ++i) result[i][dof(a, c)] = frames_[a][i][c] * value;
  }
  return result;
}

namespace {

/// The traction as a linear map of the dofs, in the axes of the strains, as is the normal.
template <int dim>
std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim> traction_on_axes(
    const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
    const typename ElasticElement<dim>::Point& point, const Vec<dim>& normal) {
  const auto lame = lame_constants(law);
  std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim> result{};
  for (int dof = 0; dof < element.n_dofs(); ++dof) {
    Voigt<dim> strain;
    for (int s = 0; s < n_strains<dim>; ++s) strain[s] = point.strain[s][dof];
    const Voigt<dim> sigma = lame ? stress<dim>(*lame, strain) : stress<dim>(law, strain);
    const Vec<dim> t = traction<dim>(sigma, normal);
    for (int d = 0; d < dim; ++d) result[d][dof] = t[d];
  }
  return result;
}

}  // namespace

template <int dim>
std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim> traction_map(
    const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
    const typename ElasticElement<dim>::Point& point, const Vec<dim>& normal) {
  if (!element.has_polar_strains()) return traction_on_axes<dim>(element, law, point, normal);
  const AxleRotation axes(element.azimuth_of_strains(point.position));
  auto result = traction_on_axes<dim>(element, law, point, axes.back(normal));
  for (int dof = 0; dof < element.n_dofs(); ++dof) {
    Vec<dim> t;
    for (int d = 0; d < dim; ++d) t[d] = result[d][dof];
    t = axes.forward(t);
    for (int d = 0; d < dim; ++d) result[d][dof] = t[d];
  }
  return result;
}

template <int dim>
Matrix cell_stiffness(const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
                      std::span<const ReferencePoint<dim>> points) {
  const int n = element.n_dofs();
  Matrix k(n, n);
  auto lame = lame_constants(law);
  std::optional<DilatationMoments<dim>> moments;
  if (element.projects_dilatation()) {
    lame->lambda -= element.projected_lambda();  // added below
    moments.emplace(n);
  }
  OnDofs<dim> stresses;
  for (const auto& q : points) {
    const auto point = element.with_own_strain(q.xi);
    const double weight = q.weight * point.determinant;
    if (moments) moments->add(element, point, weight);
    if (lame)
      weighted_stresses<dim>(*lame, point.strain, n, weight, stresses);
    else
      weighted_stresses<dim>(law, point.strain, n, weight, stresses);
    for (int j = 0; j < n; ++j)
      for (int s = 0; s < n_strains<dim>; ++s) {
        const double value = stresses[s][j];
        double* column = k.column(j);
        for (int i = j; i < n; ++i) column[i] += point.strain[s][i] * value;
      }
  }
  if (moments)
    multiply(element.projected_lambda(), moments->of_dofs, Op::transpose, moments->coefficients(), Op::none,
             1, k);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) k(i, j) = k(j, i);
  return k;
}

template <int dim>
Matrix gradient_stiffness(const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
                          std::span<const ReferencePoint<dim>> points) {
  const int n = element.n_dofs();
  Matrix k(n, n);
  for (const auto& q : points) {
    const double weight = q.weight * element.at(q.xi).determinant * law.scaling_modulus();
    for (const auto& derivative : element.gradient(q.xi))
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) k(i, j) += weight * derivative[i] * derivative[j];
  }
  return k;
}

namespace {

template <int dim>
using DofMap = std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim>;

/// The ghost penalty compares these values on both sides of a face, at one of its points: linear maps of the
/// dofs of a cell (rows: components in the frame of the minus cell).
template <int dim>
struct FaceTerm {
  DofMap<dim> minus, plus;
  double weight;  ///< of the square of their difference
};

constexpr auto own_strain = [](const auto& element, const auto& xi) { return element.with_own_strain(xi); };

/// `at` returns the map and strain of an element at a point of the unit cell.
template <int dim>
std::vector<FaceTerm<dim>> face_terms(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus,
                                      int axis, double angle, const MaterialLaw<dim>& law,
                                      const GhostPenalty& ghost, const auto& at) {
  const double h = 0.5 * (minus.size_across(axis) + plus.size_across(axis)), modulus = law.scaling_modulus();
  const auto in_frame_of_minus = [&](const DofMap<dim>& of_plus) {
    DofMap<dim> result{};
    for (int j = 0; j < plus.n_dofs(); ++j) {
      Vec<dim> column;
      for (int d = 0; d < dim; ++d) column[d] = of_plus[d][j];
      column = rotated<dim>(column, angle);
      for (int d = 0; d < dim; ++d) result[d][j] = column[d];
    }
    return result;
  };
  std::vector<FaceTerm<dim>> terms;
  for (const auto& q : unit_cell_rule<dim - 1>(minus.degree() + 1)) {
    Vec<dim> xi_minus, xi_plus, reference_normal{};
    for (int d = 0, f = 0; d < dim; ++d) {
      xi_minus[d] = d == axis ? 1 : q.xi[f];
      xi_plus[d] = d == axis ? 0 : q.xi[f];
      if (d != axis) ++f;
    }
    reference_normal[axis] = 1;
    const auto at_minus = at(minus, xi_minus), at_plus = at(plus, xi_plus);
    const auto surface = map_surface<dim>(at_minus.jacobian, reference_normal);
    const Vec<dim> normal = surface.normal, plus_normal = rotated<dim>(normal, -angle);
    const double weight = q.weight * surface.scale * 0.5 * ghost.xi;
    terms.push_back({traction_map<dim>(minus, law, at_minus, normal),
                     in_frame_of_minus(traction_map<dim>(plus, law, at_plus, plus_normal)),
                     weight * h / modulus});
    if (n_compared_derivatives(ghost, minus.degree()) > 1)
      terms.push_back({minus.second_derivative(xi_minus, axis, normal),
                       in_frame_of_minus(plus.second_derivative(xi_plus, axis, plus_normal)),
                       weight * h * h * h * modulus});
  }
  return terms;
}

/// The form of the jumps on the dofs of both cells.
template <int dim>
Matrix jump_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus,
                      const std::vector<FaceTerm<dim>>& terms) {
  const int n_minus = minus.n_dofs(), n = n_minus + plus.n_dofs();
  Matrix k(n, n);
  std::vector<double> jump(n);
  for (const auto& term : terms)
    for (int d = 0; d < dim; ++d) {
      for (int j = 0; j < n_minus; ++j) jump[j] = -term.minus[d][j];
      for (int j = n_minus; j < n; ++j) jump[j] = term.plus[d][j - n_minus];
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) k(i, j) += term.weight * jump[i] * jump[j];
    }
  return k;
}

/// The places of a node of a cell among the nodes of the cell's first or last face normal to the azimuth, and
/// among the layers from there.
struct LayerNode {
  int face_node;
  int layer;  ///< 0 on the first azimuth of the cell
};
template <int dim>
LayerNode layer_node(int degree, int node) {
  const auto p = local_node_position<dim>(degree, node);
  int face_node = p[0];
  if constexpr (dim == 3) face_node += p[2] * (degree + 1);
  return {face_node, p[1]};
}

/// The dofs of a cell whose displacement has given values on a face normal to the azimuth, the first or the
/// last, and given derivatives across it with respect to the coordinate of the unit cell. Columns: values at
/// the face's nodes, then first derivatives, then second ones; polar components at the face.
template <int dim>
Matrix extension(int degree, int n_derivatives, bool from_first_face, double column_angle) {
  const int per_face = dim * power(degree + 1, dim - 1);
  Matrix result(dim * nodes_per_cell<dim>(degree), per_face * (1 + n_derivatives));
  for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
    const auto [face_node, layer] = layer_node<dim>(degree, a);
    const double away = double(layer) / degree - (from_first_face ? 0 : 1);
    const double powers[] = {1, away, away * away / 2};
    for (int c = 0; c < dim; ++c) {
      Vec<dim> unit{};
      unit[c] = 1;
      unit = rotated<dim>(unit, -away * column_angle);
      for (int k = 0; k <= n_derivatives; ++k)
        for (int d = 0; d < dim; ++d)
          result(ElasticElement<dim>::dof(a, d), k * per_face + dim * face_node + c) = powers[k] * unit[d];
    }
  }
  return result;
}

}  // namespace

template <int dim>
Matrix ghost_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus, int axis,
                       double angle, const MaterialLaw<dim>& law, const GhostPenalty& ghost) {
  return jump_stiffness<dim>(minus, plus, face_terms<dim>(minus, plus, axis, angle, law, ghost, own_strain));
}

template <int dim>
Matrix traction_jump_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus, int axis,
                               double angle, const MaterialLaw<dim>& law, double weight) {
  const GhostPenalty of_traction{.kind = GhostPenaltyKind::paper, .xi = weight};
  const auto at = [](const ElasticElement<dim>& element, const Vec<dim>& xi) { return element.at(xi); };
  return jump_stiffness<dim>(minus, plus, face_terms<dim>(minus, plus, axis, angle, law, of_traction, at));
}

template <int dim>
GhostHalves divided_ghost_stiffness(const ElasticElement<dim>& element, double column_angle,
                                    const MaterialLaw<dim>& law, const GhostPenalty& ghost) {
  const int degree = element.degree(), n_cell = element.n_dofs(),
            n_derivatives = n_compared_derivatives(ghost, degree),
            per_face = dim * power(degree + 1, dim - 1), n = n_cell + n_derivatives * per_face;
  const Matrix before = extension<dim>(degree, n_derivatives, false, column_angle),
               after = extension<dim>(degree, n_derivatives, true, column_angle);
  GhostHalves halves{Matrix(n, n), Matrix(n, n)};
  std::vector<double> between(per_face * (1 + n_derivatives)), difference(n);
  const auto add = [&](const std::array<double, ElasticElement<dim>::max_dofs>& in_cell, int face_layer,
                       double weight, Matrix& k) {
    for (int j = 0; j < n_cell; ++j) difference[j] = -in_cell[j];
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a)
      if (const auto [face_node, layer] = layer_node<dim>(degree, a); layer == face_layer)
        for (int c = 0; c < dim; ++c)
          difference[ElasticElement<dim>::dof(a, c)] += between[dim * face_node + c];
    for (int j = n_cell; j < n; ++j) difference[j] = between[j - n_cell + per_face];
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) k(i, j) += weight * difference[i] * difference[j];
  };
  for (const auto& term : face_terms<dim>(element, element, 1, column_angle, law, ghost, own_strain))
    for (int d = 0; d < dim; ++d) {
      for (size_t j = 0; j < between.size(); ++j) {
        double sum = 0;
        for (int i = 0; i < n_cell; ++i)
          sum += term.minus[d][i] * before(i, static_cast<int>(j)) +
                 term.plus[d][i] * after(i, static_cast<int>(j));
        between[j] = sum / 2;
      }
      add(term.minus[d], degree, 2 * term.weight, halves.minus);
      add(term.plus[d], 0, 2 * term.weight, halves.plus);
    }
  return halves;
}

Matrix half_of_symmetric_pair(const Matrix& form, int degree) {
  const int n = form.rows() / 2;
  Matrix pair(2 * n, n);  // the displacements of both cells by those of the minus cell
  for (int a = 0; a < nodes_per_cell<3>(degree); ++a) {
    const int layer = local_node_position<3>(degree, a)[2];
    const int image = a + (degree - 2 * layer) * power(degree + 1, 2);
    for (int c = 0; c < 3; ++c) {
      const int dof = ElasticElement<3>::dof(a, c);
      pair(dof, dof) = 1;
      pair(n + ElasticElement<3>::dof(image, c), dof) = c == 2 ? -1 : 1;
    }
  }
  Matrix half = product(pair, Op::transpose, product(form, Op::none, pair, Op::none), Op::none);
  for (double& x : half.entries()) x /= 2;
  return half;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                             \
  template decltype(traction<dim>) traction<dim>;                                                \
  template class ElasticElement<dim>;                                                            \
  template struct DilatationMoments<dim>;                                                        \
  template std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim> traction_map<dim>( \
      const ElasticElement<dim>&, const MaterialLaw<dim>&, const ElasticElement<dim>::Point&,    \
      const Vec<dim>&);                                                                          \
  template decltype(cell_stiffness<dim>) cell_stiffness<dim>;                                    \
  template decltype(gradient_stiffness<dim>) gradient_stiffness<dim>;                            \
  template decltype(ghost_stiffness<dim>) ghost_stiffness<dim>;                                  \
  template decltype(traction_jump_stiffness<dim>) traction_jump_stiffness<dim>;                  \
  template decltype(divided_ghost_stiffness<dim>) divided_ghost_stiffness<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
