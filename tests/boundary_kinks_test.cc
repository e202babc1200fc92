// The derivative of integrals over the moving boundary, with its kinks on the faces of cells.

#include "wheelwright/shape/cut/boundary_kinks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/shape/geometry/curvature.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

constexpr int map_degree = 2;

template <int dim>
CutDomain<dim> cells_of(const LevelSet<dim>& psi, int points) {
  auto domain = cut_domain(psi, points);
  if (!domain) throw std::runtime_error(domain.failure().detail);
  return *std::move(domain);
}

template <int dim>
std::vector<SurfacePoint<dim>> boundary_of(const CutDomain<dim>& domain) {
  std::vector<SurfacePoint<dim>> points;
  for (const CutCell<dim>& cut : domain.cut) {
    const auto place = domain.grid.cell_position(cut.cell);
    const CellMap<dim> map(domain.grid, map_degree, place);
    for (const auto& q : cut.boundary) {
      const auto surface = map_surface<dim>(map.jacobian(ShapeFunctions<dim>(map_degree, q.xi)), q.normal);
      points.push_back({cut.cell, q.xi, rotated<dim>(surface.normal, place[1] * domain.grid.column_angle()),
                        q.weight * surface.scale});
    }
  }
  return points;
}

/// Cartesian, in the body frame.
template <int dim>
Vec<dim> place_of(const PolarGrid<dim>& grid, int cell, const Vec<dim>& xi) {
  const auto place = grid.cell_position(cell);
  const CellMap<dim> map(grid, map_degree, place);
  return rotated<dim>(map.position(ShapeFunctions<dim>(map_degree, xi)), place[1] * grid.column_angle());
}

/// g = |x|^2, the same in every sector.
template <int dim>
double integral(const LevelSet<dim>& psi, int cut_points) {
  double sum = 0;
  for (const auto& point : boundary_of(cells_of(psi, cut_points))) {
    const Vec<dim> x = place_of<dim>(psi.lattice.grid(), point.cell, point.xi);
    sum += point.weight * dot<dim>(x, x);
  }
  return sum;
}

/// The derivative of the integral along a direction, with and without kinks, less the difference quotient, by
/// that.
struct DerivativeErrors {
  double with_kinks, without;
};

template <int dim>
DerivativeErrors errors(const LevelSet<dim>& psi, std::span<const double> direction, int cut_points) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const auto domain = cells_of(psi, cut_points);
  const auto points = boundary_of(domain);
  const auto kinks = kink_densities<dim>(psi, domain, map_degree, points, [&](int cell, const Vec<dim>& xi) {
    const Vec<dim> x = place_of<dim>(grid, cell, xi);
    return dot<dim>(x, x);
  });
  std::vector<SurfaceSample<dim>> smooth, all;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const Vec<dim> x = place_of<dim>(grid, points[q].cell, points[q].xi);
    const double density =
        mean_curvature<dim>(psi, map_degree, points[q].cell, points[q].xi) * dot<dim>(x, x) +
        2 * dot<dim>(x, points[q].normal);
    smooth.push_back({points[q], density});
    all.push_back({points[q], density + kinks[q]});
  }
  const auto moved = [&](double t) {
    LevelSet<dim> result = psi;
    for (std::size_t i = 0; i < direction.size(); ++i) result.values[i] += t * direction[i];
    return integral(result, cut_points);
  };
  constexpr double step = 1e-6;
  const double difference =
      (8 * (moved(step) - moved(-step)) - (moved(2 * step) - moved(-2 * step))) / (12 * step);
  const auto error = [&](const std::vector<SurfaceSample<dim>>& gradient) {
    return std::abs(directional_derivative<dim>(gradient, psi, direction, map_degree) / difference - 1);
  };
  return {error(all), error(smooth)};
}

TEST(BoundaryKinks, MakeDerivativesExactInThePlane) {
  for (const int degree : {1, 2}) {
    const PolarGrid<2> grid = testing::paper_model(14, 192).grid;
    const auto psi = testing::holes(grid, degree, {{0.2681, 0.47 * grid.sector_angle(), 0.0373}});
    const auto [with_kinks, without] = errors<2>(psi, testing::smooth_direction(psi.lattice), 8);
    EXPECT_LT(with_kinks, 1e-6);
    EXPECT_GT(without, 1e-4);
  }
}

struct SolidShape {
  LevelSet<3> psi;
  std::vector<double> direction;
};

/// A hole that ends at the side faces at an angle, or a ball that ends inside.
SolidShape solid_shape(int degree, bool is_ball) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 16, {7, 6, 3}};
  SolidShape result{{Lattice<3>(grid, degree), {}}, {}};
  for (int i = 0; i < result.psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = result.psi.lattice.polar_point(i), x = cartesian<3>(p),
                 c = cartesian<3>({0.2681, 0.47 * grid.sector_angle(), 0.0563});
    const Vec<3> d = x - c;
    result.psi.values.push_back(is_ball ? 0.0373 - norm<3>(d)
                                        : 0.0273 + 0.1 * p[2] - std::hypot(d[0], d[1]) +
                                              0.002 * std::cos(20 * p[2]));
    result.direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(15 * p[2]));
  }
  return result;
}

// The level set of the hole has all its curvature in the kinks.
TEST(BoundaryKinks, MakeDerivativesExactIn3D) {
  for (const int degree : {1, 2})
    for (const bool is_ball : {false, true}) {
      const auto [psi, direction] = solid_shape(degree, is_ball);
      const auto [with_kinks, without] = errors<3>(psi, direction, 8);
      EXPECT_LT(with_kinks, 1e-5) << degree << is_ball;
      EXPECT_GT(without, 1e-3) << degree << is_ball;
    }
}

TEST(BoundaryKinks, NeedAsManyPointsAsPolynomials) {
  EXPECT_EQ(points_for_kinks<2>(1), 3);
  EXPECT_EQ(points_for_kinks<2>(2), 8);
  EXPECT_EQ(points_for_kinks<3>(1), 3);
  ASSERT_EQ(points_for_kinks<3>(2), 6);
  for (const bool is_ball : {false, true}) {
    const auto [psi, direction] = solid_shape(2, is_ball);
    const double with_four = errors<3>(psi, direction, 4).with_kinks;
    EXPECT_LT(errors<3>(psi, direction, 6).with_kinks, 0.02 * with_four) << is_ball;
  }
}

}  // namespace
}  // namespace wheelwright
