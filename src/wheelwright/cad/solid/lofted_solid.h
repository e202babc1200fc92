#pragma once

#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/solid/lofted_hole.h"
#include "wheelwright/shape/surface/faceted_solid.h"

namespace wheelwright::cad {

/// A solid between plane side faces: cylinders at rim and tread, and a smooth surface for every hole.
struct LoftedSolid {
  struct Hole {
    SplineSurface surface;
    bool faces_out;  ///< whether by_u x by_v points out of the material
  };
  /// An edge of a side face: that of a hole at v = 0 or at its last v.
  struct Edge {
    int hole;
    bool is_last;
    bool is_counter_clockwise;  ///< with the material on the left as seen from outside
  };
  struct SideFace {
    bool is_last;                     ///< at z = width, not at z = 0
    bool ends_at_rim, ends_at_tread;  ///< along the circle of a cylinder
    std::vector<Edge> edges;          ///< the others
  };

  double inner_radius, outer_radius, width;  ///< [m]
  std::vector<Hole> holes;
  std::vector<SideFace> side_faces;

  /// Into how many faces files divide the surface of a hole, around it.
  static constexpr int faces_per_hole = 4;
  std::size_t n_hole_faces() const { return faces_per_hole * holes.size(); }
  std::size_t n_faces() const { return 2 + side_faces.size() + n_hole_faces(); }
};

/// The solid of a closed surface whose holes are within `tolerance` [m] of {psi = 0}. Fails, with the reason,
/// for several bodies, closed cavities, holes through rim or tread, and holes that branch or are not
/// star-shaped about a line along the axle.
Expected<LoftedSolid, std::string> lofted_solid(const SurfaceMesh& mesh, const LevelSet<3>& psi,
                                                double tolerance);

/// Enclosed volume [m^3].
double enclosed_volume(const LoftedSolid& solid);

}  // namespace wheelwright::cad
