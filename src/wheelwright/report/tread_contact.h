#pragma once

#include <filesystem>
#include <vector>

#include "wheelwright/state/state.h"

namespace wheelwright {

/// A point of the tread under one load position. Vectors in the body frame.
struct TreadContactPoint {
  Vec<2> position;      ///< before the deformation, relative to the axle [m]
  Vec<2> displacement;  ///< the rim's motion included [m]
  Vec<2> traction;      ///< of the ground on the tread, by the law of the contact [Pa]
  double pressure;      ///< its part towards the axle, >= 0 [Pa]
  double friction;      ///< its part along the ground, positive towards larger azimuth [Pa]
  double gap;           ///< distance to the ground in the deformed state, negative: penetration [m]
  double weight;        ///< length of tread that the point stands for [m]
};

/// The whole tread, by azimuth. In the contact zone there are all quadrature points, elsewhere, where
/// tractions are zero, one point per column of cells.
using TreadContact = std::vector<TreadContactPoint>;

/// Of all load positions of a sector, those of images reflected.
std::vector<TreadContact> all_tread_contacts(const StateSolver<2>& solver, const State<2>& state);

/// The tread as a closed line for ParaView, with all of the above. Throws OutputError.
void write_tread_vtu(const std::filesystem::path& path, const TreadContact& tread);

/// A piece of the ground for ParaView: a rectangle, as long as the wheel, that the undeformed tread touches
/// at this azimuth of the body frame [rad]. Throws OutputError.
void write_ground_vtu(const std::filesystem::path& path, const PolarGrid<2>& grid, double ground_azimuth);

}  // namespace wheelwright
