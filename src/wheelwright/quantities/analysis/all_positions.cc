#include "wheelwright/quantities/analysis/all_positions.h"

#include "wheelwright/mechanics/state/load_case.h"

namespace wheelwright {

std::vector<PositionSource> position_sources(const LoadPositions& solved, int n) {
  std::vector<PositionSource> sources;
  for (int i = 0; i < solved.size(); ++i) sources.push_back({i, false});
  if (solved.stand_for_images())
    for (int i = solved.size(); i < n; ++i) sources.push_back({n - i, true});
  return sources;
}

template <int dim>
Expected<std::shared_ptr<const State<dim>>> on_all_positions(const StateSolver<dim>& solver,
                                                             const LevelSet<dim>& psi,
                                                             const State<dim>& state) {
  auto all = solver.states({psi, &state.domain()}, solver.all_positions(), Interrupt());
  if (!all) return all;
  return (*all)->under(with_loads((*all)->model(), state.model()), Interrupt());
}

template decltype(on_all_positions<2>) on_all_positions<2>;
template decltype(on_all_positions<3>) on_all_positions<3>;

}  // namespace wheelwright
