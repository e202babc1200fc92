#include "wheelwright/output/report/pressure_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "wheelwright/output/report/colour_map.h"
#include "wheelwright/output/report/colour_scale.h"
#include "wheelwright/output/report/plot_svg.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

constexpr double box_width = 560, box_height = 300, box_left = 90, box_top = 90, bar_space = 170,
                 box_foot = 70;  // [pixels]
constexpr int max_axis_ticks = 6;

/// Contact points at one place along the axle, in order along the ground.
using Line = std::vector<ContactPoint>;

std::vector<Line> lines(std::span<const ContactPoint> points) {
  std::map<long, Line> by_place;
  for (const ContactPoint& p : points) by_place[std::lround(1e9 * p.z)].push_back(p);
  std::vector<Line> result;
  for (auto& [place, line] : by_place) {
    std::ranges::sort(line, {}, &ContactPoint::x);
    result.push_back(std::move(line));
  }
  return result;
}

/// The middles between neighbours, and the ends.
std::vector<double> edges(const std::vector<double>& middles, double first, double last) {
  std::vector<double> result{first};
  for (std::size_t k = 1; k < middles.size(); ++k) result.push_back(0.5 * (middles[k - 1] + middles[k]));
  result.push_back(last);
  return result;
}

/// From metres to pixels: the axle to the right, larger azimuths up. Each axis has its own scale, because the
/// contact is often much shorter than wide.
struct MapView {
  double half_width, half_length;

  double x(double along_axle) const {
    return box_left + (along_axle + half_width) * box_width / (2 * half_width);
  }
  double y(double along_ground) const {
    return box_top + (half_length - along_ground) * box_height / (2 * half_length);
  }
};

MapView view_of(const PolarGrid<3>& grid, std::span<const ContactPoint> points) {
  double reach = 0;
  for (const ContactPoint& p : points)
    if (p.pressure > 0) reach = std::max(reach, std::abs(p.x));
  return {0.5 * grid.width, reach > 0 ? 1.3 * reach : 0.5 * grid.width};
}

std::string rectangles(const std::vector<Line>& all, const MapView& view, const ColourScale& scale) {
  std::vector<double> places;
  for (const Line& line : all) places.push_back(line.front().z);
  const auto z = edges(places, -view.half_width, view.half_width);
  std::string svg;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<double> middles;
    for (const ContactPoint& p : all[i]) middles.push_back(p.x);
    const auto x = edges(middles, middles.front(), middles.back());
    for (std::size_t k = 0; k < middles.size(); ++k) {
      const double from = std::max(x[k], -view.half_length), to = std::min(x[k + 1], view.half_length);
      const double pressure = all[i][k].pressure;
      if (!(to > from) || !(pressure > 0)) continue;
      svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                         view.x(z[i]), view.y(to), view.x(z[i + 1]) - view.x(z[i]) + 0.2,
                         view.y(from) - view.y(to) + 0.2, viridis(scale.fraction(pressure)));
    }
  }
  return svg;
}

std::string axes(const MapView& view) {
  constexpr double mm = 1e3, bottom = box_top + box_height;
  std::string svg =
      fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#24292f\"/>\n",
                  box_left, box_top, box_width, box_height);
  for (const double tick : axis_ticks(-view.half_width * mm, view.half_width * mm, max_axis_ticks))
    svg += fmt::format(
        "<path stroke=\"#24292f\" d=\"M{0:.2f} {1}v5\"/>"
        "<text x=\"{0:.2f}\" y=\"{2}\" text-anchor=\"middle\">{3:.6g}</text>\n",
        view.x(tick / mm), bottom, bottom + 20, tick + 0.0);
  for (const double tick : axis_ticks(-view.half_length * mm, view.half_length * mm, max_axis_ticks))
    svg += fmt::format(
        "<path stroke=\"#24292f\" d=\"M{0} {1:.2f}h-5\"/>"
        "<text x=\"{2}\" y=\"{3:.2f}\" text-anchor=\"end\">{4:.6g}</text>\n",
        box_left, view.y(tick / mm), box_left - 9, view.y(tick / mm) + 5, tick + 0.0);
  return svg +
         fmt::format(
             "<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">along the axle, from the middle of the "
             "width "
             "[mm]</text>\n"
             "<text transform=\"translate({} {:.2f}) rotate(-90)\" text-anchor=\"middle\">along the ground "
             "[mm]</text>\n",
             view.x(0), bottom + 44, box_left - 56, view.y(0));
}

}  // namespace

std::string pressure_map_svg(const std::string& title, const PolarGrid<3>& grid,
                             std::span<const ContactPoint> points) {
  std::vector<double> pressures;
  double force = 0, area = 0;
  for (const ContactPoint& p : points) {
    pressures.push_back(p.pressure);
    force += p.weight * p.pressure;
    if (p.pressure > 0) area += p.weight;
  }
  const MapView view = view_of(grid, points);
  const ColourScale scale = colour_scale_from_zero(pressures, 0);
  const double peak = pressures.empty() ? 0 : std::ranges::max(pressures);
  const double bar_x = box_left + box_width + 40, width = bar_x + bar_space,
               height = box_top + box_height + box_foot + 20;
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
             "viewBox=\"0 0 {0:.0f} {1:.0f}\" "
             "font-family=\"Helvetica Neue,Helvetica,Arial,DejaVu Sans,sans-serif\" font-size=\"14\" "
             "fill=\"#24292f\">\n"
             "<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"#ffffff\"/>\n"
             "<text x=\"40\" y=\"36\" font-size=\"20\" font-weight=\"600\">{2}</text>\n"
             "<text x=\"40\" y=\"60\">contact pressure \u00b7 peak {3} \u00b7 contact on {4:.4g} mm\u00b2 "
             "\u00b7 force of the ground {5:.5g} N</text>\n",
             width, height, escape_xml(title), value_text(peak, "Pa"), area * 1e6, force) +
         rectangles(lines(points), view, scale) + axes(view) +
         colour_bar(scale, "contact pressure", "Pa", bar_x, box_top + box_height + 60) + "</svg>\n";
}

}  // namespace wheelwright
