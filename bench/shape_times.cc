/// Solves one shape of the paper's 16-hole wheel, with the paper's ghost penalty (81) and xi = 1e-3, in all
/// load positions, mirror images too, and prints answers and times as JSON: strain energy and rim
/// displacement of every load position, and the phases of the fastest repetition. The function that is
/// differentiated is the strain energy, or the rolling resistance.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <string>
#include <vector>

#include "tests/support.h"
#include "unavoidable_work.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/quantities/functionals/rolling_resistance.h"

namespace wheelwright::bench {
namespace {

double total(const std::vector<PhaseTime>& phases) {
  return std::accumulate(phases.begin(), phases.end(), 0.0,
                         [](double sum, const PhaseTime& phase) { return sum + phase.seconds; });
}

std::string to_json(int n_unknowns, const State<2>& states, const std::vector<PhaseTime>& phases) {
  std::vector<std::string> positions, seconds;
  for (size_t i = 0; i < states.contacts().size(); ++i)
    positions.push_back(
        fmt::format(R"({{"strain_energy": {}, "rim_displacement": {}, "newton_iterations": {}}})",
                    states.strain_energy()[i], states.contacts()[i].rim.towards_ground,
                    states.contacts()[i].newton_iterations));
  for (const PhaseTime& phase : phases)
    seconds.push_back(fmt::format(R"("{}": {})", phase.phase, phase.seconds));
  return fmt::format("{{\"unknowns\": {},\n \"positions\": [{}],\n \"seconds\": {{{}}}}}\n", n_unknowns,
                     fmt::join(positions, ",\n  "), fmt::join(seconds, ", "));
}

int run(int radial_cells, int angular_cells, int n_positions, int repetitions, bool of_resistance) {
  auto model = testing::paper_model(radial_cells, angular_cells);
  model.ghost = {GhostPenaltyKind::paper, 1e-3};
  model.dilatation = DilatationKind::pointwise;
  model.n_positions = n_positions;
  if (of_resistance) {
    Material material = *model.materials.at_tread().isotropic();
    material.loss_factor = 0.1;
    model.materials = material;
  }
  const auto problem = RollingProblem<2>::create(model);
  if (!problem) {
    fmt::print(stderr, "{}\n", problem.failure().detail);
    return 1;
  }
  const auto psi = testing::paper_holes(model.grid);
  std::vector<PhaseTime> fastest;
  const ShapeFunction<2> function =
      objective(of_resistance ? WeightedSum<2>{{1, std::make_shared<RollingResistance<2>>(model)}}
                              : testing::strain_energy_alone());
  std::shared_ptr<const State<2>> states;
  for (int i = 0; i < repetitions; ++i) {
    const auto solved = testing::all_states<2>(*problem, psi);
    if (solved) states = *solved;
    const auto evaluation = solved ? differentiate<2>(*problem, std::span(&function, 1), psi, *states)
                                   : Expected<Evaluation<2>>(solved.failure());
    if (!evaluation) {
      fmt::print(stderr, "{}\n", evaluation.failure().detail);
      return 1;
    }
    if (fastest.empty() || total(evaluation->phases) < total(fastest)) fastest = evaluation->phases;
  }
  fmt::print("{}", to_json(ring_unknowns(problem->solve(psi)->ring.sector().space), *states, fastest));
  return 0;
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  wheelwright::restart_with_blas_settings(arguments);
  wheelwright::keep_freed_memory();
  const wheelwright::ThreadLimit one_thread(1);
  const bool of_resistance = count == 6 && arguments[5] == std::string("resistance");
  if (count != 5 && !of_resistance) {
    fmt::print(stderr, "usage: {} RADIAL_CELLS ANGULAR_CELLS POSITIONS REPETITIONS [resistance]\n",
               arguments[0]);
    return 2;
  }
  return wheelwright::bench::run(std::atoi(arguments[1]), std::atoi(arguments[2]), std::atoi(arguments[3]),
                                 std::atoi(arguments[4]), of_resistance);
}
