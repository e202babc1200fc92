#include "wheelwright/rolling/rolling_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/base/shared_interrupt.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/contact/contact_solver.h"
#include "wheelwright/geometry/mirror.h"
#include "wheelwright/rolling/contact_failure.h"
#include "wheelwright/rolling/position_tree.h"

namespace wheelwright {

template <int dim>
std::vector<double> case_multiplicities(const RollingSolution<dim>& solution) {
  std::vector<double> multiplicities;
  for (const double m : solution.positions.multiplicities)
    multiplicities.insert(multiplicities.end(), solution.ring.n_sectors(), m);
  return multiplicities;
}

template <int dim>
SectorFields complete_displacement(const RollingSolution<dim>& solution) {
  // Loads in the core act on all of it: then the sweep has visited all unknowns.
  return solution.core_loads.empty() ? completed(solution.ring, solution.displacement)
                                     : solution.displacement;
}

namespace {

/// Largest accepted interior_residual(); rounding gives about 1e-15.
constexpr double largest_residual = 1e-10;

/// sum_i factors_i x_i^2 over some columns of x.
double weighted_square(const std::vector<double>& factors, const Matrix& x, int first_column, int n) {
  std::vector<double> sums(factors.size(), 0.0);
  for (int j = first_column; j < first_column + n; ++j) {
    const double* column = x.column(j);
    for (size_t i = 0; i < sums.size(); ++i) sums[i] += factors[i] * column[i] * column[i];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double column_dot(const Matrix& a, const Matrix& b, int column) {
  const double *x = a.column(column), *y = b.column(column);
  double sum = 0;
  for (int i = 0; i < a.rows(); ++i) sum += x[i] * y[i];
  return sum;
}

/// J_e (3) of every position: half the work of all loads, less the ghost penalty's and Nitsche's share of it.
/// `loaded`: columns with loads on the tread.
template <int dim>
std::vector<double> bulk_energies(const RollingSolution<dim>& s, const std::vector<int>& loaded,
                                  const std::vector<double>& nitsche_factors) {
  const int n_positions = s.positions.size(), n_sectors = s.ring.n_sectors();
  const int n_columns = s.observations.columns() / n_positions;
  std::vector<double> energy(n_positions);
  for (int i = 0; i < n_positions; ++i)
    energy[i] = -0.5 * weighted_square(nitsche_factors, s.observations, i * n_columns, n_columns);
  for (const int c : loaded) energy[c / n_columns] += 0.5 * column_dot(s.tread_loads, s.observations, c);
  const auto ghost_work = work_by_case({s.ghost_loads, s.displacement.weights}, s.displacement);
  for (size_t c = 0; c < ghost_work.size(); ++c) energy[c / n_sectors] -= 0.5 * ghost_work[c];
  if (s.core_loads.empty()) return energy;
  const auto core_work = work_by_case(s.core_loads, s.displacement);
  for (size_t c = 0; c < core_work.size(); ++c) energy[c / n_sectors] += 0.5 * core_work[c];
  return energy;
}

/// P per metre of width.
template <int dim>
double line_load(const RollingModel<dim>& model) {
  return dim == 2 ? model.load : model.load / model.grid.width;
}

/// Columns from the ground position to one beyond the likely end of contact: from Hertz's theory for a load,
/// for a prescribed travel from where the circle meets the ground.
template <int dim>
int columns_in_contact(const RollingModel<dim>& model, bool between_columns) {
  constexpr double margin = 1.2;  // holes widen a patch
  const PolarGrid<dim>& grid = model.grid;
  const double half_width =
      model.travel ? 0.5 * std::sqrt(2 * grid.outer_radius * std::max(*model.travel, 0.0))
                   : 2 * std::sqrt(line_load(model) * grid.outer_radius /
                                   (std::numbers::pi * model.materials.at_tread().contact_modulus()));
  return static_cast<int>(std::ceil(margin * half_width / (grid.outer_radius * grid.cell_size()[1]))) + 1 +
         between_columns;
}

template <int dim>
bool touches_edge(const ContactState<dim>& state) {
  const auto per_column = static_cast<long>(state.traction.size()) / state.zone.n_columns;
  const auto touches = [](auto first, auto last) {
    return std::any_of(first, last, [](const Vec<dim>& t) { return t[0] < 0; });
  };
  return touches(state.traction.begin(), state.traction.begin() + per_column) ||
         touches(state.traction.end() - per_column, state.traction.end());
}

/// The columns of the sector in the contact zones of some positions, `half` columns to either side.
template <int dim>
std::vector<bool> columns_in_zones(const PolarGrid<dim>& grid, const LoadPositions& positions, int half) {
  std::vector<bool> result(grid.columns(), false);
  for (const GroundPosition& ground : positions.grounds)
    for (int c = ground.column - half; c < ground.column + half; ++c) result[wrap(c, grid.columns())] = true;
  return result;
}

template <int dim>
bool is_bonded(const Tread<dim>& tread) {
  return tread.form().counterpart == Counterpart::ring;
}

/// The surface's compliance for contact zones at some positions, `half` columns to either side.
template <int dim>
SurfaceCompliance<dim> surface_compliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                          const PolarGrid<dim>& grid, const LoadPositions& positions,
                                          int half) {
  return {ring, tread, 2 * half - 1, columns_in_zones(grid, positions, half)};
}

bool all_finite(const Matrix& a) {
  return std::all_of(a.entries().begin(), a.entries().end(), [](double x) { return std::isfinite(x); });
}

/// The components of the column frame that contact meets: without friction and lean the ground pushes in the
/// plane of the wheel.
template <int dim>
int components_in_contact(const RollingModel<dim>& model) {
  return model.contact.friction == 0 && model.camber == 0 ? 2 : dim;
}

/// Why the materials of a model are not those of a linear ring.
template <int dim>
std::optional<Failure> unsupported_material(const RollingModel<dim>& model) {
  for (int row = 0; row < model.grid.cells[0]; ++row) {
    const MaterialLaw<dim>& law = model.materials.in_row(row);
    if (dim == 3 && law.isotropic() && law.isotropic()->plane == Plane::stress)
      return Failure{FailureReason::unsupported_model, "plane stress is for two dimensions only"};
    if (const auto fault = fault_of_linear_law<dim>(law))
      return Failure{FailureReason::unsupported_model,
                     "the material law does not suit linear elasticity: " + *fault};
  }
  return {};
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
  auto elements = std::make_unique<ElementTable<dim>>(model.grid, model.degree, model.materials, model.ghost,
                                                      cell_stiffness<dim>, model.side_faces);
  TreadGrid grid = model.tread;
  grid.observes_spin = grid.observes_spin || model.distributed.angular_speed != 0;
  auto tread = Tread<dim>::condense(*elements, grid, model.contact, model.contact_points,
                                    components_in_contact(model));
  if (!tread) return tread.failure();
  return RollingProblem(model, std::move(elements), *std::move(tread));
}

namespace {

/// The prescribed motion of a model's rim at a load position. A prescribed travel is measured from where the
/// rotating wheel touches the ground without load, in the mean of all positions.
template <int dim>
RimControl rim_control(const RollingModel<dim>& model, const Preload& preload) {
  RimControl rim = rim_control(model);
  if (model.travel) rim.prescribed.towards_ground -= preload.mean_growth;
  return rim;
}

template <int dim>
Expected<ContactState<dim>> solve_in_zone(const RollingModel<dim>& model, const ReducedContact<dim>& contact,
                                          const std::optional<ContactState<dim>>& known,
                                          const Interrupt& interrupt) {
  std::vector<ContactUnknowns<dim>> starts;
  if (known) starts.push_back(contact.start_from(*known));
  starts.push_back(model.travel ? contact.undeformed_start()
                                : contact.hertz_start(line_load(model), model.grid.outer_radius,
                                                      model.materials.at_tread().contact_modulus()));
  auto state = solve_contact<dim>(contact, starts, interrupt);
  if (!state) return contact_failure(state.failure(), model, contact);
  return *std::move(state);
}

}  // namespace

template <int dim>
Expected<RolledContact<dim>> roll_to(const RollingModel<dim>& model, const Tread<dim>& tread,
                                     const CyclicStiffness<dim>& ring, const SurfaceCompliance<dim>& surface,
                                     GroundPosition ground, const Preload& preload,
                                     const std::optional<ContactState<dim>>& neighbour,
                                     const Interrupt& interrupt) {
  const PolarGrid<dim>& grid = model.grid;
  if (is_bonded(tread)) {
    const int n = grid.ring_columns();
    ReducedContact<dim> contact(surface, tread, grid, ground, {ground.column - n / 2, n},
                                rim_control(model, preload), preload);
    auto state = solve_in_zone<dim>(model, contact, {}, interrupt);
    if (!state) return state.failure();
    return RolledContact<dim>{std::move(contact), *std::move(state)};
  }
  int half =
      std::max(columns_in_contact(model, ground.offset > 0), neighbour ? neighbour->zone.n_columns / 2 : 0);
  const int largest_half = (grid.ring_columns() / 2 - 1) / 2;
  std::optional<ContactState<dim>> known = neighbour;
  std::optional<SurfaceCompliance<dim>> wider;
  while (true) {
    half = std::min(half, (grid.ring_columns() - 1) / 2);
    const int width = 2 * half - 1;
    if (width > (wider ? *wider : surface).width())
      wider = surface_compliance<dim>(ring, tread, grid, {{ground}, {1}}, half);
    ReducedContact<dim> contact(wider ? *wider : surface, tread, grid, ground,
                                {ground.column - half, 2 * half}, rim_control(model, preload), preload);
    auto state = solve_in_zone(model, contact, known, interrupt);
    if (!state) return state.failure();
    if (!touches_edge(*state) || half >= largest_half)
      return RolledContact<dim>{std::move(contact), *std::move(state)};
    known = *std::move(state);
    half += std::max(2, half / 8);
  }
}

template <int dim>
Expected<RolledContact<dim>> reload(const RollingModel<dim>& model, const Tread<dim>& tread,
                                    const CyclicStiffness<dim>& ring, const SurfaceCompliance<dim>& surface,
                                    GroundPosition ground, const Preload& preload,
                                    const RolledContact<dim>& before) {
  ReducedContact<dim> contact = before.contact.under(rim_control(model, preload));
  auto state = solve_in_zone<dim>(model, contact, before.state, Interrupt());
  if (!state) return state.failure();
  if (touches_edge(*state) && !is_bonded(tread))
    return roll_to<dim>(model, tread, ring, surface, ground, preload, *state);
  return RolledContact<dim>{std::move(contact), *std::move(state)};
}

namespace {

/// The contacts of all of a solution's positions (position_tree.h), with its model, surface and preloads.
/// Widens the surface to the widest contact zone.
template <int dim>
Expected<std::vector<RolledContact<dim>>> roll_to_all(RollingSolution<dim>& s, const Tread<dim>& tread,
                                                      const Interrupt& interrupt) {
  const int n = s.positions.size();
  const Interrupt shared = shared_by_threads(interrupt);
  const auto roll = [&](int i, const std::optional<ContactState<dim>>& neighbour) {
    auto rolled = roll_to(s.model, tread, s.ring, *s.surface, s.positions.grounds[i], s.preloads[i],
                          neighbour, shared.at_position(i, n));
    std::optional<Failure> failure;
    if (rolled) failure = rim_under_ground(s.model, rolled->state.rim);
    return failure ? Expected<RolledContact<dim>>(*std::move(failure)) : rolled;
  };
  std::vector<std::optional<Expected<RolledContact<dim>>>> all(n);
  for (const auto& generation : position_tree(n)) {
    parallel_for(static_cast<int>(generation.size()), [&](int k) {
      const auto [position, from] = generation[k];
      all[position] = roll(position, from < 0 ? std::nullopt : std::optional((**all[from]).state));
    });
    int widest = 0;
    for (const auto& [position, from] : generation) {
      if (!*all[position]) return all[position]->failure();
      widest = std::max(widest, (**all[position]).contact.zone().n_columns);
    }
    if (widest > s.surface->width() + 1 && !is_bonded(tread))
      s.surface = std::make_shared<const SurfaceCompliance<dim>>(
          surface_compliance(s.ring, tread, s.model.grid, s.positions, widest / 2));
  }
  std::vector<RolledContact<dim>> result;
  for (auto& rolled : all) result.push_back(**std::move(rolled));
  return result;
}

}  // namespace

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
typename RollingProblem<dim>::WithoutGround RollingProblem<dim>::without_ground(
    const RollingSolution<dim>& s, const DistributedLoads<dim>& loads,
    const std::vector<GroundPosition>& grounds) const {
  WithoutGround result{applied_loads<dim>(loads, s.domain, *elements_, s.ring, tread_, grounds), {}, {}};
  CondensedLoads& condensed = result.condensed;
  condensed.core = result.applied.core;
  condensed.boundary =
      s.ring.eliminate_interface(condense<dim>(s.ring, s.ring.sector_factor().full_sweep(), condensed.core));
  const TreadLoads on_tread = tread_loads(tread_, result.applied.tread);
  const Matrix outer =
      s.ring.outer_displacements(sum(condensed.boundary.outer, base_loads(tread_, on_tread)));
  result.observed = observations(tread_, tread_field(tread_, outer, on_tread), on_tread);
  return result;
}

/// From the observations of the tread under rotation without load, at any position.
template <int dim>
void RollingProblem<dim>::find_standing_points(const Matrix& observed, RollingSolution<dim>& s) const {
  double sum = 0, count = 0;
  for (int i = 0; i < s.positions.size(); ++i) {
    s.standing.push_back(standing_point(tread_, s.model.grid, s.positions.grounds[i], observed));
    s.preloads[i].growth = s.standing[i].growth;
    sum += s.positions.multiplicities[i] * s.standing[i].growth;
    count += s.positions.multiplicities[i];
  }
  for (Preload& preload : s.preloads) preload.mean_growth = sum / count;
}

/// Applies the loads that are not the ground's: fills the solution's core_loads, tread_loads, preloads and
/// standing points.
template <int dim>
typename RollingProblem<dim>::CondensedLoads RollingProblem<dim>::preload(RollingSolution<dim>& s) const {
  const int n_positions = s.positions.size(), n_columns = tread_.n_columns();
  const DistributedLoads<dim>& loads = s.model.distributed;
  s.preloads.resize(n_positions);
  if (!loads.any()) return {{}, {{}, Matrix(s.ring.n_outer(), n_positions * s.ring.n_sectors())}};
  WithoutGround free = without_ground(s, loads, s.positions.grounds);
  s.core_loads = std::move(free.applied.core);
  s.tread_loads = std::move(free.applied.tread);
  for (int i = 0; i < n_positions; ++i) {
    s.preloads[i] = {Matrix(free.observed.rows(), n_columns), free.applied.on_the_rim[i]};
    std::copy_n(free.observed.column(i * n_columns), s.preloads[i].observations.entries().size(),
                s.preloads[i].observations.data());
  }
  if (loads.angular_speed != 0 && !is_bonded(tread_)) {
    const DistributedLoads<dim> rotation{.angular_speed = loads.angular_speed};
    find_standing_points(without_ground(s, rotation, {s.positions.grounds.front()}).observed, s);
  }
  return std::move(free.condensed);
}

template <int dim>
Expected<std::shared_ptr<const FactoredShape<dim>>> RollingProblem<dim>::factor(
    const CutShape<dim>& shape) const {
  std::vector<PhaseTime> phases;
  Stopwatch watch;
  auto domain = shape.domain ? Expected<CutDomain<dim>>(*shape.domain)
                             : cut_domain(shape.psi, model_.points_in_cut_cells());
  if (!domain) return domain.failure();
  if (auto failure = check_attached(*domain, protected_rim_rows(), protected_tread_rows())) return *failure;
  phases.push_back({phase::cut, watch.lap()});
  auto sector = sector_stiffness(*domain, *elements_, core_rows());
  phases.push_back({phase::assembly, watch.lap()});
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
  auto factored = factor(shape);
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
  const int n_positions = positions.size(), n_columns = model.grid.ring_columns();
  std::vector<PhaseTime> phases;
  Stopwatch watch;
  const bool between_columns =
      std::ranges::any_of(positions.grounds, [](const GroundPosition& ground) { return ground.offset > 0; });
  const int likely_half = std::min(columns_in_contact(model, between_columns), (n_columns - 1) / 2);
  if (!surface && is_bonded(tread_))
    surface = std::make_shared<const SurfaceCompliance<dim>>(shape->ring, tread_, n_columns / 2);
  if (!surface || surface->width() < 2 * likely_half - 1)
    surface = std::make_shared<const SurfaceCompliance<dim>>(
        surface_compliance(shape->ring, tread_, model.grid, positions, likely_half));
  RollingSolution<dim> s{.shape = shape,
                         .domain = shape->domain,
                         .ring = shape->ring,
                         .model = model,
                         .surface = std::move(surface),
                         .positions = std::move(positions),
                         .contacts = {},
                         .states = {},
                         .sweep = {},
                         .displacement = {},
                         .outer_line = {},
                         .core_loads = {},
                         .tread_loads = {},
                         .preloads = {},
                         .standing = {},
                         .observations = {},
                         .ghost_loads = {},
                         .strain_energy = {},
                         .phases = {}};
  s.tread_loads = Matrix(tread_.n_observations(), n_positions * n_columns);
  const CondensedLoads preloaded = preload(s);
  auto rolled = roll_to_all(s, tread_, interrupt);
  if (!rolled) return rolled.failure();
  for (int i = 0; i < n_positions; ++i) {
    auto& [contact, state] = (*rolled)[i];
    if (reach == Ground::touched)
      if (auto failure = no_contact(model, contact, state)) return *failure;
    const ContactZone& zone = contact.zone();
    const Matrix loads = contact.contact_loads(state);
    for (int c = 0; c < zone.n_columns; ++c)
      std::copy_n(loads.column(c), loads.rows(),
                  s.tread_loads.column(i * n_columns + wrap(zone.first_column + c, n_columns)));
    s.contacts.push_back(std::move(contact));
    s.states.push_back(std::move(state));
  }
  phases.push_back({phase::contact, watch.lap()});

  const TreadLoads loads = tread_loads(tread_, s.tread_loads);
  s.outer_line = s.ring.outer_displacements(sum(preloaded.boundary.outer, base_loads(tread_, loads)));
  const Matrix boundary = s.ring.boundary_displacements(s.outer_line, preloaded.boundary.interface);
  s.sweep = boundary_sweep(s.ring, s.domain, s.core_loads);
  s.displacement = displacement_fields(s.ring, s.sweep, boundary, preloaded.core, case_multiplicities(s));
  s.observations = observations(tread_, tread_field(tread_, s.outer_line, loads), loads);
  s.ghost_loads = ghost_loads(s.ring, s.displacement.modes);
  if (!all_finite(s.displacement.modes) || !all_finite(s.observations))
    return Failure{FailureReason::not_finite, "the displacement is not finite"};
  if (const double residual = interior_residual(s.ring, s.sweep, s.displacement, s.core_loads);
      !(residual <= largest_residual))
    return Failure{FailureReason::inaccurate_solution,
                   fmt::format("the equations of a sector are off by {:.2g} of their terms", residual)};

  s.strain_energy = bulk_energies(s, loads.columns, nitsche_factors());
  for (int i = 0; i < n_positions; ++i)
    if (!(s.strain_energy[i] > 0))
      return Failure{FailureReason::negative_energy,
                     fmt::format("the strain energy of position {} is {:.4g} J/m", i, s.strain_energy[i])};
  phases.push_back({phase::recovery, watch.lap()});
  s.phases = std::move(phases);
  return s;
}

template class RollingProblem<2>;
template class RollingProblem<3>;
template decltype(case_multiplicities<2>) case_multiplicities<2>;
template decltype(complete_displacement<2>) complete_displacement<2>;
template decltype(roll_to<2>) roll_to<2>;
template decltype(reload<2>) reload<2>;
template decltype(case_multiplicities<3>) case_multiplicities<3>;
template decltype(complete_displacement<3>) complete_displacement<3>;
template decltype(roll_to<3>) roll_to<3>;
template decltype(reload<3>) reload<3>;

}  // namespace wheelwright
