#include "wheelwright/output/report/svg.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/base/text.h"
#include "wheelwright/base/units.h"
#include "wheelwright/output/report/cut_open.h"
#include "wheelwright/output/report/lit_wheel.h"
#include "wheelwright/output/report/picture_polygon.h"

namespace wheelwright {
namespace {

std::string polyline_path(const std::vector<Vec<2>>& points, double units_per_metre, int decimals,
                          double spacing) {
  std::string path;
  Vec<2> last{};
  for (const Vec<2>& p : points) {
    if (!path.empty() && distance(p, last) < spacing) continue;
    path += fmt::format("{}{:.{}f} {:.{}f}", path.empty() ? 'M' : 'L', p[0] * units_per_metre, decimals,
                        -p[1] * units_per_metre, decimals);
    last = p;
  }
  return path + 'Z';
}

/// Size of the comparison's parts, in pixels.
constexpr double wheel_diameter = 400, margin = 30, gap = 50, top = 110, foot = 110;
constexpr double point_spacing = 1.5;  // along curves
constexpr int units_per_pixel = 10;    // of the wheels
constexpr double picture_width = 2 * wheel_diameter + 2 * margin + gap;
constexpr double picture_height = top + wheel_diameter + foot;
constexpr double first_middle = margin + 0.5 * wheel_diameter,
                 second_middle = first_middle + wheel_diameter + gap;

std::string text(double x, double y, std::string_view style, std::string_view content) {
  return fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\">{}</text>\n", x, y, style, escape_xml(content));
}

std::string percentage(double fraction) { return fmt::format("{:.2f} %", 100 * fraction); }

/// e.g. "-18.1 %", with a proper minus sign.
std::string signed_percentage(double fraction) {
  return fmt::format("{}{:.1f} %", fraction < 0 ? "\u2212" : "+", 100 * std::abs(fraction));
}

/// Free contours in units of the picture, thinned to visibly distinct points.
std::vector<PicturePolygon> thinned(const std::vector<Contour>& contours, double pixels_per_metre) {
  std::vector<PicturePolygon> result;
  for (const Contour& contour : contours) {
    if (contour.kind != ContourKind::free) continue;
    PicturePolygon points;
    Vec<2> last{};
    for (const Vec<2>& p : contour.points) {
      if (!points.empty() && distance(p, last) < point_spacing / pixels_per_metre) continue;
      const double units = units_per_pixel * pixels_per_metre;
      points.push_back(
          {static_cast<int>(std::lround(p[0] * units)), static_cast<int>(std::lround(-p[1] * units))});
      last = p;
    }
    result.push_back(std::move(points));
  }
  return result;
}

/// The circles of rim and tread that bound material, in units of the picture.
std::string circle_paths(const PolarGrid<2>& grid, const std::vector<Contour>& contours,
                         double pixels_per_metre) {
  std::string path;
  for (const Contour& contour : contours)
    if (contour.kind != ContourKind::free)
      path += circle_path((contour.kind == ContourKind::rim ? grid.inner_radius : grid.outer_radius) *
                              units_per_pixel * pixels_per_metre,
                          0);
  return path;
}

/// Without U+FFFE and U+FFFF, which XML 1.0 excludes.
std::string without_noncharacters(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const bool excluded = text.starts_with("\xef\xbf\xbe") || text.starts_with("\xef\xbf\xbf");
    result += excluded ? '?' : text[0];
    text.remove_prefix(excluded ? 3 : 1);
  }
  return result;
}

constexpr std::string_view comparison_style = R"(<style>
text{font-family:"Helvetica Neue",Helvetica,Arial,"DejaVu Sans",sans-serif;fill:#24292f;text-anchor:middle}
.title{font-size:22px;font-weight:600}.heading{font-size:16px;font-weight:600}
.fact{font-size:15px}.caption{font-size:13px;fill:#57606a}
.material{fill:#3b6ea5;fill-rule:evenodd;stroke:#1f3d5c;stroke-width:8;stroke-linejoin:round}
.former{fill:none;stroke:#d1495b;stroke-width:11;stroke-dasharray:40 25}
.rim{fill:none;stroke:#24292f;stroke-width:30}
</style>
)";

std::string wheel_panel(const PolarGrid<2>& grid, const WheelState<2>& wheel, double centre_x,
                        const LayerCircles& layers, std::string_view overlay) {
  const double scale = 0.5 * wheel_diameter / grid.outer_radius;
  std::string panel = fmt::format("<g transform=\"translate({} {}) scale({})\">\n", centre_x,
                                  top + 0.5 * wheel_diameter, 1.0 / units_per_pixel);
  const std::string material =
      circle_paths(grid, wheel.boundary, scale) + outline_path(thinned(wheel.boundary, scale));
  panel += fmt::format("<path class=\"material\" d=\"{}\"/>\n", material);
  const auto circle = [&](std::string_view kind, double radius) {
    return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind,
                       circle_path(radius * scale * units_per_pixel, 0));
  };
  if (!layers.empty()) {
    const std::string id = fmt::format("material-{}", centre_x);
    panel += fmt::format(
        "<clipPath id=\"{0}\"><path d=\"{1}\" clip-rule=\"evenodd\"/></clipPath>\n<g "
        "clip-path=\"url(#{0})\">\n",
        id, material);
    std::string circles;
    for (const double radius : layers.radii) circles += circle_path(radius * scale * units_per_pixel, 0);
    panel += layer_lines(circles, units_per_pixel);
    panel += "</g>\n";
  }
  panel += circle("rim", grid.inner_radius);
  panel += overlay;
  return panel + "</g>\n";
}

std::string wheel_panel(const PolarGrid<3>& grid, const WheelState<3>& wheel, double centre_x,
                        const LayerCircles& layers, SideFace shown) {
  constexpr int pixels = 720;  // for screens with several pixels per unit of the picture
  const Image image =
      lit_image(lit_wheel(wheel.boundary, grid, shown, layers), wheel_camera(grid, shown), pixels);
  return fmt::format("<image x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\" href=\"{3}\"/>\n",
                     centre_x - 0.5 * wheel_diameter, top, wheel_diameter, data_url(image));
}

/// Empty if it is not known. The zero of degrees Celsius is arbitrary: their change is a difference.
std::string change_text(double before, double after, std::string_view in) {
  if (in == unit<3>(UnitKind::temperature) && std::isfinite(after - before))
    return fmt::format("  ({:+.2f} K)", after - before);
  const double change = after / before - 1;
  return std::isfinite(change) ? fmt::format("  ({})", signed_percentage(change)) : "";
}

/// Two drawn wheels with their numbers.
template <int dim>
std::string with_numbers(const Comparison<dim>& comparison, const std::string& first_panel,
                         const std::string& second_panel) {
  const WheelState<dim>&before = comparison.before, &after = comparison.after;
  const double first_line = top + wheel_diameter + 32, second_line = first_line + 22;
  const auto objective = [&](double value) {
    if (!std::isfinite(value)) return fmt::format("{}: not computed", comparison.objective_name);
    return fmt::format("{}: {:.5g} {}", comparison.objective_name, value, comparison.objective_unit);
  };
  const auto volume = [](double fraction) {
    return std::isfinite(fraction) ? fmt::format("volume: {} of the ring", percentage(fraction))
                                   : "volume: not computed";
  };

  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<title>{2}</title>\n{3}"
      "<rect width=\"{0}\" height=\"{1}\" rx=\"8\" fill=\"#ffffff\"/>\n",
      picture_width, picture_height, escape_xml(comparison.title), comparison_style);
  svg += text(0.5 * picture_width, 44, "title", comparison.title);
  svg += first_panel + text(first_middle, top - 18, "heading", before.heading);
  svg += second_panel + text(second_middle, top - 18, "heading", after.heading);
  svg += text(first_middle, first_line, "fact", objective(before.objective));
  svg += text(first_middle, second_line, "fact", volume(before.volume_fraction));
  svg += text(
      second_middle, first_line, "fact",
      objective(after.objective) + change_text(before.objective, after.objective, comparison.objective_unit));
  svg += text(second_middle, second_line, "fact", volume(after.volume_fraction));
  const std::string of_layers = comparison.layers.empty() ? "" : "; " + text(comparison.layers);
  svg += text(0.5 * picture_width, picture_height - 18, "caption", comparison.caption + of_layers);
  return svg + "</svg>\n";
}

template <int dim>
const LayerCircles& layers_before(const Comparison<dim>& comparison) {
  return comparison.layers_before.empty() ? comparison.layers : comparison.layers_before;
}

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string result;
  for (const char c : without_noncharacters(without_control_characters(text))) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&apos;";
    else
      result += c;
  }
  return result;
}

std::string circle_path(double radius, int decimals) {
  return fmt::format(
      "M{0:.{1}f} 0A{0:.{1}f} {0:.{1}f} 0 1 0 -{0:.{1}f} 0A{0:.{1}f} {0:.{1}f} 0 1 0 {0:.{1}f} 0Z", radius,
      decimals);
}

std::string titled_svg(double width, double height, std::string_view title, double left) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"Helvetica Neue,Helvetica,Arial,DejaVu Sans,sans-serif\" font-size=\"14\" "
      "fill=\"#24292f\">\n"
      "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" rx=\"8\" fill=\"#ffffff\"/>\n"
      "<text x=\"{3}\" y=\"36\" font-size=\"20\" font-weight=\"600\">{2}</text>\n",
      width, height, escape_xml(title), left);
}

std::string material_path(const PolarGrid<2>& grid, std::span<const Contour> contours, double units_per_metre,
                          int decimals, double spacing) {
  std::string path;
  for (const Contour& c : contours) {
    if (c.kind == ContourKind::free)
      path += polyline_path(c.points, units_per_metre, decimals, spacing);
    else
      path += circle_path(
          (c.kind == ContourKind::rim ? grid.inner_radius : grid.outer_radius) * units_per_metre, decimals);
    path += '\n';
  }
  return path;
}

std::string shape_svg(const PolarGrid<2>& grid, std::span<const Contour> contours, std::string_view title) {
  constexpr double mm = 1000, border = 1;
  const double half = grid.outer_radius * mm + border;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{0}mm\" "
      "viewBox=\"{1} {1} {0} {0}\">\n"
      "<title>{2}</title>\n"
      "<desc>One user unit is one millimetre.</desc>\n"
      "<path fill=\"#d0d7de\" fill-rule=\"evenodd\" stroke=\"#000000\" stroke-width=\"0.1\" d=\"{3}\"/>\n"
      "</svg>\n",
      2 * half, -half, escape_xml(title), material_path(grid, contours, mm, 4, 0));
}

std::string comparison_svg(const PolarGrid<2>& grid, const Comparison<2>& comparison) {
  const double scale = 0.5 * wheel_diameter / grid.outer_radius;
  const std::string former = fmt::format("<path class=\"former\" d=\"{}\"/>\n",
                                         outline_path(thinned(comparison.before.boundary, scale)));
  return with_numbers(comparison,
                      wheel_panel(grid, comparison.before, first_middle, layers_before(comparison), ""),
                      wheel_panel(grid, comparison.after, second_middle, comparison.layers, former));
}

std::string comparison_svg(const PolarGrid<3>& grid, const Comparison<3>& comparison) {
  Comparison<3> captioned = comparison;
  if (has_closed_cavities(comparison.before.boundary) || has_closed_cavities(comparison.after.boundary))
    captioned.caption += "; cut open to show closed cavities";
  return with_numbers(
      captioned,
      wheel_panel(grid, comparison.before, first_middle, layers_before(comparison), comparison.shown),
      wheel_panel(grid, comparison.after, second_middle, comparison.layers, comparison.shown));
}

}  // namespace wheelwright
