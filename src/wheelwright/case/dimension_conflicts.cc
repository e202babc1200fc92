#include <fmt/format.h>

#include <array>
#include <utility>

#include "wheelwright/case/layers.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

/// A 2D wheel has no width.
void check_plane_wheel(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  if (c.wheel.side_faces != SideFaces::free)
    found.push_back({{key_of(&Wheel::side_faces), key_of(&Wheel::dimension)},
                     "a 2D wheel has no side faces; plane strain already fixes them",
                     "omit the key, or use dimension = 3"});
  for (const auto& [key, value] : {std::pair(single.key(&Load::lateral_force), c.load.lateral_force),
                                   std::pair(single.key(&Load::camber), c.load.camber)})
    if (value != 0)
      found.push_back({{key, key_of(&Wheel::dimension)},
                       "a 2D wheel has no axial direction",
                       "omit the key, or use dimension = 3"});
  for (const auto& [key, n] : {std::pair(key_of(&HoleSphere::count, 0), c.holes.spheres.size()),
                               std::pair(key_of(&HoleTapered::count, 0), c.holes.tapered.size()),
                               std::pair(key_of(&HoleGroove::depth, 0), c.holes.grooves.size())})
    if (n > 0)
      found.push_back({{key, key_of(&Wheel::dimension)},
                       "such a hole exists only in 3D",
                       "use dimension = 3, or [[holes.ring]]"});
  if (c.optimizer.made != Manufacture::free)
    found.push_back({{key_of(&Optimizer::made), key_of(&Wheel::dimension)},
                     "a 2D wheel has one section",
                     "omit the key, or use dimension = 3"});
}

/// Finds keys that wheels in 3D do not support.
void check_solid_wheel(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  if (c.material.plane == Plane::stress)
    found.push_back({{key_of(&Material::plane), key_of(&Wheel::dimension)},
                     "plane stress is a 2D assumption",
                     "omit the key: in 3D the side faces are free of stress"});
  const bool leans = c.load.camber != 0, is_pushed = c.load.lateral_force != 0;
  if (c.wheel.side_faces == SideFaces::symmetric && (leans || is_pushed))
    found.push_back(
        {{key_of(&Wheel::side_faces), leans ? single.key(&Load::camber) : single.key(&Load::lateral_force)},
         "symmetric side faces fix the wheel along the axle, so it can neither lean nor be pushed",
         "use side_faces = \"free\""});
  if (leans && (c.load.torque != 0 || c.load.hole_pressure != 0 || c.load.speed != 0 ||
                c.load.body_force != std::array<double, 2>{}))
    found.push_back({{single.key(&Load::camber), single.key(&Load::torque), single.key(&Load::body_force),
                      single.key(&Load::hole_pressure), single.key(&Load::speed)},
                     "a leaning wheel supports only forces on its rim",
                     "omit torque, body_force, hole_pressure and speed, or use camber = 0"});
  constexpr double largest = 0.4;
  for (const PlacedMaterial& placed : placed_materials(c))
    if (const Material* material = placed.isotropic(); c.grid.degree == 1 && material &&
                                                       material->poissons_ratio > largest &&
                                                       !material->nearly_incompressible())
      found.push_back({{key_of(&Grid::degree), placed.poissons_ratio_key(), key_of(&Wheel::dimension)},
                       fmt::format("elements of degree 1 lock: with poissons_ratio = {} the wheel would be "
                                   "tens of percent too stiff, with a different optimum",
                                   material->poissons_ratio),
                       fmt::format("use degree = 2, or poissons_ratio <= {}", largest)});
}

}  // namespace

void dimension_conflicts(const Case& c, Conflicts& found) {
  check_loads(single_loads(c), found, c.wheel.dimension == 2 ? check_plane_wheel : check_solid_wheel);
}

}  // namespace wheelwright
