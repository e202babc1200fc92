#include "wheelwright/quantities/analysis/shape_summary.h"

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
int most_stressed_position(const State<dim>& state) {
  const std::vector<double>& peaks = state.strain_peaks().von_mises;
  return static_cast<int>(std::ranges::max_element(peaks) - peaks.begin());
}

template <int dim>
StressPeak<dim> stress_peak(const StateSolver<dim>& solver, const State<dim>& state) {
  const StrainPeaks<dim>& peaks = state.strain_peaks();
  const int worst = most_stressed_position(state);
  return {peaks.von_mises[worst], peaks.von_mises_places[worst],
          state.positions().grounds[worst].azimuth(solver.model().grid)};
}

template <int dim>
ShapeSummary<dim> shape_summary(const StateSolver<dim>& solver, const State<dim>& state) {
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
          .von_mises = stress_peak(solver, state)};
}

template decltype(contact_summaries<2>) contact_summaries<2>;
template decltype(most_stressed_position<2>) most_stressed_position<2>;
template decltype(stress_peak<2>) stress_peak<2>;
template decltype(shape_summary<2>) shape_summary<2>;
template decltype(contact_summaries<3>) contact_summaries<3>;
template decltype(most_stressed_position<3>) most_stressed_position<3>;
template decltype(stress_peak<3>) stress_peak<3>;
template decltype(shape_summary<3>) shape_summary<3>;

}  // namespace wheelwright
