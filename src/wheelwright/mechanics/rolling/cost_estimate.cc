#include "wheelwright/mechanics/rolling/cost_estimate.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

constexpr double square(double x) { return x * x; }
constexpr double cube(double x) { return x * x * x; }

/// Entries and flops of the sparse factor of a section, fitted to sections of 1320 to 4800 unknowns.
double section_entries(const ProblemSize& n) { return 1.8e5 * std::pow(n.sector_dofs / 1320, 1.1); }
double section_flops(const ProblemSize& n) { return 26e6 * std::pow(n.sector_dofs / 1320, 1.25); }

/// The number of copies of each array at the peak of memory, fitted to measurements.
struct Copies {
  double condensed, harmonics, surface;
};
constexpr Copies in_the_plane{3.5, 0.55, 0.1}, in_space{3, 0.55, 4};

/// At large deformation: quadrature and fields of the ring, and of every position that is solved its tangent
/// with the factor, in the plane.
double memory_at_large_deformation(const ProblemSize& n) {
  constexpr double libraries = 26e6, of_ring = 400, of_position = 1220;  // bytes per dof
  return libraries + n.dofs * (of_ring + of_position * n.rings_at_once);
}

}  // namespace

double estimated_memory(const ProblemSize& n) {
  if (n.rings_at_once > 0) return memory_at_large_deformation(n);
  constexpr double number = sizeof(double), complex = 2 * number;
  const bool in_3d = n.dimension == 3;
  const Copies& copies = in_3d ? in_space : in_the_plane;

  const double libraries = 26e6;
  const double fields = number * (n.is_halved ? 0.5 : 1) * (56 * n.cells + 4.6 * n.dofs * n.positions);
  // Fill of nested dissection: n log n in the plane, n^(4/3) in space.
  const double fill = in_3d ? 6 * std::pow(n.sector_dofs, 4.0 / 3)
                            : 0.6 * n.sector_dofs * std::log2(std::max(n.sector_dofs, 2.0));
  const double factor = n.has_sections() ? 0 : number * fill;
  const double condensed =
      n.has_sections() ? 0 : number * copies.condensed * square(2 * n.radial_line + n.sector_line());
  const bool real_harmonics = in_3d && n.has_real_harmonics;
  const double of_harmonic =
      n.has_sections() ? number * section_entries(n)
                       : copies.harmonics * (real_harmonics ? number * square(n.boundary())
                                                            : complex * square(n.complex_boundary()));
  const double harmonics = (n.sectors / 2 + 1) * of_harmonic;
  // Right-hand sides on the outer line that are solved together.
  const double responses = number * 5 * 192 * n.ring_line;
  const double surface =
      number * copies.surface * (2 * n.zone_columns - 1) * n.loaded_columns * square(n.tractions);
  const double tread = number * (8 * square(2 * n.tractions) + 1.8 * n.observed * n.columns * n.positions);
  const double zones = number * 0.1 * n.positions * square(n.zone_columns * n.tractions);
  const double shape = number * 10 * n.holes;
  return libraries + fields + n.rings * (factor + condensed + harmonics) + responses + surface + tread +
         zones + shape;
}

double estimated_seconds_at_large_deformation(const ProblemSize& n) {
  constexpr double per_dof = 7e-6;  // two to three tangents, five corrections, two adjoints
  return per_dof * n.dofs * n.positions;
}

double estimated_seconds_in_3d(const ProblemSize& n) {
  const bool real = n.has_real_harmonics;
  constexpr double flops_per_second = 45e9;  // dense matrices on one core
  constexpr double sparse_flops_per_second = 8.5e9;
  const double contact =
      (real ? 2.5e-7 : 6e-7) * (2 * n.zone_columns - 1) * n.loaded_columns * square(n.tractions);
  if (n.has_sections()) return (n.sectors / 2 + 1) * section_flops(n) / sparse_flops_per_second + contact;
  const double boundary = real ? n.boundary() : n.complex_boundary();
  const double flops = cube(boundary) / 3 + 2 * cube(n.sector_line()) / 3;
  const double strong_modes = real || !n.has_strong_modes() ? 0 : 13 * cube(n.radial_line);
  const double harmonics = ((real ? 1 : 4) * (n.sectors / 2 + 1) * flops + strong_modes) / flops_per_second;
  const double sector = 2e-9 * square(n.sector_dofs);
  return harmonics + sector + contact;
}

}  // namespace wheelwright
