#pragma once

#include <string>
#include <vector>

#include "wheelwright/output/report/deformed_svg.h"
#include "wheelwright/output/report/lit_scene.h"
#include "wheelwright/shape/geometry/print.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// Points of the body frame in a scene (Camera): the contact's azimuth points down, the axle is along z, and
/// the origin is in the middle of the axle.
std::vector<Vec<3>> standing_on_the_ground(std::vector<Vec<3>> points, const PolarGrid<3>& grid,
                                           double contact_azimuth);

/// A view of the whole wheel and of one of its side faces, from the right and from above.
Camera wheel_camera(const PolarGrid<3>& grid, SideFace shown = SideFace::larger_z);

/// A surface without load, in one colour, with lines between layers, in the scene of that view. If it has
/// closed cavities, it is cut open to show them, with the cut faces in another colour.
std::vector<LitBody> lit_wheel(const SurfaceMesh& surface, const PolarGrid<3>& grid,
                               SideFace shown = SideFace::larger_z, const LayerCircles& layers = {});

/// Points of the body frame, displaced for a picture: `displacement` [component][point], magnified. Like
/// DeformedMaterial, moves onto the ground points of the tread that magnified displacements would move
/// through it, and proportionally the material between them and the rim.
std::vector<Vec<3>> displaced(const std::vector<Vec<3>>& points,
                              const std::vector<std::vector<float>>& displacement, const Lattice<3>& lattice,
                              const DeformedPicture<3>& picture);

/// The picture as an SVG document: the lit surface with its colours, which holds pixels, lines between
/// layers, the ground, the colours' scale, load, position and magnification.
std::string deformed_svg(const SurfaceMesh& surface, const Lattice<3>& lattice,
                         const DeformedPicture<3>& picture);

}  // namespace wheelwright
