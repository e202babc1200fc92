#pragma once

#include <filesystem>
#include <vector>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// A point of the tread under one load position. Vectors in the body frame.
template <int dim>
struct TreadContactPoint {
  Vec<dim> position;      ///< before the deformation, relative to the axle [m]
  Vec<dim> displacement;  ///< the rim's motion included [m]
  Vec<dim> traction;      ///< of the ground on the loaded tread, by the law of the contact [Pa]
  double pressure;        ///< its part towards the axle, >= 0 [Pa]
  double friction;        ///< its part along the ground, positive towards larger azimuth [Pa]
  double gap;             ///< distance to the ground in the deformed state, negative: penetration [m]
  double weight;          ///< length of unloaded tread represented by the point [m]; in 3D its area [m^2]
};

/// The whole tread. In 2D by azimuth: in the contact zone there are all quadrature points, elsewhere, where
/// tractions are zero, one point per column of cells. In 3D all quadrature points, in lines around the tread
/// from one side face to the other: the points of a line have the same z and are in order around the wheel.
template <int dim>
using TreadContact = std::vector<TreadContactPoint<dim>>;

/// Of all load positions of a sector, those of images reflected.
template <int dim>
std::vector<TreadContact<dim>> all_tread_contacts(const StateSolver<dim>& solver, const State<dim>& state);

/// The tread as a closed line, or in 3D as a surface, for ParaView, with all of the above. Throws
/// OutputError.
template <int dim>
void write_tread_vtu(const std::filesystem::path& path, const TreadContact<dim>& tread);

/// A piece of the ground for ParaView: a rectangle, or in 3D a block, as long as the wheel, that the
/// undeformed tread touches at this azimuth of the body frame, the wheel leaning on it by the camber [rad].
/// Throws OutputError.
template <int dim>
void write_ground_vtu(const std::filesystem::path& path, const PolarGrid<dim>& grid, double ground_azimuth,
                      const Ground& ground = {}, double camber = 0);

}  // namespace wheelwright
