#pragma once

#include <set>
#include <string>

#include "wheelwright/geometry/components.h"

namespace wheelwright {

/// What happens to a shape besides the motion of its boundary.
enum class ShapeEventKind {
  hole_appeared,
  hole_vanished,
  holes_merged,
  hole_split,
  hole_at_rim_band,    ///< a hole came to the protected band at the rim
  hole_at_tread_band,  ///< a hole came to the protected band at the tread
  island_removed,      ///< material that was not attached to the rim
};

/// The kind as a word for logs and files, e.g. "holes_merged".
constexpr const char* to_string(ShapeEventKind kind) {
  switch (kind) {
    case ShapeEventKind::hole_appeared:
      return "hole_appeared";
    case ShapeEventKind::hole_vanished:
      return "hole_vanished";
    case ShapeEventKind::holes_merged:
      return "holes_merged";
    case ShapeEventKind::hole_split:
      return "hole_split";
    case ShapeEventKind::hole_at_rim_band:
      return "hole_at_rim_band";
    case ShapeEventKind::hole_at_tread_band:
      return "hole_at_tread_band";
    case ShapeEventKind::island_removed:
      return "island_removed";
  }
  return "unknown";
}

template <int dim>
struct ShapeEvent {
  ShapeEventKind kind;
  Vec<dim> place;  ///< (radius, azimuth[, axial]) in the sector
  double measure;  ///< of the hole or the piece of material [m^2, or m^3 when dim = 3], as in Component
};

/// "holes_merged of 83.2 mm^2 at azimuth 12.30 deg, radius 270.1 mm".
template <int dim>
std::string text(const ShapeEvent<dim>& event);

/// The holes of one shape that overlap each hole of another on the same grid: indices into `with.all`, one
/// set a component of `of`.
template <int dim>
std::vector<std::set<int>> overlapping_holes(const Components<dim>& of, const Components<dim>& with);

/// How the holes of one shape became those of another on the same grid, by which of them overlap: an event
/// for every hole of `after` that joins several or is new, and for every hole of `before` that is in several
/// parts or gone. A hole that moved farther than its own size counts as vanished and appeared.
template <int dim>
std::vector<ShapeEvent<dim>> topology_changes(const Components<dim>& before, const Components<dim>& after);

}  // namespace wheelwright
