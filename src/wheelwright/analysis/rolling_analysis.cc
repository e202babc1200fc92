#include "wheelwright/analysis/rolling_analysis.h"

#include <algorithm>

#include "wheelwright/analysis/all_positions.h"

namespace wheelwright {
namespace {

template <int dim>
RollingModel<dim> at_load(RollingModel<dim> model, double load) {
  model.load = load;
  model.travel.reset();
  return model;
}

template <int dim>
RollingModel<dim> at_travel(RollingModel<dim> model, double travel) {
  model.travel = travel;
  return model;
}

template <int dim>
std::vector<ContactSummary> summaries(const std::vector<ContactPatch<dim>>& contacts) {
  std::vector<ContactSummary> result;
  for (const ContactPatch<dim>& contact : contacts) result.push_back(contact_summary(contact));
  return result;
}

template <int dim>
Expected<std::vector<std::vector<ContactSummary>>> under(const State<dim>& state,
                                                         std::span<const RollingModel<dim>> models) {
  const auto contacts = state.contacts_under(models);
  if (!contacts) return contacts.failure();
  std::vector<std::vector<ContactSummary>> result;
  for (const auto& of_model : *contacts) result.push_back(summaries(of_model));
  return result;
}

std::vector<double> values(const std::vector<ContactSummary>& positions, double ContactSummary::*member) {
  std::vector<double> result;
  for (const ContactSummary& position : positions) result.push_back(position.*member);
  return result;
}

/// From the positions that were solved to all positions of a sector.
template <int dim>
RollingAnalysis of_all_positions(RollingAnalysis a, const LoadPositions& solved,
                                 const RollingModel<dim>& model) {
  if (!solved.stand_for_images()) return a;
  const auto sources = position_sources(solved, model.n_positions);
  const std::vector<ContactSummary> contacts = std::move(a.positions);
  a.positions.clear();
  for (const PositionSource& source : sources)
    a.positions.push_back(source.is_image ? mirror_image(contacts[source.solved]) : contacts[source.solved]);
  a.azimuths.clear();
  for (size_t i = 0; i < sources.size(); ++i)
    a.azimuths.push_back(i * model.grid.sector_angle() / static_cast<double>(sources.size()));
  for (auto* values :
       {&a.strain_energy, &a.peak_von_mises, &a.peak_strain, &a.travel_at_load, &a.force_at_travel})
    *values = of_all(solved, *values);
  return a;
}

/// Equal weights for all positions of a sector, also where one of them stands for two.
double mean(const LoadPositions& solved, const std::vector<double>& values) {
  return rolling_variation(of_all(solved, values)).mean;
}

}  // namespace

template <int dim>
Expected<RollingAnalysis> rolling_analysis(const StateSolver<dim>& solver, const State<dim>& state) {
  const RollingModel<dim>& model = state.model();
  RollingAnalysis analysis{};
  analysis.held = model.travel ? Held::travel : Held::load;
  for (const GroundPosition& ground : state.positions().grounds)
    analysis.azimuths.push_back(ground.azimuth(model.grid));
  analysis.positions = summaries(state.contacts());
  analysis.strain_energy = state.strain_energy();
  const StrainPeaks<dim>& peaks = state.strain_peaks();
  analysis.peak_von_mises = peaks.von_mises;
  analysis.peak_strain = peaks.principal;
  analysis.most_stressed =
      std::ranges::max_element(analysis.peak_von_mises) - analysis.peak_von_mises.begin();
  analysis.peak_radius = peaks.von_mises_places[analysis.most_stressed][0];
  analysis.peak_azimuth = peaks.von_mises_places[analysis.most_stressed][1];

  if (analysis.held == Held::travel) {
    analysis.force_at_travel = values(analysis.positions, &ContactSummary::radial_force);
    analysis.travel = *model.travel;
    analysis.load = mean(state.positions(), analysis.force_at_travel);
  } else {
    analysis.travel_at_load = values(analysis.positions, &ContactSummary::travel);
    analysis.load = model.load;
    analysis.travel = mean(state.positions(), analysis.travel_at_load);
  }
  const RollingModel<dim> other =
      analysis.held == Held::travel ? at_load(model, analysis.load) : at_travel(model, analysis.travel);
  const auto held_otherwise = under<dim>(state, std::span(&other, 1));
  if (!held_otherwise) return held_otherwise.failure();
  if (analysis.held == Held::travel)
    analysis.travel_at_load = values(held_otherwise->front(), &ContactSummary::travel);
  else
    analysis.force_at_travel = values(held_otherwise->front(), &ContactSummary::radial_force);
  return of_all_positions(std::move(analysis), state.positions(), model);
}

template <int dim>
Expected<std::vector<std::vector<ContactSummary>>> under_loads(const State<dim>& state,
                                                               std::span<const double> loads) {
  std::vector<RollingModel<dim>> models;
  for (const double load : loads) models.push_back(at_load(state.model(), load));
  return under<dim>(state, models);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                               \
  template Expected<RollingAnalysis> rolling_analysis(const StateSolver<dim>&, const State<dim>&); \
  template Expected<std::vector<std::vector<ContactSummary>>> under_loads(const State<dim>&,       \
                                                                          std::span<const double>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
