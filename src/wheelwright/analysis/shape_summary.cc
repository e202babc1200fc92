#include "wheelwright/analysis/shape_summary.h"

#include <algorithm>

namespace wheelwright {

template <int dim>
std::vector<ContactSummary> contact_summaries(const State<dim>& state) {
  std::vector<ContactSummary> positions;
  for (size_t i = 0; i < state.contacts().size(); ++i) {
    positions.push_back(contact_summary(state.contacts()[i]));
    if (state.positions().multiplicities[i] > 1) positions.push_back(mirror_image(positions.back()));
  }
  return positions;
}

template <int dim>
StressPeak<dim> stress_peak(const StateSolver<dim>& solver, const State<dim>& state) {
  const StrainPeaks<dim>& peaks = state.strain_peaks();
  const auto worst = std::ranges::max_element(peaks.von_mises) - peaks.von_mises.begin();
  return {peaks.von_mises[worst], peaks.von_mises_places[worst],
          state.positions().grounds[worst].azimuth(solver.model().grid)};
}

template <int dim>
ShapeSummary<dim> shape_summary(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state) {
  const auto contacts = contact_summaries(state);
  double force = 0, travel = 0, energy = 0;
  for (const ContactSummary& contact : contacts) {
    force += contact.radial_force;
    travel += contact.travel;
  }
  for (int i = 0; i < state.positions().size(); ++i)
    energy += state.positions().multiplicities[i] * state.strain_energy()[i];
  return {.rolling = rolling_measures(contacts),
          .strain_energy = energy / contacts.size(),
          .stiffness = force / travel,
          .von_mises = stress_peak(solver, state),
          .deformation = deformation_size(solver, psi, state)};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                \
  template std::vector<ContactSummary> contact_summaries(const State<dim>&);        \
  template StressPeak<dim> stress_peak(const StateSolver<dim>&, const State<dim>&); \
  template ShapeSummary<dim> shape_summary(const StateSolver<dim>&, const LevelSet<dim>&, const State<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
