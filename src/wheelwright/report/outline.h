#pragma once

#include <array>
#include <string>
#include <vector>

namespace wheelwright {

/// A point of a picture, in whole units of the picture.
using PicturePoint = std::array<int, 2>;
using PicturePolygon = std::vector<PicturePoint>;

/// The outlines of a union of polygons with common sides: what two neighbours share is left out, so that a
/// region of many cells becomes a few curves. Polygons must not overlap; their sense of rotation does not
/// matter. Closed curves, all of one sense around what they enclose; sides of no length are dropped.
std::vector<PicturePolygon> union_outlines(const std::vector<PicturePolygon>& polygons);

/// Closed curves as the `d` attribute of an SVG path, in relative moves; those that enclose nothing, of less
/// than three points, are left out.
std::string outline_path(const std::vector<PicturePolygon>& outlines);

}  // namespace wheelwright
