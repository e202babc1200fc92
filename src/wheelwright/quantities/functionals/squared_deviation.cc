#include "wheelwright/quantities/functionals/squared_deviation.h"

#include "wheelwright/quantities/functionals/mean_contact_stress.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> squared_deviation(const TreadSurface<dim>& tread, const State<dim>& state,
                                       const Matrix& mean, std::span<const WeightedTraction> tractions) {
  const Matrix deviation = deviation_from_mean(tread, state.positions(), state.observations(), mean);
  FunctionalValue<dim> value{.by_position = std::vector<double>(state.positions().size()),
                             .derivative = {.energy = {},
                                            .tread_loads = Matrix(deviation.rows(), deviation.columns()),
                                            .integrals = {}},
                             .compares_with_mean = true};
  for (int j = 0; j < deviation.columns(); ++j) {
    const double* observed = deviation.column(j);
    double* load = value.derivative.tread_loads.column(j);
    for (const auto& [first, weight] : tractions)
      for (int row = first; row < first + dim; ++row) {
        value.by_position[j / tread.n_columns] += 0.5 * weight * observed[row] * observed[row];
        load[row] = -weight * observed[row];
      }
  }
  return value;
}

template decltype(squared_deviation<2>) squared_deviation<2>;
template decltype(squared_deviation<3>) squared_deviation<3>;

}  // namespace wheelwright
