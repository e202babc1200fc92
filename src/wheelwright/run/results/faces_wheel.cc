#include "wheelwright/run/results/faces_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "wheelwright/output/export/fit_surface.h"
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

/// The largest distance of facets from {psi = 0}, at the points that divide their sides into equal parts. All
/// sectors are alike, and their facets follow each other.
SurfaceDeviation deviation(const FacetedSolid& solid, const LevelSet<3>& psi) {
  constexpr int parts = 8;
  const ZeroSurface zero(psi);
  SurfaceDeviation largest{0, {}};
  const std::size_t per_sector = solid.triangles.size() / psi.lattice.grid().n_sectors;
  for (const auto& [corners, shell] : std::span(solid.triangles).first(per_sector)) {
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
    return FacesFaults{{fmt::format("{}: {}; use a smaller --tolerance",
                                    place(polar<3>(report.failure().place)), report.failure().what)}};
  return mesh;
}

/// The surface on which faces are made, with this many cubes per cell and axis. Its vertices are where polar
/// coordinates put them, on circles around the axle, instead of on the sides of isoparametric cells, which at
/// degree 1 are chords.
SurfaceMesh surface_for_faces(const LevelSet<3>& psi, int parts) {
  constexpr int any_degree = 1;
  SurfaceMesh mesh = material_surface(psi, parts, any_degree);
  const PolarGrid<3>& grid = psi.lattice.grid();
  const int n = mesh.sector_points();
  for (int v = 0; v < n; ++v) {
    const CellPoint& at = mesh.places[v];
    const Vec<3> x = cartesian<3>(grid.polar_point(at.cell, at.xi));
    for (int s = 0; s < mesh.n_sectors; ++s)
      mesh.points[std::size_t(s) * n + v] = rotated<3>(x, s * grid.sector_angle());
  }
  return mesh;
}

/// The shares of the tolerance that simplified() may use at the points of triangles where it looks. The next
/// one is tried if the facets deviate too much between these points.
constexpr std::array shares{0.8, 0.4, 0.2, 0.1};

/// Facets from a surface by fewer and fewer triangles until they stay within the tolerance everywhere, or are
/// those of the surface itself. `fewer` is the first of these surfaces.
Expected<Faces, FacesFaults> facets_from(const SurfaceMesh& surface, SurfaceMesh fewer,
                                         const LevelSet<3>& psi, double tolerance) {
  for (std::size_t k = 0;; ++k) {
    FacetedSolid solid = facets_of(fewer, psi);
    const auto found = deviation(solid, psi);
    if (found.distance <= tolerance) return Faces{std::move(solid), found, {}};
    const bool can_be_nearer =
        k + 1 < shares.size() && deviation(facets_of(surface, psi), psi).distance <= tolerance;
    if (!can_be_nearer)
      return FacesFaults{{fmt::format(
          "{}: facets deviate by {:.3g} mm from the level set, more than the tolerance of {:.3g} mm; {}",
          place(found.place), found.distance * millimetres, tolerance * millimetres,
          advice_on_tolerance(found.distance))}};
    auto next = checked_and_simplified(surface, psi, shares[k + 1] * tolerance);
    if (!next) return next.failure();
    fewer = *std::move(next);
  }
}

/// Smooth faces if these are wanted and possible, otherwise facets on the coarsest surface, from `parts`
/// cubes per cell and axis on, that stays within the tolerance.
Expected<Faces, FacesFaults> faces_of(const LevelSet<3>& psi, int parts, FaceKind kind, double tolerance) {
  std::string why_facets = "smooth ones do not make a valid solid";
  bool can_be_smooth = kind == FaceKind::smooth;
  for (auto division = std::ranges::find(divisions_of_cell, parts);;) {
    const SurfaceMesh surface = surface_for_faces(psi, *division);
    auto fewer = checked_and_simplified(surface, psi, shares[0] * tolerance);
    if (!fewer) return fewer.failure();
    if (can_be_smooth) {
      auto lofted = cad::lofted_solid(*fewer, psi, tolerance);
      if (lofted) {
        const auto found = deviation(*lofted, psi);
        if (found.distance <= tolerance) return Faces{*std::move(lofted), found, {}};
        why_facets =
            fmt::format("they deviate by {:.3g} mm at {}", found.distance * millimetres, place(found.place));
      } else {
        why_facets = lofted.failure();
      }
      can_be_smooth = false;
    }
    auto faces = facets_from(surface, *std::move(fewer), psi, tolerance);
    if (faces) faces->why_facets = why_facets;
    if (faces || ++division == divisions_of_cell.end()) return faces;
  }
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
  auto whole = faces_of(wheel.shape, wheel.parts, kind, tolerance);
  if (!whole) return whole.failure();
  const double volume = std::visit([](const auto& solid) { return enclosed_volume(solid); }, whole->solid);
  const double fine = enclosed_volume(facets_of(surface_for_faces(wheel.shape, wheel.parts), wheel.shape));
  FittedFacesWheel fitted{{wheel.title, wheel.program, std::move(whole->solid), {}},
                          std::move(whole->why_facets),
                          volume,
                          volume / fine - 1,
                          whole->deviation.distance,
                          whole->deviation.place};
  for (const SurfaceLayer& layer : wheel.layers) {
    auto part = faces_of(layer.shape, layer.parts, kind, tolerance);
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
