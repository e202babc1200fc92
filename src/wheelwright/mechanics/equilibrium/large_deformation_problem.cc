#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/shared_interrupt.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/contact/tangent_stiffness.h"
#include "wheelwright/mechanics/equilibrium/deformed_state.h"
#include "wheelwright/mechanics/state/material_edges.h"

namespace wheelwright {
namespace {

Failure unsupported(std::string what) { return {FailureReason::unsupported_model, std::move(what)}; }

/// Why large deformation cannot be computed for a model's loads.
template <int dim>
std::optional<Failure> unsupported_loads(const RollingModel<dim>& model) {
  if (model.torque != 0) return unsupported("large deformation does not know a torque on the rim");
  if (model.distributed.any())
    return unsupported("large deformation does not know body forces, rotation, nor pressure in holes");
  if (!model.ground.is_flat()) return unsupported("large deformation needs flat ground");
  return {};
}

template <int dim>
std::optional<Failure> unsupported_model(const RollingModel<dim>& model) {
  if (model.contact.theta() != 0)
    return unsupported("large deformation needs Nitsche's method with theta = 0, or the penalty method");
  if (model.contact.counterpart != Counterpart::ground)
    return unsupported("large deformation knows contact with ground only");
  if (model.tread.levels != 0) return unsupported("large deformation does not know a refined tread");
  if (!model.design_lines.empty())
    return unsupported("large deformation has no derivatives with respect to radii");
  return unsupported_loads(model);
}

/// An equilibrium under a load, or at a held travel.
template <int dim>
struct UnderLoad {
  std::optional<double> load;  ///< [N/m]
  const RingEquilibrium<dim>& equilibrium;
};

/// The load of a model, unless the travel is held.
template <int dim>
std::optional<double> load_of(const RollingModel<dim>& model) {
  return model.travel ? std::nullopt : std::optional(model.load);
}

/// The failure of a position whose edges cross, and do not under `last`.
template <int dim>
std::optional<EquilibriumFailure> overlap(const DeformableRing<dim>& ring, const MaterialEdges<dim>& edges,
                                          const UnderLoad<dim>& last, const UnderLoad<dim>& now) {
  const PolarGrid<dim>& grid = ring.domain.grid;
  const double travel = now.equilibrium.state.rim.towards_ground / (grid.outer_radius - grid.inner_radius);
  if (travel < smallest_travel_of_overlap) return {};
  const auto place = edges.first_crossing(nodal_displacement(ring, last.equilibrium),
                                          nodal_displacement(ring, now.equilibrium));
  if (!place) return {};
  if (!last.load || !now.load) return EquilibriumFailure{overlap_failure(travel, *place)};
  return EquilibriumFailure{
      overlap_failure<dim>(travel, *place, std::lerp(*last.load, *now.load, place->share))};
}

/// Seeks a position from a solution with the tangent there (null: unknown). The zone of the tangent at its
/// own solution has at least so many columns to either side of the ground.
template <int dim>
Expected<LinearizedEquilibrium<dim>, EquilibriumFailure> linearized_solution(
    const EquilibriumSolver<dim>& solver, const RingEquilibrium<dim>& from,
    std::shared_ptr<const RingLinearization<dim>> tangent, int half_zone, const Interrupt& interrupt) {
  const auto solved = solver.solve_from(from, std::move(tangent), interrupt);
  if (!solved) return solved.failure();
  return solver.linearized(*solved, interrupt, half_zone);
}

/// Continues a displacement to the nodes of a ring that had no material: layer by layer, each node by the
/// mean of the straight lines through its neighbours with values and the nodes behind them, or of its
/// neighbours where there are no such lines.
template <int dim>
class Continuation {
 public:
  Continuation(const RingSpace<dim>& space, RingField field)
      : space_(space), lattice_(space.lattice()), field_(std::move(field)) {}

  /// On the dofs of the ring; 0 where no node with a value can be reached.
  std::vector<double> continued() && {
    std::vector<int> missing(space_.n_nodes());
    std::iota(missing.begin(), missing.end(), 0);
    std::erase_if(missing, [&](int node) { return is_known(place(node)); });
    while (!missing.empty()) {
      std::vector<std::pair<int, Vec<dim>>> found;
      for (const int node : missing)
        if (const auto u = from_neighbours(place(node))) found.push_back({node, *u});
      if (found.empty()) break;
      for (const auto& [node, u] : found) std::ranges::copy(u, &field_.values[index(place(node))]);
      std::erase_if(missing, [&](int node) { return is_known(place(node)); });
    }
    std::vector<double> v(space_.n_dofs(), 0.0);
    for (int node = 0; node < space_.n_nodes(); ++node)
      if (is_known(place(node)))
        std::copy_n(&field_.values[index(place(node))], dim, &v[space_.dof(node, 0)]);
    return v;
  }

 private:
  using Place = std::array<int, dim>;

  Place place(int node) const {
    Place p = space_.position_in_sector(node);
    p[1] += node / space_.n_nodes_of_sector() * lattice_.nodes()[1];
    return p;
  }
  std::size_t index(const Place& p) const { return dim * ring_node<dim>(lattice_, p); }
  bool is_known(const Place& p) const { return !std::isnan(field_.values[index(p)]); }

  std::optional<Vec<dim>> value(const Place& p) const {
    for (int axis = 0; axis < dim; ++axis)
      if (axis != 1 && (p[axis] < 0 || p[axis] >= lattice_.nodes()[axis])) return {};
    if (!is_known(p)) return {};
    Vec<dim> u;
    std::copy_n(&field_.values[index(p)], dim, u.begin());
    return u;
  }

  std::optional<Vec<dim>> from_neighbours(const Place& p) const {
    Vec<dim> of_lines{}, of_neighbours{};
    int n_lines = 0, n_neighbours = 0;
    for (int axis = 0; axis < dim; ++axis)
      for (const int step : {-1, 1}) {
        Place next = p, behind = p;
        next[axis] += step;
        behind[axis] += 2 * step;
        const auto u = value(next);
        if (!u) continue;
        of_neighbours = of_neighbours + *u;
        ++n_neighbours;
        if (const auto w = value(behind)) {
          of_lines = of_lines + 2.0 * *u - *w;
          ++n_lines;
        }
      }
    if (n_lines > 0) return of_lines / n_lines;
    if (n_neighbours > 0) return of_neighbours / n_neighbours;
    return {};
  }

  const RingSpace<dim>& space_;
  const Lattice<dim>& lattice_;
  RingField field_;
};

}  // namespace

template <int dim>
DeformableRing<dim>::DeformableRing(const LevelSet<dim>& of_wheel, CutDomain<dim> of_shape,
                                    const HyperelasticTable<dim>& table, const RollingModel<dim>& model)
    : psi(of_wheel),
      domain(std::move(of_shape)),
      forms(domain, table),
      contact(forms, model.contact_points),
      tread(forms, contact, model.materials, model.tread),
      orders(forms),
      problem{forms, contact, orders} {}

template <int dim>
Expected<LargeDeformationProblem<dim>> LargeDeformationProblem<dim>::create(const RollingModel<dim>& model) {
  if (auto failure = unsupported_model(model)) return *failure;
  auto table = HyperelasticTable<dim>::create(model.grid, model.degree, model.materials, model.ghost,
                                              model.dilatation);
  if (!table) return table.failure();
  RollingModel<dim> small = model;
  small.materials = for_small_strains(model.materials);
  auto small_strains = RollingProblem<dim>::create(small);
  if (!small_strains) return small_strains.failure();
  return LargeDeformationProblem(model, std::make_unique<HyperelasticTable<dim>>(*std::move(table)),
                                 std::make_unique<RollingProblem<dim>>(*std::move(small_strains)));
}

template <int dim>
auto LargeDeformationProblem<dim>::roll(const RollingModel<dim>& model,
                                        std::shared_ptr<const DeformableRing<dim>> ring,
                                        LoadPositions positions,
                                        const std::function<std::optional<EquilibriumStart<dim>>(int)>& start,
                                        const Interrupt& interrupt) const
    -> Expected<LargeDeformation<dim>, EquilibriumFailure> {
  if (auto failure = unsupported_loads(model)) return EquilibriumFailure{*failure};
  Stopwatch watch;
  const EquilibriumSolver<dim> solver(model, ring->problem, small_strains_->tread());
  const Interrupt shared = shared_by_threads(interrupt);
  std::vector<std::optional<Expected<RingEquilibrium<dim>, EquilibriumFailure>>> solved(positions.size());
  parallel_for(positions.size(), [&](int i) {
    solved[i] = solver.solve(positions.grounds[i], start(i), shared.at_position(i, positions.size()));
  });
  LargeDeformation<dim> result{std::move(ring), model, std::move(positions), {}, {}};
  for (auto& position : solved) {
    if (!*position) return position->failure();
    result.equilibria.push_back(std::move(**position));
  }
  result.phases.push_back({phase::contact, watch.lap()});
  return result;
}

template <int dim>
Expected<LargeDeformation<dim>, EquilibriumFailure> LargeDeformationProblem<dim>::solve(
    const CutShape<dim>& shape, LoadPositions positions, const StartDisplacements& starts,
    const Interrupt& interrupt) const {
  Stopwatch watch;
  auto domain = shape.domain ? Expected<CutDomain<dim>>(*shape.domain)
                             : cut_domain(shape.psi, model_.points_in_cut_cells());
  if (!domain) return EquilibriumFailure{domain.failure()};
  if (auto failure = check_attached(*domain, small_strains_->protected_rim_rows(),
                                    small_strains_->protected_tread_rows()))
    return EquilibriumFailure{*failure};
  std::vector<PhaseTime> phases{{phase::cut, watch.lap()}};
  const auto ring =
      std::make_shared<const DeformableRing<dim>>(shape.psi, *std::move(domain), *table_, model_);
  phases.push_back({phase::assembly, watch.lap()});
  const Lattice<dim>& lattice = ring->forms.space().lattice();
  const std::size_t n_values = dim * std::size_t(lattice.n_nodes()) * lattice.grid().n_sectors;
  const auto start = [&, grounds = positions.grounds](int i) -> std::optional<EquilibriumStart<dim>> {
    const StartDisplacement* known = start_of(starts, grounds[i]);
    if (!known || known->displacement.values.size() != n_values) return {};  // of another grid
    return EquilibriumStart<dim>{Continuation<dim>(ring->forms.space(), known->displacement).continued()};
  };
  auto result = roll(model_, ring, std::move(positions), start, interrupt);
  if (result) result->phases.insert(result->phases.begin(), phases.begin(), phases.end());
  return result;
}

template <int dim>
Expected<LargeDeformation<dim>, EquilibriumFailure> LargeDeformationProblem<dim>::solve_under(
    const RollingModel<dim>& model, const LargeDeformation<dim>& solution, const Interrupt& interrupt) const {
  const auto start = [&](int i) -> std::optional<EquilibriumStart<dim>> {
    return EquilibriumStart<dim>{solution.equilibria[i].v, solution.equilibria[i].state};
  };
  return roll(model, solution.ring, solution.positions, start, interrupt);
}

template <int dim>
auto LargeDeformationProblem<dim>::curve(const LargeDeformation<dim>& solution, int position,
                                         std::span<const RollingModel<dim>> models,
                                         const Interrupt& interrupt) const
    -> std::vector<Expected<LoadedEquilibrium<dim>, EquilibriumFailure>> {
  const auto solver = [&](const RollingModel<dim>& model) {
    return EquilibriumSolver<dim>(model, solution.ring->problem, small_strains_->tread());
  };
  const DeformableRing<dim>& ring = *solution.ring;
  const MaterialEdges<dim> edges(ring.psi, ring.forms.space().lattice());
  LinearizedEquilibrium<dim> last{solution.equilibria[position], nullptr};
  std::optional<double> last_load = load_of(solution.model);
  struct FailedLoad {
    double load;
    Failure of_larger;  ///< of loads that are not sought
  };
  std::optional<FailedLoad> too_large;
  std::vector<Expected<LoadedEquilibrium<dim>, EquilibriumFailure>> result;
  for (size_t k = 0; k < models.size(); ++k) {
    if (too_large && !models[k].travel && models[k].load > too_large->load) {
      result.emplace_back(EquilibriumFailure{too_large->of_larger});
      continue;
    }
    const int next_half_zone = k + 1 < models.size() ? solver(models[k + 1]).first_half_zone() : 0;
    auto point = linearized_solution(solver(models[k]), last.solution, last.linearization, next_half_zone,
                                     interrupt.at_load(static_cast<int>(k), static_cast<int>(models.size())));
    if (point)
      if (auto failure =
              overlap<dim>(ring, edges, {last_load, last.solution}, {load_of(models[k]), point->solution}))
        point = *std::move(failure);
    if (!point) {
      const EquilibriumFailure& failure = point.failure();
      if (!models[k].travel && failure.reason != FailureReason::interrupted)
        too_large = FailedLoad{models[k].load,
                               {failure.reason, "a smaller load fails already", failure.largest_load}};
      result.emplace_back(point.failure());
      continue;
    }
    last = *std::move(point);
    last_load = load_of(models[k]);
    result.emplace_back(
        LoadedEquilibrium<dim>{last.solution, tangent_stiffness(last.solution.contact, last.solution.state)});
  }
  return result;
}

template <int dim>
Expected<LinearizedEquilibrium<dim>, EquilibriumFailure> LargeDeformationProblem<dim>::linearized(
    const LargeDeformation<dim>& solution, const RingEquilibrium<dim>& equilibrium) const {
  return EquilibriumSolver<dim>(solution.model, solution.ring->problem, small_strains_->tread())
      .linearized(equilibrium);
}

template <int dim>
Expected<std::shared_ptr<const State<dim>>> LargeDeformationProblem<dim>::states_near(
    const StartDisplacements& starts, const CutShape<dim>& shape, LoadPositions positions,
    const Interrupt& interrupt) const {
  auto solution = solve(shape, std::move(positions), starts, interrupt);
  if (!solution) return Failure(solution.failure());
  return deformed_state(*this, *std::move(solution));
}

template <int dim>
RingField nodal_displacement(const DeformableRing<dim>& ring, const RingEquilibrium<dim>& equilibrium) {
  const RingSpace<dim>& space = ring.forms.space();
  const Lattice<dim>& lattice = space.lattice();
  const double ground = equilibrium.ground.azimuth(lattice.grid());
  RingField field{dim, std::vector<double>(dim * size_t(lattice.n_nodes()) * lattice.grid().n_sectors,
                                           std::numeric_limits<double>::quiet_NaN())};
  for (int line = 0; line < lattice.nodes()[1] * lattice.grid().n_sectors; ++line) {
    const double azimuth = line * lattice.node_angle();
    for (int radial = 0; radial < lattice.nodes()[0]; ++radial) {
      const std::array<int, dim> place{radial, line};
      const int node = space.number(place);
      if (node < 0 && radial > 0) continue;
      Vec<dim> v{};
      if (node >= 0) std::copy_n(&equilibrium.v[space.dof(node, 0)], dim, v.begin());
      const double radius = lattice.radius(radial);
      const Vec<dim> of_rim = rotated<dim>(
          displacement<dim>(equilibrium.state.rim, rotated<dim>({radius}, azimuth - ground)), ground);
      const Vec<dim> u = rotated<dim>(v, azimuth) + of_rim;
      std::copy(u.begin(), u.end(), &field.values[dim * ring_node<dim>(lattice, place)]);
    }
  }
  return field;
}

template <int dim>
StartDisplacements starts_from(const LargeDeformation<dim>& solution) {
  const RingSpace<dim>& space = solution.ring->forms.space();
  const Lattice<dim>& lattice = space.lattice();
  StartDisplacements starts;
  for (const auto& equilibrium : solution.equilibria) {
    RingField field{dim, std::vector<double>(dim * size_t(lattice.n_nodes()) * space.grid().n_sectors,
                                             std::numeric_limits<double>::quiet_NaN())};
    for (int sector = 0; sector < space.grid().n_sectors; ++sector)
      for (int i = 0; i < lattice.n_nodes(); ++i) {
        auto p = lattice.node_position(i);
        p[1] += sector * lattice.nodes()[1];
        double* value = &field.values[dim * ring_node<dim>(lattice, p)];
        if (p[0] == 0)
          std::fill_n(value, dim, 0.0);
        else if (const int node = space.number(p); node >= 0)
          std::copy_n(&equilibrium.v[space.dof(node, 0)], dim, value);
      }
    starts.push_back({equilibrium.ground, std::move(field)});
  }
  return starts;
}

template struct DeformableRing<2>;
template class LargeDeformationProblem<2>;
template decltype(nodal_displacement<2>) nodal_displacement<2>;
template decltype(starts_from<2>) starts_from<2>;

}  // namespace wheelwright
