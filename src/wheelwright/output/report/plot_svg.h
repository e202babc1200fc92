#pragma once

#include <string>
#include <vector>

namespace wheelwright {

/// An axis; values are in its unit.
struct PlotAxis {
  std::string name;
  std::string unit;
};

/// A line through points; interrupted by NaN.
struct PlotCurve {
  std::string label;  ///< in the legend
  std::vector<double> x, y;
  std::vector<double> errors = {};  ///< of y, drawn as a band around the line; empty: none
};

struct LinePlot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotCurve> curves;  ///< several get a legend
};

/// The plot as an SVG document, whatever the locale. Axes span the data with their errors and need not start
/// at zero; data that vary by less than 1e-6 of their size are drawn as constant.
std::string plot_svg(const LinePlot& plot);

/// The multiples in [low, high] of the smallest step that divides it into at most `most` parts and is 1, 2 or
/// 5 times a power of ten.
std::vector<double> axis_ticks(double low, double high, int most);

}  // namespace wheelwright
