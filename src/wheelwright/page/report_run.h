#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/report/run_summary.h"
#include "wheelwright/report/solution_fields.h"

namespace wheelwright {

/// A column of history.csv for the accepted shapes; NaN where a cell is empty.
struct HistoryCurve {
  std::string name;  ///< with its unit, as in the file
  std::vector<double> values;
};

/// The edges of one accepted shape, in whole outline units.
struct ShapeOutline {
  int shape;
  std::vector<std::vector<std::array<int, 2>>> contours;  ///< closed polylines round the whole wheel
};

/// Outline units per outer radius of the wheel.
inline constexpr int outline_units = 10000;

/// The edges of the holes of a shape, simplified to within two outline units.
ShapeOutline shape_outline(int shape, const LevelSet<2>& psi);

/// One line of a file of outlines, and back; nothing from a line that is none.
std::string outline_line(const ShapeOutline& outline);
std::optional<ShapeOutline> parse_outline_line(const std::string& line);

/// What the page tells about one run. In 2D: its pictures are plane.
struct ReportRun {
  std::string name;  ///< of the run's folder
  std::string title;
  std::string status;     ///< e.g. "converged", "running"
  bool is_running;        ///< the page reloads itself then
  std::string program;    ///< version, compiler and libraries
  std::string case_text;  ///< case.toml
  double seconds;         ///< computed
  std::string load;       ///< for people
  PolarGrid<2> grid;
  int trials, rejected;
  std::vector<HistoryCurve> history;
  std::vector<ShapeOutline> outlines;
  std::vector<std::string> flags;        ///< what deserves attention, in sentences
  std::optional<RunSummary<2>> summary;  ///< absent while the run goes on
  const LevelSet<2>* shape = nullptr;    ///< the last one, with the fields of all positions
  std::vector<PositionFields<2>> positions;
  std::vector<ContactPoint> contact_points;
};

/// One HTML file that needs no network: what came out, the wheel rolling, the shapes of the run, curves.
std::string report_page(const std::vector<ReportRun>& runs);

}  // namespace wheelwright
