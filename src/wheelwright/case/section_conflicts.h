#pragma once

#include <vector>

#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/drawn_shapes.h"

namespace wheelwright {

// One function per subject, in a file of its name: each adds the conflicts that it finds.

void wheel_conflicts(const Case& c, Conflicts& found);
void grid_conflicts(const Case& c, Conflicts& found);
/// `shapes` are the drawn shapes of the case.
void hole_conflicts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found);
void saved_shape_conflicts(const Case& c, Conflicts& found);
/// Keys of drawn shapes that contradict each other, holes beyond the bands, material beyond the ring,
/// outlines that cross themselves, too many curves, drawings that are not the same in all sectors.
void shape_conflicts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found);
void load_conflicts(const Case& c, Conflicts& found);
/// Grounds that lack a value, do not fit the wheel, or do not go together with other loads.
void ground_conflicts(const Case& c, Conflicts& found);
void contact_conflicts(const Case& c, Conflicts& found);
void material_conflicts(const Case& c, Conflicts& found);
/// A section heat without what it needs.
void heat_conflicts(const Case& c, Conflicts& found);
void large_strain_conflicts(const Case& c, Conflicts& found);
/// Ranges of radii of layers, whose places must be valid.
void design_radius_conflicts(const Case& c, Conflicts& found);
/// Keys that exist only in 2D or only in 3D.
void dimension_conflicts(const Case& c, Conflicts& found);
void objective_conflicts(const Case& c, Conflicts& found);
void volume_conflicts(const Case& c, Conflicts& found);
void optimizer_conflicts(const Case& c, Conflicts& found);
/// Minimum widths of walls and gaps, and minimum radii of corners.
void width_conflicts(const Case& c, Conflicts& found);
void constraint_conflicts(const Case& c, Conflicts& found);
void expectation_conflicts(const Case& c, Conflicts& found);

/// Loads that would crush the walls between holes. An estimate, used only if the case has other conflicts;
/// otherwise a solve decides.
void wall_conflicts(const Case& c, Conflicts& found);
/// Minimum widths of gaps that would fill all drawn holes. Only for a case without other conflicts.
void widest_gap_conflicts(const Case& c, Conflicts& found);

}  // namespace wheelwright
