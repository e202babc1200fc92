#include "contact/rolling_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/periodic.h"
#include "base/stopwatch.h"
#include "contact/contact_solver.h"

namespace wheelwright {

template <int dim>
RimControl rim_control(const RollingModel<dim>& model) {
  RimControl rim;
  if (model.travel)
    rim.prescribed.towards_ground = *model.travel;
  else
    rim.free.push_back({{.towards_ground = 1}, model.load});
  if (model.horizontal_force != 0) rim.free.push_back({{.along_ground = 1}, model.horizontal_force});
  if (model.torque != 0) rim.free.push_back({{.rotation = 1}, model.torque});
  return rim;
}

template <int dim>
void gather(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Matrix& field,
            Matrix& local) {
  for (size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; c < dim; ++c) {
      const int row = nodes[a] < 0 ? -1 : ring.row(dim * nodes[a] + c);
      for (int j = 0; j < field.columns(); ++j)
        local(dim * static_cast<int>(a) + c, j) = row < 0 ? 0.0 : field(row, j);
    }
}

template <int dim>
Matrix outer_rows(const CyclicStiffness<dim>& ring, const Matrix& boundary, int per_column) {
  const int n_outer = ring.n_outer(), first = ring.n_boundary() - n_outer;
  Matrix result(per_column, boundary.columns() * (n_outer / per_column));
  for (int j = 0; j < boundary.columns(); ++j)
    std::copy_n(boundary.column(j) + first, n_outer, result.data() + size_t(j) * n_outer);
  return result;
}

template <int dim>
void add_outer_rows(const CyclicStiffness<dim>& ring, const Matrix& outer, Matrix& boundary) {
  const int n_outer = ring.n_outer(), first = ring.n_boundary() - n_outer;
  for (int j = 0; j < boundary.columns(); ++j)
    for (int i = 0; i < n_outer; ++i) boundary(first + i, j) += outer.entries()[size_t(j) * n_outer + i];
}

namespace {

/// The ghost penalty applied to a core field.
template <int dim>
Matrix apply_ghost(const CyclicStiffness<dim>& ring, const Matrix& field) {
  Matrix result(field.rows(), field.columns());
  Matrix local, applied;
  for (const auto& ghost : ring.sector().ghosts) {
    const int n = dim * static_cast<int>(ghost.nodes.size());
    if (local.rows() != n) local = applied = Matrix(n, field.columns());
    gather(ring, ghost.nodes, field, local);
    multiply(1, *ghost.stiffness, Op::none, local, Op::none, 0, applied);
    for (int j = 0; j < field.columns(); ++j)
      for (int i = 0; i < n; ++i)
        if (const int node = ghost.nodes[i / dim]; node >= 0)
          result(ring.row(dim * node + i % dim), j) += applied(i, j);
  }
  return result;
}

/// How far the interior equations of one sector are from K v = loads (empty: zero), relative to their largest
/// terms.
template <int dim>
double interior_residual(const CyclicStiffness<dim>& ring, const Matrix& field, const Matrix& loads,
                         int column) {
  const SparseSymmetric& k = ring.sector().matrix;
  const int n_interior = ring.sector_factor().size() - ring.sector_factor().n_trailing();
  std::vector<double> x(k.size), force(k.size, 0.0);
  double largest_displacement = 0, largest_stiffness = 0, largest_force = 0;
  for (int dof = 0; dof < k.size; ++dof) {
    x[dof] = field(ring.row(dof), column);
    largest_displacement = std::max(largest_displacement, std::abs(x[dof]));
    largest_stiffness = std::max(largest_stiffness, k.values[k.column_start[dof]]);
  }
  k.add_product(x.data(), force.data());
  if (loads.rows() > 0)
    for (int dof = 0; dof < k.size; ++dof) force[dof] -= loads(ring.row(dof), column);
  for (int dof = 0; dof < k.size; ++dof)
    if (ring.row(dof) < n_interior) largest_force = std::max(largest_force, std::abs(force[dof]));
  return largest_force / (largest_stiffness * largest_displacement);
}

/// Of interior_residual(): rounding leaves about 1e-15.
constexpr double largest_residual = 1e-10;

double column_dot(const Matrix& a, const Matrix& b, int column) {
  const double *x = a.column(column), *y = b.column(column);
  double sum = 0;
  for (int i = 0; i < a.rows(); ++i) sum += x[i] * y[i];
  return sum;
}

/// J_e (3) of one position: half the work of all loads, less the ghost penalty's and Nitsche's share of it.
template <int dim>
double bulk_energy(const RollingSolution<dim>& s, const Matrix& nitsche_loads, int position) {
  const int n_positions = static_cast<int>(s.grounds.size()), n_sectors = s.ring.n_sectors();
  const int n_columns = s.observations.columns() / n_positions;
  double work = 0;
  for (int c = position * n_columns; c < (position + 1) * n_columns; ++c)
    work += column_dot(s.tread_loads, s.observations, c) - column_dot(nitsche_loads, s.observations, c);
  for (int c = position * n_sectors; c < (position + 1) * n_sectors; ++c) {
    if (s.core_loads.rows() > 0) work += column_dot(s.core_loads, s.displacement, c);
    work -= column_dot(s.ghost_loads, s.displacement, c);
  }
  return 0.5 * work;
}

/// P per metre of width.
template <int dim>
double line_load(const RollingModel<dim>& model) {
  return dim == 2 ? model.load : model.load / model.grid.width;
}

/// Columns from the ground position to beyond the likely end of contact: from Hertz's theory for a load, for
/// a prescribed travel from where the circle meets the ground.
template <int dim>
int columns_in_contact(const RollingModel<dim>& model) {
  const PolarGrid<dim>& grid = model.grid;
  const double half_width = model.travel
                                ? 0.5 * std::sqrt(2 * grid.outer_radius * std::max(*model.travel, 0.0))
                                : 2 * std::sqrt(line_load(model) * grid.outer_radius /
                                                (std::numbers::pi * model.material.plane_strain_modulus()));
  return static_cast<int>(std::ceil(half_width / (grid.outer_radius * grid.cell_size()[1]))) + 2;
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

bool all_finite(const Matrix& a) {
  return std::all_of(a.entries().begin(), a.entries().end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

template <int dim>
RollingProblem<dim>::RollingProblem(const RollingModel<dim>& model,
                                    std::unique_ptr<ElementTable<dim>> elements, Tread<dim> tread)
    : model_(model),
      elements_(std::move(elements)),
      harmonics_(model.grid.n_sectors),
      tread_(std::move(tread)),
      elimination_order_(nested_dissection<dim>(model.grid, model.degree, core_rows())),
      outer_stiffness_(tread_.outer_stiffness(harmonics_)) {}

template <int dim>
Expected<RollingProblem<dim>> RollingProblem<dim>::create(const RollingModel<dim>& model) {
  auto elements = std::make_unique<ElementTable<dim>>(model.grid, model.degree, model.material, model.ghost);
  auto tread = Tread<dim>::condense(*elements, model.tread, model.contact, model.contact_points);
  if (!tread) return tread.failure();
  return RollingProblem(model, std::move(elements), *std::move(tread));
}

namespace {

template <int dim>
Expected<ContactState<dim>> solve_in_zone(const RollingModel<dim>& model, const ReducedContact<dim>& contact,
                                          const std::optional<ContactState<dim>>& known) {
  const auto cold_start = [&](double fraction) {
    return model.travel ? contact.undeformed_start(fraction)
                        : contact.hertz_start(fraction * line_load(model), model.grid.outer_radius,
                                              model.material.plane_strain_modulus());
  };
  std::optional<ContactUnknowns<dim>> warm_start;
  if (known) warm_start = contact.start_from(*known);
  return solve_contact<dim>(contact, cold_start, warm_start);
}

}  // namespace

template <int dim>
Expected<RolledContact<dim>> roll_to(const RollingModel<dim>& model, const Tread<dim>& tread,
                                     const CyclicStiffness<dim>& ring, GroundPosition ground,
                                     const Preload& preload,
                                     const std::optional<ContactState<dim>>& neighbour) {
  const PolarGrid<dim>& grid = model.grid;
  int half = std::max(columns_in_contact(model), neighbour ? neighbour->zone.n_columns / 2 : 0);
  const int largest_half = (grid.ring_columns() / 2 - 1) / 2;
  std::optional<ContactState<dim>> known = neighbour;
  while (true) {
    half = std::min(half, (grid.ring_columns() - 1) / 2);
    ReducedContact<dim> contact(ring, tread, grid, ground, {ground.column - half, 2 * half},
                                rim_control(model), preload);
    auto state = solve_in_zone(model, contact, known);
    if (!state) return state.failure();
    if (!touches_edge(*state) || half >= largest_half)
      return RolledContact<dim>{std::move(contact), *std::move(state)};
    known = *std::move(state);
    half += 2;
  }
}

template <int dim>
Expected<RolledContact<dim>> reload(const RollingModel<dim>& model, const Tread<dim>& tread,
                                    const CyclicStiffness<dim>& ring, GroundPosition ground,
                                    const Preload& preload, const RolledContact<dim>& before) {
  ReducedContact<dim> contact = before.contact.under(rim_control(model));
  auto state = solve_in_zone<dim>(model, contact, before.state);
  if (!state) return state.failure();
  if (touches_edge(*state)) return roll_to<dim>(model, tread, ring, ground, preload, *state);
  return RolledContact<dim>{std::move(contact), *std::move(state)};
}

template <int dim>
Matrix RollingProblem<dim>::nitsche_loads(const Matrix& observations) const {
  Matrix loads(observations.rows(), observations.columns());
  for (int j = 0; j < loads.columns(); ++j)
    for (size_t q = 0; q < tread_.points().size(); ++q)
      for (int d = 0; d < dim; ++d) {
        const int row = 2 * dim * static_cast<int>(q) + dim + d;
        loads(row, j) = -tread_.form().theta() / tread_.points()[q].gamma * tread_.points()[q].weight *
                        observations(row, j);
      }
  return loads;
}

/// Applies the loads that are not the ground's: fills the solution's core_loads, tread_loads and preloads,
/// leaves condense()'s interior rows in its displacement and returns the condensed boundary loads.
template <int dim>
Matrix RollingProblem<dim>::preload(RollingSolution<dim>& s) const {
  const int n_positions = static_cast<int>(s.grounds.size()), n_columns = tread_.n_columns();
  s.preloads.resize(n_positions);
  if (!model_.distributed.any()) return Matrix(s.ring.n_boundary(), s.displacement.columns());
  auto applied = applied_loads<dim>(model_.distributed, s.domain, *elements_, s.ring, tread_, s.grounds);
  s.displacement = applied.core;
  s.core_loads = std::move(applied.core);
  s.tread_loads = std::move(applied.tread);
  Matrix core_boundary = s.ring.condense(s.displacement);
  Matrix boundary = core_boundary;
  add_outer_rows(s.ring, base_loads(tread_, s.tread_loads), boundary);
  const Matrix outer = outer_rows(s.ring, s.ring.solve_boundary(boundary), tread_.base_per_column());
  const Matrix observed = tread_field(tread_, outer, s.tread_loads).observations;
  for (int i = 0; i < n_positions; ++i) {
    s.preloads[i] = {Matrix(observed.rows(), n_columns), applied.on_the_rim[i]};
    std::copy_n(observed.column(i * n_columns), s.preloads[i].observations.entries().size(),
                s.preloads[i].observations.data());
  }
  return core_boundary;
}

template <int dim>
Expected<RollingSolution<dim>> RollingProblem<dim>::solve(const LevelSet<dim>& psi) const {
  const PolarGrid<dim>& grid = model_.grid;
  const int n_sectors = grid.n_sectors, n_positions = model_.n_positions, n_columns = grid.ring_columns();
  std::vector<PhaseTime> phases;
  Stopwatch watch;

  auto domain = cut_domain(psi, model_.degree + 2);
  if (!domain) return domain.failure();
  if (auto failure = check_attached(*domain, protected_rim_rows(), protected_tread_rows())) return *failure;
  phases.push_back({"cut", watch.lap()});
  auto sector = sector_stiffness(*domain, *elements_, core_rows());
  phases.push_back({"assembly", watch.lap()});
  auto factored =
      CyclicStiffness<dim>::factor(std::move(sector), elimination_order_, outer_stiffness_, harmonics_);
  if (!factored) return factored.failure();
  phases.push_back({"factorization", watch.lap()});

  RollingSolution<dim> s{
      *std::move(domain), *std::move(factored), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  for (int i = 0; i < n_positions; ++i)
    s.grounds.push_back(
        {i * grid.columns() / n_positions, double(i * grid.columns() % n_positions) / n_positions});
  s.displacement = Matrix(s.ring.sector_factor().size(), n_positions * n_sectors);
  s.tread_loads = Matrix(tread_.n_observations(), n_positions * n_columns);
  const Matrix core_boundary = preload(s);
  std::optional<ContactState<dim>> neighbour;
  for (int i = 0; i < n_positions; ++i) {
    auto rolled = roll_to(model_, tread_, s.ring, s.grounds[i], s.preloads[i], neighbour);
    if (!rolled) return rolled.failure();
    neighbour = rolled->state;
    const ContactZone& zone = rolled->contact.zone();
    const Matrix loads = rolled->contact.contact_loads(rolled->state);
    for (int c = 0; c < zone.n_columns; ++c)
      std::copy_n(loads.column(c), loads.rows(),
                  s.tread_loads.column(i * n_columns + wrap(zone.first_column + c, n_columns)));
    s.contacts.push_back(std::move(rolled->contact));
    s.states.push_back(std::move(rolled->state));
  }
  phases.push_back({"contact", watch.lap()});

  Matrix boundary = core_boundary;
  add_outer_rows(s.ring, base_loads(tread_, s.tread_loads), boundary);
  boundary = s.ring.solve_boundary(boundary);
  s.ring.recover(boundary, s.displacement);
  s.outer_line = outer_rows(s.ring, boundary, tread_.base_per_column());
  s.observations = tread_field(tread_, s.outer_line, s.tread_loads).observations;
  s.ghost_loads = apply_ghost(s.ring, s.displacement);
  if (!all_finite(s.displacement) || !all_finite(s.observations))
    return Failure{FailureReason::not_finite, "the displacement is not finite"};
  if (const double residual = interior_residual(s.ring, s.displacement, s.core_loads, 0);
      residual > largest_residual)
    return Failure{FailureReason::inaccurate_solution,
                   fmt::format("the equations of a sector are off by {:.2g} of their terms", residual)};

  const Matrix nitsche = nitsche_loads(s.observations);
  for (int i = 0; i < n_positions; ++i) {
    s.strain_energy.push_back(bulk_energy(s, nitsche, i));
    if (!(s.strain_energy[i] > 0))
      return Failure{FailureReason::negative_energy,
                     fmt::format("the strain energy of position {} is {:.4g} J/m", i, s.strain_energy[i])};
  }
  phases.push_back({"recovery", watch.lap()});
  s.phases = std::move(phases);
  return s;
}

template class RollingProblem<2>;
template class RollingProblem<3>;
#define WHEELWRIGHT_INSTANTIATE(dim)                                                                         \
  template RimControl rim_control(const RollingModel<dim>&);                                                 \
  template Matrix outer_rows(const CyclicStiffness<dim>&, const Matrix&, int);                               \
  template void add_outer_rows(const CyclicStiffness<dim>&, const Matrix&, Matrix&);                         \
  template void gather(const CyclicStiffness<dim>&, std::span<const int>, const Matrix&, Matrix&);           \
  template Expected<RolledContact<dim>> roll_to(const RollingModel<dim>&, const Tread<dim>&,                 \
                                                const CyclicStiffness<dim>&, GroundPosition, const Preload&, \
                                                const std::optional<ContactState<dim>>&);                    \
  template Expected<RolledContact<dim>> reload(const RollingModel<dim>&, const Tread<dim>&,                  \
                                               const CyclicStiffness<dim>&, GroundPosition, const Preload&,  \
                                               const RolledContact<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
