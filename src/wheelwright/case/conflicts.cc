#include "wheelwright/case/conflicts.h"

#include "wheelwright/case/drawn_shapes.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

Conflicts conflicts(const Case& c) {
  Conflicts found;
  const std::vector<DrawnShape> shapes = drawn_shapes(c);
  wheel_conflicts(c, found);
  grid_conflicts(c, found);
  hole_conflicts(c, shapes, found);
  saved_shape_conflicts(c, found);
  shape_conflicts(c, shapes, found);
  load_conflicts(c, found);
  ground_conflicts(c, found);
  contact_conflicts(c, found);
  material_conflicts(c, found);
  heat_conflicts(c, found);
  large_strain_conflicts(c, found);
  dimension_conflicts(c, found);
  objective_conflicts(c, found);
  volume_conflicts(c, found);
  optimizer_conflicts(c, found);
  width_conflicts(c, found);
  constraint_conflicts(c, found);
  expectation_conflicts(c, found);
  if (found.empty())
    widest_gap_conflicts(c, found);
  else
    wall_conflicts(c, found);
  return found;
}

}  // namespace wheelwright
