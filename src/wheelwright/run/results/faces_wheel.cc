#include "wheelwright/run/results/faces_wheel.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/shape/geometry/place.h"
#include "wheelwright/shape/surface/check_surface.h"
#include "wheelwright/shape/surface/simplified_surface.h"
#include "wheelwright/shape/surface/zero_surface.h"

namespace wheelwright {
namespace {

using FacesFaults = std::vector<cad::OutlineFault>;
constexpr double millimetres = 1e3;

FacetedSolid facets_of(const SurfaceMesh& mesh, const LevelSet<3>& psi) {
  const PolarGrid<3>& grid = psi.lattice.grid();
  return faceted_solid(mesh, grid.inner_radius, grid.outer_radius, grid.width);
}

struct Faces {
  SolidFaces solid;
  SurfaceDeviation deviation;
  std::string why_facets;
};

/// The largest distance of facets from {psi = 0}, at the points that divide their sides into equal parts.
SurfaceDeviation deviation(const FacetedSolid& solid, const LevelSet<3>& psi) {
  constexpr int parts = 8;
  const ZeroSurface zero(psi);
  SurfaceDeviation largest{0, {}};
  for (const auto& [corners, shell] : solid.triangles) {
    const Vec<3>&a = solid.points[corners[0]], &b = solid.points[corners[1]], &c = solid.points[corners[2]];
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        const Vec<3> x = a + (double(i) / parts) * (b - a) + (double(j) / parts) * (c - a);
        const double radius = std::hypot(x[0], x[1]);
        const double to_cylinders =
            std::min(std::abs(radius - solid.inner_radius), std::abs(radius - solid.outer_radius));
        const double found = std::min(zero.at(x).distance(), to_cylinders);
        if (found > largest.distance) largest = {found, polar<3>(x)};
      }
  }
  return largest;
}

SurfaceDeviation deviation(const cad::LoftedSolid& solid, const LevelSet<3>& psi) {
  constexpr int parts = 4;
  const ZeroSurface zero(psi);
  SurfaceDeviation largest{0, {}};
  for (const auto& hole : solid.holes) {
    const auto found = cad::deviation(hole.surface, zero, parts);
    if (found.distance > largest.distance) largest = found;
  }
  return largest;
}

std::string place(const Vec<3>& polar_place) {
  return fmt::format("{}, z = {:.1f} mm", place_text<3>(polar_place), polar_place[2] * millimetres);
}

/// The surface by fewer triangles that stay within a tolerance at some points of them, checked.
Expected<SurfaceMesh, FacesFaults> checked_and_simplified(const SurfaceMesh& surface, const LevelSet<3>& psi,
                                                          double tolerance) {
  SurfaceMesh mesh = simplified(surface, psi, tolerance);
  if (const auto report = check_surface(mesh.points, mesh.triangles); !report)
    return FacesFaults{{fmt::format("{}: {}; choose another --tolerance",
                                    place(polar<3>(report.failure().place)), report.failure().what)}};
  return mesh;
}

/// Facets that stay within the tolerance everywhere, from those simplified first.
Expected<Faces, FacesFaults> facets_within(double tolerance, const SurfaceMesh& surface,
                                           const LevelSet<3>& psi, FacetedSolid solid, double share,
                                           std::string why_facets) {
  constexpr double smallest_share = 0.1;
  for (;;) {
    const auto found = deviation(solid, psi);
    if (found.distance <= tolerance) return Faces{std::move(solid), found, std::move(why_facets)};
    share /= 2;
    if (share < smallest_share)
      return FacesFaults{
          {fmt::format("{}: facets deviate by {:.4f} mm from the level set; increase --tolerance",
                       place(found.place), found.distance * millimetres)}};
    const auto mesh = checked_and_simplified(surface, psi, share * tolerance);
    if (!mesh) return mesh.failure();
    solid = facets_of(*mesh, psi);
  }
}

Expected<Faces, FacesFaults> faces_of(const SurfaceMesh& surface, const LevelSet<3>& psi, FaceKind kind,
                                      double tolerance) {
  constexpr double share = 0.8;  // of the tolerance, at the points of triangles where simplified() looks
  const auto mesh = checked_and_simplified(surface, psi, share * tolerance);
  if (!mesh) return mesh.failure();
  std::string why_facets = "smooth ones do not make a valid solid";
  if (kind != FaceKind::facets) {
    auto lofted = cad::lofted_solid(*mesh, psi, tolerance);
    if (lofted) {
      const auto found = deviation(*lofted, psi);
      return Faces{*std::move(lofted), found, {}};
    }
    why_facets = lofted.failure();
  }
  return facets_within(tolerance, surface, psi, facets_of(*mesh, psi), share, std::move(why_facets));
}

std::string count(const FacetedSolid& solid) {
  return fmt::format("{} faces: {} cylinders, {} planes across the axle and {} triangles", solid.n_faces(),
                     int(solid.has_rim_cylinder) + int(solid.has_tread_cylinder), solid.side_faces.size(),
                     solid.triangles.size());
}

std::string count(const cad::LoftedSolid& solid) {
  return fmt::format("{} faces: 2 cylinders, {} planes across the axle and {} B-spline surfaces",
                     solid.n_faces(), solid.side_faces.size(), solid.n_hole_faces());
}

}  // namespace

Expected<FittedFacesWheel, FacesFaults> fitted_faces_wheel(const SurfaceModel& wheel, FaceKind kind,
                                                           double tolerance) {
  auto whole = faces_of(wheel.surface, wheel.shape, kind, tolerance);
  if (!whole) return whole.failure();
  const double volume = std::visit([](const auto& solid) { return enclosed_volume(solid); }, whole->solid);
  const double fine = enclosed_volume(facets_of(wheel.surface, wheel.shape));
  FittedFacesWheel fitted{{wheel.title, wheel.program, std::move(whole->solid), {}},
                          std::move(whole->why_facets),
                          volume,
                          volume / fine - 1,
                          whole->deviation.distance,
                          whole->deviation.place};
  for (const SurfaceLayer& layer : wheel.layers) {
    auto part = faces_of(layer.surface, layer.shape, kind, tolerance);
    if (!part) return part.failure();
    fitted.model.layers.push_back({layer.name, std::move(part->solid)});
  }
  return fitted;
}

std::string text(const FittedFacesWheel& wheel) {
  const auto line = [](const char* name, const std::string& value) {
    return fmt::format("{:<16} {}\n", name, value);
  };
  return line("STEP", std::visit([](const auto& solid) { return count(solid); }, wheel.model.solid)) +
         (wheel.why_facets.empty() ? "" : line("", "no smooth faces: " + wheel.why_facets)) +
         line("", fmt::format("{:.0f} mm^3, {:+.1e} of the surface's with exact cylinders",
                              wheel.volume * std::pow(millimetres, 3), wheel.volume_error)) +
         line("",
              fmt::format("deviation {:.4f} mm at {}", wheel.deviation * millimetres, place(wheel.place)));
}

}  // namespace wheelwright
