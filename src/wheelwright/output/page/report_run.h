#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "wheelwright/base/units.h"
#include "wheelwright/output/page/sector_mesh.h"
#include "wheelwright/output/report/layered_surface.h"
#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// A column of history.csv for the accepted shapes; NaN where a cell is empty.
struct HistoryCurve {
  std::string name;  ///< with its unit, as in the file
  std::vector<double> values;
};

/// The events of the holes at one accepted shape, as in history.csv.
struct HoleEvents {
  std::string shape, text;
};

/// The edges of one accepted shape, in whole outline units.
struct ShapeOutline {
  int shape;
  double objective;  ///< its value, as in history.csv; NaN if missing there
  std::vector<std::vector<std::array<int, 2>>> contours;  ///< closed polylines around the whole wheel
};

/// Outline units per outer radius of the wheel.
inline constexpr int outline_units = 10000;

/// The edges of the holes of a shape, simplified to within two outline units.
ShapeOutline shape_outline(int shape, double objective, const LevelSet<2>& psi);

/// Conversion to and from one line of a file of outlines; nothing if the line is invalid.
std::string outline_line(const ShapeOutline& outline);
std::optional<ShapeOutline> parse_outline_line(const std::string& line);

/// One load position of a lit wheel: the fields at the vertices of its surface.
struct SurfacePosition {
  double ground_azimuth;                         ///< as in PositionFields
  std::vector<std::vector<float>> displacement;  ///< [component][vertex] [m], body frame
  std::vector<float> von_mises;                  ///< as in MeshPosition [Pa]
  std::optional<ShownGround> ground = {};
};

/// One load position as the page shows it.
template <int dim>
using ShownPosition = std::conditional_t<dim == 2, MeshPosition, SurfacePosition>;

/// The loaded wheel as the page shows it: a plane drawing in 2D, a lit surface in 3D.
template <int dim>
struct ShownWheel {
  std::conditional_t<dim == 2, SectorMesh, LayeredSurface> mesh;
  std::vector<ShownPosition<dim>> positions;
};

/// The wheel under a load case after the first one.
template <int dim>
struct LoadedPositions {
  std::string load_case;
  std::vector<ShownPosition<dim>> positions;
};

/// What the page shows of one run.
template <int dim>
struct ReportRun {
  std::string name;  ///< of the run's folder
  std::string title;
  std::string status;     ///< e.g. "converged", "running"
  bool is_running;        ///< if so, the page reloads itself
  std::string program;    ///< version, compiler and libraries
  std::string case_text;  ///< case.toml
  double seconds = 0;     ///< of computation
  std::string load;       ///< as readable text
  ShownUnit objective;
  PolarGrid<dim> grid;
  LayerCircles layers = {};
  int trials = 0;
  std::map<std::string, int> rejected = {};  ///< trials, by reason
  std::vector<HoleEvents> events = {};       ///< the newest ones, oldest first
  int events_omitted = 0;                    ///< older events that are not in `events`
  std::vector<HistoryCurve> history = {};
  std::vector<ShapeOutline> outlines;
  std::optional<ShapeOutline> given = {};    ///< the wheel of the case, if the first shape differs from it
  std::vector<std::string> flags = {};       ///< warnings, in sentences
  bool has_rough_edges = false;              ///< teeth or ripples that cannot be cut
  std::vector<std::string> limits = {};      ///< what was not checked or not computed, in sentences
  std::optional<RunSummary<dim>> summary{};  ///< absent while the run continues
  std::optional<ShownWheel<dim>> wheel{};    ///< the last shape
  std::vector<LoadedPositions<dim>> other_loads = {};
  std::vector<ContactPoint> contact_points = {};
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

/// One HTML file that needs no network: results, the rolling wheel, the shapes of the run, curves.
std::string report_page(const std::vector<PageRun>& runs);

}  // namespace wheelwright
