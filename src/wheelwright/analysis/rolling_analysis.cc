#include "wheelwright/analysis/rolling_analysis.h"

#include "wheelwright/analysis/stress_peak.h"

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
Expected<std::vector<ContactSummary>> reload_all(const RollingModel<dim>& model,
                                                 const RollingProblem<dim>& problem,
                                                 const RollingSolution<dim>& solution,
                                                 std::vector<RolledContact<dim>>& positions) {
  std::vector<ContactSummary> result;
  for (size_t i = 0; i < positions.size(); ++i) {
    auto rolled = reload(model, problem.tread(), solution.ring, solution.surface,
                         solution.positions.grounds[i], solution.preloads[i], positions[i]);
    if (!rolled) return rolled.failure();
    positions[i] = *std::move(rolled);
    result.push_back(contact_summary(positions[i].contact, positions[i].state));
  }
  return result;
}

template <int dim>
std::vector<RolledContact<dim>> rolled_contacts(const RollingSolution<dim>& solution) {
  std::vector<RolledContact<dim>> result;
  for (size_t i = 0; i < solution.contacts.size(); ++i)
    result.push_back({solution.contacts[i], solution.states[i]});
  return result;
}

std::vector<double> values(const std::vector<ContactSummary>& positions, double ContactSummary::*member) {
  std::vector<double> result;
  for (const ContactSummary& position : positions) result.push_back(position.*member);
  return result;
}

}  // namespace

template <int dim>
Expected<RollingAnalysis> rolling_analysis(const RollingProblem<dim>& problem,
                                           const RollingSolution<dim>& solution) {
  RollingAnalysis analysis{};
  analysis.held = problem.model().travel ? Held::travel : Held::load;
  for (const GroundPosition& ground : solution.positions.grounds)
    analysis.azimuths.push_back(ground.azimuth(problem.model().grid));
  for (size_t i = 0; i < solution.contacts.size(); ++i)
    analysis.positions.push_back(contact_summary(solution.contacts[i], solution.states[i]));
  analysis.strain_energy = solution.strain_energy;
  analysis.peak_von_mises = peak_von_mises(problem, solution);

  const RollingModel<dim>& model = problem.model();
  auto contacts = rolled_contacts(solution);
  if (analysis.held == Held::travel) {
    analysis.force_at_travel = values(analysis.positions, &ContactSummary::radial_force);
    analysis.travel = *model.travel;
    analysis.load = rolling_variation(analysis.force_at_travel).mean;
    const auto other = reload_all(at_load(model, analysis.load), problem, solution, contacts);
    if (!other) return other.failure();
    analysis.travel_at_load = values(*other, &ContactSummary::travel);
  } else {
    analysis.travel_at_load = values(analysis.positions, &ContactSummary::travel);
    analysis.load = model.load;
    analysis.travel = rolling_variation(analysis.travel_at_load).mean;
    const auto other = reload_all(at_travel(model, analysis.travel), problem, solution, contacts);
    if (!other) return other.failure();
    analysis.force_at_travel = values(*other, &ContactSummary::radial_force);
  }
  return analysis;
}

template <int dim>
Expected<std::vector<std::vector<ContactSummary>>> under_loads(const RollingProblem<dim>& problem,
                                                               const RollingSolution<dim>& solution,
                                                               std::span<const double> loads) {
  auto contacts = rolled_contacts(solution);
  std::vector<std::vector<ContactSummary>> result;
  for (const double load : loads) {
    auto positions = reload_all(at_load(problem.model(), load), problem, solution, contacts);
    if (!positions) return positions.failure();
    result.push_back(*std::move(positions));
  }
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                \
  template Expected<RollingAnalysis> rolling_analysis(const RollingProblem<dim>&,   \
                                                      const RollingSolution<dim>&); \
  template Expected<std::vector<std::vector<ContactSummary>>> under_loads(          \
      const RollingProblem<dim>&, const RollingSolution<dim>&, std::span<const double>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
