/// The times of evaluations of a case's initial shape, values and gradients, on one thread: prints their
/// median in seconds. With fourth_power the case's functions and the integral of the fourth power of the von
/// Mises stress, as python/bench/overhead.py has it in numpy. usage: evaluations CASE REPETITIONS
/// none|fourth_power [KEY=NUMBER ...]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "given_case.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/quantities/functionals/material_density_integral.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright::bench {
namespace {

/// int (von Mises stress / MPa)^4 dx.
class FourthPower : public MaterialDensityIntegral<2> {
 public:
  std::string name() const override { return "fourth_power"; }

 private:
  Value at(const Voigt<2>& strain, const MaterialLaw<2>& law) const override {
    Voigt<2> slope;
    double square = 0;
    law.squared_von_mises(one_strain<2>(strain), std::span(&square, 1));
    law.squared_von_mises_slope(one_strain<2>(strain), one_stress<2>(slope));
    for (double& s : slope) s *= 2e-24 * square;
    return {1e-24 * square * square, slope};
  }
};

int run(const Case& c, int repetitions, bool with_fourth_power) {
  const ThreadLimit one(1);
  keep_freed_memory();
  auto study = make_study<2>(c);
  if (!study) return EXIT_FAILURE;
  if (with_fourth_power)
    study->functions.push_back(
        {.name = "fourth_power", .terms = {{1, std::make_shared<const FourthPower>()}}});
  std::vector<double> seconds;
  for (int k = 0; k < repetitions; ++k) {
    Stopwatch watch;
    if (!evaluate_of(*study)(study->initial, nullptr)) return EXIT_FAILURE;
    seconds.push_back(watch.lap());
  }
  std::ranges::sort(seconds);
  fmt::print("{}\n", seconds[seconds.size() / 2]);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  using namespace wheelwright;
  restart_with_blas_settings(arguments);
  if (count < 4) return EXIT_FAILURE;
  const auto c = bench::given_case(arguments[1], std::span(arguments + 4, count - 4));
  if (!c) return EXIT_FAILURE;
  return bench::run(*c, std::atoi(arguments[2]), std::string_view(arguments[3]) == "fourth_power");
}
