// Writes an outline with all kinds of curves, clockwise and counter-clockwise arcs among them, in all
// formats, and prints its loops as polygons in millimetres, one point per line and an empty line after each
// loop. usage: write_sample_outline FOLDER

#include <cmath>
#include <iostream>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/output/export/formats.h"

namespace wheelwright {
using namespace cad;

namespace {

using std::numbers::pi;

Loop circle(LoopKind kind, double radius, double sweep) { return {kind, {Arc{{0, 0}, radius, 0, sweep}}}; }

Vec<2> start(const Arc& arc) { return start_of(Curve(arc)); }
Vec<2> end(const Arc& arc) { return end_of(Curve(arc)); }

/// Two clockwise arcs of different radii, joined by lines.
Loop slot() {
  const Arc outer{{0.02, 0.3}, 0.015, 3.0, -3.3}, inner{{0.01, 0.24}, 0.01, 0, -2.8};
  return {LoopKind::hole, {outer, Line{end(outer), start(inner)}, inner, Line{end(inner), start(outer)}}};
}

/// A spline, a counter-clockwise arc, which makes the hole narrower, and a line.
Loop mixed() {
  const Arc arc{{-0.27, 0.05}, 0.02, 2.0, 1.5};
  const Vec<2> a = start(arc), b = end(arc), corner{-0.3, 0.03};
  const Spline spline{{0, 0, 0, 0, 0.4, 1, 1, 1, 1},
                      {corner, {-0.31, 0.05}, {-0.325, 0.075}, {-0.3, 0.1}, a}};
  return {LoopKind::hole, {spline, arc, Line{b, corner}}};
}

}  // namespace
}  // namespace wheelwright

int main(int, char** argv) {
  using namespace wheelwright;
  const PolarGrid<2> grid{0.2, 0.34, 0.05, 1, {14, 192}};
  const Outline outline{
      {circle(LoopKind::outer_edge, 0.34, 2 * pi), circle(LoopKind::bore, 0.2, -2 * pi), slot(), mixed()}};
  const WheelModel wheel{.title = "All kinds of curves",
                         .program = "test",
                         .shape = testing::holes(grid, 2, {}),
                         .outline = outline,
                         .width = grid.width,
                         .tolerance = 1e-5};
  for (const ExportFormat& format : export_formats())
    if (format.of_plane != nullptr)
      write_atomically(std::filesystem::path(argv[1]) / ("sample." + std::string(format.name)),
                       format.of_plane(wheel));
  std::cout.precision(12);
  for (const Loop& loop : outline.loops) {
    for (const Vec<2>& p : flattened(loop, 1e-7)) std::cout << 1e3 * p[0] << " " << 1e3 * p[1] << "\n";
    std::cout << "\n";
  }
}
