// Steady conduction of heat on fitted and cut cells, against exact and manufactured solutions.

#include "wheelwright/mechanics/heat/conduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "tests/support.h"
#include "wheelwright/mechanics/heat/scalar_element.h"
#include "wheelwright/mechanics/heat/steady_temperature.h"
#include "wheelwright/mechanics/state/material_rule.h"

namespace wheelwright {
namespace {

/// A function of the place (Cartesian, body frame) with its gradient and its Laplacian.
template <int dim>
struct Solution {
  std::function<double(const Vec<dim>&)> value;
  std::function<Vec<dim>(const Vec<dim>&)> gradient;
  std::function<double(const Vec<dim>&)> laplacian;
};

Material conducting(double conductivity) {
  Material material;
  material.conductivity = conductivity;
  return material;
}

template <int dim>
CutDomain<dim> cells_of(const LevelSet<dim>& psi, int points = 6) {
  auto domain = cut_domain(psi, points);
  if (!domain) throw std::runtime_error(domain.failure().detail);
  return *std::move(domain);
}

/// A ring without holes.
template <int dim>
LevelSet<dim> solid(const PolarGrid<dim>& grid) {
  const Lattice<dim> lattice(grid, 1);
  return {lattice, std::vector<double>(lattice.n_nodes(), -1.0)};
}

/// The place of a point of a cell.
template <int dim>
Vec<dim> place_of(const PolarGrid<dim>& grid, const std::array<int, dim>& cell, const Vec<dim>& in_cell) {
  return rotated<dim>(in_cell, cell[1] * grid.column_angle());
}

/// Adds int value N_a over points with weights.
template <int dim>
void add_load(const Lattice<dim>& lattice, const std::array<int, dim>& cell,
              const typename ScalarElement<dim>::Point& point, double value, std::vector<double>& loads) {
  for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a)
    loads[lattice.node_index(lattice.cell_node(cell, a))] += value * point.value[a];
}

/// int q N_a over the material.
template <int dim>
std::vector<double> source_loads(const CutDomain<dim>& domain, int degree,
                                 const std::function<double(const Vec<dim>&)>& source) {
  const Lattice<dim> lattice(domain.grid, degree);
  std::vector<double> loads(lattice.n_nodes(), 0.0);
  MaterialRule<dim>(domain, degree + 4)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> rule) {
        const auto place = domain.grid.cell_position(cell);
        const ScalarElement<dim> element(domain.grid, degree, place);
        for (const auto& q : rule) {
          const auto point = element.at(q.xi);
          add_load<dim>(
              lattice, place, point,
              q.weight * point.determinant * source(place_of<dim>(domain.grid, place, point.position)),
              loads);
        }
      });
  return loads;
}

/// The data of a Robin condition, k d_n T + h T, of a solution on all surfaces but the rim.
template <int dim>
void add_robin_loads(const CutDomain<dim>& domain, int degree, const Solution<dim>& exact, double k,
                     const Cooling& cooling, std::vector<double>& loads) {
  const PolarGrid<dim>& grid = domain.grid;
  const Lattice<dim> lattice(grid, degree);
  const auto add = [&](int cell, std::span<const ReferenceSurfacePoint<dim>> rule, double h) {
    const auto place = grid.cell_position(cell);
    const ScalarElement<dim> element(grid, degree, place);
    for (const auto& q : rule) {
      const auto point = element.at(q.xi);
      const auto surface = map_surface<dim>(point.jacobian, q.normal);
      const Vec<dim> x = place_of<dim>(grid, place, point.position),
                     n = place_of<dim>(grid, place, surface.normal);
      add_load<dim>(lattice, place, point,
                    q.weight * surface.scale * (k * dot<dim>(exact.gradient(x), n) + h * exact.value(x)),
                    loads);
    }
  };
  for (int cell = grid.cells[0] - 1; cell < grid.n_cells(); cell += grid.cells[0])
    add(cell, face_rule<dim>(0, 1, degree + 3), cooling.tread);
  for (const CutCell<dim>& cut : domain.cut) add(cut.cell, cut.boundary, cooling.holes);
  if constexpr (dim == 3)
    for (const int end : {0, 1}) {
      const int axial = end * (grid.cells[2] - 1);
      for (int cell = 0; cell < grid.n_cells(); ++cell)
        if (grid.cell_position(cell)[2] == axial && domain.kinds[cell] == CellKind::inside)
          add(cell, face_rule<3>(2, end, degree + 3), cooling.side_faces);
      for (const CutCell<3>& cut : domain.cut)
        if (grid.cell_position(cut.cell)[2] == axial)
          add(cut.cell, side_face_rule(cut, end), cooling.side_faces);
    }
}

template <int dim>
std::vector<double> at_nodes(const Lattice<dim>& lattice,
                             const std::function<double(const Vec<dim>&)>& value) {
  std::vector<double> values;
  for (int node = 0; node < lattice.n_nodes(); ++node)
    values.push_back(value(cartesian<dim>(lattice.polar_point(node))));
  return values;
}

template <int dim>
TemperatureField<dim> solved(const RollingModel<dim>& model, const CutDomain<dim>& domain,
                             const std::vector<double>& loads, const std::vector<double>& at_rim) {
  const auto solver = ConductionSolver<dim>::create(Conduction<dim>(model, domain));
  if (!solver) throw std::runtime_error(solver.failure().detail);
  auto field = solver->solve(loads, at_rim);
  if (!field) throw std::runtime_error(field.failure().detail);
  return *std::move(field);
}

struct Errors {
  double value, gradient;  ///< in L2 over the material
};

template <int dim>
Errors errors(const CutDomain<dim>& domain, const TemperatureField<dim>& field, const Solution<dim>& exact) {
  Errors sums{0, 0};
  const int degree = field.lattice.degree();
  MaterialRule<dim>(domain, degree + 4)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> rule) {
        const auto place = domain.grid.cell_position(cell);
        const ScalarElement<dim> element(domain.grid, degree, place);
        for (const auto& q : rule) {
          const auto point = element.at(q.xi);
          const Vec<dim> x = place_of<dim>(domain.grid, place, point.position);
          Vec<dim> gradient{};
          for (int a = 0; a < element.n_nodes(); ++a)
            gradient +=
                field.values[field.lattice.node_index(field.lattice.cell_node(place, a))] * point.gradient[a];
          const Vec<dim> in_cell = rotated<dim>(exact.gradient(x), -place[1] * domain.grid.column_angle());
          const double weight = q.weight * point.determinant;
          sums.value += weight * std::pow(field.at(place, q.xi) - exact.value(x), 2);
          sums.gradient += weight * dot<dim>(gradient - in_cell, gradient - in_cell);
        }
      });
  return {std::sqrt(sums.value), std::sqrt(sums.gradient)};
}

/// A temperature by the radius in a layer of a ring with a uniform source q: a + b log r - q r^2 / (4 k).
struct RingLayer {
  double a, b, q, k;
  double value(double r) const { return a + b * std::log(r) - q * r * r / (4 * k); }
  double flux(double r) const { return -k * b / r + q * r / 2; }  ///< outwards
};

/// Its largest error at the nodes of active cells, by its largest value.
double error_at_nodes(const TemperatureField<2>& field, const std::function<double(double)>& exact) {
  double error = 0, largest = 0;
  for (int node = 0; node < field.lattice.n_nodes(); ++node) {
    const double value = exact(field.lattice.polar_point(node)[0]);
    error = std::max(error, std::abs(field.values[node] - value));
    largest = std::max(largest, std::abs(value));
  }
  return error / largest;
}

// The rim held at 15 K over the air, convection at the tread.
TEST(Conduction, OfARingWithAUniformSourceIsLogarithmic) {
  constexpr double q = 2e5, k = 0.25, h = 30, rim = 0.2, tread = 0.34, of_rim = 15;
  // value(rim) = of_rim, flux(tread) = h value(tread).
  RingLayer exact{0, 0, q, k};
  exact.b = (h * (of_rim + q * (rim * rim - tread * tread) / (4 * k)) - q * tread / 2) /
            (-k / tread - h * std::log(tread / rim));
  exact.a = of_rim - exact.b * std::log(rim) + q * rim * rim / (4 * k);
  ASSERT_NEAR(exact.flux(tread), h * exact.value(tread), 1e-9 * exact.flux(tread));
  std::vector<double> found;
  for (const int refinement : {1, 2}) {
    RollingModel<2> model;
    model.grid = {rim, tread, 0.12, 16, {28 * refinement, 24 * refinement}};
    model.materials = conducting(k);
    model.cooling = Cooling{20, 20 + of_rim, h, 0, 0};
    const auto domain = cells_of(solid(model.grid));
    const auto field = solved<2>(model, domain, source_loads<2>(domain, 2, [&](const Vec<2>&) { return q; }),
                                 std::vector<double>(Lattice<2>(model.grid, 2).n_nodes(), of_rim));
    found.push_back(error_at_nodes(field, [&](double r) { return exact.value(r); }));
  }
  RecordProperty("error", std::to_string(found.back()));
  EXPECT_LT(found[1], 1e-8) << found[0];
}

/// A conductive band outside, an insulated rim.
TEST(Conduction, OfTwoLayersIsThatOfEach) {
  constexpr double rim = 0.2, edge = 0.27, tread = 0.34, h = 25;
  RingLayer inner{0, 0, 3e4, 0.2}, outer{0, 0, 1e4, 15};
  inner.b = inner.q * rim * rim / (2 * inner.k);                       // no flux at the rim
  outer.b = (outer.q * edge / 2 - inner.flux(edge)) * edge / outer.k;  // the same flux
  outer.a = outer.flux(tread) / h - outer.b * std::log(tread) + outer.q * tread * tread / (4 * outer.k);
  inner.a = outer.value(edge) - inner.value(edge);
  RollingModel<2> model;
  model.grid = {rim, tread, 0.12, 16, {56, 48}};
  model.materials = Materials<2>({{edge, std::make_shared<IsotropicLaw<2>>(conducting(inner.k)), "inner"},
                                  {tread, std::make_shared<IsotropicLaw<2>>(conducting(outer.k)), "outer"}});
  model.cooling = Cooling{.tread = h};
  const auto domain = cells_of(solid(model.grid));
  const auto source = [&](const Vec<2>& x) { return norm<2>(x) < edge ? inner.q : outer.q; };
  const std::vector<double> none(Lattice<2>(model.grid, 2).n_nodes(), 0.0);
  const auto field = solved<2>(model, domain, source_loads<2>(domain, 2, source), none);
  EXPECT_LT(error_at_nodes(field, [&](double r) { return r <= edge ? inner.value(r) : outer.value(r); }),
            1e-7);
}

/// Without symmetry, and not a polynomial.
Solution<2> wavy() {
  return {
      [](const Vec<2>& x) { return 30 + 20 * std::sin(9 * x[0]) * std::exp(4 * x[1]) + 40 * x[0] * x[1]; },
      [](const Vec<2>& x) {
        const double e = 20 * std::exp(4 * x[1]), s = std::sin(9 * x[0]), c = std::cos(9 * x[0]);
        return Vec<2>{9 * e * c + 40 * x[1], 4 * e * s + 40 * x[0]};
      },
      [](const Vec<2>& x) { return (16 - 81) * 20 * std::sin(9 * x[0]) * std::exp(4 * x[1]); }};
}

/// Three holes of different sizes in a wheel of one sector, with convection in them.
TEST(Conduction, OfAManufacturedTemperatureConvergesOnCutCells) {
  constexpr double k = 0.3;
  const Solution<2> exact = wavy();
  std::vector<Errors> found;
  for (const int refinement : {1, 2, 4}) {
    RollingModel<2> model;
    model.grid = {0.20, 0.34, 0.12, 1, {7 * refinement, 96 * refinement}};
    model.materials = conducting(k);
    model.cooling = Cooling{20, 20, 12, 9, 0};
    const auto domain = cells_of(
        testing::holes(model.grid, 2, {{0.2681, 0.47, 0.0373}, {0.2631, 2.31, 0.0273}, {0.28, 4.4, 0.0313}}));
    auto loads = source_loads<2>(domain, 2, [&](const Vec<2>& x) { return -k * exact.laplacian(x); });
    add_robin_loads(domain, 2, exact, k, *model.cooling, loads);
    const auto field = solved(model, domain, loads, at_nodes<2>(Lattice<2>(model.grid, 2), exact.value));
    found.push_back(errors(domain, field, exact));
  }
  for (int step : {1, 2}) {
    EXPECT_GT(std::log2(found[step - 1].value / found[step].value), 2.9) << found[step].value;
    EXPECT_GT(std::log2(found[step - 1].gradient / found[step].gradient), 1.9) << found[step].gradient;
  }
}

/// A hole that widens along the axle, convection on all surfaces.
TEST(Conduction, OfAManufacturedTemperatureConvergesIn3D) {
  constexpr double k = 0.3;
  const Solution<3> exact{
      [](const Vec<3>& x) {
        return 30 + 20 * std::sin(9 * x[0] + 2) * std::exp(8 * x[2]) + 30 * x[1] * x[2];
      },
      [](const Vec<3>& x) {
        const double e = 20 * std::exp(8 * x[2]), s = std::sin(9 * x[0] + 2), c = std::cos(9 * x[0] + 2);
        return Vec<3>{9 * e * c, 30 * x[2], 8 * e * s + 30 * x[1]};
      },
      [](const Vec<3>& x) { return (64 - 81) * 20 * std::sin(9 * x[0] + 2) * std::exp(8 * x[2]); }};
  std::vector<Errors> found;
  for (const int refinement : {1, 2}) {
    RollingModel<3> model;
    model.grid = {0.20, 0.34, 0.12, 1, {4 * refinement, 32 * refinement, 3 * refinement}};
    model.materials = conducting(k);
    model.cooling = Cooling{20, 20, 12, 9, 7};
    LevelSet<3> psi{Lattice<3>(model.grid, 2), {}};
    for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
      const Vec<3> x = cartesian<3>(psi.lattice.polar_point(node));
      psi.values.push_back(0.033 + 0.1 * x[2] - std::hypot(x[0] - 0.2681, x[1] - 0.0131));
    }
    const auto domain = cells_of(psi, 4);
    auto loads = source_loads<3>(domain, 2, [&](const Vec<3>& x) { return -k * exact.laplacian(x); });
    add_robin_loads(domain, 2, exact, k, *model.cooling, loads);
    const auto field = solved(model, domain, loads, at_nodes<3>(Lattice<3>(model.grid, 2), exact.value));
    found.push_back(errors(domain, field, exact));
  }
  EXPECT_GT(std::log2(found[0].value / found[1].value), 2.8) << found[1].value;
  EXPECT_GT(std::log2(found[0].gradient / found[1].gradient), 1.9) << found[1].gradient;
}

// With insulated side faces the temperature does not depend on the place along the axle.
TEST(Conduction, InThePlaneIsThatOfASlice) {
  const auto run = []<int dim>(RollingModel<dim> model, const LevelSet<dim>& psi) {
    model.materials = conducting(0.3);
    model.cooling = Cooling{20, 32, 25, 10, 0};
    const auto domain = cells_of(psi, 10);
    const std::vector<double> at_rim(Lattice<dim>(model.grid, 2).n_nodes(), 12.0);
    return solved<dim>(
        model, domain,
        source_loads<dim>(domain, 2, [](const Vec<dim>& x) { return 1e5 * (1 + std::sin(40 * x[1])); }),
        at_rim);
  };
  RollingModel<2> plane;
  plane.grid = {0.20, 0.34, 0.12, 16, {10, 9}};
  RollingModel<3> slice;
  slice.grid = {0.20, 0.34, 0.12, 16, {10, 9, 2}};
  const auto flat = testing::generic_hole(plane.grid);
  LevelSet<3> extruded{Lattice<3>(slice.grid, 2), {}};
  for (int node = 0; node < extruded.lattice.n_nodes(); ++node) {
    const auto p = extruded.lattice.node_position(node);
    extruded.values.push_back(flat.values[flat.lattice.node_index({p[0], p[1]})]);
  }
  const auto in_plane = run(plane, flat);
  const auto in_slice = run(slice, extruded);
  for (int node = 0; node < in_slice.lattice.n_nodes(); ++node) {
    const auto p = in_slice.lattice.node_position(node);
    const double expected = in_plane.values[in_plane.lattice.node_index({p[0], p[1]})];
    ASSERT_NEAR(in_slice.values[node], expected, 1e-6 * (1 + std::abs(expected))) << node;
  }
}

// Nothing takes the heat: the temperature is not determined.
TEST(Conduction, WithoutCoolingFails) {
  RollingModel<2> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6}};
  model.materials = conducting(0.3);
  model.cooling = Cooling();
  const auto domain = cells_of(solid(model.grid));
  const auto solver = ConductionSolver<2>::create(Conduction<2>(model, domain));
  if (solver) {
    const auto loads = source_loads<2>(domain, 2, [](const Vec<2>&) { return 1.0; });
    EXPECT_FALSE(solver->solve(loads, std::vector<double>(loads.size(), 0.0)));
  }
}

}  // namespace
}  // namespace wheelwright
