#include <fmt/format.h>

#include "wheelwright/drawing/parts.h"
#include "wheelwright/run/command.h"
#include "wheelwright/run/edit_bounds.h"

namespace wheelwright {
namespace {

/// Material by which a hole is filled beyond its edge, so that no trace of the edge stays [m].
constexpr double overlap = 5e-4;

Obeyed drawn(RunControl& run, std::span<const Stroke> strokes, const std::string& what) {
  if (auto refusal = run.draw(strokes, what)) return *std::move(refusal);
  return what;
}

Refusal no_hole(const std::array<double, 2>& at) {
  return {fmt::format("there is no hole at {}", place_text(at))};
}

Stroke filling(const std::vector<Point>& edge) {
  return {{Fill::material, {polygon_outline(edge)}}, overlap};
}

/// Discs at the corners of a path, and strips between them.
std::vector<Outline> brush_outlines(const Paint& paint) {
  std::vector<Outline> outlines;
  const Point* last = nullptr;
  for (const Point& at : paint.path) {
    if (last && norm<2>(at - *last) < 1e-3 * paint.radius) continue;
    outlines.push_back(circle_outline(Affine::shift(at), paint.radius));
    if (last) outlines.push_back(strip_outline(*last, at, 2 * paint.radius, 0));
    last = &at;
  }
  return outlines;
}

}  // namespace

Obeyed Paint::obey(RunControl& run) const {
  if (auto refused = refused_line(run.current_case().wheel, path, radius))
    return Refusal{*std::move(refused)};
  const Stroke stroke{{as, brush_outlines(*this)}, 0};
  return drawn(
      run, std::span(&stroke, 1),
      fmt::format("{} painted at {}", as == Fill::hole ? "a hole" : "material", place_text(path.front())));
}

Obeyed MoveHole::obey(RunControl& run) const {
  constexpr double most = 100;
  if (!(scale >= 1 / most && scale <= most))
    return Refusal{fmt::format("a hole can be made {:.6g} to {:.6g} times as wide, not {:.6g} times",
                               1 / most, most, scale)};
  const std::vector<Point> edge = run.hole_at(at);
  if (edge.empty()) return no_hole(at);
  const Point centre = centroid(edge);
  std::vector<Point> moved;
  for (const Point& p : edge) moved.push_back(centre + Point(by) + scale * (p - centre));
  if (auto refused = refused_hole(run.current_case().wheel, moved)) return Refusal{*std::move(refused)};
  const std::array<Stroke, 2> strokes{filling(edge), Stroke{{Fill::hole, {polygon_outline(moved)}}, 0}};
  const std::string size = scale == 1 ? "" : fmt::format(" and made {:.3g} times as wide", scale);
  return drawn(run, strokes,
               fmt::format("the hole at {} moved by {}{}", place_text(at), place_text(by), size));
}

Obeyed FillHole::obey(RunControl& run) const {
  const std::vector<Point> edge = run.hole_at(at);
  if (edge.empty()) return no_hole(at);
  const Stroke stroke = filling(edge);
  return drawn(run, std::span(&stroke, 1), fmt::format("the hole at {} filled", place_text(at)));
}

}  // namespace wheelwright
