#pragma once

#include <span>
#include <string>

#include "wheelwright/output/report/field_points.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// The vertices of a surface in sector 0, to evaluate fields there and in the other sectors: in the order of
/// the surface's points.
FieldPoints<3> field_points(const SurfaceMesh& surface, const Lattice<3>& lattice);

/// The surface as a ParaView file with fields at its vertices, and for every triangle the part of the
/// boundary (`part`: 0 the rim, 1 the tread, 2 a side face, 3 a hole). `lattice` carries the fields. The
/// numbers are written as they are.
std::string surface_vtp(const SurfaceMesh& surface, const Lattice<3>& lattice,
                        std::span<const NamedField> fields);

}  // namespace wheelwright
