#include "wheelwright/mechanics/rolling/ring_state.h"

#include <algorithm>
#include <mutex>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/contact/contact_results.h"
#include "wheelwright/mechanics/contact/tangent_stiffness.h"
#include "wheelwright/mechanics/rolling/energy_by_harmonic.h"
#include "wheelwright/mechanics/rolling/growth_gradient.h"
#include "wheelwright/mechanics/rolling/neumann_to_dirichlet.h"
#include "wheelwright/mechanics/rolling/radius_gradient.h"
#include "wheelwright/mechanics/rolling/ring_displacement.h"
#include "wheelwright/mechanics/rolling/topological_derivative.h"
#include "wheelwright/mechanics/rolling/turned_state.h"
#include "wheelwright/mechanics/state/strain_peaks.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

template <int dim>
class RingState : public State<dim> {
 public:
  RingState(const RollingProblem<dim>& problem, RollingSolution<dim> solution)
      : problem_(problem),
        solution_(std::move(solution)),
        boundary_(boundary_points(problem, solution_)),
        edges_(edge_points(problem, solution_)) {
    for (size_t i = 0; i < solution_.contacts.size(); ++i)
      contacts_.push_back(contact_patch(solution_.contacts[i], solution_.states[i]));
  }

  const RollingModel<dim>& model() const override { return solution_.model; }
  const CutDomain<dim>& domain() const override { return solution_.domain; }
  const LoadPositions& positions() const override { return solution_.positions; }
  const std::vector<ContactPatch<dim>>& contacts() const override { return contacts_; }
  const std::vector<double>& strain_energy() const override { return solution_.strain_energy; }
  const std::vector<double>& energy_by_harmonic() const override {
    std::call_once(has_harmonics_,
                   [this] { energy_by_harmonic_ = wheelwright::energy_by_harmonic(problem_, solution_); });
    return energy_by_harmonic_;
  }
  const Matrix& observations() const override { return solution_.observations; }
  const std::vector<PhaseTime>& phases() const override { return solution_.phases; }
  const std::vector<SurfacePoint<dim>>& boundary() const override { return boundary_; }
  const std::vector<SurfacePoint<dim>>& edges() const override { return edges_; }

  const Displacement<dim>& displacement() const override {
    std::call_once(is_recovered_, [this] { displacement_.emplace(problem_, solution_); });
    return *displacement_;
  }

  const StrainPeaks<dim>& strain_peaks() const override {
    std::call_once(has_peaks_, [this] { peaks_ = wheelwright::strain_peaks(problem_, *this); });
    return peaks_;
  }

  Expected<ShapeGradients> shape_gradients(
      std::span<const FunctionalDerivative<dim>> functions) const override {
    auto found = adjoint_gradients<dim>(problem_, solution_, functions);
    if (!found) return found.failure();
    auto& [adjoints, gradients] = *found;
    Stopwatch watch;
    if (auto failure = add_growth<dim>(problem_, solution_, functions, adjoints, gradients)) return *failure;
    gradients.phases.back().seconds += watch.lap();
    return std::move(gradients);
  }

  Expected<std::vector<std::vector<double>>> topological_derivatives(
      std::span<const FunctionalDerivative<dim>> functions,
      std::span<const MaterialPoint<dim>> points) const override {
    auto derivatives = wheelwright::topological_derivatives<dim>(problem_, solution_, functions, points);
    if (!derivatives || solution_.standing.empty()) return derivatives;
    const auto adjoints = solve_adjoints(problem_, solution_, functions);
    if (!adjoints) return adjoints.failure();
    if (auto failure = add_growth<dim>(problem_, solution_, functions, *adjoints, points, *derivatives))
      return *failure;
    return derivatives;
  }

  std::vector<Expected<std::vector<ContactPatch<dim>>>> contacts_under(
      std::span<const RollingModel<dim>> models, const Interrupt&) const override {
    std::vector<RolledContact<dim>> rolled;
    for (size_t i = 0; i < solution_.contacts.size(); ++i)
      rolled.push_back({solution_.contacts[i], solution_.states[i]});
    std::vector<Expected<std::vector<ContactPatch<dim>>>> result;
    for (const RollingModel<dim>& model : models) {
      std::vector<std::optional<Failure>> failures(rolled.size());
      std::vector<ContactPatch<dim>> patches(rolled.size());
      parallel_for(static_cast<int>(rolled.size()), [&](int i) {
        auto next = reload(model, problem_.tread(), solution_.ring, *solution_.surface,
                           solution_.positions.grounds[i], solution_.preloads[i], rolled[i]);
        if (!next) {
          failures[i] = next.failure();
          return;
        }
        rolled[i] = *std::move(next);
        patches[i] = contact_patch(rolled[i].contact, rolled[i].state);
        patches[i].stiffness = tangent_stiffness(rolled[i].contact, rolled[i].state);
      });
      const auto failed = std::ranges::find_if(failures, [](const auto& f) { return f.has_value(); });
      if (failed == failures.end())
        result.emplace_back(std::move(patches));
      else
        result.emplace_back(**failed);
    }
    return result;
  }

  Expected<std::shared_ptr<const State<dim>>> under(const RollingModel<dim>& model,
                                                    const Interrupt& interrupt) const override {
    auto solution = problem_.solve_under(model, solution_, interrupt);
    if (!solution) return solution.failure();
    return ring_state(problem_, *std::move(solution));
  }

 private:
  const RollingProblem<dim>& problem_;
  RollingSolution<dim> solution_;
  std::vector<SurfacePoint<dim>> boundary_, edges_;
  std::vector<ContactPatch<dim>> contacts_;
  mutable std::once_flag is_recovered_, has_peaks_, has_harmonics_;
  mutable std::vector<double> energy_by_harmonic_;
  mutable std::optional<RingDisplacement<dim>> displacement_;
  mutable StrainPeaks<dim> peaks_;
};

}  // namespace

template <int dim>
std::shared_ptr<const State<dim>> ring_state(const RollingProblem<dim>& problem,
                                             RollingSolution<dim> solution) {
  return std::make_shared<RingState<dim>>(problem, std::move(solution));
}

template <int dim>
Expected<std::shared_ptr<const State<dim>>> RollingProblem<dim>::states(const CutShape<dim>& shape,
                                                                        LoadPositions positions,
                                                                        const Interrupt& interrupt) const {
  const auto solved = [&](const CutShape<dim>& of,
                          LoadPositions at) -> Expected<std::shared_ptr<const State<dim>>> {
    auto solution = solve(of, std::move(at), interrupt);
    if (!solution) return solution.failure();
    return ring_state(*this, *std::move(solution));
  };
  const auto columns =
      possible_first_columns(model_.grid, positions.stand_for_images() || is_mirror_symmetric(shape.psi));
  if (columns.size() == 1) return solved(shape, std::move(positions));
  Stopwatch watch;
  auto domain = shape.domain ? Expected<CutDomain<dim>>(*shape.domain)
                             : cut_domain(shape.psi, model_.points_in_cut_cells());
  if (!domain) return domain.failure();
  if (auto failure = check_attached(*domain, protected_rim_rows(), protected_tread_rows())) return *failure;
  const int first = best_first_column(*domain, *elements_, core_rows(), columns);
  if (first == 0) return solved({shape.psi, &*domain}, std::move(positions));
  const auto turned = turned_back(shape.psi, *domain, first);
  std::vector<PhaseTime> phases{{phase::cut, watch.lap()}};
  auto state = solved({turned.psi, &turned.domain}, turned_back(positions, model_.grid, first));
  if (!state) return state;
  phases.insert(phases.end(), (*state)->phases().begin(), (*state)->phases().end());
  return turned_state<dim>(*std::move(state), std::make_shared<const CutDomain<dim>>(*std::move(domain)),
                           std::move(positions), first, std::move(phases));
}

template <int dim>
Expected<typename StateSolver<dim>::TractionMap> RollingProblem<dim>::neumann_to_dirichlet(
    DualNorm norm) const {
  return traction_map<dim>(model_, norm);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                \
  template decltype(ring_state<dim>) ring_state<dim>;                               \
  template Expected<std::shared_ptr<const State<dim>>> RollingProblem<dim>::states( \
      const CutShape<dim>&, LoadPositions, const Interrupt&) const;                 \
  template Expected<StateSolver<dim>::TractionMap> RollingProblem<dim>::neumann_to_dirichlet(DualNorm) const;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
