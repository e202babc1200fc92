#include "wheelwright/output/export/stl.h"

namespace wheelwright {

std::string stl(const SolidModel& solid) {
  return stl_file(solid.bodies.front().mesh, solid.program + ", millimetres: " + solid.title);
}

}  // namespace wheelwright
