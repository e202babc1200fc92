#include "wheelwright/output/export/svg_outline.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

/// Arcs deviate by at most this fraction of the tolerance.
constexpr double share_of_arcs = 0.1;

std::string point(const Vec<2>& p) {
  return fmt::format("{:.10g} {:.10g}", p[0] * millimetres_per_metre, -p[1] * millimetres_per_metre);
}

/// Some programs draw every cubic with a fixed number of chords, whatever its length: these must suffice.
int n_parts(const Bezier& cubic, double tolerance) {
  constexpr int chords_of_others = 16;
  return (n_chords(cubic, tolerance) + chords_of_others - 1) / chords_of_others;
}

std::string subpath(const cad::Loop& loop, double tolerance) {
  std::string path = fmt::format("M{}", point(start_of(loop.curves.front())));
  for (const cad::Curve& curve : loop.curves) {
    if (std::holds_alternative<cad::Line>(curve)) {
      path += fmt::format("\nL{}", point(end_of(curve)));
      continue;
    }
    for (const Bezier& cubic : beziers(curve, share_of_arcs * tolerance))
      for (const Bezier& p : divided(cubic, n_parts(cubic, tolerance)))
        path += fmt::format("\nC{} {} {}", point(p[1]), point(p[2]), point(p[3]));
  }
  return path + "Z";
}

std::string path_of(const cad::Outline& outline, double tolerance) {
  std::string path;
  for (const cad::Loop& loop : outline.loops) path += fmt::format("{}\n", subpath(loop, tolerance));
  return path;
}

/// The paths of the layers, which programs like Inkscape show as layers.
template <class Model>
std::string layer_paths(const Model& wheel) {
  std::string groups;
  for (const auto& layer : wheel.layers) {
    const auto [red, green, blue] = layer_colour(&layer - wheel.layers.data());
    std::string id = layer.name;
    std::ranges::replace(id, ' ', '-');
    groups += fmt::format(
        "<g id=\"layer-{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\" "
        "fill=\"#{:02x}{:02x}{:02x}\">\n"
        "<path d=\"{}\"/>\n</g>\n",
        id, escape_xml(layer.name), red, green, blue, path_of(layer.outline, wheel.tolerance));
  }
  return groups;
}

/// The paths of the material.
template <class Model>
std::string material_paths(const Model& wheel) {
  return wheel.layers.empty()
             ? fmt::format("<path id=\"material\" d=\"{}\"/>\n", path_of(wheel.outline, wheel.tolerance))
             : layer_paths(wheel);
}

/// A page of this size [mm], with the origin of the drawing at a place on it.
struct Page {
  double width, height;
  Vec<2> origin;
};

template <class Model>
std::string document(const Model& wheel, const Page& page, const std::string& content) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" {}width=\"{:.6g}mm\" height=\"{:.6g}mm\" "
      "viewBox=\"0 0 {:.6g} {:.6g}\">\n"
      "<title>{}</title>\n<desc>{}; millimetres</desc>\n"
      "<g id=\"wheel\" transform=\"translate({:.6g} {:.6g})\" fill=\"#3b6ea5\" fill-rule=\"evenodd\" "
      "stroke=\"none\">\n{}</g>\n</svg>\n",
      wheel.layers.empty() ? "" : "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" ",
      page.width, page.height, page.width, page.height, escape_xml(wheel.title), escape_xml(wheel.program),
      page.origin[0], page.origin[1], content);
}

}  // namespace

std::string svg_outline(const WheelModel& wheel) {
  const double half = wheel.shape.lattice.grid().outer_radius * millimetres_per_metre;
  return document(wheel, {2 * half, 2 * half, {half, half}}, material_paths(wheel));
}

std::string svg_outline(const TurnedModel& wheel) {
  constexpr double share_of_margin = 0.02;
  const double width = wheel.width * millimetres_per_metre,
               radius = wheel.outer_radius * millimetres_per_metre, margin = share_of_margin * radius;
  const std::string axle = fmt::format(
      "<path id=\"axle\" d=\"M{:.6g} 0H{:.6g}\" fill=\"none\" stroke=\"#000000\" stroke-width=\"{:.3g}\" "
      "stroke-dasharray=\"{:.3g} {:.3g} {:.3g} {:.3g}\"/>\n",
      -margin, width + margin, 0.05 * margin, 2 * margin, 0.3 * margin, 0.3 * margin, 0.3 * margin);
  return document(wheel, {width + 2 * margin, radius + 2 * margin, {margin, radius + margin}},
                  material_paths(wheel) + axle);
}

}  // namespace wheelwright
