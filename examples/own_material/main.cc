// Computes the wheel of a case file, made of a material that the library does not know. Prints for several
// temperatures: the temperature [C]; then strain energy [J/m], peak of the von Mises stress [Pa] and the norm
// of the shape gradient of the energy, first with the own law and then with the built-in law of the same
// constants. usage: own_material CASE

#include <wheelwright/wheelwright.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "warm_polymer.h"

using namespace wheelwright;

namespace {

/// Prints the results of a study's initial shape with another material.
bool print_results(Study<2> study, const Materials<2>& materials) {
  RollingModel<2> model = study.model();
  model.materials = materials;
  const auto solver = make_solver<2>(model);
  if (!solver) return false;
  study.solver = *solver;
  const auto solved = evaluate_of(study)(study.initial, nullptr);
  if (!solved) return false;
  const FunctionValue& energy = solved->evaluation.function("objective");
  double peak = 0, square = 0;
  for (const double s : solved->state->strain_peaks().von_mises) peak = std::max(peak, s);
  for (std::size_t i = 0; i < energy.gradient.size(); ++i)
    square += solved->evaluation.boundary[i].weight * energy.gradient[i] * energy.gradient[i];
  std::printf(" %.17g %.17g %.17g", energy.value, peak, std::sqrt(square));
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  restart_with_blas_settings(arguments);
  const CaseResult wheel = read_case(count > 1 ? arguments[1] : "");
  for (const Diagnostic& problem : wheel.problems) std::fprintf(stderr, "%s\n", problem.text().c_str());
  if (!wheel.value) return 2;

  const auto study = make_study<2>(*wheel.value);
  if (!study) return 1;
  Material constants = wheel.value->material;
  for (const double temperature : {20.0, 60.0}) {
    const auto polymer = std::make_shared<WarmPolymer>(wheel.value->material.youngs_modulus,
                                                       constants.poissons_ratio, temperature);
    constants.youngs_modulus = polymer->youngs_modulus();
    std::printf("%g", temperature);
    if (!print_results(*study, Materials<2>(polymer)) || !print_results(*study, constants)) return 1;
    std::printf("\n");
  }
  return 0;
}
