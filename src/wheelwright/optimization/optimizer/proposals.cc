#include "wheelwright/optimization/optimizer/proposals.h"

#include "wheelwright/optimization/optimizer/descent.h"
#include "wheelwright/optimization/optimizer/sequential_quadratic.h"

namespace wheelwright {

template <int dim>
Expected<std::unique_ptr<Proposals<dim>>> proposals_from(const Evolver<dim>& evolver,
                                                         const OptimizerOptions& options,
                                                         const OptimizationState<dim>& state) {
  if (options.method == Method::sequential_quadratic)
    return std::unique_ptr<Proposals<dim>>(
        std::make_unique<SequentialQuadraticProposals<dim>>(evolver, options, state));
  auto velocity = descent_velocity(evolver, options, state);
  if (!velocity) return velocity.failure();
  return std::unique_ptr<Proposals<dim>>(
      std::make_unique<DescentProposals<dim>>(evolver, options, state, *std::move(velocity)));
}

template decltype(proposals_from<2>) proposals_from<2>;
template decltype(proposals_from<3>) proposals_from<3>;

}  // namespace wheelwright
