#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/cad/solid/lofted_solid.h"
#include "wheelwright/output/report/layer_circles.h"
#include "wheelwright/output/report/solid_mesh.h"
#include "wheelwright/shape/geometry/print.h"
#include "wheelwright/shape/surface/faceted_solid.h"

namespace wheelwright {

/// A layer of a wheel of several materials, as a wheel of its own.
struct WheelLayer {
  std::string name;
  LevelSet<2> shape;
  cad::Outline outline;  ///< its part of the wheel's outline, cut by circles (cad/outline/cut_outline.h)
};

/// A plane wheel as CAD and workshop programs see it: an outline, and the solid obtained by extruding it
/// along the axle. Files of all formats are in millimetres, with the axle at the origin, azimuth 0 along x,
/// and the solid from z = 0 to its width.
struct WheelModel {
  std::string title;
  std::string program;   ///< that wrote it, e.g. "wheelwright 1.0"
  LevelSet<2> shape;     ///< from which the outline was made
  cad::Outline outline;  ///< [m]
  double width;          ///< [m]
  double tolerance;      ///< of chords and cubics that replace curves a format does not support [m]
  std::vector<WheelLayer> layers = {};  ///< from the rim to the tread; empty: there is one material
};

struct SurfaceLayer {
  std::string name;
  LevelSet<3> shape;
  SurfaceMesh surface;
  int parts;  ///< as in SurfaceModel
};

/// A wheel whose shape changes along the axle: a closed surface. Placed in files like the solid of a
/// WheelModel.
struct SurfaceModel {
  std::string title;
  std::string program;
  LevelSet<3> shape;    ///< from which the surface was made
  SurfaceMesh surface;  ///< [m]
  int parts;            ///< into which each cell was divided along each axis for the surface
  int map_degree;       ///< of its isoparametric cells
  std::vector<SurfaceLayer> layers = {};
  SideFace shown = SideFace::larger_z;  ///< in pictures
};

/// The faces of a solid whose shape changes along the axle.
using SolidFaces = std::variant<cad::LoftedSolid, FacetedSolid>;

struct FacesLayer {
  std::string name;
  SolidFaces solid;
};

/// A wheel whose shape changes along the axle, as a solid with smooth faces or with facets. Placed in files
/// like the solid of a WheelModel.
struct FacesModel {
  std::string title;
  std::string program;
  SolidFaces solid;
  std::vector<FacesLayer> layers = {};
};

struct TurnedLayer {
  std::string name;
  cad::Outline outline;  ///< its part of the profile
};

/// A body of revolution by its profile (cad/outline/profile.h), which turns about the axle. Placed in files
/// like the solid of a WheelModel; in drawings the axle is the line y = 0, with z to the right and the radius
/// upwards.
struct TurnedModel {
  std::string title;
  std::string program;
  cad::Outline outline;  ///< the profile
  double width;          ///< [m]
  double outer_radius;   ///< [m]
  double tolerance;      ///< as in WheelModel
  std::vector<TurnedLayer> layers = {};
};

/// A body of a SolidModel.
struct SolidBody {
  std::string name;
  SolidMesh mesh;
};

/// Either of them, for programs that support only triangles.
struct SolidModel {
  std::string title;
  std::string program;
  std::vector<SolidBody> bodies;  ///< the whole wheel, or its layers
};

/// A layer of a wheel as a wheel.
WheelModel layer_model(const WheelModel& wheel, const WheelLayer& layer);
SurfaceModel layer_model(const SurfaceModel& wheel, const SurfaceLayer& layer);
FacesModel layer_model(const FacesModel& wheel, const FacesLayer& layer);
TurnedModel layer_model(const TurnedModel& wheel, const TurnedLayer& layer);

/// The circles between the layers.
template <class Model>
LayerCircles layer_circles(const Model& wheel) {
  LayerCircles circles;
  for (const auto& layer : wheel.layers) {
    circles.names.push_back(layer.name);
    if (&layer != &wheel.layers.back()) circles.radii.push_back(layer.shape.lattice.grid().outer_radius);
  }
  return circles;
}

/// The layer of every row of cells, as in layers_of_rows().
template <class Model>
std::vector<int> layers_of_rows(const Model& wheel) {
  std::vector<int> result;
  for (const auto& layer : wheel.layers)
    result.insert(result.end(), layer.shape.lattice.grid().cells[0],
                  static_cast<int>(&layer - wheel.layers.data()));
  return result;
}

/// Red, green and blue of a layer in files with colours.
std::array<std::uint8_t, 3> layer_colour(std::size_t layer);

/// All formats write millimetres.
inline constexpr double millimetres_per_metre = 1e3;

}  // namespace wheelwright
