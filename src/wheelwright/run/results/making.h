#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/output/report/made_wheel.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// How a shape of a case in 3D is made, with its smallest draft or largest overhang measured on its surface.
MadeWheel made_wheel(const Case& c, const SurfaceMesh& surface);

/// The same, measured on the surface of pictures and files of a run; nothing in 2D.
template <int dim>
std::optional<MadeWheel> made_wheel(const Case& c, const LevelSet<dim>& shape);

/// The side face that pictures of a wheel in 3D show: that at z = width, unless it is printed on this one.
SideFace shown_side_face(const Case& c);

}  // namespace wheelwright
