#include "wheelwright/output/report/made_wheel.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {
namespace {

constexpr double mm_per_m = 1e3, degrees_per_radian = 180 / std::numbers::pi;

/// How much more than allowed the surface may hang over [deg]: its triangles, and the level set of degree 2
/// between the nodes of a spline, deviate by as much.
constexpr double overhang_tolerance = 3;

/// In degrees, to a hundredth.
std::string degrees(double angle) {
  const double rounded = std::round(100 * angle * degrees_per_radian) / 100;
  return fmt::format("{:.3g} deg", rounded == 0 ? 0 : rounded);  // no -0
}

std::string at(const AxialAngle& found) {
  return fmt::format("{} at {}, z = {:.1f} mm", degrees(found.angle), place_text<3>(found.place),
                     found.place[2] * mm_per_m);
}

}  // namespace

std::string text(const MadeWheel& made) {
  if (made.mould) {
    const auto& [plane, draft, smallest] = *made.mould;
    const std::string halves = fmt::format("the halves of the mould meet at z = {:.1f} mm", plane * mm_per_m);
    if (!std::isfinite(smallest.angle)) return halves;
    return fmt::format("{}, smallest draft {}", halves, at(smallest));
  }
  if (made.print) {
    const auto& [plate, overhang, largest] = *made.print;
    const std::string stands = fmt::format("it stands on its side face at z = {:.1f} mm", plate * mm_per_m);
    if (!std::isfinite(largest.angle)) return stands;
    return fmt::format("{}, largest overhang {}", stands, at(largest));
  }
  if (made.how == "extruded") return "the same all along the axle";
  if (made.how == "turned") return "a body of revolution";
  return "";
}

std::string sentence(const MadeWheel& made) {
  const std::string meaning = text(made);
  return meaning.empty() ? "" : fmt::format("{}: {}", made.how, meaning);
}

std::string making_warning(const MadeWheel& made) {
  constexpr double rounding = 0.01;  // degrees
  if (made.mould && made.mould->smallest.angle * degrees_per_radian < -rounding)
    return fmt::format("an undercut does not come out of the mould: {}", at(made.mould->smallest));
  if (made.print &&
      (made.print->largest.angle - made.print->overhang) * degrees_per_radian > overhang_tolerance)
    return fmt::format(
        "an overhang needs support: {}, where the case allows {}; more grid.axial_cells keep it smaller",
        at(made.print->largest), degrees(made.print->overhang));
  return "";
}

}  // namespace wheelwright
