#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"

#include <cmath>
#include <limits>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/shared_interrupt.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/equilibrium/deformed_state.h"

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

/// The start of a position in the numbers of a ring: at nodes that had no material the mean of their
/// neighbours with values, layer by layer.
template <int dim>
std::vector<double> on_ring(const RingSpace<dim>& space, RingField field) {
  const Lattice<dim>& lattice = space.lattice();
  const int lines = lattice.nodes()[1] * space.grid().n_sectors;
  const auto index = [&](std::array<int, dim> p) { return dim * ring_node<dim>(lattice, p); };
  std::vector<int> missing;
  for (int node = 0; node < space.n_nodes(); ++node) missing.push_back(node);
  const auto position = [&](int node) {
    auto p = space.position_in_sector(node);
    p[1] += node / space.n_nodes_of_sector() * lattice.nodes()[1];
    return p;
  };
  std::erase_if(missing, [&](int node) { return !std::isnan(field.values[index(position(node))]); });
  while (!missing.empty()) {
    std::vector<std::pair<int, Vec<dim>>> found;
    for (const int node : missing) {
      Vec<dim> sum{};
      int n = 0;
      for (int axis = 0; axis < dim; ++axis)
        for (const int step : {-1, 1}) {
          auto p = position(node);
          p[axis] += step;
          if (axis == 1) p[1] = (p[1] + lines) % lines;
          if (axis != 1 && (p[axis] < 0 || p[axis] >= lattice.nodes()[axis])) continue;
          const double* value = &field.values[index(p)];
          if (std::isnan(value[0])) continue;
          for (int c = 0; c < dim; ++c) sum[c] += value[c];
          ++n;
        }
      if (n > 0) found.push_back({node, sum / n});
    }
    if (found.empty()) break;
    for (const auto& [node, value] : found)
      std::copy(value.begin(), value.end(), &field.values[index(position(node))]);
    std::erase_if(missing, [&](int node) { return !std::isnan(field.values[index(position(node))]); });
  }
  std::vector<double> v(space.n_dofs(), 0.0);
  for (int node = 0; node < space.n_nodes(); ++node)
    for (int c = 0; c < dim; ++c)
      if (const double value = field.values[index(position(node)) + c]; std::isfinite(value))
        v[space.dof(node, c)] = value;
  return v;
}

}  // namespace

template <int dim>
DeformableRing<dim>::DeformableRing(CutDomain<dim> of_shape, const HyperelasticTable<dim>& table,
                                    const RollingModel<dim>& model)
    : domain(std::move(of_shape)),
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
    const CutShape<dim>& shape, LoadPositions positions, const DeformedStarts& starts,
    const Interrupt& interrupt) const {
  Stopwatch watch;
  auto domain = shape.domain ? Expected<CutDomain<dim>>(*shape.domain)
                             : cut_domain(shape.psi, model_.points_in_cut_cells());
  if (!domain) return EquilibriumFailure{domain.failure()};
  if (auto failure = check_attached(*domain, small_strains_->protected_rim_rows(),
                                    small_strains_->protected_tread_rows()))
    return EquilibriumFailure{*failure};
  std::vector<PhaseTime> phases{{phase::cut, watch.lap()}};
  const auto ring = std::make_shared<const DeformableRing<dim>>(*std::move(domain), *table_, model_);
  phases.push_back({phase::assembly, watch.lap()});
  const auto start = [&](int i) -> std::optional<EquilibriumStart<dim>> {
    if (i >= static_cast<int>(starts.displacements.size())) return {};
    return EquilibriumStart<dim>{on_ring(ring->forms.space(), starts.displacements[i])};
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
Expected<RingEquilibrium<dim>, EquilibriumFailure> LargeDeformationProblem<dim>::linearized(
    const LargeDeformation<dim>& solution, const RingEquilibrium<dim>& equilibrium) const {
  return EquilibriumSolver<dim>(solution.model, solution.ring->problem, small_strains_->tread())
      .linearized(equilibrium);
}

template <int dim>
Expected<std::shared_ptr<const State<dim>>> LargeDeformationProblem<dim>::states(
    const CutShape<dim>& shape, LoadPositions positions, const DeformedStarts& starts,
    const Interrupt& interrupt) const {
  auto solution = solve(shape, std::move(positions), starts, interrupt);
  if (!solution) return Failure(solution.failure());
  return deformed_state(*this, *std::move(solution));
}

template <int dim>
DeformedStarts starts_from(const LargeDeformation<dim>& solution) {
  const RingSpace<dim>& space = solution.ring->forms.space();
  const Lattice<dim>& lattice = space.lattice();
  DeformedStarts starts;
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
    starts.displacements.push_back(std::move(field));
  }
  return starts;
}

template struct DeformableRing<2>;
template class LargeDeformationProblem<2>;
template decltype(starts_from<2>) starts_from<2>;

}  // namespace wheelwright
