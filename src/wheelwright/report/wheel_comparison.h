#pragma once

#include <string>
#include <vector>

#include "wheelwright/analysis/rolling_analysis.h"
#include "wheelwright/analysis/shape_summary.h"
#include "wheelwright/geometry/contour.h"

namespace wheelwright {

/// A wheel beside others: who it is, its outline, and what describes it in rolling. In 2D: forces of the
/// analysis are per metre of width and are shown on the whole width.
struct ComparedWheel {
  std::string name;   ///< of its case file or run
  std::string which;  ///< e.g. "shape 31"
  PolarGrid<2> grid;
  std::vector<Contour> contours;
  double volume_fraction;  ///< material area over the area of the full ring
  ShapeSummary<2> summary;
  RollingAnalysis rolling;
};

/// For people: every quantity of every wheel, with its change from the first wheel.
std::string wheels_table(const std::vector<ComparedWheel>& wheels);

/// For programs: the same in SI units, which the names of the keys end in. Numbers read back to the same
/// double.
std::string wheels_json(const std::vector<ComparedWheel>& wheels);

/// The outlines of all wheels over each other, in one scale: the first filled, the others as coloured lines.
std::string overlay_svg(const std::vector<ComparedWheel>& wheels);

}  // namespace wheelwright
