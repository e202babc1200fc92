#include "wheelwright/output/report/load_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/output/report/cell_means.h"
#include "wheelwright/output/report/colour_scale.h"

namespace wheelwright {
namespace {

constexpr const char* ink = "#24292f";
constexpr const char* force_colour = "#c2185b";
constexpr double longest_arrow = 64, shortest_arrow = 26, hatch_spacing = 9, hatch_depth = 9;
constexpr double pressure_height = 46;  // of the peak
constexpr double min_share = 1e-3;      // of forces that are drawn

/// Text with a white edge, readable on any ground.
std::string label(double x, double y, const char* anchor, const char* colour, const std::string& content) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"4\" "
      "stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>\n",
      x, y, anchor, colour, content);
}

/// The head of an arrow that ends at `end` and points along the unit vector `d`.
std::string arrow_head(const Vec<2>& end, const Vec<2>& d) {
  constexpr double length = 11, half_width = 4.5;
  const Vec<2> base{end[0] - length * d[0], end[1] - length * d[1]};
  return fmt::format("<path fill=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}z\"/>\n", force_colour,
                     end[0], end[1], base[0] - half_width * d[1], base[1] + half_width * d[0],
                     base[0] + half_width * d[1], base[1] - half_width * d[0]);
}

std::string arrow(const Vec<2>& begin, const Vec<2>& d, double length) {
  const Vec<2> end{begin[0] + length * d[0], begin[1] + length * d[1]};
  return fmt::format(
             "<path fill=\"none\" stroke=\"{}\" stroke-width=\"3\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n",
             force_colour, begin[0], begin[1], end[0] - 8 * d[0], end[1] - 8 * d[1]) +
         arrow_head(end, d);
}

/// A third of a turn about the axle, below it, where no other arrow is; counter-clockwise for a positive
/// torque.
std::string torque_arc(const Vec<2>& axle, double sign, double radius) {
  const double sine = 0.5 * std::numbers::sqrt3, cosine = 0.5;  // of the angle from the bottom to an end
  const Vec<2> from{axle[0] - sign * sine * radius, axle[1] + cosine * radius},
      to{axle[0] + sign * sine * radius, axle[1] + cosine * radius}, along{sign * cosine, -sine};
  return fmt::format(
             "<path fill=\"none\" stroke=\"{}\" stroke-width=\"3\" d=\"M{:.1f} {:.1f}A{} {} 0 0 {} {:.1f} "
             "{:.1f}\"/>\n",
             force_colour, from[0], from[1], radius, radius, sign > 0 ? 0 : 1, to[0], to[1]) +
         arrow_head({to[0] + 7 * along[0], to[1] + 7 * along[1]}, along);
}

}  // namespace

std::string force_text(double value, const std::string& unit) {
  return std::abs(value) < 1e5 ? fmt::format("{:.5g} {}", value, unit) : value_text(value, unit);
}

namespace {

/// The outline of ground that is not flat, hatched below.
std::string outline_mark(const PictureView& view, double radius, const Ground& ground) {
  const double level = radius + ground.standing(radius).rise, right = view.left + view.size;
  const double pixel = 1 / view.pixels_per_metre(), bottom = view.top + view.size;
  const auto at = [&](const Vec<2>& place) { return view.pixel({place[0], level - place[1]}); };
  const auto is_shown = [&](const Vec<2>& p) { return p[1] >= view.top && p[1] <= bottom + hatch_depth; };
  std::string path, hatch;
  bool pen_is_down = false;
  for (const Vec<2>& place :
       ground.line(view.centre[0] - view.half, view.centre[0] + view.half, 0.1 * pixel)) {
    const Vec<2> p = at(place);
    if (is_shown(p)) path += fmt::format("{}{:.1f} {:.1f}", pen_is_down ? "L" : "M", p[0], p[1] + 1);
    pen_is_down = is_shown(p);
  }
  for (double x = view.left + hatch_spacing; x <= right; x += hatch_spacing) {
    const double along = view.centre[0] + (x - view.left - 0.5 * view.size) * pixel;
    const double height = ground.height(along);
    if (!std::isfinite(height)) continue;
    if (const Vec<2> p = at({along, height}); is_shown(p))
      hatch += fmt::format("M{:.0f} {:.1f}l-{} {}", x, p[1], hatch_depth, hatch_depth);
  }
  return fmt::format(
      "<path fill=\"none\" stroke=\"#8c959f\" d=\"{}\"/>\n"
      "<path fill=\"none\" stroke=\"{}\" stroke-width=\"2\" d=\"{}\"/>\n",
      hatch, ink, path);
}

}  // namespace

std::string ground_mark(const PictureView& view, double depth, const Ground& ground) {
  if (!ground.is_flat()) return outline_mark(view, depth, ground);
  const double y = view.pixel({0, depth})[1], right = view.left + view.size;
  std::string hatch;
  for (double x = view.left + hatch_spacing; x <= right; x += hatch_spacing)
    hatch += fmt::format("M{:.0f} {:.1f}l-{} {}", x, y, hatch_depth, hatch_depth);
  return fmt::format(
      "<path fill=\"none\" stroke=\"#8c959f\" d=\"{}\"/>\n"
      "<path fill=\"none\" stroke=\"{}\" stroke-width=\"2\" d=\"M{} {:.1f}h{}\"/>\n",
      hatch, ink, view.left, y + 1, view.size);
}

std::string ring_mark(const PictureView& view, double radius) {
  const Vec<2> axle = view.pixel({0, 0});
  const double r = radius * view.pixels_per_metre();
  const int n = static_cast<int>(2 * std::numbers::pi * r / hatch_spacing);
  std::string hatch;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n, turned = angle + hatch_depth / r;
    const Vec<2> from{axle[0] + r * std::cos(angle), axle[1] + r * std::sin(angle)},
        to{axle[0] + (r + hatch_depth) * std::cos(turned), axle[1] + (r + hatch_depth) * std::sin(turned)};
    if (from[0] < view.left - hatch_depth || from[0] > view.left + view.size + hatch_depth ||
        from[1] < view.top - hatch_depth || from[1] > view.top + view.size + hatch_depth)
      continue;
    hatch += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", from[0], from[1], to[0], to[1]);
  }
  return fmt::format(
      "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\" viewBox=\"{0} {1} {2} {2}\" overflow=\"hidden\" "
      "fill=\"none\">\n<path stroke=\"#8c959f\" d=\"{3}\"/>\n"
      "<circle cx=\"{4:.1f}\" cy=\"{5:.1f}\" r=\"{6:.1f}\" stroke=\"{7}\" stroke-width=\"2\"/>\n</svg>\n",
      view.left, view.top, view.size, hatch, axle[0], axle[1], r + 1, ink);
}

std::string force_marks(const PictureView& view, const Vec<2>& axle, const RimForce& force,
                        const PolarGrid<2>& grid) {
  if (!view.holds(axle)) return "";
  const Vec<2> at = view.pixel(axle);
  const double outer_radius = grid.outer_radius;
  const double length =
      std::clamp(0.6 * grid.inner_radius * view.pixels_per_metre(), shortest_arrow, longest_arrow);
  const double size = std::max(
      {std::abs(force.towards_ground), std::abs(force.along_ground), std::abs(force.torque) / outer_radius});
  std::string svg;
  if (std::abs(force.towards_ground) > min_share * size) {
    const double sign = std::copysign(1, force.towards_ground);
    svg += arrow({at[0], at[1] - sign * length}, {0, sign}, length);
    svg += label(at[0] + 10, at[1] - sign * 0.7 * length + 5, "start", force_colour,
                 force_text(std::abs(force.towards_ground), "N"));
  }
  if (std::abs(force.along_ground) > min_share * size) {
    const double sign = std::copysign(1, force.along_ground);
    svg += arrow(at, {sign, 0}, length);
    svg += label(at[0] + sign * (length + 6), at[1] + 5, sign > 0 ? "start" : "end", force_colour,
                 force_text(std::abs(force.along_ground), "N"));
  }
  if (std::abs(force.torque) > min_share * size * outer_radius) {
    svg += torque_arc(at, std::copysign(1, force.torque), 0.7 * length);
    svg += label(at[0], at[1] + 0.7 * length + 20, "middle", force_colour,
                 force_text(std::abs(force.torque), "N m"));
  }
  return svg + fmt::format(
                   "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#ffffff\" stroke=\"{}\" "
                   "stroke-width=\"2\"/>\n",
                   at[0], at[1], ink);
}

std::string azimuth_mark(const PictureView& view, const Vec<2>& axle, const Vec<2>& rim) {
  constexpr double length = 10, text_distance = 22;
  if (!view.holds(axle) || !view.holds(rim)) return "";
  const Vec<2> a = view.pixel(axle), b = view.pixel(rim);
  const double radius = distance(a, b);
  const Vec<2> end = b + length * (a - b) / radius, text = b + text_distance * (a - b) / radius;
  return fmt::format(
             "<path fill=\"none\" stroke=\"{}\" stroke-width=\"2\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n",
             ink, b[0], b[1], end[0], end[1]) +
         label(text[0], text[1] + 5, "middle", ink, "0\u00b0");
}

std::string peak_mark(const PictureView& view, const Vec<2>& place, const std::string& content) {
  if (!view.holds(place)) return "";
  const Vec<2> at = view.pixel(place);
  const double side = at[0] > view.left + 0.72 * view.size ? -1 : 1;  // where there is room for the text
  const Vec<2> end{at[0] + side * 44, at[1] - 40};
  return fmt::format(
             "<g fill=\"none\"><path stroke=\"#ffffff\" stroke-width=\"4\" d=\"M{0:.1f} {1:.1f}L{2:.1f} "
             "{3:.1f}\"/>"
             "<circle cx=\"{4:.1f}\" cy=\"{5:.1f}\" r=\"6\" stroke=\"#ffffff\" stroke-width=\"4\"/>"
             "<path stroke=\"{6}\" stroke-width=\"1.5\" d=\"M{0:.1f} {1:.1f}L{2:.1f} {3:.1f}\"/>"
             "<circle cx=\"{4:.1f}\" cy=\"{5:.1f}\" r=\"6\" stroke=\"{6}\" stroke-width=\"1.5\"/></g>\n",
             at[0] + side * 4.4, at[1] - 4, end[0], end[1], at[0], at[1], ink) +
         label(end[0] + side * 4, end[1] + 4, side > 0 ? "start" : "end", ink, content);
}

std::string pressure_mark(const PictureView& view, double depth, std::span<const ContactPoint> points) {
  const std::vector<ContactPoint> cells = cell_means(points);
  const auto touches = [](const ContactPoint& p) { return p.pressure > 0; };
  if (std::ranges::none_of(cells, touches)) return "";
  const double peak = std::ranges::max(cells, {}, &ContactPoint::pressure).pressure;
  const double ground = view.pixel({0, depth})[1] + 2;
  std::string path;
  double first = 0, last = 0;
  for (const ContactPoint& p : cells) {
    if (!touches(p)) continue;
    const double x = view.pixel({p.x, 0})[0];
    if (path.empty()) path = fmt::format("M{:.1f} {:.1f}", first = x, ground);
    path += fmt::format("L{:.1f} {:.1f}", last = x, ground + pressure_height * p.pressure / peak);
  }
  path += fmt::format("L{:.1f} {:.1f}z", last, ground);
  return fmt::format(
             "<path fill=\"{0}\" fill-opacity=\"0.35\" stroke=\"{0}\" stroke-width=\"1.5\" d=\"{1}\"/>\n",
             force_colour, path) +
         label(view.pixel(view.centre)[0], ground + pressure_height + 18, "middle", force_colour,
               "contact pressure, means of cells, up to " + value_text(peak, "Pa"));
}

std::string undeformed_mark(const PictureView& view, double inner_radius, double outer_radius) {
  const Vec<2> centre = view.pixel({0, 0});
  std::string svg = "<g fill=\"none\" stroke=\"#8c959f\" stroke-dasharray=\"6 4\">";
  for (const double radius : {inner_radius, outer_radius})
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", centre[0], centre[1],
                       radius * view.pixels_per_metre());
  return svg + "</g>\n";
}

}  // namespace wheelwright
