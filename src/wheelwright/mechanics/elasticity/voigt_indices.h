#pragma once

#include <array>

#include "wheelwright/mechanics/elasticity/voigt.h"

namespace wheelwright {

/// Tensor indices (i, j) of the Voigt components.
template <int dim>
constexpr std::array<std::array<int, 2>, n_strains<dim>> voigt_indices() {
  if constexpr (dim == 2)
    return {{{0, 0}, {1, 1}, {0, 1}}};
  else
    return {{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
}

}  // namespace wheelwright
