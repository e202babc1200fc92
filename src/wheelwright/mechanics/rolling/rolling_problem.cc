#include "wheelwright/mechanics/rolling/rolling_problem.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/periodic.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/contact/contact_results.h"
#include "wheelwright/mechanics/rolling/contact_failure.h"
#include "wheelwright/mechanics/rolling/recovery.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {

template <int dim>
std::vector<double> case_multiplicities(const RollingSolution<dim>& solution) {
  return case_multiplicities(solution.positions, solution.ring.n_sectors());
}

template <int dim>
SectorFields complete_displacement(const RollingSolution<dim>& solution) {
  // Loads in the core act on all of it: then the sweep has visited all unknowns.
  return solution.core_loads.empty() ? completed(solution.ring, solution.displacement)
                                     : solution.displacement;
}

namespace {

/// The components of the column frame that contact meets: without friction and lean the ground pushes in the
/// plane of the wheel.
template <int dim>
int components_in_contact(const RollingModel<dim>& model) {
  const bool is_in_plane = !contact_law_of(model)->is_tangential() && model.camber == 0;
  return is_in_plane ? std::min(2, dim) : dim;
}

/// Why the materials of a model, or its rows, are not those of a linear ring.
template <int dim>
std::optional<Failure> unsupported_material(const RollingModel<dim>& model) {
  if (!model.materials.fit(model.grid))
    return Failure{FailureReason::unsupported_model, "layers of materials end between the lines of the grid"};
  const int rows = model.grid.cells[0];
  if (model.grid.equal_rows(rows - 1).first > rows - model.tread.rows)
    return Failure{FailureReason::unsupported_model,
                   "the rows that are condensed at the tread differ in height"};
  for (int row = rows - model.tread.rows; row + 1 < rows; ++row)
    if (model.materials.is_interface(model.grid, row))
      return Failure{FailureReason::unsupported_model,
                     "materials meet in the rows that are condensed at the tread"};
  for (const auto& cord : model.materials.cords())
    if (model.grid.nearest_line(cord.radius).line > rows - model.tread.rows)
      return Failure{FailureReason::unsupported_model,
                     "a cord lies in the rows that are condensed at the tread"};
  for (const int line : model.design_lines)
    if (std::ranges::find(model.grid.fixed_lines, line, &FixedLine::line) == model.grid.fixed_lines.end() ||
        model.grid.equal_rows(line).end > rows - model.tread.rows)
      return Failure{FailureReason::unsupported_model,
                     "derivatives are wanted with respect to the radius of a line that is not fixed, or that "
                     "stretches rows that are condensed at the tread"};
  for (int row = 0; row < model.grid.cells[0]; ++row) {
    const MaterialLaw<dim>& law = model.materials.in_row(model.grid, row);
    const Material* isotropic = law.isotropic();
    const OrthotropicMaterial* orthotropic = law.orthotropic();
    if (dim == 3 && ((isotropic && isotropic->plane == Plane::stress) ||
                     (orthotropic && orthotropic->plane == Plane::stress)))
      return Failure{FailureReason::unsupported_model, "plane stress is for two dimensions only"};
    if (const auto fault = fault_of_linear_law<dim>(law))
      return Failure{FailureReason::unsupported_model,
                     "the material law does not suit linear elasticity: " + *fault};
    if (orthotropic && orthotropic->locks())
      return Failure{FailureReason::unsupported_model,
                     "an orthotropic material is so nearly incompressible that the elements lock"};
  }
  return {};
}

/// Cords lie in material: their nodes are those of the cells below them.
template <int dim>
std::optional<Failure> cord_in_a_hole(const Materials<dim>& materials, const CutDomain<dim>& domain) {
  if (materials.cords().empty()) return {};
  for (int cell = 0; cell < domain.grid.n_cells(); ++cell)
    if (!domain.active(cell) && materials.cords_on(domain.grid, domain.grid.cell_position(cell)[0]) > 0)
      return Failure{FailureReason::protected_band, "a hole reaches a cord"};
  return {};
}

/// The ground's tractions in addition to other loads on the tread's observations.
template <int dim>
Matrix with_ground(Matrix tread_loads, const RolledContacts<dim>& rolled) {
  const int n_columns = tread_loads.columns() / static_cast<int>(rolled.contacts.size());
  for (size_t i = 0; i < rolled.contacts.size(); ++i) {
    const ContactZone& zone = rolled.contacts[i].zone();
    const Matrix loads = contact_loads(rolled.contacts[i], rolled.states[i]);
    for (int c = 0; c < zone.n_columns; ++c)
      std::copy_n(
          loads.column(c), loads.rows(),
          tread_loads.column(static_cast<int>(i) * n_columns + wrap(zone.first_column + c, n_columns)));
  }
  return tread_loads;
}

}  // namespace

template <int dim>
RollingProblem<dim>::RollingProblem(const RollingModel<dim>& model,
                                    std::unique_ptr<ElementTable<dim>> elements, Tread<dim> tread)
    : model_(model),
      elements_(std::move(elements)),
      harmonics_(model.grid.n_sectors),
      tread_(std::move(tread)) {}

template <int dim>
Expected<RollingProblem<dim>> RollingProblem<dim>::create(const RollingModel<dim>& model) {
  if (auto failure = unsupported_material(model)) return *failure;
  auto elements =
      std::make_unique<ElementTable<dim>>(model.grid, model.degree, model.materials, model.ghost,
                                          cell_stiffness<dim>, model.side_faces, model.dilatation);
  TreadGrid grid = model.tread;
  grid.observes_spin = grid.observes_spin || model.distributed.angular_speed != 0;
  auto tread = Tread<dim>::condense(*elements, grid, model.contact, model.contact_points,
                                    components_in_contact(model));
  if (!tread) return tread.failure();
  return RollingProblem(model, std::move(elements), *std::move(tread));
}

template <int dim>
std::vector<double> RollingProblem<dim>::nitsche_factors() const {
  std::vector<double> factors(tread_.n_observations(), 0.0);
  const ObservationRows<dim> rows = tread_.observation_rows();
  for (int q = 0; q < rows.n_points; ++q)
    for (int d = 0; d < dim; ++d)
      factors[rows.traction(q) + d] =
          -tread_.form().theta() / tread_.points()[q].gamma * tread_.points()[q].weight;
  return factors;
}

template <int dim>
Matrix RollingProblem<dim>::nitsche_loads(const Matrix& observations) const {
  const std::vector<double> factors = nitsche_factors();
  Matrix loads = observations;
  for (int j = 0; j < loads.columns(); ++j) {
    double* load = loads.column(j);
    for (int i = 0; i < loads.rows(); ++i) load[i] *= factors[i];
  }
  return loads;
}

template <int dim>
Expected<std::shared_ptr<const FactoredShape<dim>>> RollingProblem<dim>::factor(
    const CutShape<dim>& shape, const Interrupt& interrupt) const {
  std::vector<PhaseTime> phases;
  Stopwatch watch;
  auto domain = shape.domain ? Expected<CutDomain<dim>>(*shape.domain)
                             : cut_domain(shape.psi, model_.points_in_cut_cells());
  if (!domain) return domain.failure();
  if (auto failure = check_attached(*domain, protected_rim_rows(), protected_tread_rows())) return *failure;
  if (auto failure = cord_in_a_hole(model_.materials, *domain)) return *failure;
  phases.push_back({phase::cut, watch.lap()});
  if (auto failure = interrupt.before(phase::assembly)) return *failure;
  auto sector = sector_stiffness(*domain, *elements_, core_rows());
  phases.push_back({phase::assembly, watch.lap()});
  if (auto failure = interrupt.before(phase::factorization)) return *failure;
  auto factored = CyclicStiffness<dim>::factor(
      std::move(sector), [&](int harmonic) { return tread_.outer_stiffness(harmonics_, harmonic); },
      harmonics_);
  if (!factored) return factored.failure();
  phases.push_back({phase::factorization, watch.lap()});
  return std::make_shared<const FactoredShape<dim>>(
      FactoredShape<dim>{*std::move(domain), *std::move(factored), std::move(phases)});
}

template <int dim>
Expected<RollingSolution<dim>> RollingProblem<dim>::solve(const CutShape<dim>& shape, LoadPositions positions,
                                                          const Interrupt& interrupt) const {
  auto factored = factor(shape, interrupt);
  if (!factored) return factored.failure();
  auto solution = roll(model_, *factored, nullptr, std::move(positions), Ground::touched, interrupt);
  if (!solution) return solution.failure();
  const auto& phases = (*factored)->phases;
  solution->phases.insert(solution->phases.begin(), phases.begin(), phases.end());
  return solution;
}

template <int dim>
Expected<RollingSolution<dim>> RollingProblem<dim>::solve_under(const RollingModel<dim>& model,
                                                                const RollingSolution<dim>& solution,
                                                                const Interrupt& interrupt) const {
  return roll(model, solution.shape, solution.surface, solution.positions, Ground::touched, interrupt);
}

template <int dim>
Expected<RollingSolution<dim>> RollingProblem<dim>::without_load(const RollingSolution<dim>& solution) const {
  RollingModel<dim> model = solution.model;
  model.horizontal_force = model.lateral_force = model.torque = 0;
  model.distributed = {.angular_speed = model.distributed.angular_speed};
  double highest = 0;
  for (const StandingPoint<dim>& at : solution.standing) highest = std::max(highest, std::abs(at.growth));
  model.travel = -2 * highest - (model.grid.outer_radius - model.grid.inner_radius);
  return roll(model, solution.shape, solution.surface, solution.positions, Ground::out_of_reach, {});
}

/// `surface`: of the ring for these positions, or null.
template <int dim>
Expected<RollingSolution<dim>> RollingProblem<dim>::roll(
    const RollingModel<dim>& model, std::shared_ptr<const FactoredShape<dim>> shape,
    std::shared_ptr<const SurfaceCompliance<dim>> surface, LoadPositions positions, Ground reach,
    const Interrupt& interrupt) const {
  if (auto failure = interrupt.before(phase::contact)) return *failure;
  Stopwatch watch;
  Preloaded<dim> preloaded = preload(model, *elements_, tread_, *shape, positions);
  auto rolled = roll_to_all<dim>(model, tread_, shape->ring, std::move(surface), positions,
                                 preloaded.positions, interrupt);
  if (!rolled) return rolled.failure();
  for (int i = 0; i < positions.size() && reach == Ground::touched; ++i)
    if (auto failure = no_contact(model, rolled->contacts[i], rolled->states[i])) return *failure;
  Matrix on_tread = with_ground(preloaded.tread_loads, *rolled);
  std::vector<PhaseTime> phases{{phase::contact, watch.lap()}};
  if (auto failure = interrupt.before(phase::recovery)) return *failure;

  const TreadLoads loads = tread_loads(tread_, on_tread);
  auto fields = recover(*shape, tread_, positions, preloaded, loads);
  if (!fields) return fields.failure();
  auto energies =
      strain_energies(*fields, positions, preloaded.core_loads, on_tread, loads.columns, nitsche_factors());
  if (!energies) return energies.failure();
  phases.push_back({phase::recovery, watch.lap()});
  return RollingSolution<dim>{.shape = shape,
                              .domain = shape->domain,
                              .ring = shape->ring,
                              .model = model,
                              .surface = std::move(rolled->surface),
                              .positions = std::move(positions),
                              .contacts = std::move(rolled->contacts),
                              .states = std::move(rolled->states),
                              .sweep = std::move(fields->sweep),
                              .displacement = std::move(fields->displacement),
                              .outer_line = std::move(fields->outer_line),
                              .core_loads = std::move(preloaded.core_loads),
                              .tread_loads = std::move(on_tread),
                              .preloads = std::move(preloaded.positions),
                              .standing = std::move(preloaded.standing),
                              .observations = std::move(fields->observations),
                              .ghost_loads = std::move(fields->ghost_loads),
                              .strain_energy = *std::move(energies),
                              .phases = std::move(phases)};
}

template class RollingProblem<2>;
template class RollingProblem<3>;
template decltype(case_multiplicities<2>) case_multiplicities<2>;
template decltype(complete_displacement<2>) complete_displacement<2>;
template decltype(case_multiplicities<3>) case_multiplicities<3>;
template decltype(complete_displacement<3>) complete_displacement<3>;

}  // namespace wheelwright
