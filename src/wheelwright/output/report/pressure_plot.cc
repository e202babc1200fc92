#include "wheelwright/output/report/pressure_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "wheelwright/output/report/cell_means.h"

namespace wheelwright {
namespace {

constexpr size_t max_curves = 8;

/// The cells in contact and the open ones next to them, along the ground.
std::vector<ContactPoint> contact_patch(std::span<const ContactPoint> cells, int position) {
  std::vector<ContactPoint> patch;
  std::ranges::copy_if(cells, std::back_inserter(patch),
                       [&](const ContactPoint& p) { return p.position == position; });
  const auto touches = [](const ContactPoint& p) { return p.pressure > 0; };
  auto first = std::ranges::find_if(patch, touches);
  auto end = std::find_if(patch.rbegin(), patch.rend(), touches).base();
  if (first >= end) return {};
  if (first != patch.begin()) --first;
  if (end != patch.end()) ++end;
  return {first, end};
}

}  // namespace

LinePlot pressure_plot(std::span<const ContactPoint> points, std::span<const double> azimuths,
                       const std::string& title) {
  constexpr double mm = 1e3, MPa = 1e-6, degree = 180 / std::numbers::pi;
  LinePlot plot{title, {"along the ground", "mm"}, {"contact pressure, means of cells", "MPa"}, {}};
  const std::vector<ContactPoint> cells = cell_means(points);
  const size_t stride = (azimuths.size() + max_curves - 1) / max_curves;
  for (size_t i = 0; i < azimuths.size(); i += stride) {
    PlotCurve curve{fmt::format("{:.2f}\u00b0", azimuths[i] * degree), {}, {}};
    for (const ContactPoint& p : contact_patch(cells, static_cast<int>(i))) {
      curve.x.push_back(p.x * mm);
      curve.y.push_back(p.pressure * MPa);
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace wheelwright
