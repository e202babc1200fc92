#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "wheelwright/run/checkpoints/checkpoint.h"

/// A checkpoint with every part filled, for tests of its format.
namespace wheelwright::testing {

class Random {
 public:
  double number() { return std::ldexp(uniform_(engine_), static_cast<int>(engine_() % 40) - 20); }
  std::vector<double> numbers(int n) {
    std::vector<double> result(n);
    for (double& value : result) value = number();
    return result;
  }

 private:
  std::mt19937 engine_{1};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

template <int dim>
PolarGrid<dim> small_grid() {
  PolarGrid<dim> grid{0.2, 0.34, 0.12, 16, {2, 3}};
  if constexpr (dim == 3) grid.cells[2] = 1;
  return grid;
}

template <int dim>
LevelSet<dim> some_level_set(Random& random, int degree) {
  const Lattice<dim> lattice(small_grid<dim>(), degree);
  return {lattice, random.numbers(lattice.n_nodes())};
}

template <int dim>
Checkpoint<dim> some_checkpoint() {
  Random random;
  const auto point = [&] {
    Vec<dim> x;
    for (double& value : x) value = random.number();
    return x;
  };
  Matrix mean(3, 4);
  std::ranges::copy(random.numbers(12), mean.data());
  Evaluation<dim> evaluation{
      .functions =
          {{"objective", random.number(), random.numbers(3), {random.number(), -0.0}, {}},
           {"volume", random.number(), {}, random.numbers(2), {-1.5, random.number()}, {}, UnitKind::volume}},
      .terms = {{"strain_energy", random.number(), random.numbers(3)}, {"volume", random.number(), {}}},
      .boundary = {{0, point(), point(), random.number()}, {5, point(), point(), random.number()}},
      .newton_iterations = {7, 0, 12},
      .mean_observations = mean,
      .phases = {{"cut", 0.25}, {"contact", 1e-3}},
      .measures = {{"run_out", std::numeric_limits<double>::denorm_min()},
                   {"pressure_spread", std::numeric_limits<double>::quiet_NaN()}},
      .starts = {
          {{2, 0.5, random.number()}, {dim, {random.number(), std::numeric_limits<double>::quiet_NaN()}}},
          {{5}, {dim, random.numbers(4)}}}};
  const int n_nodes = Lattice<dim>(small_grid<dim>(), 2).n_nodes();
  OptimizationState<dim> state{
      some_level_set<dim>(random, 2),
      evaluation,
      random.number(),
      random.number(),
      3,
      0.5,
      2,
      1,
      {{{random.numbers(n_nodes), random.numbers(n_nodes)},
        {random.numbers(n_nodes), random.numbers(n_nodes)}},
       random.numbers(2),
       random.numbers(3)},
      {{random.number(), 0, 2}, {random.number(), random.number(), 1}, {random.number()}, {random.number()}},
      0,
      FinalWidths::kept_with_sharper_corners};
  return {{"[load]\nforce = 1\n", "wheelwright 1.2.3"},
          state,
          {some_level_set<dim>(random, 1), random.number(), random.number()},
          {{{some_level_set<dim>(random, 2), random.number(), random.number(), true}}, false},
          {{1, "peak_von_mises", random.number()}, {0, "run_out", random.number()}},
          {123456789012, 0xfedcba98},
          17.25,
          StopReason::no_descent,
          2e-4};
}

}  // namespace wheelwright::testing
