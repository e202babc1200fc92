#include "wheelwright/mechanics/rolling/rolled_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/base/shared_interrupt.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/mechanics/rolling/contact_failure.h"
#include "wheelwright/mechanics/rolling/position_tree.h"

namespace wheelwright {
namespace {

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
  const double radius = effective_radius(model.ground, grid.outer_radius);
  const double half_width =
      model.travel ? 0.5 * std::sqrt(2 * radius * std::max(*model.travel, 0.0))
                   : 2 * std::sqrt(line_load(model) * radius /
                                   (std::numbers::pi * model.materials.at_tread().contact_modulus()));
  const double to_middle = grid.outer_radius * std::abs(model.ground.standing(grid.outer_radius).tilt);
  const double width = std::min(margin * half_width + to_middle, grid.outer_radius * std::numbers::pi);
  return static_cast<int>(std::ceil(width / (grid.outer_radius * grid.column_angle()))) + 1 + between_columns;
}

/// Columns from the ground position to one beyond the last at which a rigid tread whose rim moves so would
/// reach the ground, within a quarter of the ring: other parts of uneven ground than where the wheel stands.
template <int dim>
int columns_reached(const RollingModel<dim>& model, const Tread<dim>& tread, GroundPosition ground,
                    const RimMotion& rim) {
  const int half = (model.grid.ring_columns() / 2 - 1) / 2;
  const auto at = contact_points(tread, model.grid, ground, {ground.column - half, 2 * half}, model.ground);
  int reached = 0;
  for (int i = 0; i < at.size(); ++i)
    if (at.points[i].gap < rim_displacement(at.points[i], rim)[0])
      reached = std::max(reached, std::max(half - at.column(i), at.column(i) - half + 1));
  return std::min(half, reached + 1);
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

/// The surface's compliance for contact zones at some positions, `half` columns to either side.
template <int dim>
SurfaceCompliance<dim> surface_compliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                          const PolarGrid<dim>& grid, const LoadPositions& positions,
                                          int half) {
  return {ring, tread, 2 * half - 1, columns_in_zones(grid, positions, half)};
}

/// `known` if it is wide enough for the likely contact zones.
template <int dim>
std::shared_ptr<const SurfaceCompliance<dim>> likely_surface(
    const RollingModel<dim>& model, const Tread<dim>& tread, const CyclicStiffness<dim>& ring,
    std::shared_ptr<const SurfaceCompliance<dim>> known, const LoadPositions& positions) {
  const int n_columns = model.grid.ring_columns();
  const bool between_columns =
      std::ranges::any_of(positions.grounds, [](const GroundPosition& ground) { return ground.offset > 0; });
  const int likely_half = std::min(columns_in_contact(model, between_columns), (n_columns - 1) / 2);
  if (!known && has_linear_contact(model))
    known = std::make_shared<const SurfaceCompliance<dim>>(ring, tread, n_columns / 2);
  if (known && known->width() >= 2 * likely_half - 1) return known;
  return std::make_shared<const SurfaceCompliance<dim>>(
      surface_compliance(ring, tread, model.grid, positions, likely_half));
}

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
  if (known) starts.push_back(start_from(contact, *known));
  const double radius = model.grid.outer_radius;
  starts.push_back(model.travel
                       ? undeformed_start(contact)
                       : hertz_start(contact, line_load(model), effective_radius(model.ground, radius),
                                     model.materials.at_tread().contact_modulus(),
                                     radius * std::sin(model.ground.standing(radius).tilt)));
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
  const auto law = contact_law_of(model);
  if (law->is_linear()) {
    const int n = grid.ring_columns();
    auto contact = reduced_contact<dim>(surface, tread, grid, ground, {ground.column - n / 2, n}, law,
                                        rim_control(model, preload), preload, model.ground);
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
    auto contact =
        reduced_contact<dim>(wider ? *wider : surface, tread, grid, ground, {ground.column - half, 2 * half},
                             law, rim_control(model, preload), preload, model.ground);
    auto state = solve_in_zone(model, contact, known, interrupt);
    if (!state) return state.failure();
    const int reached = model.ground.is_even() ? 0 : columns_reached(model, tread, ground, state->rim);
    if ((!touches_edge(*state) && reached <= half) || half >= largest_half)
      return RolledContact<dim>{std::move(contact), *std::move(state)};
    known = *std::move(state);
    half = std::max(half + std::max(2, half / 8), reached);
  }
}

template <int dim>
Expected<RolledContact<dim>> reload(const RollingModel<dim>& model, const Tread<dim>& tread,
                                    const CyclicStiffness<dim>& ring, const SurfaceCompliance<dim>& surface,
                                    GroundPosition ground, const Preload& preload,
                                    const RolledContact<dim>& before) {
  if (!(model.ground == before.contact.tread().at.shape))
    return roll_to<dim>(model, tread, ring, surface, ground, preload, {});
  ReducedContact<dim> contact = before.contact.under(rim_control(model, preload));
  auto state = solve_in_zone<dim>(model, contact, before.state, Interrupt());
  if (!state) return state.failure();
  const bool is_wide = touches_edge(*state) ||
                       (!model.ground.is_even() &&
                        2 * columns_reached(model, tread, ground, state->rim) > contact.zone().n_columns);
  if (is_wide && !has_linear_contact(model))
    return roll_to<dim>(model, tread, ring, surface, ground, preload, *state);
  return RolledContact<dim>{std::move(contact), *std::move(state)};
}

template <int dim>
Expected<RolledContacts<dim>> roll_to_all(const RollingModel<dim>& model, const Tread<dim>& tread,
                                          const CyclicStiffness<dim>& ring,
                                          std::shared_ptr<const SurfaceCompliance<dim>> known,
                                          const LoadPositions& positions, std::span<const Preload> preloads,
                                          const Interrupt& interrupt) {
  auto surface = likely_surface(model, tread, ring, std::move(known), positions);
  const int n = positions.size();
  const Interrupt shared = shared_by_threads(interrupt);
  const auto roll = [&](int i, const std::optional<ContactState<dim>>& neighbour) {
    auto rolled = roll_to(model, tread, ring, *surface, positions.grounds[i], preloads[i], neighbour,
                          shared.at_position(i, n));
    std::optional<Failure> failure;
    if (rolled) failure = rim_under_ground(model, rolled->state.rim);
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
    if (widest > surface->width() + 1 && !has_linear_contact(model))
      surface = std::make_shared<const SurfaceCompliance<dim>>(
          surface_compliance(ring, tread, model.grid, positions, widest / 2));
  }
  RolledContacts<dim> result{std::move(surface), {}, {}};
  for (auto& rolled : all) {
    result.contacts.push_back(std::move((**rolled).contact));
    result.states.push_back(std::move((**rolled).state));
  }
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                        \
  template Expected<RolledContact<dim>> roll_to(const RollingModel<dim>&, const Tread<dim>&,                \
                                                const CyclicStiffness<dim>&, const SurfaceCompliance<dim>&, \
                                                GroundPosition, const Preload&,                             \
                                                const std::optional<ContactState<dim>>&, const Interrupt&); \
  template Expected<RolledContact<dim>> reload(const RollingModel<dim>&, const Tread<dim>&,                 \
                                               const CyclicStiffness<dim>&, const SurfaceCompliance<dim>&,  \
                                               GroundPosition, const Preload&, const RolledContact<dim>&);  \
  template Expected<RolledContacts<dim>> roll_to_all(                                                       \
      const RollingModel<dim>&, const Tread<dim>&, const CyclicStiffness<dim>&,                             \
      std::shared_ptr<const SurfaceCompliance<dim>>, const LoadPositions&, std::span<const Preload>,        \
      const Interrupt&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
