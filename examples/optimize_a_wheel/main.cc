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

  const auto study = make_study<2>(*wheel.value);
  if (!study) return 1;
  const auto print = [&](const Trial<2>& trial, const OptimizationState<2>& state) {
    if (trial.verdict == Verdict::accepted)
      std::printf("%d %.17g %.17g\n", state.iteration, state.evaluation.function("objective").value,
                  volume_fraction(study->grid(), state.measure));
  };
  const auto outcome = optimize<2>(optimizer_of(*study), study->initial, print, [] { return false; });
  return outcome.state ? 0 : 1;
}
