#include "wheelwright/optimization/sensitivity/evaluation.h"

#include <algorithm>
#include <cassert>

namespace wheelwright {

template <int dim>
const FunctionValue& Evaluation<dim>::function(std::string_view name) const {
  const auto found = std::ranges::find(functions, name, &FunctionValue::name);
  assert(found != functions.end());
  return *found;
}

template <int dim>
std::vector<SurfaceSample<dim>> Evaluation<dim>::gradient(std::string_view name) const {
  const FunctionValue& of = function(name);
  std::vector<SurfaceSample<dim>> samples;
  for (size_t i = 0; i < boundary.size(); ++i) samples.push_back({boundary[i], of.gradient[i]});
  return samples;
}

template <int dim>
std::vector<SurfaceSample<dim>> Evaluation<dim>::edge_gradient(std::string_view name) const {
  const FunctionValue& of = function(name);
  std::vector<SurfaceSample<dim>> samples;
  for (size_t i = 0; i < edges.size(); ++i) samples.push_back({edges[i], of.edge_gradient[i]});
  return samples;
}

template struct Evaluation<2>;
template struct Evaluation<3>;

}  // namespace wheelwright
