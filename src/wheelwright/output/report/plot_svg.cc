#include "wheelwright/output/report/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/output/report/colour_map.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

/// Size of the picture's parts, in pixels.
constexpr double frame_width = 560, frame_height = 340, left = 92, top = 56, right = 28, bottom = 66;
constexpr double legend_width = 132, legend_line = 20;
constexpr double picture_height = top + frame_height + bottom;
constexpr int max_x_ticks = 9, max_y_ticks = 8;
constexpr size_t max_marked = 40;  ///< points of a curve that are marked by dots

constexpr std::string_view style = R"(<style>
text{font-family:"Helvetica Neue",Helvetica,Arial,"DejaVu Sans",sans-serif;font-size:13px;fill:#24292f}
.title{font-size:17px;font-weight:600;text-anchor:middle}.name{text-anchor:middle}
.x{text-anchor:middle}.y{text-anchor:end}
.grid{fill:none;stroke:#d8dee4;stroke-width:1}.frame{fill:none;stroke:#57606a;stroke-width:1}
.curve{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}
</style>
)";

/// One axis, from data to pixels.
struct Scale {
  double low, high;
  double from, to;  ///< [pixels]

  double operator()(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

struct Interval {
  double low, high;
};

/// The range of the finite values, if it is wider than rounding.
Interval span_of(const std::vector<double>& values) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return {0, 1};
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low > 1e-6 * size) return {low, high};
  const double middle = 0.5 * (low + high), half = size > 0 ? 1e-3 * size : 1;
  return {middle - half, middle + half};
}

std::vector<double> all_x(const LinePlot& plot) {
  std::vector<double> all;
  for (const PlotCurve& curve : plot.curves) all.insert(all.end(), curve.x.begin(), curve.x.end());
  return all;
}

/// Of all curves and their bands.
std::vector<double> all_y(const LinePlot& plot) {
  std::vector<double> all;
  for (const PlotCurve& curve : plot.curves) {
    all.insert(all.end(), curve.y.begin(), curve.y.end());
    for (size_t i = 0; i < curve.errors.size(); ++i)
      for (const double side : {-1, 1}) all.push_back(curve.y[i] + side * curve.errors[i]);
  }
  return all;
}

Interval widened(Interval data, double fraction) {
  const double more = fraction * (data.high - data.low);
  return {data.low - more, data.high + more};
}

double tick_step(double low, double high, int most) {
  const double minimum = (high - low) / most;
  double power = std::pow(10, std::floor(std::log10(minimum)));
  while (true) {
    for (const double factor : {1, 2, 5})
      if (factor * power >= minimum * (1 - 1e-9)) return factor * power;
    power *= 10;
  }
}

/// A multiple of the step with the decimals that it needs and a proper minus sign.
std::string tick_text(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  return value < -0.5 * step ? "\u2212" + digits : digits;
}

std::string axis_title(const PlotAxis& axis) {
  return axis.unit.empty() ? axis.name : fmt::format("{} [{}]", axis.name, axis.unit);
}

std::string text(double x, double y, std::string_view kind, std::string_view content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, kind,
                     escape_xml(content));
}

std::string axes(const LinePlot& plot, const Scale& x, const Scale& y) {
  std::string grid, labels;
  const double x_step = tick_step(x.low, x.high, max_x_ticks), y_step = tick_step(y.low, y.high, max_y_ticks);
  for (const double value : axis_ticks(x.low, x.high, max_x_ticks)) {
    grid += fmt::format("M{:.1f} {}v{}", x(value), top, frame_height);
    labels += text(x(value), top + frame_height + 20, "x", tick_text(value, x_step));
  }
  for (const double value : axis_ticks(y.low, y.high, max_y_ticks)) {
    grid += fmt::format("M{} {:.1f}h{}", left, y(value), frame_width);
    labels += text(left - 8, y(value) + 4.5, "y", tick_text(value, y_step));
  }
  return fmt::format("<path class=\"grid\" d=\"{}\"/>\n", grid) + labels +
         text(left + 0.5 * frame_width, picture_height - 16, "name", axis_title(plot.x)) +
         fmt::format("<text transform=\"translate(22 {:.1f}) rotate(-90)\" class=\"name\">{}</text>\n",
                     top + 0.5 * frame_height, escape_xml(axis_title(plot.y))) +
         fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", left, top,
                     frame_width, frame_height);
}

std::string curve_colour(size_t index, size_t n_curves) {
  if (n_curves == 1) return "#3b6ea5";
  return viridis(0.9 * static_cast<double>(index) / static_cast<double>(n_curves - 1));
}

std::string curve_svg(const PlotCurve& curve, const Scale& x, const Scale& y, std::string_view colour) {
  std::string path, dots;
  char command = 'M';
  const size_t n = std::min(curve.x.size(), curve.y.size());
  for (size_t i = 0; i < n; ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      command = 'M';
      continue;
    }
    const double px = x(curve.x[i]), py = y(curve.y[i]);
    path += fmt::format("{}{:.2f} {:.2f}", command, px, py);
    command = 'L';
    if (n <= max_marked)
      dots += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.4\" fill=\"{}\"/>\n", px, py, colour);
  }
  return fmt::format("<path class=\"curve\" stroke=\"{}\" d=\"{}\"/>\n{}", colour, path, dots);
}

/// The band of the errors, behind the line; empty if a value or an error is not finite.
std::string band_svg(const PlotCurve& curve, const Scale& x, const Scale& y, std::string_view colour) {
  std::string there, back;
  for (size_t i = 0; i < curve.errors.size(); ++i) {
    const double low = y(curve.y[i] - curve.errors[i]), high = y(curve.y[i] + curve.errors[i]);
    if (!std::isfinite(low) || !std::isfinite(high)) return "";
    there += fmt::format("{}{:.2f} {:.2f}", i == 0 ? 'M' : 'L', x(curve.x[i]), low);
    back.insert(0, fmt::format("L{:.2f} {:.2f}", x(curve.x[i]), high));
  }
  if (there.empty()) return "";
  return fmt::format("<path class=\"band\" fill=\"{}\" fill-opacity=\"0.2\" d=\"{}{}Z\"/>\n", colour, there,
                     back);
}

std::string legend_entry(const std::string& label, size_t index, std::string_view colour) {
  const double x = left + frame_width + 18, y = top + 12 + legend_line * static_cast<double>(index);
  return fmt::format("<path class=\"curve\" stroke=\"{}\" d=\"M{} {}h22\"/>\n", colour, x, y) +
         text(x + 30, y + 4.5, "legend", label);
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, int most) {
  const double step = tick_step(low, high, most), slack = 1e-9 * (high - low);
  std::vector<double> ticks;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k)
    ticks.push_back(k * step + 0.0);  // -0 becomes 0
  return ticks;
}

std::string plot_svg(const LinePlot& plot) {
  const size_t n = plot.curves.size();
  const double picture_width = left + frame_width + (n > 1 ? legend_width : right);
  const Interval x_range = span_of(all_x(plot)), y_range = widened(span_of(all_y(plot)), 0.05);
  const Scale x{x_range.low, x_range.high, left, left + frame_width};
  const Scale y{y_range.low, y_range.high, top + frame_height, top};

  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<title>{2}</title>\n{3}"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      picture_width, picture_height, escape_xml(plot.title), style);
  svg += text(left + 0.5 * frame_width, 32, "title", plot.title);
  svg += axes(plot, x, y);
  for (size_t i = 0; i < n; ++i) {
    const std::string colour = curve_colour(i, n);
    svg += band_svg(plot.curves[i], x, y, colour);
    svg += curve_svg(plot.curves[i], x, y, colour);
    if (n > 1) svg += legend_entry(plot.curves[i].label, i, colour);
  }
  return svg + "</svg>\n";
}

}  // namespace wheelwright
