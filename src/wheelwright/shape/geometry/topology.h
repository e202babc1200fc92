#pragma once

#include <set>
#include <string>

#include "wheelwright/shape/geometry/components.h"

namespace wheelwright {

/// Changes of a shape other than the motion of its boundary.
enum class ShapeEventKind {
  hole_appeared,
  hole_vanished,
  holes_merged,
  hole_split,
  hole_at_rim_band,       ///< a hole reached the protected band at the rim
  hole_at_tread_band,     ///< a hole reached the protected band at the tread
  island_removed,         ///< material that was not attached to the rim was removed
  thin_wall_repaired,     ///< a wall below the minimum width was thickened or removed
  narrow_gap_repaired,    ///< a gap below the minimum width was filled
  sharp_corner_repaired,  ///< an internal corner below the minimum radius was rounded
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
    case ShapeEventKind::thin_wall_repaired:
      return "thin_wall_repaired";
    case ShapeEventKind::narrow_gap_repaired:
      return "narrow_gap_repaired";
    case ShapeEventKind::sharp_corner_repaired:
      return "sharp_corner_repaired";
  }
  return "unknown";
}

template <int dim>
struct ShapeEvent {
  ShapeEventKind kind;
  Vec<dim> place;  ///< (radius, azimuth[, axial]) in the sector
  double measure;  ///< area [m^2] or volume [m^3] of the hole or piece of material, as in Component; of the
                   ///< ball that fitted into a wall or gap where that was narrowest
};

/// Describes an event, e.g. "holes_merged of 83.2 mm^2 at azimuth 12.30 deg, radius 270.1 mm".
template <int dim>
std::string text(const ShapeEvent<dim>& event);

/// For each component of `of`, the indices into `with.all` of the holes that overlap it. The set is empty for
/// pieces of material. Both shapes must have the same grid.
template <int dim>
std::vector<std::set<int>> overlapping_holes(const Components<dim>& of, const Components<dim>& with);

/// The changes of the holes from one shape to another on the same grid. Overlapping holes are considered the
/// same hole. There is one event for each hole of `after` that joins several holes or is new, and for each
/// hole of `before` that split or vanished. A hole that moved by more than its own size counts as vanished
/// and appeared.
template <int dim>
std::vector<ShapeEvent<dim>> topology_changes(const Components<dim>& before, const Components<dim>& after);

}  // namespace wheelwright
