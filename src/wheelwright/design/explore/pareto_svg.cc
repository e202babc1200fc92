#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/design/explore/report_designs.h"
#include "wheelwright/output/report/plot_svg.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

/// Sizes in pixels.
constexpr double frame_width = 560, frame_height = 360, left = 92, top = 56, bottom = 66, gap = 30;
constexpr double panel_height = frame_height + bottom;
constexpr double wheel_size = 92, wheels_left = left + frame_width + gap, wheels_width = 390;
constexpr double line_height = 13;  // of captions
constexpr int max_wheels = 8, wheels_per_row = 3;

constexpr std::string_view style = R"(<style>
text{font-family:"Helvetica Neue",Helvetica,Arial,"DejaVu Sans",sans-serif;font-size:13px;fill:#24292f}
.title{font-size:17px;font-weight:600}.middle{text-anchor:middle}.end{text-anchor:end}.small{font-size:10.5px}
.number{font-size:11px;font-weight:600}
.grid{stroke:#d8dee4;stroke-width:1}.frame{fill:none;stroke:#57606a;stroke-width:1}
.design{fill:#8c959f;stroke:#8c959f}.best{fill:#0a5ca8;stroke:#0a5ca8}.preview{fill:#ffffff}
.error{stroke:#0a5ca8;stroke-width:1}
.wheel{fill:#9db8d6;fill-rule:evenodd}
</style>
)";

/// One axis: maps values in display units to pixels.
struct Axis {
  const RankedQuantity& quantity;
  double low = HUGE_VAL, high = -HUGE_VAL, from, to;

  Axis(const RankedQuantity& shown, const std::vector<RankedDesign>& designs, double first, double last)
      : quantity(shown), from(first), to(last) {
    for (const RankedDesign& one : designs)
      if (const double v = value(one), e = error(one); std::isfinite(v))
        low = std::min(low, v - e), high = std::max(high, v + e);
    if (low > high) low = 0, high = 1;
    const double size = std::max(std::abs(low), std::abs(high));
    const double more = high - low > 1e-6 * size ? 0.06 * (high - low) : std::max(0.01 * size, 1e-12);
    low -= more;
    high += more;
  }
  double value(const RankedDesign& one) const { return one.value(quantity.key) * quantity.shown.factor; }
  double error(const RankedDesign& one) const {
    return one.error(quantity.key).value_or(0) * quantity.shown.factor;
  }
  double pixel(double v) const { return from + (v - low) / (high - low) * (to - from); }
};

void draw_axes(const Axis& x, const Axis& y, std::string& svg) {
  constexpr int max_ticks = 8;
  for (const double t : axis_ticks(x.low, x.high, max_ticks))
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"/><text "
        "class=\"middle\" x=\"{0:.1f}\" y=\"{3:.1f}\">{4:.6g}</text>\n",
        x.pixel(t), y.to, y.from, y.from + 20, t);
  for (const double t : axis_ticks(y.low, y.high, max_ticks))
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{1:.1f}\" x2=\"{2:.1f}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/><text "
        "class=\"end\" x=\"{3:.1f}\" y=\"{4:.1f}\">{5:.6g}</text>\n",
        y.pixel(t), x.from, x.to, x.from - 8, y.pixel(t) + 4.5, t);
  svg += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", x.from, y.to,
                     frame_width, frame_height);
  svg += fmt::format("<text class=\"middle\" x=\"{}\" y=\"{}\">{} [{}]</text>\n", x.from + 0.5 * frame_width,
                     y.from + 44, escape_xml(x.quantity.label), escape_xml(x.quantity.shown.name));
  svg += fmt::format("<text class=\"middle\" transform=\"translate({} {}) rotate(-90)\">{} [{}]</text>\n",
                     x.from - 66, y.to + 0.5 * frame_height, escape_xml(y.quantity.label),
                     escape_xml(y.quantity.shown.name));
}

/// A bar along each axis from the value less its error to the value and its error.
void draw_errors(const Axis& x, const Axis& y, const RankedDesign& one, std::string& svg) {
  const double vx = x.value(one), vy = y.value(one), ex = x.error(one), ey = y.error(one);
  const auto bar = [&](double x1, double y1, double x2, double y2) {
    svg += fmt::format("<line class=\"error\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
                       x.pixel(x1), y.pixel(y1), x.pixel(x2), y.pixel(y2));
  };
  if (ex > 0) bar(vx - ex, vy, vx + ex, vy);
  if (ey > 0) bar(vx, vy - ey, vx, vy + ey);
}

void draw_points(const Axis& x, const Axis& y, const std::vector<RankedDesign>& designs, std::string& svg) {
  for (int i = static_cast<int>(designs.size()) - 1; i >= 0; --i) {  // the best ones on top
    const RankedDesign& one = designs[i];
    if (!std::isfinite(x.value(one)) || !std::isfinite(y.value(one))) continue;
    const double px = x.pixel(x.value(one)), py = y.pixel(y.value(one));
    draw_errors(x, y, one, svg);
    const bool is_best = one.front == 1;
    svg += fmt::format(
        "<circle class=\"design{}{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}</title></circle>\n",
        is_best ? " best" : "", one.result.progression == Progression::preview ? " preview" : "", px, py,
        is_best ? 6 : 4, escape_xml(one.design.name + ": " + one.design.text));
    if (is_best && i < max_wheels)
      svg +=
          fmt::format("<text class=\"number\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", px + 8, py - 6, i + 1);
  }
}

/// A text in lines as wide as a wheel's place, divided after spaces and the marks in names of keys.
std::vector<std::string> divided(std::string_view text) {
  constexpr std::size_t most = 22;
  std::vector<std::string> lines;
  while (text.size() > most) {
    const auto mark = text.find_last_of(" ._", most - 1);
    const std::size_t end = mark == std::string_view::npos ? most : mark + 1;
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  lines.emplace_back(text);
  return lines;
}

/// The text of a design in lines as wide as a wheel's place; a part after a comma begins a line.
std::vector<std::string> caption_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (true) {
    const auto comma = text.find(", ");
    std::ranges::move(divided(text.substr(0, comma)), std::back_inserter(lines));
    if (comma == std::string_view::npos) return lines;
    text.remove_prefix(comma + 2);
  }
}

/// The wheels beside the plots, and the captions below them.
struct ShownWheels {
  std::vector<std::vector<std::string>> captions;
  double row_height;

  explicit ShownWheels(const std::vector<RankedDesign>& designs) {
    std::size_t n_lines = 3;
    for (int i = 0; i < std::min(max_wheels, static_cast<int>(designs.size())); ++i) {
      captions.push_back(caption_lines(designs[i].design.text));
      n_lines = std::max(n_lines, captions.back().size());
    }
    row_height = wheel_size + line_height * static_cast<double>(n_lines) + 5;
  }
  double height() const {
    const std::size_t n_rows = (captions.size() + wheels_per_row - 1) / wheels_per_row;
    return static_cast<double>(n_rows) * row_height;
  }
};

void draw_wheels(const std::vector<RankedDesign>& designs, const ShownWheels& wheels, std::string& svg) {
  for (int i = 0; i < static_cast<int>(wheels.captions.size()); ++i) {
    const RankedDesign& one = designs[i];
    if (one.front != 1 || one.outline.empty()) continue;
    const int row = i / wheels_per_row, column = i % wheels_per_row;
    const double x = wheels_left + (column + 0.5) * wheels_width / wheels_per_row,
                 y = top + row * wheels.row_height + 0.5 * wheel_size;
    const auto path = [&](const char* style, const std::string& d) {
      return fmt::format("<path {} transform=\"translate({:.1f} {:.1f}) scale({})\" d=\"{}\"/>", style, x, y,
                         wheel_size / 100, d);
    };
    svg += path("class=\"wheel\"", one.outline);
    if (!one.layers.empty()) svg += path("fill=\"none\" stroke=\"#24292f\" stroke-width=\"0.8\"", one.layers);
    svg +=
        fmt::format("<text class=\"number middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, y + 4, i + 1);
    double below = y + 0.5 * wheel_size;
    for (const std::string& line : wheels.captions[i])
      svg += fmt::format("<text class=\"small middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x,
                         below += line_height, escape_xml(line));
  }
}

}  // namespace

std::string pareto_svg(const std::vector<RankedDesign>& designs,
                       const std::vector<RankedQuantity>& quantities, const std::string& title) {
  const std::size_t n_panels = std::max<std::size_t>(1, quantities.size() - 1);
  const ShownWheels wheels(designs);
  const double width = wheels_left + wheels_width + 10,
               height = top + std::max(n_panels * panel_height, wheels.height());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n{2}<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n<text class=\"title\" "
      "x=\"{3}\" "
      "y=\"32\">{4}</text>\n",
      width, height, style, left, escape_xml(title));
  for (std::size_t k = 0; k < n_panels; ++k) {
    const double from_top = top + static_cast<double>(k) * panel_height;
    const Axis x(quantities[0], designs, left, left + frame_width),
        y(quantities[std::min(k + 1, quantities.size() - 1)], designs, from_top + frame_height, from_top);
    draw_axes(x, y, svg);
    draw_points(x, y, designs, svg);
  }
  draw_wheels(designs, wheels, svg);
  return svg + "</svg>\n";
}

}  // namespace wheelwright
