#include "wheelwright/quantities/analysis/rolling_analysis.h"

#include <algorithm>

#include "wheelwright/quantities/analysis/all_positions.h"
#include "wheelwright/quantities/analysis/shape_summary.h"

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
Expected<std::vector<ContactSummary>> summaries(const Expected<std::vector<ContactPatch<dim>>>& contacts) {
  if (!contacts) return contacts.failure();
  return summaries(*contacts);
}

template <int dim>
Expected<std::vector<ContactSummary>> under(const State<dim>& state, const RollingModel<dim>& model,
                                            const Interrupt& interrupt) {
  return summaries(state.contacts_under(std::span(&model, 1), interrupt).front());
}

std::vector<double> values(const std::vector<ContactSummary>& positions, double ContactSummary::*member) {
  std::vector<double> result;
  for (const ContactSummary& position : positions) result.push_back(position.*member);
  return result;
}

/// Equal weights for all positions of a sector, even if one of them represents two.
double mean(const LoadPositions& solved, const std::vector<double>& values) {
  return rolling_variation(of_all(solved, values)).mean;
}

/// By how far the axle descends at each position, from the mean height at which the wheel touches the ground
/// without load: all descents, moved to the mean of the travels.
std::vector<double> axle_travel(const LoadPositions& solved, const std::vector<ContactSummary>& positions) {
  std::vector<double> result = values(positions, &ContactSummary::descent);
  const double growth = mean(solved, values(positions, &ContactSummary::travel)) - mean(solved, result);
  for (double& descent : result) descent += growth;
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
  const auto deformations = std::move(a.deformations);
  a.deformations.clear();
  for (const PositionSource& source : sources) a.deformations.push_back(deformations[source.solved]);
  for (auto* values : {&a.strain_energy, &a.peak_von_mises, &a.peak_strain})
    *values = of_all(solved, *values);
  for (auto* values : {&a.travel_at_load, &a.force_at_travel})
    if (*values) **values = of_all(solved, **values);
  return a;
}

}  // namespace

template <int dim>
RollingAnalysis rolling_analysis(const StateSolver<dim>& solver, const State<dim>& state,
                                 const Interrupt& interrupt) {
  const RollingModel<dim>& model = state.model();
  const StrainPeaks<dim>& peaks = state.strain_peaks();
  const int worst = most_stressed_position(state);
  const std::vector<ContactSummary> positions = summaries(state.contacts());
  const Held held = model.travel ? Held::travel : Held::load;
  const std::vector<double> travels = axle_travel(state.positions(), positions),
                            forces = values(positions, &ContactSummary::radial_force);
  RollingAnalysis analysis{
      .held = held,
      .azimuths = {},
      .positions = positions,
      .strain_energy = state.strain_energy(),
      .peak_von_mises = peaks.von_mises,
      .peak_strain = peaks.principal,
      .deformations = position_deformations(solver, state),
      .most_stressed = static_cast<size_t>(worst),
      .peak_radius = peaks.von_mises_places[worst][0],
      .peak_azimuth = peaks.von_mises_places[worst][1],
      .layers = layer_results(solver, state),
      .load = held == Held::load ? model.load : mean(state.positions(), forces),
      .travel = held == Held::travel ? *model.travel : mean(state.positions(), travels),
      .travel_at_load = travels,
      .force_at_travel = forces,
  };
  for (const GroundPosition& ground : state.positions().grounds)
    analysis.azimuths.push_back(ground.azimuth(solver.model().grid));
  const auto held_otherwise =
      under(state, held == Held::load ? at_travel(model, analysis.travel) : at_load(model, analysis.load),
            interrupt);
  auto& unknown = held == Held::load ? analysis.force_at_travel : analysis.travel_at_load;
  if (!held_otherwise)
    unknown = held_otherwise.failure();
  else if (held == Held::load)
    unknown = values(*held_otherwise, &ContactSummary::radial_force);
  else
    unknown = axle_travel(state.positions(), *held_otherwise);
  return of_all_positions(std::move(analysis), state.positions(), model);
}

template <int dim>
std::vector<Expected<std::vector<ContactSummary>>> under_loads(const State<dim>& state,
                                                               std::span<const double> loads,
                                                               const Interrupt& interrupt) {
  std::vector<RollingModel<dim>> models;
  for (const double load : loads) models.push_back(at_load(state.model(), load));
  std::vector<Expected<std::vector<ContactSummary>>> result;
  for (const auto& contacts : state.contacts_under(models, interrupt)) result.push_back(summaries(contacts));
  return result;
}

std::optional<double> tangent_stiffness(std::span<const ContactSummary> positions) {
  double compliance = 0;
  for (const ContactSummary& position : positions) {
    if (!position.stiffness) return {};
    compliance += 1 / *position.stiffness / static_cast<double>(positions.size());
  }
  return 1 / compliance;
}

template decltype(rolling_analysis<2>) rolling_analysis<2>;
template decltype(under_loads<2>) under_loads<2>;
template decltype(rolling_analysis<3>) rolling_analysis<3>;
template decltype(under_loads<3>) under_loads<3>;

}  // namespace wheelwright
