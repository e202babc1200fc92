#include "wheelwright/run/results/mould_report.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "wheelwright/case/derived.h"
#include "wheelwright/shape/geometry/place.h"
#include "wheelwright/shape/surface/axial_angles.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, degrees = 180 / std::numbers::pi;

std::string at(const AxialAngle& found) {
  return fmt::format("{:.3g} deg at {}, z = {:.1f} mm", found.angle * degrees, place_text<3>(found.place),
                     found.place[2] * mm);
}

}  // namespace

MouldReport mould_report(const Case& c, const SurfaceMesh& surface) {
  constexpr double rounding = 0.01;  // degrees
  if (c.wheel.dimension != 3 || !mould(c)) return {};
  const PolarGrid<3> grid = polar_grid<3>(c);
  const double plane = parting_plane_of(*mould(c), grid) * grid.axial_size();
  const AxialAngle draft = smallest_draft(surface, plane);
  if (!std::isfinite(draft.angle)) return {};
  MouldReport result{
      fmt::format("{:<16} parts at z = {:.1f} mm, smallest draft {}\n", "mould", plane * mm, at(draft)), {}};
  if (draft.angle * degrees < -rounding)
    result.warning = fmt::format("an undercut does not come out of the mould: {}", at(draft));
  return result;
}

}  // namespace wheelwright
