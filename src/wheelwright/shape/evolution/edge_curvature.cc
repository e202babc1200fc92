#include "wheelwright/shape/evolution/edge_curvature.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {
namespace {

/// Lines per cell along each axis.
constexpr int fineness = 4;

/// A cell of the spline: the coefficients on which it depends, first axis fastest, and their nodes. Those
/// beyond the ends of a nonperiodic axis have weight zero.
template <int dim>
struct SplineCell {
  static constexpr int most = SplineSupport::most * power(4, dim - 1);
  std::array<SplineSupport, dim> support;
  int n = 1;
  std::array<double, most> coefficient;
  std::array<int, most> node;
  std::array<std::array<int, dim>, most> place;  ///< in the support along each axis

  SplineCell(const LevelSet<dim>& coefficients, const std::array<int, dim>& cell) {
    const Lattice<dim>& lattice = coefficients.lattice;
    for (int d = 0; d < dim; ++d) {
      support[d] = spline_support(lattice.grid(), d, cell[d]);
      n *= support[d].count;
    }
    for (int k = 0; k < n; ++k) {
      std::array<int, dim> vertex;
      int rest = k;
      for (int d = 0; d < dim; ++d) {
        place[k][d] = rest % support[d].count;
        rest /= support[d].count;
        int position = support[d].first + place[k][d];
        if (d != 1) position = std::clamp(position, 0, lattice.grid().cells[d]);
        vertex[d] = lattice.degree() * position;
      }
      node[k] = lattice.node_index(vertex);
      coefficient[k] = coefficients.values[node[k]];
    }
  }

  /// The spline lies between its coefficients; those beyond the ends continue a straight line.
  bool may_be_cut() const {
    const auto [minimum, largest] = std::ranges::minmax(std::span(coefficient).first(n));
    return minimum < 0 && largest >= 0;
  }
};

/// Weights of the coefficients of a cell for the derivatives along each axis.
template <int dim>
using Weights = std::array<std::array<SplineWeights, 4>, dim>;

template <int dim>
Weights<dim> weights_at(const PolarGrid<dim>& grid, const std::array<int, dim>& cell, const Vec<dim>& xi) {
  Weights<dim> result;
  for (int d = 0; d < dim; ++d) result[d] = spline_derivative_weights(grid, d, cell[d], xi[d]);
  return result;
}

/// The weight of one of the coefficients in a derivative of these orders along the axes.
template <int dim>
double weight_of(const SplineCell<dim>& spline, const Weights<dim>& weights,
                 const std::array<int, dim>& order, int k) {
  double product = 1;
  for (int d = 0; d < dim; ++d) product *= weights[d][order[d]][spline.place[k][d]];
  return product;
}

/// Value and partial derivatives of the function given by derivative(order) in the unit cell of a cell of
/// this size, differentiated once more along `more` if that is an axis.
template <int dim, class Derivative>
PolarPartials<dim> partials_of(const Vec<dim>& size, int more, Derivative derivative) {
  std::array<int, dim> base{};
  double unit = 1;
  if (more >= 0) {
    ++base[more];
    unit = size[more];
  }
  PolarPartials<dim> result{.value = derivative(base) / unit};
  for (int i = 0; i < dim; ++i) {
    auto first = base;
    ++first[i];
    result.first[i] = derivative(first) / (unit * size[i]);
    for (int j = 0; j <= i; ++j) {
      auto second = first;
      ++second[j];
      result.second[i][j] = derivative(second) / (unit * size[i] * size[j]);
    }
  }
  return result;
}

/// The derivatives of the holes' function -psi.
template <int dim>
PolarPartials<dim> partials_at(const Vec<dim>& size, const SplineCell<dim>& spline,
                               const Weights<dim>& weights, int more = -1) {
  return partials_of<dim>(size, more, [&](const std::array<int, dim>& order) {
    double sum = 0;
    for (int k = 0; k < spline.n; ++k)
      sum -= weight_of<dim>(spline, weights, order, k) * spline.coefficient[k];
    return sum;
  });
}

/// Their derivatives with respect to one of the coefficients.
template <int dim>
PolarPartials<dim> partials_by(const Vec<dim>& size, const SplineCell<dim>& spline,
                               const Weights<dim>& weights, int k) {
  return partials_of<dim>(size, -1, [&](const std::array<int, dim>& order) {
    return -weight_of<dim>(spline, weights, order, k);
  });
}

/// The rate of the curvature if the jet changes at this rate.
template <int dim>
double rate(const PrincipalCurvature<dim>& curvature, const Jet<dim>& change) {
  double sum = 0;
  for (int i = 0; i < dim; ++i) {
    sum += curvature.by_gradient[i] * change.gradient[i];
    for (int j = 0; j < dim; ++j) sum += curvature.by_hessian[i][j] * change.hessian[i][j];
  }
  return sum;
}

/// The spline along a line parallel to an axis, given by its coefficients.
struct SplineLine {
  int count;
  std::array<double, SplineSupport::most> coefficient = {};

  double operator()(const SplineWeights& weight) const {
    double sum = 0;
    for (int k = 0; k < count; ++k) sum += weight[k] * coefficient[k];
    return sum;
  }
};

template <int dim>
SplineLine line_of(const SplineCell<dim>& spline, const Weights<dim>& weights, int axis) {
  SplineLine line{spline.support[axis].count};
  for (int k = 0; k < spline.n; ++k) {
    double weight = 1;
    for (int d = 0; d < dim; ++d)
      if (d != axis) weight *= weights[d][0][spline.place[k][d]];
    line.coefficient[spline.place[k][axis]] += weight * spline.coefficient[k];
  }
  return line;
}

/// The root between two places of different sign, by Newton's method in a shrinking bracket.
template <class Derivatives>
double root_between(double low, double high, bool negative_at_low, Derivatives derivatives) {
  double x = 0.5 * (low + high);
  for (int k = 0; k < 60; ++k) {
    const auto [value, slope] = derivatives(x);
    ((value < 0) == negative_at_low ? low : high) = x;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::abs(next - x);
    x = next;
    if (change < 1e-13) break;
  }
  return x;
}

/// Finds the crossings of one cell with the lines along each axis.
template <int dim, class Visit>
void for_each_crossing(const PolarGrid<dim>& grid, const std::array<int, dim>& cell,
                       const SplineCell<dim>& spline, Visit visit) {
  const auto lines = [&](int d) {  // the last face belongs to the next cell, if there is one
    return d != 1 && cell[d] + 1 == grid.cells[d] ? fineness + 1 : fineness;
  };
  for (int axis = 0; axis < dim; ++axis) {
    std::array<int, dim> count;
    int total = 1;
    for (int d = 0; d < dim; ++d) total *= count[d] = d == axis ? 1 : lines(d);
    for (int index = 0; index < total; ++index) {
      Vec<dim> xi;
      int rest = index;
      for (int d = 0; d < dim; ++d) {
        xi[d] = static_cast<double>(rest % count[d]) / fineness;
        rest /= count[d];
      }
      const SplineLine line = line_of<dim>(spline, weights_at<dim>(grid, cell, xi), axis);
      const auto derivatives = [&](double x) {
        const auto weights = spline_derivative_weights(grid, axis, cell[axis], x);
        return std::pair{line(weights[0]), line(weights[1])};
      };
      bool negative = derivatives(0).first < 0;
      for (int part = 0; part < fineness; ++part) {
        const double low = static_cast<double>(part) / fineness, high = low + 1.0 / fineness;
        const bool negative_after = derivatives(high).first < 0;
        if (negative_after != negative) {
          xi[axis] = root_between(low, high, negative, derivatives);
          visit(axis, xi);
        }
        negative = negative_after;
      }
    }
  }
}

/// A unit vector of the tangent plane along which the curvature is the largest.
Vec<2> sharpest_direction(const Jet<2>& f) {
  const double length = norm<2>(f.gradient);
  return {-f.gradient[1] / length, f.gradient[0] / length};
}

Vec<3> sharpest_direction(const Jet<3>& f) {
  const Vec<3> n = f.gradient / norm(f.gradient);
  const auto smallest = std::ranges::min_element(n, {}, [](double x) { return std::abs(x); }) - n.begin();
  Vec<3> t{};
  t[smallest] = 1;
  t -= n[smallest] * n;
  t = t / norm(t);
  const Vec<3> u = cross(n, t);
  const auto form = [&](const Vec<3>& a, const Vec<3>& b) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += a[i] * f.hessian[i][j] * b[j];
    return sum;
  };
  const double angle = 0.5 * std::atan2(2 * form(t, u), form(t, t) - form(u, u));
  return std::cos(angle) * t + std::sin(angle) * u;
}

}  // namespace

// The curvature is the maximum of v.Hv / |g| over unit vectors v with v.g = 0, H the Hessian and g the
// gradient; its derivatives are those of the Lagrangian of that maximum.
template <int dim>
PrincipalCurvature<dim> principal_curvature(const Jet<dim>& f) {
  const Vec<dim> v = sharpest_direction(f);
  const double length = norm<dim>(f.gradient);
  double along = 0, across = 0;  // v.Hv and g.Hv
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      along += v[i] * f.hessian[i][j] * v[j];
      across += f.gradient[i] * f.hessian[i][j] * v[j];
    }
  PrincipalCurvature<dim> result{.value = along / length, .by_gradient = {}, .by_hessian = {}};
  for (int i = 0; i < dim; ++i) {
    result.by_gradient[i] = -(result.value * f.gradient[i] + 2 * across / length * v[i]) / (length * length);
    for (int j = 0; j < dim; ++j) result.by_hessian[i][j] = v[i] * v[j] / length;
  }
  return result;
}

template <int dim>
std::vector<EdgePoint<dim>> internal_corners(const LevelSet<dim>& coefficients, double curvature) {
  const auto& grid = coefficients.lattice.grid();
  std::vector<EdgePoint<dim>> result;
  for (int index = 0; index < grid.n_cells(); ++index) {
    const auto cell = grid.cell_position(index);
    const SplineCell<dim> spline(coefficients, cell);
    if (!spline.may_be_cut()) continue;
    for_each_crossing<dim>(grid, cell, spline, [&](int axis, const Vec<dim>& xi) {
      const Vec<dim> place = grid.polar_point(cell, xi);
      const auto weights = weights_at<dim>(grid, cell, xi);
      const auto f = jet(partials_at<dim>(grid.cell_size(cell[0]), spline, weights), place[0]);
      const double value = principal_curvature(f).value;
      if (value >= curvature) result.push_back({cell, xi, axis, place, value});
    });
  }
  return result;
}

template <int dim>
std::vector<Dependence> curvature_dependence(const LevelSet<dim>& coefficients, const EdgePoint<dim>& point) {
  const auto& grid = coefficients.lattice.grid();
  const SplineCell<dim> spline(coefficients, point.cell);
  const auto weights = weights_at<dim>(grid, point.cell, point.xi);
  const double radius = point.place[0];
  const Vec<dim> size = grid.cell_size(point.cell[0]);
  const auto f = partials_at<dim>(size, spline, weights);
  const auto curvature = principal_curvature(jet(f, radius));
  double along = rate(curvature, jet(partials_at<dim>(size, spline, weights, point.axis), radius));
  if (point.axis == 0) along += rate(curvature, jet_by_radius(f, radius));
  std::vector<Dependence> result;
  for (int k = 0; k < spline.n; ++k) {
    const auto change = partials_by<dim>(size, spline, weights, k);
    const double moved = -change.value / f.first[point.axis];
    const double weight = rate(curvature, jet(change, radius)) + moved * along;
    if (weight != 0) result.push_back({spline.node[k], weight});
  }
  return result;
}

template decltype(principal_curvature<2>) principal_curvature<2>;
template decltype(internal_corners<2>) internal_corners<2>;
template decltype(curvature_dependence<2>) curvature_dependence<2>;
template decltype(principal_curvature<3>) principal_curvature<3>;
template decltype(internal_corners<3>) internal_corners<3>;
template decltype(curvature_dependence<3>) curvature_dependence<3>;

}  // namespace wheelwright
