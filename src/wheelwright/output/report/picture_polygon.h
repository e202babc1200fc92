#pragma once

#include <array>
#include <string>
#include <vector>

namespace wheelwright {

/// A point of a picture, in whole units of the picture.
using PicturePoint = std::array<int, 2>;
using PicturePolygon = std::vector<PicturePoint>;

/// A directed side of a polygon.
struct PictureSide {
  PicturePoint from, to;
};

/// Adds the sides of a polygon, all polygons in the same sense of rotation.
void add_sides(const PicturePolygon& polygon, std::vector<PictureSide>& sides);

/// The sides that remain after every side is cancelled against its reverse; sides of zero length are dropped.
std::vector<PictureSide> without_opposites(const std::vector<PictureSide>& sides);

/// Joins sides to closed curves. At every point as many sides must end as start.
std::vector<PicturePolygon> closed_curves(std::vector<PictureSide> sides);

/// The outlines of a union of polygons with common sides: shared sides cancel, so that a region of many cells
/// becomes a few curves. Polygons must not overlap; their sense of rotation does not matter. Closed curves,
/// all in the same sense around what they enclose; sides of zero length are dropped.
std::vector<PicturePolygon> union_outlines(const std::vector<PicturePolygon>& polygons);

/// The curve without points closer than `tolerance` to a chord between remaining points.
PicturePolygon simplified(const PicturePolygon& curve, double tolerance);

/// Closed curves as the `d` attribute of an SVG path, in relative moves. Points on straight lines, and curves
/// of less than three points, are omitted.
std::string outline_path(const std::vector<PicturePolygon>& outlines);

}  // namespace wheelwright
