#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheelwright/base/vec.h"
#include "wheelwright/output/report/image.h"

namespace wheelwright {

/// Red, green and blue in [0, 255].
using Rgb = std::array<int, 3>;

/// A parallel projection. Scenes have x to the right, y up and z towards the viewer [m]; the camera is turned
/// about y, then tilted down.
class Camera {
 public:
  /// Turned to the right by `yaw` and down by `pitch` [rad]; `half` [m] is half the edge of the visible
  /// square about the point `centre`.
  Camera(double yaw, double pitch, const Vec<3>& centre, double half);

  /// The image of a point: to the right and up from the middle, in [-1, 1] if visible, and towards the
  /// viewer.
  Vec<3> seen(const Vec<3>& point) const;

  /// A direction in the same axes, not scaled.
  Vec<3> turned(const Vec<3>& direction) const;

  /// The opposite: the direction in the scene of one in the camera's axes.
  Vec<3> direction(const Vec<3>& turned) const;

 private:
  std::array<Vec<3>, 3> axes_;
  Vec<3> centre_;
  double half_;
};

/// A body to draw: triangles, counter-clockwise when seen from outside.
struct LitBody {
  std::vector<Vec<3>> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Rgb> colours;  ///< of the points; they are interpolated
  bool is_lit = true;        ///< otherwise shown in its own colours
};

/// The scene in a square window of that many pixels, on white: lit from above, from the camera's left. Edges
/// of more than 40 degrees are sharp, others are shaded smoothly.
Image lit_image(const std::vector<LitBody>& bodies, const Camera& camera, int pixels);

}  // namespace wheelwright
