#include "wheelwright/shape/geometry/topology.h"

#include <fmt/format.h>

#include <cassert>

#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {

template <int dim>
std::string text(const ShapeEvent<dim>& event) {
  return fmt::format("{} of {} at {}", to_string(event.kind), measure_text<dim>(event.measure),
                     place_text<dim>(event.place));
}

template <int dim>
std::vector<std::set<int>> overlapping_holes(const Components<dim>& of, const Components<dim>& with) {
  assert(of.of_sample.size() == with.of_sample.size());
  std::vector<std::set<int>> result(of.all.size());
  for (std::size_t k = 0; k < of.of_sample.size(); ++k) {
    const int one = of.of_sample[k], other = with.of_sample[k];
    if (!of.all[one].is_material && !with.all[other].is_material) result[one].insert(other);
  }
  return result;
}

namespace {

/// Adds one event for each hole of `of` that overlaps several holes of `with` or none.
template <int dim>
void compare(const Components<dim>& of, const Components<dim>& with, ShapeEventKind several,
             ShapeEventKind none, std::vector<ShapeEvent<dim>>& events) {
  const auto partners = overlapping_holes(of, with);
  for (std::size_t k = 0; k < of.all.size(); ++k) {
    const Component<dim>& hole = of.all[k];
    if (hole.is_material || partners[k].size() == 1) continue;
    events.push_back({partners[k].empty() ? none : several, hole.centre, hole.measure});
  }
}

}  // namespace

template <int dim>
std::vector<ShapeEvent<dim>> topology_changes(const Components<dim>& before, const Components<dim>& after) {
  std::vector<ShapeEvent<dim>> events;
  compare(before, after, ShapeEventKind::hole_split, ShapeEventKind::hole_vanished, events);
  compare(after, before, ShapeEventKind::holes_merged, ShapeEventKind::hole_appeared, events);
  return events;
}

template std::string text(const ShapeEvent<2>&);
template std::string text(const ShapeEvent<3>&);
template decltype(overlapping_holes<2>) overlapping_holes<2>;
template decltype(overlapping_holes<3>) overlapping_holes<3>;
template decltype(topology_changes<2>) topology_changes<2>;
template decltype(topology_changes<3>) topology_changes<3>;

}  // namespace wheelwright
