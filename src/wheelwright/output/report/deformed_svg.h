#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/mechanics/state/rim.h"
#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/output/report/colour_scale.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/geometry/print.h"

namespace wheelwright {

/// How the colours of a picture cover its values.
enum class ScaleKind {
  all,          ///< from the minimum to the maximum
  without_tail  ///< values >= 0: from 0 to a round number that at most 1 % of the drawn pieces exceed
};

/// The deformed wheel under one load position, coloured by a scalar.
template <int dim>
struct DeformedPicture {
  std::string title;
  RingField displacement;    ///< dim components [m]
  double magnification;      ///< of the displacement in the picture
  double contact_azimuth;    ///< azimuth of the contact point in the body frame [rad]: drawn at the bottom
  int most_stressed_of = 1;  ///< load positions of a sector
  bool is_bonded = false;    ///< the tread to a rigid ring, which is drawn instead of the ground
  Ground ground = {};
  double camber = 0;  ///< of the wheel on it; when dim = 3 [rad]
  /// Half the edge of a square view of the contact [m]; absent: the whole wheel.
  std::optional<double> window;
  NamedField scalar;  ///< in an SI unit without prefix, e.g. "von Mises stress" in "Pa"
  ScaleKind scale;
  RimMotion rim;                      ///< ground frame
  double travel;                      ///< from where the rotating wheel without load touches the ground [m]
  RimForce rim_force;                 ///< on the whole width [N, N m]
  std::vector<ContactPoint> contact;  ///< of this position; its pressure is shown in a window
  /// The largest scalar and its place before the deformation (body frame); absent: that of the drawn points.
  std::optional<DrawnPeak<dim>> peak;
  bool is_peak_projected = false;  ///< when dim = 3: a ring marks it through the material in front of it
  LayerCircles layers = {};
  SideFace shown = SideFace::larger_z;  ///< when dim = 3
};

/// The largest of 1, 2, 5, 10, 20, ... with which no displacement is drawn larger than 5 % of the wheel's
/// radius, at least 1. NaN is ignored.
double picture_magnification(const RingField& displacement, double outer_radius);

/// The picture as an SVG document: the material with colours between level lines, their scale, the ground as
/// a line that the tread touches or the rigid ring round a bonded tread, load, position and magnification,
/// the place of the largest scalar, and the deformed circles between layers. `lattice` carries the fields, on
/// psi's grid.
std::string deformed_svg(const LevelSet<2>& psi, const Lattice<2>& lattice,
                         const DeformedPicture<2>& picture);

/// The text of a picture about load, position and magnification.
template <int dim>
std::string facts(const DeformedPicture<dim>& picture);

/// Size of the parts of such a picture, in pixels.
struct DeformedLayout {
  static constexpr double wheel_size = 640, margin = 40, top = 76;
};

/// Such a picture as an SVG document: its title and facts, the drawn `wheel`, the colours, and `notes`. Below
/// the wheel is room of height `foot` [pixels].
template <int dim>
std::string deformed_document(const DeformedPicture<dim>& picture, const std::string& wheel,
                              const ColourScale& scale, double foot, const std::string& notes);

/// The note in that room for pictures whose tread was moved onto the ground.
std::string footnote(double magnification, double foot);

}  // namespace wheelwright
