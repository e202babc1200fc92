#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "wheelwright/page/sector_mesh.h"
#include "wheelwright/report/run_summary.h"
#include "wheelwright/report/solution_fields.h"
#include "wheelwright/surface/surface_mesh.h"

namespace wheelwright {

/// A column of history.csv for the accepted shapes; NaN where a cell is empty.
struct HistoryCurve {
  std::string name;  ///< with its unit, as in the file
  std::vector<double> values;
};

/// This tells what happened to the holes at one accepted shape, as history.csv has it.
struct HoleEvents {
  std::string shape, text;
};

/// The edges of one accepted shape, in whole outline units.
struct ShapeOutline {
  int shape;
  double objective;  ///< its value, as history.csv has it; NaN where the file does not tell
  std::vector<std::vector<std::array<int, 2>>> contours;  ///< closed polylines round the whole wheel
};

/// Outline units per outer radius of the wheel.
inline constexpr int outline_units = 10000;

/// The edges of the holes of a shape, simplified to within two outline units.
ShapeOutline shape_outline(int shape, double objective, const LevelSet<2>& psi);

/// One line of a file of outlines, and back; nothing from a line that is none.
std::string outline_line(const ShapeOutline& outline);
std::optional<ShapeOutline> parse_outline_line(const std::string& line);

/// One load position of a lit wheel: the fields at the vertices of its surface.
struct SurfacePosition {
  double ground_azimuth;                         ///< as in PositionFields
  std::vector<std::vector<float>> displacement;  ///< [component][vertex] [m], body frame
  std::vector<float> von_mises;                  ///< [Pa]
};

/// One load position as the page shows it.
template <int dim>
using ShownPosition = std::conditional_t<dim == 2, MeshPosition, SurfacePosition>;

/// The loaded wheel as the page shows it: in 2D drawn in the plane, in 3D as a lit surface.
template <int dim>
struct ShownWheel {
  std::conditional_t<dim == 2, SectorMesh, SurfaceMesh> mesh;
  std::vector<ShownPosition<dim>> positions;
};

/// It under a load case after the first one.
template <int dim>
struct LoadedPositions {
  std::string load_case;
  std::vector<ShownPosition<dim>> positions;
};

/// What the page tells about one run.
template <int dim>
struct ReportRun {
  std::string name;  ///< of the run's folder
  std::string title;
  std::string status;     ///< e.g. "converged", "running"
  bool is_running;        ///< the page reloads itself then
  std::string program;    ///< version, compiler and libraries
  std::string case_text;  ///< case.toml
  double seconds;         ///< computed
  std::string load;       ///< for people
  ShownUnit objective;
  PolarGrid<dim> grid;
  int trials;
  std::map<std::string, int> rejected;  ///< trials, by the reason
  std::vector<HoleEvents> events;       ///< the newest ones, oldest first
  int events_left_out = 0;              ///< older ones
  std::vector<HistoryCurve> history;
  std::vector<ShapeOutline> outlines;
  std::optional<ShapeOutline> given = {};  ///< the wheel of the case, where the first shape is another one
  std::vector<std::string> flags;          ///< what deserves attention, in sentences
  std::vector<std::string> limits;         ///< what was not checked or computed, in sentences
  std::optional<RunSummary<dim>> summary;  ///< absent while the run goes on
  std::optional<ShownWheel<dim>> wheel;    ///< the last shape
  std::vector<LoadedPositions<dim>> other_loads = {};
  std::vector<ContactPoint> contact_points;
};

/// A run as the page holds it.
struct PageRun {
  std::string title;
  std::string json;
  bool is_solid;  ///< has a surface to be lit
};

template <int dim>
PageRun page_run(const ReportRun<dim>& run);

/// The loaded wheel in its load positions, as the page holds it.
template <int dim>
std::string loaded_wheel_json(const ShownWheel<dim>& wheel);

/// One HTML file that needs no network: what came out, the wheel rolling, the shapes of the run, curves.
std::string report_page(const std::vector<PageRun>& runs);

}  // namespace wheelwright
