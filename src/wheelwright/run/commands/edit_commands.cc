#include <fmt/format.h>

#include "wheelwright/cad/drawing/parts.h"
#include "wheelwright/run/commands/commands.h"
#include "wheelwright/run/commands/edit_bounds.h"

namespace wheelwright {
namespace {

/// How far filling extends beyond the edge of a hole, so that no trace of the edge remains [m].
constexpr double overlap = 5e-4;

CommandResult drawn(RunControl& run, std::span<const Stroke> strokes, const std::string& what) {
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
std::vector<DrawnOutline> brush_outlines(const Paint& paint) {
  std::vector<DrawnOutline> outlines;
  const Point* last = nullptr;
  for (const Point& at : paint.path) {
    if (last && norm<2>(at - *last) < 1e-3 * paint.radius) continue;
    outlines.push_back(circle_outline(Affine::shift(at), paint.radius));
    if (last) outlines.push_back(strip_outline(*last, at, 2 * paint.radius, 0));
    last = &at;
  }
  return outlines;
}

std::string what_was_painted(const Paint& paint) {
  const std::string from = place_text(paint.path.front());
  if (paint.as == Fill::material) return "material added along a line from " + from;
  if (paint.path.size() > 1) return "material removed along a line from " + from;
  return fmt::format("a hole of radius {:.4g} mm added at {}", 1e3 * paint.radius, from);
}

std::string what_was_moved(const MoveHole& hole) {
  std::string text = fmt::format("the hole at {}", place_text(hole.at));
  const bool is_moved = hole.by != std::array<double, 2>{}, is_scaled = hole.scale != 1;
  if (is_moved || !is_scaled) text += " moved by " + place_text(hole.by);
  if (is_scaled) text += fmt::format("{} made {:.3g} times as wide", is_moved ? " and" : "", hole.scale);
  return text;
}

}  // namespace

CommandResult Paint::execute(RunControl& run) const {
  if (auto refused = refused_line(run.current_case().wheel, path, radius))
    return Refusal{*std::move(refused)};
  const Stroke stroke{{as, brush_outlines(*this)}, 0};
  return drawn(run, std::span(&stroke, 1), what_was_painted(*this));
}

CommandResult MoveHole::execute(RunControl& run) const {
  constexpr double most = 100;
  if (!(scale >= 1 / most && scale <= most))
    return Refusal{
        fmt::format("a hole can be scaled by {:.6g} to {:.6g}, not by {:.6g}", 1 / most, most, scale)};
  const std::vector<Point> edge = run.hole_at(at);
  if (edge.empty()) return no_hole(at);
  const Point centre = centroid(edge);
  std::vector<Point> moved;
  for (const Point& p : edge) moved.push_back(centre + Point(by) + scale * (p - centre));
  if (auto refused = refused_hole(run.current_case().wheel, moved)) return Refusal{*std::move(refused)};
  const std::array<Stroke, 2> strokes{filling(edge), Stroke{{Fill::hole, {polygon_outline(moved)}}, 0}};
  return drawn(run, strokes, what_was_moved(*this));
}

CommandResult FillHole::execute(RunControl& run) const {
  const std::vector<Point> edge = run.hole_at(at);
  if (edge.empty()) return no_hole(at);
  const Stroke stroke = filling(edge);
  return drawn(run, std::span(&stroke, 1), fmt::format("the hole at {} filled", place_text(at)));
}

}  // namespace wheelwright
