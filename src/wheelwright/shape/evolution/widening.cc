#include "wheelwright/shape/evolution/widening.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "wheelwright/linalg/box_program.h"

namespace wheelwright {

// With the multipliers x, the deformation is -sum x_i a_i, a_i the representatives of the loads, and x
// minimizes x.Q x / 2 - gap.x, Q the products of the a_i, with x >= 0 for the widths.
template <int dim>
std::vector<double> widening(const DeformationSpace<dim>& space, const BoundaryMotion<dim>& motion,
                             const std::vector<Width<dim>>& widths,
                             const std::vector<std::vector<double>>& kept) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double immovable = 1e-12;  // of the largest product
  std::vector<std::vector<double>> loads = kept, representatives;
  BoxProgram dual{Matrix(0, 0), {}, {}, {}};
  dual.linear.assign(kept.size(), 0.0);
  dual.lower.assign(kept.size(), -infinite);
  for (const auto& width : widths) {
    loads.push_back(gap_load<dim>(motion, width));
    dual.linear.push_back(-width.gap());
    dual.lower.push_back(0);
  }
  const int n = static_cast<int>(loads.size());
  for (const auto& load : loads) representatives.push_back(space.representative(load));
  dual.upper.assign(loads.size(), infinite);
  dual.quadratic = Matrix(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i)
      dual.quadratic(i, j) = dual.quadratic(j, i) =
          std::inner_product(loads[i].begin(), loads[i].end(), representatives[j].begin(), 0.0);
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, dual.quadratic(i, i));
  for (int i = 0; i < n; ++i)
    if (dual.quadratic(i, i) <= immovable * largest) dual.lower[i] = dual.upper[i] = 0;
  const auto multipliers = solve(dual).x;
  std::vector<double> deformation(representatives.front().size(), 0.0);
  for (int i = 0; i < n; ++i)
    for (std::size_t k = 0; k < deformation.size(); ++k)
      deformation[k] -= multipliers[i] * representatives[i][k];
  return deformation;
}

template decltype(widening<2>) widening<2>;
template decltype(widening<3>) widening<3>;

}  // namespace wheelwright
