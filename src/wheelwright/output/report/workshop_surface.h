#pragma once

#include <cmath>

#include "wheelwright/output/report/shape_boundary.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

/// The surface of a shape for the workshop: the one of pictures or, if its volume differs by more than 1 %
/// from that of the level set on cells of the displacement's degree, the first that does not with more cubes
/// per cell and axis, at most 8.
inline SurfaceMesh workshop_surface(SurfaceMesh of_pictures, const LevelSet<3>& psi,
                                    int displacement_degree) {
  constexpr double largest_volume_error = 0.01;
  constexpr int gauss_points = 4, most_parts = 8;
  const auto domain = cut_domain(psi, gauss_points);
  if (!domain) return of_pictures;
  const double volume = of_pictures.n_sectors * material_measure(*domain, displacement_degree);
  SurfaceMesh surface = std::move(of_pictures);
  for (int parts = surface_parts + 1; parts <= most_parts; ++parts) {
    if (std::abs(enclosed_volume(surface) / volume - 1) <= largest_volume_error) break;
    surface = material_surface(psi, parts, displacement_degree);
  }
  return surface;
}

}  // namespace wheelwright
