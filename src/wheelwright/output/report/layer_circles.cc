#include "wheelwright/output/report/layer_circles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "wheelwright/output/report/svg.h"

namespace wheelwright {

std::string text(const LayerCircles& circles) {
  return fmt::format("layers from the rim: {}", fmt::join(circles.names, ", "));
}

std::string layer_legend(const LayerCircles& circles, double x, double y) {
  if (circles.empty()) return "";
  constexpr double line_height = 18;
  std::string svg = layer_lines(fmt::format("M{} {}h24", x, y - 4), 1) +
                    fmt::format("<text x=\"{}\" y=\"{}\">between layers,</text>\n", x + 32, y) +
                    fmt::format("<text x=\"{}\" y=\"{}\">from the rim:</text>\n", x, y + line_height);
  for (const std::string& name : circles.names)
    svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, (y += line_height) + line_height,
                       escape_xml(name));
  return svg;
}

std::string layer_lines(const std::string& path, double pixel) {
  if (path.empty()) return "";
  return fmt::format(
      "<g class=\"layers\" fill=\"none\"><path stroke=\"#ffffff\" stroke-opacity=\"0.7\" "
      "stroke-width=\"{0}\" "
      "d=\"{2}\"/><path stroke=\"#24292f\" stroke-width=\"{1}\" d=\"{2}\"/></g>\n",
      2.4 * pixel, 1.0 * pixel, path);
}

}  // namespace wheelwright
