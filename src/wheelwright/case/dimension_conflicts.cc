#include <fmt/format.h>

#include <array>
#include <utility>

#include "wheelwright/case/load_case_conflicts.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

namespace {

/// Keys that exist only in 2D or only in 3D.
void check_dimension(const Case& c, Conflicts& found) {
  if (c.wheel.dimension == 2) {
    if (c.wheel.side_faces != SideFaces::free)
      found.push_back({{"wheel.side_faces", "wheel.dimension"},
                       "a 2D wheel has no side faces; plane strain already fixes them",
                       "omit the key, or use dimension = 3"});
    for (const auto& [key, value] :
         {std::pair("load.lateral_force", c.load.lateral_force), std::pair("load.camber", c.load.camber)})
      if (value != 0)
        found.push_back({{key, "wheel.dimension"},
                         "a 2D wheel has no axial direction",
                         "omit the key, or use dimension = 3"});
    for (const auto& [name, n] :
         {std::pair("sphere", c.holes.spheres.size()), std::pair("tapered", c.holes.tapered.size())})
      if (n > 0)
        found.push_back({{fmt::format("holes.{}[1].count", name), "wheel.dimension"},
                         "such a hole exists only in 3D",
                         "use dimension = 3, or [[holes.ring]]"});
    return;
  }
  if (c.material.plane == Plane::stress)
    found.push_back({{"material.plane", "wheel.dimension"},
                     "plane stress is a 2D assumption",
                     "omit the key: in 3D the side faces are free of stress"});
  const bool leans = c.load.camber != 0, is_pushed = c.load.lateral_force != 0;
  if (c.wheel.side_faces == SideFaces::symmetric && (leans || is_pushed))
    found.push_back(
        {{"wheel.side_faces", leans ? "load.camber" : "load.lateral_force"},
         "symmetric side faces fix the wheel along the axle, so it can neither lean nor be pushed",
         "use side_faces = \"free\""});
  if (leans && (c.load.torque != 0 || c.load.hole_pressure != 0 || c.load.speed != 0 ||
                c.load.body_force != std::array<double, 2>{}))
    found.push_back({{"load.camber", "load.torque", "load.body_force", "load.hole_pressure", "load.speed"},
                     "a leaning wheel supports only forces on its rim",
                     "omit torque, body_force, hole_pressure and speed, or use camber = 0"});
  constexpr double largest = 0.4;
  if (c.grid.degree == 1 && c.material.poissons_ratio > largest && !c.material.nearly_incompressible())
    found.push_back({{"grid.degree", "material.poissons_ratio", "wheel.dimension"},
                     fmt::format("elements of degree 1 lock: with poissons_ratio = {} the wheel would be "
                                 "tens of percent too stiff, with a different optimum",
                                 c.material.poissons_ratio),
                     fmt::format("use degree = 2, or poissons_ratio <= {}", largest)});
}

}  // namespace

void dimension_conflicts(const Case& c, Conflicts& found) {
  check_load_cases(c, all_load_cases(c), found, check_dimension);
}

}  // namespace wheelwright
