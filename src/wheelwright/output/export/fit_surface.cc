#include "wheelwright/output/export/fit_surface.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/place.h"
#include "wheelwright/shape/surface/deviation.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, max_volume_error = 1e-3;
constexpr int gauss_points = 4;

std::string place(const Vec<3>& polar) {
  return fmt::format("{}, z = {:.1f} mm", place_text<3>(polar), polar[2] * mm);
}

/// The subject of a refusal.
std::string division(const FittedSurface& surface) {
  return fmt::format("with {0} x {0} x {0} triangulated cubes per cell the surface", surface.parts);
}

}  // namespace

std::string advice_on_tolerance(double deviation) {
  const double decade = std::pow(10, std::floor(std::log10(deviation * mm)) - 1);
  return fmt::format("use --tolerance {:.4g} or more, or a finer grid",
                     (std::floor(deviation * mm / decade) + 1) * decade);
}

Expected<FittedSurface, SurfaceRefusal> fit_surface(const LevelSet<3>& psi, int map_degree,
                                                    double tolerance) {
  const auto domain = cut_domain(psi, gauss_points);
  if (!domain) return SurfaceRefusal{domain.failure().detail};
  const double volume = psi.lattice.grid().n_sectors * material_measure(*domain, map_degree);
  FittedSurface fitted{};
  for (const int parts : divisions_of_cell) {
    fitted.parts = parts;
    fitted.surface = material_surface(psi, parts, map_degree);
    const SurfaceDeviation found = deviation(fitted.surface, psi, map_degree);
    fitted.deviation = found.distance;
    fitted.place = found.place;
    fitted.volume_error = enclosed_volume(fitted.surface) / volume - 1;
    if (fitted.deviation <= tolerance && std::abs(fitted.volume_error) < max_volume_error) break;
  }
  if (fitted.deviation > tolerance)
    return SurfaceRefusal{fmt::format(
        "{} still deviates by {:.3g} mm at {}, more than the tolerance of {:.3g} mm; {}", division(fitted),
        fitted.deviation * mm, place(fitted.place), tolerance * mm, advice_on_tolerance(fitted.deviation))};
  const auto report = check_solid(solid_mesh(fitted.surface));
  if (!report) {
    Vec<3> at = report.failure().place;
    for (double& x : at) x /= mm;
    return SurfaceRefusal{fmt::format("{}: {}", place(polar<3>(at)), report.failure().what)};
  }
  fitted.report = *report;
  fitted.volume_error = report->volume / (volume * mm * mm * mm) - 1;
  if (!(std::abs(fitted.volume_error) < max_volume_error))
    return SurfaceRefusal{
        fmt::format("{} still has a volume that differs by {:.3g} % from the level set's; use a finer grid",
                    division(fitted), 100 * fitted.volume_error)};
  return fitted;
}

std::string text(const FittedSurface& surface) {
  const auto line = [](const char* name, const std::string& value) {
    return fmt::format("{:<16} {}\n", name, value);
  };
  return line("surface", fmt::format("{} triangles, closed, {} per cell and axis",
                                     surface.surface.triangles.size(), surface.parts)) +
         line("bodies", fmt::format("{}, with {} handles and {} closed cavities", surface.report.bodies,
                                    surface.report.handles(), surface.report.cavities)) +
         line("volume", fmt::format("{:.0f} mm^3, {:+.1e} of the level set's", surface.report.volume,
                                    surface.volume_error)) +
         line("deviation", fmt::format("{:.4f} mm at {}", surface.deviation * mm, place(surface.place)));
}

}  // namespace wheelwright
