#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/optimization/sensitivity/evaluate.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/functionals/strain_energy.h"

/// Shapes and models that the tests share.
namespace wheelwright::testing {

/// The wheel of the paper's section 5.1, without its shape.
inline RollingModel<2> paper_model(int radial_cells = 28, int angular_cells = 384) {
  RollingModel<2> model;
  model.grid = {0.20, 0.34, 0.12, 16, {radial_cells, angular_cells / 16}};
  model.materials = Material{200e6, 0.48};
  model.load = 300 * 9.81 / 0.12;
  return model;
}

/// The model by another of Nitsche's variants, with a gamma_0 that is safe for it.
inline RollingModel<2> with_theta(RollingModel<2> model, double theta) {
  model.contact.theta_nitsche = theta;
  model.contact.gamma_0 = theta == 1 ? 1000 : theta == 0 ? 10 : 1;
  return model;
}

/// A circular hole given by its centre, in (radius, azimuth), and its radius.
struct Hole {
  double centre_radius, azimuth, radius;
};

/// Signed distance of holes, repeated in every sector.
inline LevelSet<2> holes(const PolarGrid<2>& grid, int degree, const std::vector<Hole>& all) {
  LevelSet<2> psi{Lattice<2>(grid, degree), {}};
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> x = cartesian<2>(psi.lattice.polar_point(i));
    double value = -1;
    for (const Hole& hole : all)
      for (int image = -1; image <= 1; ++image) {
        const Vec<2> c = cartesian<2>({hole.centre_radius, hole.azimuth + image * grid.sector_angle()});
        value = std::max(value, hole.radius - std::hypot(x[0] - c[0], x[1] - c[1]));
      }
    psi.values.push_back(value);
  }
  return psi;
}

inline LevelSet<2> paper_holes(const PolarGrid<2>& grid) {
  return holes(grid, 2, {{0.27, 0.5 * grid.sector_angle(), 0.04}});
}

/// |a - b| / |b| in the Euclidean norm.
inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, size = 0;
  for (size_t i = 0; i < b.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return a.size() == b.size() ? std::sqrt(difference / size) : INFINITY;
}

inline WeightedSum<2> strain_energy_alone() { return {{1, std::make_shared<StrainEnergy<2>>()}}; }

/// The evaluation of one function, the objective.
template <int dim>
Expected<Evaluation<dim>> evaluate_objective(const StateSolver<dim>& solver, const WeightedSum<dim>& terms,
                                             const LevelSet<dim>& psi, const Matrix* held_mean = nullptr) {
  const ShapeFunction<dim> function = objective(terms);
  auto evaluated = evaluate<dim>(solver, std::span(&function, 1), psi, held_mean);
  if (!evaluated) return evaluated.failure();
  return std::move(evaluated->evaluation);
}

/// The states at all load positions.
template <int dim>
Expected<std::shared_ptr<const State<dim>>> all_states(const StateSolver<dim>& solver,
                                                       const LevelSet<dim>& psi) {
  return solver.states(psi, solver.all_positions(), Interrupt());
}

/// A functional summed over the load positions of those states.
template <int dim>
double value_of(const Functional<dim>& functional, const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                const State<dim>& state, const Matrix& mean) {
  const auto value = functional.evaluate(solver, psi, state, mean);
  return std::inner_product(value.by_position.begin(), value.by_position.end(),
                            state.positions().multiplicities.begin(), value.of_shape);
}

/// A hole whose boundary touches no grid line, and a direction with several wave lengths: where a Taylor test
/// finds the same cells cut at all its steps.
inline LevelSet<2> generic_hole(const PolarGrid<2>& grid) {
  return holes(grid, 2, {{0.2681, 0.47 * grid.sector_angle(), 0.0373}});
}
inline std::vector<double> smooth_direction(const Lattice<2>& lattice) {
  std::vector<double> direction;
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    const Vec<2> p = lattice.polar_point(i);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(40 * (p[0] - 0.27)));
  }
  return direction;
}

/// The Taylor test of an objective there.
inline Expected<TaylorTest> generic_taylor_test(const RollingProblem<2>& problem,
                                                const WeightedSum<2>& terms) {
  const auto psi = generic_hole(problem.model().grid);
  return taylor_test<2>(
      [&](const LevelSet<2>& shape) { return evaluate_objective<2>(problem, terms, shape); }, psi,
      smooth_direction(psi.lattice), problem.model().degree, 2e-5, 3);
}

/// The evaluation of an objective with this value and this gradient.
template <int dim>
Evaluation<dim> evaluation_with(double objective, const std::vector<SurfaceSample<dim>>& gradient) {
  Evaluation<dim> evaluation;
  evaluation.functions.push_back({"objective", objective, {}, {}, {}});
  for (const auto& sample : gradient) {
    evaluation.boundary.push_back(sample);
    evaluation.functions[0].gradient.push_back(sample.value);
  }
  return evaluation;
}

/// An objective that depends only on the shape and provides no solution, for the loop.
template <int dim, class EvaluateShape>
typename ShapeOptimizer<dim>::Evaluate objective_of_shape(EvaluateShape evaluate) {
  return [evaluate](const CutShape<dim>& shape, const Evaluation<dim>*) mutable -> Expected<Evaluated<dim>> {
    auto evaluation = evaluate(shape.psi);
    if (!evaluation) return evaluation.failure();
    return Evaluated<dim>{*std::move(evaluation), nullptr};
  };
}

}  // namespace wheelwright::testing
