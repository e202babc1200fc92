#pragma once

#include <optional>
#include <vector>

#include "wheelwright/output/report/picture_polygon.h"

namespace wheelwright {

/// A scalar over a region of a picture: linear in triangles, whose corners are points of the picture. If
/// several values are given for one point, the first one counts, so that the scalar is continuous.
class PictureScalar {
 public:
  using Corners = std::array<PicturePoint, 3>;

  /// A triangle and the values at its corners, which must be finite.
  struct Triangle {
    Corners corners;
    std::array<double, 3> values;
  };

  /// Triangles must not overlap.
  explicit PictureScalar(const std::vector<Triangle>& triangles);

  /// The outlines of the whole region.
  std::vector<PicturePolygon> region() const;

  /// For every level, in ascending order, the outlines of the part of the region where the scalar reaches it.
  std::vector<std::vector<PicturePolygon>> superlevels(const std::vector<double>& levels) const;

  /// The same where the scalar does not reach it.
  std::vector<std::vector<PicturePolygon>> sublevels(const std::vector<double>& levels) const;

  /// The median of the scalar at the triangles' corners; 0 if there are none.
  double median() const;

 private:
  /// A corner of a triangle with the value there.
  struct Corner {
    PicturePoint place;
    double value;
  };
  /// A directed side of the region.
  struct Side {
    Corner from, to;
  };

  static PicturePoint crossing(const Corner& a, const Corner& b, double level);
  static std::optional<PictureSide> part_above(const Side& side, double level);
  static std::optional<PictureSide> part_below(const Side& side, double level);
  std::vector<std::vector<PictureSide>> level_lines(const std::vector<double>& levels) const;

  std::vector<std::array<Corner, 3>> triangles_;  ///< all of one sense of rotation
  std::vector<Side> boundary_;                    ///< the sides that no two triangles share
};

}  // namespace wheelwright
