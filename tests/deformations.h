#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "wheelwright/shape/evolution/boundary_motion.h"

namespace wheelwright::testing {

/// A smooth deformation of the whole ring, without any symmetry.
template <int dim>
std::vector<double> smooth_deformation(const Lattice<dim>& lattice, int n_components) {
  std::vector<double> result;
  for (int component = 0; component < n_components; ++component)
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const auto x = lattice.polar_point(node);
      result.push_back(component == 0 ? 0.3 + std::sin(12 * x[1]) * std::sin(40 * x[0])
                                      : std::cos(12 * x[1]) - 3 * x[0]);
    }
  return result;
}

/// A dimension and a kind of deformations, for typed tests.
template <int space_dim, DeformationKind deformation_kind>
struct DeformationSetting {
  static constexpr int dim = space_dim;
  static constexpr DeformationKind kind = deformation_kind;
};
using DeformationSettings = ::testing::Types<DeformationSetting<2, DeformationKind::vector_field>,
                                             DeformationSetting<2, DeformationKind::normal_speed>,
                                             DeformationSetting<3, DeformationKind::vector_field>,
                                             DeformationSetting<3, DeformationKind::normal_speed>>;

}  // namespace wheelwright::testing
