#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "wheelwright/mechanics/state/rolling_model.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The measure [m^2, m^3 when dim = 3] of every layer in one sector of a shape; `counts` says which radial
/// rows of cells do. `degree`: of the elements.
template <int dim>
std::vector<double> layer_measures(
    const Materials<dim>& materials, int degree, const CutDomain<dim>& shape,
    const std::function<bool(int)>& counts = [](int) { return true; });

/// The mass of a shape by its volume [kg/m^3]; nothing if a layer has no density.
template <int dim>
std::optional<double> mean_density(const Materials<dim>& materials, const LevelSet<dim>& psi);

/// The mass of the whole ring that every layer of a model has in a shape [kg per metre of width when dim = 2,
/// kg when dim = 3]; nothing for a layer without a density.
template <int dim>
std::vector<std::optional<double>> layer_masses(const RollingModel<dim>& model, const CutDomain<dim>& shape);

}  // namespace wheelwright
