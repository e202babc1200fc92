#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "wheelwright/report/outline.h"

namespace wheelwright {

/// A scalar over a region of a picture: linear in triangles, whose corners are points of the picture. Where
/// several values are given for one point the first counts, so that the scalar is continuous.
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

  /// For every level the outlines of the part of the region where the scalar reaches it.
  std::vector<std::vector<PicturePolygon>> superlevels(const std::vector<double>& levels) const;

  /// The same where the scalar does not reach it.
  std::vector<std::vector<PicturePolygon>> sublevels(const std::vector<double>& levels) const;

  /// The median of the scalar at the triangles' corners; 0 if there are none.
  double median() const;

 private:
  struct Hash {
    std::size_t operator()(const PicturePoint& p) const;
  };

  double value(const PicturePoint& point) const { return values_.at(point); }
  PicturePoint crossing(PicturePoint a, PicturePoint b, double level) const;
  std::vector<std::vector<PictureSide>> level_lines(const std::vector<double>& levels) const;
  std::optional<PictureSide> part_above(const PictureSide& side, double level) const;
  std::optional<PictureSide> part_below(const PictureSide& side, double level) const;

  std::unordered_map<PicturePoint, double, Hash> values_;
  std::vector<Corners> triangles_;     ///< all of one sense of rotation
  std::vector<PictureSide> boundary_;  ///< the sides that no two triangles share
};

}  // namespace wheelwright
