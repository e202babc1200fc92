#include "wheelwright/quantities/analysis/rolling_losses.h"

#include <numeric>

#include "wheelwright/mechanics/state/turn_losses.h"
#include "wheelwright/quantities/analysis/all_positions.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"

namespace wheelwright {
namespace {

double total(const std::vector<double>& forces) { return std::accumulate(forces.begin(), forces.end(), 0.0); }

template <int dim>
double mean_ground_force(const State<dim>& state) {
  double sum = 0;
  for (const ContactPatch<dim>& contact : state.contacts()) sum += contact_summary(contact).radial_force;
  return sum / static_cast<double>(state.contacts().size());
}

}  // namespace

template <int dim>
std::optional<Expected<RollingLosses>> rolling_losses(const StateSolver<dim>& solver,
                                                      const LevelSet<dim>& psi, const State<dim>& state) {
  if (!has_loss_factors(solver.model().materials)) return {};
  if (state.positions().stand_for_images()) {
    const auto all = on_all_positions(solver, psi, state);
    if (!all) return all.failure();
    return rolling_losses(solver, psi, **all);
  }
  const auto of_layers = resistance_of_layers(solver, state);
  RollingLosses losses{};
  losses.by_harmonic.resize(of_layers.front().size(), 0.0);
  for (const auto& layer : of_layers) {
    for (std::size_t n = 0; n < layer.size(); ++n) losses.by_harmonic[n] += layer[n];
    if (of_layers.size() > 1) losses.by_layer.push_back(total(layer));
  }
  losses.resistance = total(losses.by_harmonic);
  losses.coefficient = losses.resistance / mean_ground_force(state);
  losses.beyond = resistance_beyond(losses.by_harmonic);
  return losses;
}

template decltype(rolling_losses<2>) rolling_losses<2>;
template decltype(rolling_losses<3>) rolling_losses<3>;

}  // namespace wheelwright
