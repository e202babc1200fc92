#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheelwright/base/vec.h"
#include "wheelwright/report/image.h"

namespace wheelwright {

/// Red, green and blue in [0, 255].
using Rgb = std::array<int, 3>;

/// A parallel projection. Scenes have x to the right, y up and z towards the viewer [m]; the camera is turned
/// about y, then it looks down.
class Camera {
 public:
  /// Turned to the right by `yaw` and down by `pitch` [rad]; `half` [m] is half the edge of the square that
  /// it sees, about the point `centre`.
  Camera(double yaw, double pitch, const Vec<3>& centre, double half);

  /// A point as it is seen: to the right and up from the middle, in [-1, 1] where it is seen, and towards the
  /// viewer.
  Vec<3> seen(const Vec<3>& point) const;

  /// A direction in the same axes, not scaled.
  Vec<3> turned(const Vec<3>& direction) const;

 private:
  std::array<Vec<3>, 3> axes_;
  Vec<3> centre_;
  double half_;
};

/// What is drawn: triangles, counter-clockwise when seen from outside.
struct LitBody {
  std::vector<Vec<3>> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Rgb> colours;  ///< of the points; they are interpolated
  bool is_lit = true;        ///< or seen in its own colours
};

/// The scene from a square window of that many pixels, on white: lit from above, from the left of the camera.
/// Edges of more than 40 degrees are sharp, others are shaded smoothly.
Image lit_image(const std::vector<LitBody>& bodies, const Camera& camera, int pixels);

}  // namespace wheelwright
