// Derivatives with respect to the radii of layers.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/quantities/functionals/fatigue.h"
#include "wheelwright/quantities/functionals/mass.h"
#include "wheelwright/quantities/functionals/material_volume.h"
#include "wheelwright/quantities/functionals/peak_temperature.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/perimeter.h"
#include "wheelwright/quantities/functionals/rim_quantities.h"
#include "wheelwright/quantities/functionals/rolling_resistance.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/moved_lines.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using testing::paper_model;

/// A wheel whose materials meet at two lines of the grid, and a shape on it.
template <int dim>
struct LayeredWheel {
  RollingModel<dim> model;
  std::vector<Material> materials;  ///< outwards
  double softening = 1;

  /// With the first design line and the edge of its layer at another radius.
  RollingModel<dim> at(double radius) const {
    RollingModel<dim> moved = model;
    moved.grid = with_fixed_line_at(model.grid, model.design_lines.front(), radius);
    std::vector<typename Materials<dim>::Layer> layers;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      const double outer = i < moved.grid.fixed_lines.size() ? moved.grid.fixed_lines[i].radius : 0.34;
      layers.push_back({outer, std::make_shared<IsotropicLaw<dim>>(materials[i])});
    }
    moved.materials = Materials<dim>(std::move(layers), model.materials.cords());
    return moved;
  }
  double radius() const { return radius_of_fixed_line(model.grid, model.design_lines.front()); }
};

/// A hole across the lines at 0.2431 m and 0.2664 m, without symmetry, with friction and a torque. The third
/// fixed line keeps rows at the tread as they are.
LayeredWheel<2> generic_wheel(double contrast, double nu = 0.3) {
  LayeredWheel<2> wheel{paper_model(14, 192), {}};
  auto& model = wheel.model;
  model.n_positions = 3;
  model.contact.friction = 0.3;
  model.horizontal_force = 0.1 * model.load;
  model.grid.fixed_lines = {{4, 0.2431}, {7, 0.2664}, {13, 0.33}};
  model.design_lines = {7};
  wheel.materials = {{200e6, nu, Plane::strain, 7000},
                     {200e6 * contrast, nu, Plane::strain, 8000},
                     {200e6, 0.3, Plane::strain, 1100},
                     {200e6, 0.3, Plane::strain, 1100}};
  return wheel;
}

LevelSet<2> generic_holes(const PolarGrid<2>& grid) {
  return testing::holes(grid, 2, {{0.2681, 0.47 * grid.sector_angle(), 0.0373}});
}

template <int dim>
LevelSet<dim> on_grid(const LevelSet<dim>& psi, const PolarGrid<dim>& grid) {
  return {Lattice<dim>(grid, psi.lattice.degree()), psi.values};
}

/// The orders of the Taylor test with respect to the first design line, with the terms at that radius.
template <int dim, class Terms>
void expect_exact(const LayeredWheel<dim>& wheel, const LevelSet<dim>& psi, Terms terms, double step = 4e-4) {
  const auto evaluation_at = [&](double radius) {
    const RollingModel<dim> model = wheel.at(radius);
    const auto solver = make_solver(model);
    if (!solver) throw std::runtime_error(solver.failure().detail);
    auto result = testing::evaluate_objective<dim>(**solver, terms(model), on_grid(psi, model.grid));
    if (!result) throw std::runtime_error(result.failure().detail);
    return result->functions.front();
  };
  const auto start = evaluation_at(wheel.radius());
  ASSERT_EQ(start.by_radius.size(), wheel.model.design_lines.size());
  const double derivative = start.by_radius.front();
  EXPECT_NE(derivative, 0);
  double last = 0;
  for (int k = 0; k < 4; ++k) {
    const double t = std::ldexp(step, -k),
                 remainder = std::abs(evaluation_at(wheel.radius() + t).value - start.value - t * derivative);
    const double rounding = 1e-9 * std::abs(t * derivative);
    if (k > 0 && remainder > rounding) {
      EXPECT_GT(std::log2(last / remainder), 1.9)
          << k << ": " << last << " " << remainder << " of " << t * derivative;
    }
    last = remainder;
  }
}

template <class Quantity>
auto terms_of() {
  return [](const auto&) { return WeightedSum<2>{{1, std::make_shared<Quantity>()}}; };
}
auto masses() {
  return [](const RollingModel<2>& model) {
    return WeightedSum<2>{{1, std::make_shared<Mass<2>>(model.materials)}};
  };
}

TEST(RadiusGradient, PassesTheTaylorTest) {
  for (const double contrast : {0.02, 50.0})
    for (const double nu : {0.3, 0.4999}) {
      SCOPED_TRACE(::testing::Message() << contrast << ", nu = " << nu);
      const auto wheel = generic_wheel(contrast, nu);
      const auto psi = generic_holes(wheel.model.grid);
      expect_exact(wheel, psi, terms_of<StrainEnergy<2>>());
      expect_exact(wheel, psi, terms_of<Travel<2>>());
    }
}

TEST(RadiusGradient, OfNumbersOfTheShapePassesTheTaylorTest) {
  const auto wheel = generic_wheel(50);
  const auto psi = generic_holes(wheel.model.grid);
  expect_exact(wheel, psi, terms_of<MaterialVolume<2>>());
  expect_exact(wheel, psi, terms_of<Perimeter<2>>());
  expect_exact(wheel, psi, masses());
}

/// With the same loss factor everywhere, with those of layers, and of the fatigue of a turn.
TEST(RadiusGradient, OfATurnPassesTheTaylorTest) {
  auto wheel = generic_wheel(50, 0.4);
  const auto psi = generic_holes(wheel.model.grid);
  const auto resistance = [](const RollingModel<2>& model) {
    return WeightedSum<2>{{1, std::make_shared<RollingResistance<2>>(model)}};
  };
  for (const bool differ : {false, true}) {
    for (std::size_t k = 0; k < wheel.materials.size(); ++k)
      wheel.materials[k].loss_factor = differ && k == 1 ? 0.02 : 0.1;
    expect_exact(wheel, psi, resistance);
  }
  for (Material& material : wheel.materials)
    material.fatigue = FatigueStrength{.measure = FatigueMeasure::strain_energy, .limit = 2e4};
  expect_exact(wheel, psi, [](const RollingModel<2>& model) {
    return WeightedSum<2>{
        {1, std::make_shared<FatigueUtilization<2>>(model.materials, std::nullopt, PeakNorm{4, 1.0})}};
  });
}

/// The conduction is stretched too, with convection in the hole across the line.
TEST(RadiusGradient, OfTheTemperaturePassesTheTaylorTest) {
  auto wheel = generic_wheel(50, 0.4);
  wheel.model.distributed.angular_speed = 15;
  wheel.model.cooling = Cooling{20, 35, 25, 15, 10};
  for (std::size_t k = 0; k < wheel.materials.size(); ++k) {
    wheel.materials[k].loss_factor = k == 1 ? 0.02 : 0.1;
    wheel.materials[k].conductivity = k == 1 ? 5 : 0.3;
  }
  expect_exact(wheel, generic_holes(wheel.model.grid), [](const auto&) {
    return WeightedSum<2>{{1, std::make_shared<PeakTemperature<2>>(std::nullopt, PeakNorm{4, 1.0})}};
  });
}

/// In the norm of the peak the correction is held, as the derivative takes it.
TEST(RadiusGradient, OfQuantitiesOfLayersPassesTheTaylorTest) {
  const auto wheel = generic_wheel(50, 0.4);
  const auto psi = generic_holes(wheel.model.grid);
  const auto part = [](const RollingModel<2>& model, int layer) {
    return PartOfRing{"layer", model.grid.fixed_lines[layer - 1].radius,
                      model.grid.fixed_lines[layer].radius};
  };
  for (const int layer : {1, 2}) {
    expect_exact(wheel, psi, [&](const RollingModel<2>& model) {
      return WeightedSum<2>{{1, std::make_shared<Mass<2>>(model.materials, part(model, layer))}};
    });
    expect_exact(wheel, psi, [&](const RollingModel<2>& model) {
      return WeightedSum<2>{{1e-6, std::make_shared<PeakVonMises<2>>(
                                       0, PeakNorm{.exponent = 4, .correction = 1}, part(model, layer))}};
    });
  }
}

/// Body force, pressure in the holes and rotation act in the rows that are stretched; the rotating wheel
/// grows.
TEST(RadiusGradient, UnderDistributedLoadsPassesTheTaylorTest) {
  auto wheel = generic_wheel(0.1);
  wheel.model.distributed = {.body_force = {8e4, 3e4}, .hole_pressure = 2e4, .angular_speed = 60};
  const auto psi = generic_holes(wheel.model.grid);
  expect_exact(wheel, psi, terms_of<StrainEnergy<2>>());
  expect_exact(wheel, psi, terms_of<Travel<2>>());
  wheel.model.travel = 0.004;
  expect_exact(wheel, psi, terms_of<StrainEnergy<2>>());
}

/// Also with rows of cells that are cut by one hole and stretched in opposite directions, with cords on the
/// line above, and with the ghost penalty of only the first derivative.
TEST(RadiusGradient, WithCordsAndOtherPenaltiesPassesTheTaylorTest) {
  auto wheel = generic_wheel(20);
  wheel.model.materials = Materials<2>({{0.3, std::make_shared<IsotropicLaw<2>>(Material())}},
                                       {{wheel.model.grid.radius(11), 5e5}});
  wheel.model.grid.fixed_lines = {{4, 0.2431}, {7, 0.2664}, {11, wheel.model.grid.radius(11)}};
  const auto psi = generic_holes(wheel.model.grid);
  expect_exact(wheel, psi, terms_of<StrainEnergy<2>>());
  wheel.model.ghost.kind = GhostPenaltyKind::paper;
  wheel.model.contact.theta_nitsche = 1;
  wheel.model.contact.gamma_0 = 1000;
  expect_exact(wheel, psi, terms_of<StrainEnergy<2>>());
}

/// Also solved on half of the width, if the shape is its own mirror image there.
TEST(RadiusGradient, In3DPassesTheTaylorTest) {
  for (const bool is_symmetric : {true, false}) {
    SCOPED_TRACE(is_symmetric);
    LayeredWheel<3> wheel;
    auto& model = wheel.model;
    model.grid = {0.20, 0.34, 0.12, 16, {7, 6, 2}, {{3, 0.2631}, {6, 0.32}}};
    model.design_lines = {3};
    model.degree = 1;
    model.load = 2943;
    model.n_positions = 2;
    model.contact_points = 3;
    model.contact.friction = 0.3;
    model.torque = 120;
    wheel.materials = {{20e6, 0.3, Plane::strain, 7000},
                       {200e6, 0.3, Plane::strain, 1100},
                       {200e6, 0.3, Plane::strain, 1100}};
    const Circle hole{0.2581, 0.47 * model.grid.sector_angle(), 0.0273};
    auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
    for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
      const double z = psi.lattice.polar_point(i)[2];
      psi.values[i] += 0.002 * std::cos(20 * (is_symmetric ? z - 0.06 : z));
    }
    const auto energy = [](const auto&) { return WeightedSum<3>{{1, std::make_shared<StrainEnergy<3>>()}}; };
    expect_exact(wheel, psi, energy);
    expect_exact(wheel, psi, [](const RollingModel<3>& at) {
      return WeightedSum<3>{{1, std::make_shared<Mass<3>>(at.materials)}};
    });
  }
}

/// Where the interface lies in solid material, moving the shape with the rows changes nothing else: the
/// derivative is that of the exact stiffness of a bush of two layers.
TEST(RadiusGradient, TendsToThatOfTheExactStiffness) {
  const Material core{30e6, 0.3}, tyre{2e6, 0.45};
  const auto compliance = [&](double radius) {
    const auto of = [](const Material& m, double inner, double outer) {
      const double mu = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
      return (1 / (inner * inner) - 1 / (outer * outer)) / (4 * std::numbers::pi * mu);
    };
    return of(core, 0.20, radius) + of(tyre, radius, 0.34);
  };
  double last = 0;
  for (const int level : {0, 1}) {
    LayeredWheel<2> wheel{paper_model(8 << level, 64 << level), {core, tyre, tyre}};
    auto& model = wheel.model;
    model.grid.n_sectors = 8;
    model.grid.cells[1] = 8 << level;
    model.grid.fixed_lines = {{4 << level, 0.2731}, {(8 << level) - 1, 0.34 - 0.0175 / (1 << level)}};
    model.design_lines = {4 << level};
    model.contact.counterpart = Counterpart::ring;
    model.contact_points = 3;
    model.n_positions = 1;
    model.torque = 1000;
    const auto solver = make_solver(wheel.at(0.2731));
    ASSERT_TRUE(solver);
    const auto value = testing::evaluate_objective<2>(
        **solver, {{1, std::make_shared<RimTravel<2>>(RimWay::rotation)}}, testing::holes(model.grid, 2, {}));
    ASSERT_TRUE(value) << value.failure().detail;
    const double step = 1e-5,
                 exact = 1000 * (compliance(0.2731 + step) - compliance(0.2731 - step)) / (2 * step),
                 error = std::abs(value->functions[0].by_radius[0] / exact - 1);
    if (level > 0) {
      EXPECT_GT(std::log2(last / error), 1.8);
      EXPECT_LT(error, 2e-3);
    }
    last = error;
  }
}

}  // namespace
}  // namespace wheelwright
