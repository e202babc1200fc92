#include "wheelwright/mechanics/equilibrium/deformed_state.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/shared_interrupt.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/contact/contact_results.h"
#include "wheelwright/mechanics/elasticity/voigt_indices.h"
#include "wheelwright/mechanics/equilibrium/deformed_gradient.h"
#include "wheelwright/mechanics/rolling/moving_boundary.h"
#include "wheelwright/mechanics/state/strain_peaks.h"

namespace wheelwright {
namespace {

template <int dim>
class DeformedDisplacement : public Displacement<dim> {
 public:
  explicit DeformedDisplacement(const LargeDeformation<dim>& solution) : solution_(solution) {}

  RingField at_nodes(int position) const override {
    return nodal_displacement(*solution_.ring, solution_.equilibria[position]);
  }

  FactoredField strains(int cell, std::span<const Vec<dim>> points) const override {
    return {computed(cell, points, n_strains<dim>)};
  }
  FactoredField strains_and_rotations(int cell, std::span<const Vec<dim>> points) const override {
    return {computed(cell, points, n_strains<dim> + n_rotations<dim>)};
  }

 private:
  /// So many rows a point, of which the strains are the first and the rotations the next ones.
  Matrix computed(int cell, std::span<const Vec<dim>> points, int n_rows) const {
    static_assert(dim == 2, "one rotation");
    const RingForms<dim>& forms = solution_.ring->forms;
    const PolarGrid<dim>& grid = forms.domain().grid;
    const auto& element = forms.table().element(grid.cell_position(cell)[0]);
    const bool is_small = element.stored_energy().form == EnergyForm::small_strain;
    constexpr auto indices = voigt_indices<dim>();
    std::vector<typename HyperelasticElement<dim>::Point> at;
    for (const auto& xi : points) at.push_back(element.at(xi));
    Matrix result(n_rows * static_cast<int>(points.size()), solution_.positions.size() * grid.n_sectors);
    for (int j = 0; j < result.columns(); ++j) {
      typename HyperelasticElement<dim>::Dofs dofs;
      forms.space().gather(cell, j % grid.n_sectors, solution_.equilibria[j / grid.n_sectors].v.data(),
                           dofs.data());
      const auto u = element.cartesian(dofs.data());
      double* to = result.column(j);
      for (const auto& point : at) {
        const Mat<dim> f = element.deformation(point, u);
        for (int k = 0; k < n_strains<dim>; ++k) {
          const auto [a, b] = indices[k];
          double product = 0;
          for (int i = 0; i < dim; ++i) product += f[i][a] * f[i][b];
          to[k] = is_small ? (a == b ? f[a][a] - 1 : f[a][b] + f[b][a])
                           : (a == b ? 0.5 * (product - 1) : product);
        }
        if (n_rows > n_strains<dim>)
          to[n_strains<dim>] =
              is_small ? 0.5 * (f[1][0] - f[0][1]) : std::atan2(f[1][0] - f[0][1], f[0][0] + f[1][1]);
        to += n_rows;
      }
    }
    return result;
  }

  const LargeDeformation<dim>& solution_;
};

/// The contact with places and areas of the loaded wheel.
template <int dim>
ContactPatch<dim> deformed_patch(const LargeDeformation<dim>& solution,
                                 const RingEquilibrium<dim>& equilibrium) {
  const ContactObserver<dim>& observer = solution.ring->contact;
  ContactPatch<dim> patch = contact_patch(equilibrium.contact, equilibrium.state);
  int column = -1;
  std::vector<double> values, stretches;
  for (auto& point : patch.points) {
    if (std::exchange(column, point.column) != point.column) {
      values = observer.values(equilibrium.v, column);
      stretches = observer.stretches(equilibrium.v, column);
    }
    Vec<dim> u;
    std::copy_n(&values[observer.rows().displacement(point.point)], dim, u.begin());
    point.stretch = stretches[point.point];
    point.moved = point.frame.template to_ground<dim>(u);
  }
  return patch;
}

template <int dim>
class DeformedState : public State<dim> {
 public:
  DeformedState(const LargeDeformationProblem<dim>& problem, LargeDeformation<dim> solution)
      : problem_(problem),
        solution_(std::move(solution)),
        displacement_(solution_),
        boundary_(
            moving_boundary_points(solution_.ring->domain, solution_.model.degree, solution_.positions)) {
    const int n_columns = solution_.model.grid.ring_columns();
    observations_ = Matrix(solution_.ring->tread.rows().size(), solution_.positions.size() * n_columns);
    for (int i = 0; i < solution_.positions.size(); ++i) {
      const auto& equilibrium = solution_.equilibria[i];
      energies_.push_back(equilibrium.strain_energy);
      contacts_.push_back(deformed_patch(solution_, equilibrium));
      for (int c = 0; c < n_columns; ++c) {
        const auto values = solution_.ring->tread.values(equilibrium.v, c);
        std::copy(values.begin(), values.end(), observations_.column(i * n_columns + c));
      }
    }
  }

  const RollingModel<dim>& model() const override { return solution_.model; }
  const CutDomain<dim>& domain() const override { return solution_.ring->domain; }
  const LoadPositions& positions() const override { return solution_.positions; }
  const std::vector<ContactPatch<dim>>& contacts() const override { return contacts_; }
  const std::vector<double>& strain_energy() const override { return energies_; }
  const std::vector<double>& energy_by_harmonic() const override { return no_harmonics_; }
  const Matrix& observations() const override { return observations_; }
  const std::vector<PhaseTime>& phases() const override { return solution_.phases; }
  const std::vector<SurfacePoint<dim>>& boundary() const override { return boundary_; }
  const std::vector<SurfacePoint<dim>>& edges() const override { return no_edges_; }
  const Displacement<dim>& displacement() const override { return displacement_; }

  StartDisplacements start_displacements() const override { return starts_from(solution_); }

  const StrainPeaks<dim>& strain_peaks() const override {
    std::call_once(has_peaks_, [this] { peaks_ = wheelwright::strain_peaks(problem_, *this); });
    return peaks_;
  }

  Expected<ShapeGradients> shape_gradients(
      std::span<const FunctionalDerivative<dim>> functions) const override {
    Stopwatch watch;
    const auto adjoints = solve_adjoints(problem_, solution_, displacement_, functions);
    if (!adjoints) return adjoints.failure();
    const double of_adjoints = watch.lap();
    auto gradients = wheelwright::shape_gradients<dim>(solution_, displacement_, functions, *adjoints);
    gradients.phases = {{phase::adjoint, of_adjoints}, {phase::gradient, watch.lap()}};
    return gradients;
  }

  Expected<std::vector<std::vector<double>>> topological_derivatives(
      std::span<const FunctionalDerivative<dim>>, std::span<const MaterialPoint<dim>>) const override {
    return Failure{FailureReason::unsupported_model, "large deformation has no topological derivatives"};
  }

  std::vector<Expected<std::vector<ContactPatch<dim>>>> contacts_under(
      std::span<const RollingModel<dim>> models, const Interrupt& interrupt) const override {
    const Interrupt shared = shared_by_threads(interrupt);
    const int n_positions = solution_.positions.size();
    std::vector<std::vector<ContactPatch<dim>>> patches(models.size());
    for (auto& of_model : patches) of_model.resize(n_positions);
    std::vector<std::vector<std::optional<Failure>>> failures(n_positions);
    parallel_for(n_positions, [&](int i) {
      const auto curve = problem_.curve(solution_, i, models, shared.at_position(i, n_positions));
      for (size_t k = 0; k < models.size(); ++k) {
        failures[i].push_back(curve[k] ? std::nullopt : std::optional<Failure>(curve[k].failure()));
        if (!curve[k]) continue;
        patches[k][i] = deformed_patch(solution_, curve[k]->equilibrium);
        patches[k][i].stiffness = curve[k]->stiffness;
      }
    });
    std::vector<Expected<std::vector<ContactPatch<dim>>>> result;
    for (size_t k = 0; k < models.size(); ++k) {
      std::vector<Failure> failed;
      for (const auto& of_position : failures)
        if (of_position[k]) failed.push_back(*of_position[k]);
      if (failed.empty())
        result.emplace_back(std::move(patches[k]));
      else
        result.emplace_back(*std::ranges::min_element(failed, {}, [](const Failure& failure) {
          return failure.largest_load.value_or(std::numeric_limits<double>::infinity());
        }));
    }
    return result;
  }

  Expected<std::shared_ptr<const State<dim>>> under(const RollingModel<dim>& model,
                                                    const Interrupt& interrupt) const override {
    auto solution = problem_.solve_under(model, solution_, interrupt);
    if (!solution) return Failure(solution.failure());
    return deformed_state(problem_, *std::move(solution));
  }

 private:
  const LargeDeformationProblem<dim>& problem_;
  LargeDeformation<dim> solution_;
  DeformedDisplacement<dim> displacement_;
  std::vector<SurfacePoint<dim>> boundary_, no_edges_;
  std::vector<ContactPatch<dim>> contacts_;
  std::vector<double> energies_, no_harmonics_;
  Matrix observations_;
  mutable std::once_flag has_peaks_;
  mutable StrainPeaks<dim> peaks_;
};

}  // namespace

template <int dim>
std::shared_ptr<const State<dim>> deformed_state(const LargeDeformationProblem<dim>& problem,
                                                 LargeDeformation<dim> solution) {
  return std::make_shared<DeformedState<dim>>(problem, std::move(solution));
}

template decltype(deformed_state<2>) deformed_state<2>;

}  // namespace wheelwright
