#include "wheelwright/mechanics/rolling/energy_by_harmonic.h"

#include <cassert>
#include <numeric>

#include "wheelwright/mechanics/rolling/recovery.h"
#include "wheelwright/mechanics/state/turn_harmonics.h"

namespace wheelwright {
namespace {

/// Amplitudes of the waves in place of the load cases.
SectorFields in_waves(const Matrix& waves, const SectorFields& fields) {
  if (fields.empty()) return {};
  return {fields.modes, product(waves, Op::transpose, fields.weights, Op::none)};
}

}  // namespace

template <int dim>
std::vector<double> energy_by_harmonic(const RollingProblem<dim>& problem, const RollingSolution<dim>& s) {
  assert(!s.positions.stand_for_images());
  const TurnHarmonics turn(s.positions.size(), s.ring.n_sectors());
  const Matrix waves = turn.waves();
  const SectorFields displacement = in_waves(waves, s.displacement),
                     core_loads = in_waves(waves, s.core_loads);
  const Matrix observations = combined_blocks(s.observations, waves),
               tread_loads = combined_blocks(s.tread_loads, waves);
  std::vector<int> columns(tread_loads.columns());
  std::iota(columns.begin(), columns.end(), 0);
  const auto of_waves =
      strain_energies({displacement, observations, s.ghost_loads, core_loads, tread_loads, columns},
                      turn.n_cases(), problem.nitsche_factors());
  std::vector<double> energies(turn.n_harmonics(), 0.0);
  for (int wave = 0; wave < turn.n_cases(); ++wave)
    energies[TurnHarmonics::harmonic(wave)] += of_waves[wave] / s.positions.size();
  return energies;
}

template decltype(energy_by_harmonic<2>) energy_by_harmonic<2>;
template decltype(energy_by_harmonic<3>) energy_by_harmonic<3>;

}  // namespace wheelwright
