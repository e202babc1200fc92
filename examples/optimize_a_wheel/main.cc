// Optimizes the wheel of a case file. Prints a line for every accepted shape: its number, objective [J/m] and
// volume, as a fraction of the ring. usage: optimize_a_wheel CASE

#include <wheelwright/wheelwright.h>

#include <cstdio>

using namespace wheelwright;

int main(int count, char** arguments) {
  restart_with_blas_settings(arguments);
  const CaseResult wheel = read_case(count > 1 ? arguments[1] : "");
  for (const Diagnostic& problem : wheel.problems) std::fprintf(stderr, "%s\n", problem.text().c_str());
  if (!wheel.value) return 2;

  const auto problem = RollingProblem<2>::create(rolling_model(*wheel.value));
  if (!problem) return 1;
  const auto objective = criteria(*wheel.value, *problem);
  if (!objective) return 1;

  const LevelSet<2> initial = initial_shape(*wheel.value);
  const ShapeOptimizer<2> optimizer(
      initial.lattice, evolution_options(*wheel.value), optimizer_options(*wheel.value),
      [&](const LevelSet<2>& shape) { return evaluate<2>(*problem, *objective, shape); });
  const auto print = [&](const Trial<2>& trial, const OptimizationState<2>& state) {
    if (trial.verdict == Verdict::accepted)
      std::printf("%d %.17g %.17g\n", state.iteration, state.evaluation.objective,
                  volume_fraction(initial.lattice.grid(), state.measure));
  };
  return optimize<2>(optimizer, initial, print, [] { return false; }).state ? 0 : 1;
}
