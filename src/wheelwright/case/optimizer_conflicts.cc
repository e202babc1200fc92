#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/manufacture_words.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

/// The paper's rules need steepest descent.
void check_method(const Case& c, Conflicts& found) {
  if (c.optimizer.velocity == VelocityKind::vector && optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{key_of(&Optimizer::velocity), key_of(&Optimizer::method), key_of(&Volume::control)},
                     "steepest descent moves the boundary by a speed along its normal",
                     "use velocity = \"h1\", or method = \"sequential_quadratic\" with volume.control = "
                     "\"exact\""});
  if (c.optimizer.method != OptimizerMethod::sequential_quadratic) return;
  const auto refuse = [&](const CaseKey& key, const char* other) {
    found.push_back({{key, key_of(&Optimizer::method)},
                     "it is valid only with steepest descent",
                     fmt::format("use method = \"descent\" or omit the key, or use {}", other)});
  };
  if (c.optimizer.velocity == VelocityKind::harmonic) refuse(key_of(&Optimizer::velocity), "\"h1\"");
  if (c.volume.control == VolumeControl::paper) refuse(key_of(&Volume::control), "\"exact\"");
}

/// The topological derivative is that of a round hole, or a ball, without load on its boundary.
void check_nucleation(const Case& c, Conflicts& found) {
  if (c.optimizer.nucleation == NucleationTime::never) return;
  const auto refuse = [&](CaseKeys keys, std::string problem) {
    found.push_back({std::move(keys), std::move(problem), "use nucleation = \"never\""});
  };
  if (c.wheel.dimension == 3 && c.optimizer.made != Manufacture::free)
    refuse({key_of(&Optimizer::nucleation), key_of(&Optimizer::made)},
           "new holes in 3D are balls, which are only made in free shapes");
  const std::vector<SingleLoad> loads = single_loads(c);
  const auto has_pressure = [](const SingleLoad& single) { return single.c.load.hole_pressure != 0; };
  if (const auto pressed = std::ranges::find_if(loads, has_pressure); pressed != loads.end())
    refuse({key_of(&Optimizer::nucleation), pressed->key(&Load::hole_pressure)},
           "nucleation does not support hole pressure");
  const std::vector<PlacedMaterial> ring = placed_materials(c);
  const auto orthotropic = std::ranges::find_if(ring, &PlacedMaterial::orthotropic);
  if (orthotropic != ring.end() && c.wheel.dimension == 3)
    refuse({key_of(&Optimizer::nucleation), orthotropic->youngs_modulus_key()},
           "the effect of new holes in 3D is known only in isotropic materials");
  else if (orthotropic != ring.end() && optimizes_stresses(c))
    refuse({key_of(&Optimizer::nucleation), key_of(&Objective::minimize), orthotropic->youngs_modulus_key()},
           "the effect of new holes on stresses is known only in isotropic materials");
  if (optimizes_temperatures(c))
    refuse({key_of(&Optimizer::nucleation), key_of(&Objective::minimize)},
           "the effect of new holes on the temperature is not known");
}

/// The initial shape must be one that can be made so; a saved shape is made to fit.
void check_manufacture(const Case& c, Conflicts& found) {
  const auto refuse = [&](const CaseKey& key, std::size_t n, const char* problem, const char* remedy) {
    if (n > 0) found.push_back({{key, key_of(&Optimizer::made)}, problem, remedy});
  };
  if (c.optimizer.made == Manufacture::extruded) {
    constexpr auto problem = "the hole is not the same along the axle";
    constexpr auto remedy = "use [[holes.ring]] or drawn shapes, or made = \"free\"";
    refuse(key_of(&HoleSphere::count, 0), c.holes.spheres.size(), problem, remedy);
    refuse(key_of(&HoleTapered::count, 0), c.holes.tapered.size(), problem, remedy);
    refuse(key_of(&HoleGroove::depth, 0), c.holes.grooves.size(), problem, remedy);
  }
  if (c.optimizer.made != Manufacture::turned) return;
  constexpr auto problem = "the hole is not a body of revolution";
  constexpr auto remedy = "use [[holes.groove]], or made = \"free\"";
  refuse(key_of(&HoleRing::count, 0), c.holes.rings.size(), problem, remedy);
  refuse(key_of(&HoleCircle::center, 0), c.holes.circles.size(), problem, remedy);
  refuse(key_of(&HoleSphere::count, 0), c.holes.spheres.size(), problem, remedy);
  refuse(key_of(&HoleTapered::count, 0), c.holes.tapered.size(), problem, remedy);
  if (c.shapes != Shapes{})
    found.push_back({{key_of(&Optimizer::made)}, "drawn shapes are not bodies of revolution", remedy});
}

/// A key that needs another way of making the wheel.
void refuse_unless_made(Manufacture made, const CaseKey& key, const Case& c, Conflicts& found) {
  if (c.optimizer.made == made) return;
  const auto how = manufacture_words[static_cast<std::size_t>(made)];
  found.push_back({{key, key_of(&Optimizer::made)},
                   fmt::format("the wheel is not {}", how),
                   fmt::format("omit the key, or use made = \"{}\"", how)});
}

/// The keys of a print need one.
void check_print(const Case& c, Conflicts& found) {
  const Optimizer& o = c.optimizer;
  if (o.overhang) refuse_unless_made(Manufacture::printed, key_of(&Optimizer::overhang), c, found);
  if (o.stands_on != SideFace::smaller_z)
    refuse_unless_made(Manufacture::printed, key_of(&Optimizer::stands_on), c, found);
}

/// The keys of a mould need one, and it parts between cells.
void check_mould(const Case& c, Conflicts& found) {
  const Optimizer& o = c.optimizer;
  if (o.parting_plane) refuse_unless_made(Manufacture::moulded, key_of(&Optimizer::parting_plane), c, found);
  if (o.parting != Parting::given)
    refuse_unless_made(Manufacture::moulded, key_of(&Optimizer::parting), c, found);
  if (o.parting == Parting::found && o.parting_plane)
    found.push_back({{key_of(&Optimizer::parting), key_of(&Optimizer::parting_plane)},
                     "the parting plane is given and to be found",
                     "omit one of the two"});
  const Quantity& minimized = c.objective.minimize;
  const bool is_of_volume = minimized == built_in("mass") || minimized == built_in("volume_fraction");
  if (o.parting == Parting::found && is_of_volume)
    found.push_back({{key_of(&Optimizer::parting), key_of(&Objective::minimize)},
                     "the planes are compared at the same volume, where all wheels weigh the same",
                     "give parting_plane, or minimize another quantity"});
  if (o.draft != 0) refuse_unless_made(Manufacture::moulded, key_of(&Optimizer::draft), c, found);
  if (c.wheel.dimension != 3 || o.made != Manufacture::moulded || !o.parting_plane) return;
  const double cell = c.wheel.width / c.grid.axial_cells, plane = *o.parting_plane;
  const int nearest = std::clamp(static_cast<int>(std::lround(plane / cell)), 0, c.grid.axial_cells);
  if (std::abs(plane - nearest * cell) > 1e-6 * cell)
    found.push_back({{key_of(&Optimizer::parting_plane), key_of(&Grid::axial_cells)},
                     fmt::format("no plane between cells lies at {:.6g} m", plane),
                     fmt::format("use {:.6g} m, or other axial_cells", nearest * cell)});
}

}  // namespace

void optimizer_conflicts(const Case& c, Conflicts& found) {
  check_method(c, found);
  check_nucleation(c, found);
  check_manufacture(c, found);
  check_mould(c, found);
  check_print(c, found);
}

}  // namespace wheelwright
