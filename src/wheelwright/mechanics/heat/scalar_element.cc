#include "wheelwright/mechanics/heat/scalar_element.h"

#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {
namespace {

/// sum += weight a a^T, for the first n entries of a.
void add_square(double weight, const double* a, int n, Matrix& sum) {
  for (int j = 0; j < n; ++j) {
    const double factor = weight * a[j];
    double* column = sum.column(j);
    for (int i = 0; i < n; ++i) column[i] += factor * a[i];
  }
}

/// The component of the gradient along a direction.
template <int dim>
std::array<double, ScalarElement<dim>::max_nodes> slope_along(const typename ScalarElement<dim>::Point& point,
                                                              int n_nodes, const Vec<dim>& direction) {
  std::array<double, ScalarElement<dim>::max_nodes> slope{};
  for (int a = 0; a < n_nodes; ++a) slope[a] = dot<dim>(point.gradient[a], direction);
  return slope;
}

}  // namespace

template <int dim>
auto ScalarElement<dim>::at(const Vec<dim>& xi) const -> Point {
  const ShapeFunctions<dim> shape(degree_, xi);
  Point point{.position = map_.position(shape),
              .jacobian = map_.jacobian(shape),
              .determinant = 0,
              .value = shape.value,
              .gradient = {}};
  point.determinant = determinant<dim>(point.jacobian);
  const Mat<dim> inverse_jacobian = inverse<dim>(point.jacobian);
  for (int a = 0; a < n_nodes(); ++a)
    point.gradient[a] = transpose_times<dim>(inverse_jacobian, shape.gradient[a]);
  return point;
}

template <int dim>
auto ScalarElement<dim>::second_derivative(const Vec<dim>& xi, int axis, const Vec<dim>& n) const
    -> std::array<double, max_nodes> {
  const Point point = at(xi);
  const Mat<dim> inverse_jacobian = inverse<dim>(point.jacobian);
  Vec<dim> m{};  // in the coordinates of the unit cell
  for (int j = 0; j < dim; ++j) m[axis] += inverse_jacobian[axis][j] * n[j];
  const Vec<dim> curvature = map_.second_derivative(xi, m);
  std::array<double, max_nodes> result{};
  for (int a = 0; a < n_nodes(); ++a)
    result[a] = shape_second_derivative<dim>(degree_, a, xi, m) - dot<dim>(point.gradient[a], curvature);
  return result;
}

template <int dim>
Matrix gradient_form(const ScalarElement<dim>& element, std::span<const ReferencePoint<dim>> points) {
  const int n = element.n_nodes();
  Matrix form(n, n);
  std::array<double, ScalarElement<dim>::max_nodes> slope;
  for (const auto& q : points) {
    const auto point = element.at(q.xi);
    for (int d = 0; d < dim; ++d) {
      for (int a = 0; a < n; ++a) slope[a] = point.gradient[a][d];
      add_square(q.weight * point.determinant, slope.data(), n, form);
    }
  }
  return form;
}

template <int dim>
Matrix mass_form(const ScalarElement<dim>& element, std::span<const ReferencePoint<dim>> points) {
  const int n = element.n_nodes();
  Matrix form(n, n);
  for (const auto& q : points) {
    const auto point = element.at(q.xi);
    add_square(q.weight * point.determinant, point.value.data(), n, form);
  }
  return form;
}

template <int dim>
Matrix surface_form(const ScalarElement<dim>& element, std::span<const ReferenceSurfacePoint<dim>> points) {
  const int n = element.n_nodes();
  Matrix form(n, n);
  for (const auto& q : points) {
    const auto point = element.at(q.xi);
    add_square(q.weight * map_surface<dim>(point.jacobian, q.normal).scale, point.value.data(), n, form);
  }
  return form;
}

template <int dim>
Matrix jump_form(const ScalarElement<dim>& minus, const ScalarElement<dim>& plus, int axis, double angle,
                 double h, const GhostPenalty& ghost) {
  const int n = minus.n_nodes();
  Matrix form(2 * n, 2 * n);
  const auto add = [&](double weight, const auto& of_minus, const auto& of_plus) {
    std::array<double, 2 * ScalarElement<dim>::max_nodes> jump;
    for (int a = 0; a < n; ++a) {
      jump[a] = -of_minus[a];
      jump[n + a] = of_plus[a];
    }
    add_square(weight, jump.data(), 2 * n, form);
  };
  for (const auto& q : face_rule<dim>(axis, 1, minus.degree() + 1)) {
    Vec<dim> on_plus = q.xi;
    on_plus[axis] = 0;
    const auto at_minus = minus.at(q.xi), at_plus = plus.at(on_plus);
    const auto surface = map_surface<dim>(at_minus.jacobian, q.normal);
    const Vec<dim> normal = surface.normal, plus_normal = rotated<dim>(normal, -angle);
    const double weight = q.weight * surface.scale * 0.5 * ghost.xi * h;
    add(weight, slope_along<dim>(at_minus, n, normal), slope_along<dim>(at_plus, n, plus_normal));
    if (n_compared_derivatives(ghost, minus.degree()) > 1)
      add(weight * h * h, minus.second_derivative(q.xi, axis, normal),
          plus.second_derivative(on_plus, axis, plus_normal));
  }
  return form;
}

template <int dim>
std::vector<ReferenceSurfacePoint<dim>> face_rule(int axis, int end, int points) {
  std::vector<ReferenceSurfacePoint<dim>> rule;
  for (const auto& q : unit_cell_rule<dim - 1>(points)) {
    ReferenceSurfacePoint<dim> point{{}, {}, q.weight};
    for (int d = 0, f = 0; d < dim; ++d) point.xi[d] = d == axis ? end : q.xi[f++];
    point.normal[axis] = end == 0 ? -1 : 1;
    rule.push_back(point);
  }
  return rule;
}

std::vector<ReferenceSurfacePoint<3>> side_face_rule(const CutCell<3>& cut, int end) {
  // With g that does not depend on the third coordinate and z the distance from the other face, the
  // divergence of g z along the axle is g: its integral is that of g over the face and of g z n over the
  // moving boundary.
  const double outward = end == 0 ? -1 : 1;
  const auto on_face = [&](Vec<3> xi, double weight) {
    xi[2] = end;
    return ReferenceSurfacePoint<3>{xi, {0, 0, outward}, weight};
  };
  std::vector<ReferenceSurfacePoint<3>> rule;
  for (const auto& q : cut.material) rule.push_back(on_face(q.xi, q.weight));
  for (const auto& q : cut.boundary) {
    const double from_other_face = end == 0 ? 1 - q.xi[2] : q.xi[2];
    if (q.normal[2] != 0) rule.push_back(on_face(q.xi, -q.weight * from_other_face * outward * q.normal[2]));
  }
  return rule;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                        \
  template class ScalarElement<dim>;                        \
  template decltype(gradient_form<dim>) gradient_form<dim>; \
  template decltype(mass_form<dim>) mass_form<dim>;         \
  template decltype(surface_form<dim>) surface_form<dim>;   \
  template decltype(jump_form<dim>) jump_form<dim>;         \
  template decltype(face_rule<dim>) face_rule<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
