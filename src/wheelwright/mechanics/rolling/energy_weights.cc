#include "wheelwright/mechanics/rolling/energy_weights.h"

#include <algorithm>
#include <cassert>

#include "wheelwright/mechanics/state/turn_harmonics.h"

namespace wheelwright {
namespace {

/// A factor per position as one per load case.
std::vector<double> by_load_case(const std::vector<double>& factors, int n_sectors) {
  std::vector<double> result;
  for (const double factor : factors) result.insert(result.end(), n_sectors, factor);
  return result;
}

}  // namespace

template <int dim>
EnergyWeights<dim>::EnergyWeights(const RollingSolution<dim>& solution,
                                  const FunctionalDerivative<dim>& derivative)
    : s_(solution), factors_(derivative.energy) {
  const int n_positions = s_.positions.size(), n_sectors = s_.ring.n_sectors();
  if (!derivative.energy_by_harmonic.empty()) {
    assert(!s_.positions.stand_for_images());
    std::vector<double> per_position = derivative.energy_by_harmonic;
    for (double& factor : per_position) factor /= n_positions;
    coupling_ = TurnHarmonics(n_positions, n_sectors).filter(per_position);
    const auto diagonal = by_load_case(factors_, n_sectors);
    for (size_t j = 0; j < diagonal.size(); ++j) coupling_(j, j) += diagonal[j];
    factors_.clear();
  } else if (!factors_.empty() && std::ranges::count(factors_, factors_.front()) == n_positions) {
    common_ = factors_.front();
  }
  if (!empty() && !common_)
    on_modes_ = product(scaled_rows(case_multiplicities(s_), s_.displacement.weights), Op::transpose,
                        of_cases(s_.displacement.weights), Op::none);
}

template <int dim>
Matrix EnergyWeights<dim>::of_cases(const Matrix& x) const {
  if (couples()) return product(coupling_, Op::none, x, Op::none);
  return scaled_rows(by_load_case(factors_, s_.ring.n_sectors()), x);
}

template <int dim>
Matrix EnergyWeights<dim>::of_modes(Matrix x) const {
  if (!common_) return product(on_modes_, Op::none, x, Op::none);
  // W^T M W = 1 leaves the modes as they are.
  if (*common_ != 1)
    for (double& value : x.entries()) value *= *common_;
  return x;
}

template <int dim>
void EnergyWeights<dim>::add_observations(double sign, const Matrix& x, std::span<const int> columns,
                                          int first, Matrix& to) const {
  const int per_position = x.columns() / s_.positions.size();
  const Matrix combined = couples() ? combined_blocks(x, coupling_) : Matrix();
  for (size_t k = 0; k < columns.size(); ++k) {
    const int column = columns[k];
    const double factor = couples() ? sign : sign * factors_[column / per_position];
    const double* from = (couples() ? combined : x).column(column);
    double* sum = to.column(first + static_cast<int>(k));
    for (int i = 0; i < x.rows(); ++i) sum[i] += factor * from[i];
  }
}

template class EnergyWeights<2>;
template class EnergyWeights<3>;

}  // namespace wheelwright
