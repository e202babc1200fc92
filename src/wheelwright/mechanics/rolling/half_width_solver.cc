#include "wheelwright/mechanics/rolling/half_width_solver.h"

#include <algorithm>
#include <optional>

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/rolling/neumann_to_dirichlet.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

/// The displacement of the whole wheel, from that of its half, which is computed once it is asked for.
class WholeDisplacement : public Displacement<3> {
 public:
  WholeDisplacement(const State<3>& half, const WidthHalves& halves) : half_(half), halves_(halves) {}

  RingField at_nodes(int position) const override {
    return halves_.at_nodes(half_.displacement().at_nodes(position), half_.model().degree);
  }

  FactoredField strains(int cell, std::span<const Vec<3>> points) const override {
    constexpr int shears_along_axle[] = {3, 4};
    return of_half(&Displacement<3>::strains, cell, points, n_strains<3>, shears_along_axle);
  }

  FactoredField strains_and_rotations(int cell, std::span<const Vec<3>> points) const override {
    constexpr int shears_along_axle_and_rotations_in_plane[] = {3, 4, 6, 7};
    return of_half(&Displacement<3>::strains_and_rotations, cell, points, n_strains<3> + n_rotations<3>,
                   shears_along_axle_and_rotations_in_plane);
  }

 private:
  /// A field at points of a cell, of so many components per point. Those named change sign in the mirror
  /// image.
  FactoredField of_half(FactoredField (Displacement<3>::*field)(int, std::span<const Vec<3>>) const, int cell,
                        std::span<const Vec<3>> points, int n_components, std::span<const int> odd) const {
    const auto place = halves_.place(cell);
    const Displacement<3>& there = half_.displacement();
    if (!place.is_image) return (there.*field)(place.cell, points);
    std::vector<Vec<3>> images(points.begin(), points.end());
    for (Vec<3>& xi : images) xi[2] = 1 - xi[2];
    FactoredField result = (there.*field)(place.cell, images);
    Matrix& map = result.map;
    for (int j = 0; j < map.columns(); ++j)
      for (int first = 0; first < map.rows(); first += n_components)
        for (const int component : odd) map(first + component, j) *= -1;
    return result;
  }

  const State<3>& half_;
  const WidthHalves& halves_;
};

/// A shape with its cells, kept as long as it may be solved again.
struct KeptShape {
  LevelSet<3> psi;
  CutDomain<3> domain;
};

/// The states of the whole wheel, from those of its half.
class WholeState : public State<3> {
 public:
  WholeState(const HalfWidthSolver& solver, const RollingModel<3>& model,
             std::shared_ptr<const KeptShape> shape, std::shared_ptr<const State<3>> half,
             std::vector<PhaseTime> phases)
      : solver_(solver),
        model_(model),
        shape_(std::move(shape)),
        half_(std::move(half)),
        strain_energy_(half_->strain_energy()),
        observations_(halves().observations(half_->observations())),
        phases_(std::move(phases)),
        boundary_(halves().boundary(half_->boundary())),
        edges_(halves().boundary(half_->edges())),
        displacement_(*half_, halves()) {
    for (double& energy : strain_energy_) energy *= 2;
    for (const auto& contact : half_->contacts()) contacts_.push_back(halves().patch(contact));
  }

  const RollingModel<3>& model() const override { return model_; }
  const CutDomain<3>& domain() const override { return shape_->domain; }
  const LoadPositions& positions() const override { return half_->positions(); }
  const std::vector<ContactPatch<3>>& contacts() const override { return contacts_; }
  const std::vector<double>& strain_energy() const override { return strain_energy_; }
  const std::vector<double>& energy_by_harmonic() const override {
    std::call_once(has_harmonics_, [this] {
      energy_by_harmonic_ = half_->energy_by_harmonic();
      for (double& energy : energy_by_harmonic_) energy *= 2;
    });
    return energy_by_harmonic_;
  }
  const Matrix& observations() const override { return observations_; }
  const std::vector<PhaseTime>& phases() const override { return phases_; }
  const Displacement<3>& displacement() const override { return displacement_; }
  const StrainPeaks<3>& strain_peaks() const override { return half_->strain_peaks(); }
  const std::vector<SurfacePoint<3>>& boundary() const override { return boundary_; }
  const std::vector<SurfacePoint<3>>& edges() const override { return edges_; }

  Expected<ShapeGradients> shape_gradients(
      std::span<const FunctionalDerivative<3>> functions) const override {
    auto gradients = half_->shape_gradients(of_half(functions));
    if (!gradients) return gradients;
    for (auto* all : {&gradients->densities, &gradients->edge_densities})
      for (auto& densities : *all) {
        const std::vector<double> images = densities;
        densities.insert(densities.end(), images.begin(), images.end());
      }
    for (auto& derivatives : gradients->by_radius)
      for (double& derivative : derivatives) derivative *= 2;
    return gradients;
  }

  Expected<std::vector<std::vector<double>>> topological_derivatives(
      std::span<const FunctionalDerivative<3>> functions,
      std::span<const MaterialPoint<3>> points) const override {
    std::vector<MaterialPoint<3>> there(points.begin(), points.end());
    for (auto& point : there) {
      const auto place = halves().place(point.cell);
      point.cell = place.cell;
      if (place.is_image) point.xi[2] = 1 - point.xi[2];
    }
    return half_->topological_derivatives(of_half(functions), there);
  }

  std::vector<Expected<std::vector<ContactPatch<3>>>> contacts_under(
      std::span<const RollingModel<3>> models, const Interrupt& interrupt) const override {
    if (!std::ranges::all_of(models, HalfWidthSolver::can_halve)) {
      const auto whole = on_whole_width(interrupt);
      if (!whole) return {models.size(), whole.failure()};
      return (*whole)->contacts_under(models, interrupt);
    }
    std::vector<RollingModel<3>> of_half;
    for (const auto& model : models) of_half.push_back(first_half(model));
    auto contacts = half_->contacts_under(of_half, interrupt);
    for (auto& of_model : contacts) {
      if (!of_model) continue;
      for (auto& contact : *of_model) contact = halves().patch(contact);
    }
    return contacts;
  }

  Expected<std::shared_ptr<const State<3>>> under(const RollingModel<3>& model,
                                                  const Interrupt& interrupt) const override {
    if (!HalfWidthSolver::can_halve(model)) {
      const auto whole = on_whole_width(interrupt);
      if (!whole) return whole.failure();
      return (*whole)->under(model, interrupt);
    }
    auto half = half_->under(first_half(model), interrupt);
    if (!half) return half.failure();
    auto phases = (*half)->phases();
    return std::shared_ptr<const State<3>>(
        std::make_shared<const WholeState>(solver_, model, shape_, *std::move(half), std::move(phases)));
  }

 private:
  const WidthHalves& halves() const { return solver_.halves(); }

  std::vector<FunctionalDerivative<3>> of_half(std::span<const FunctionalDerivative<3>> functions) const {
    std::vector<FunctionalDerivative<3>> result;
    for (const auto& function : functions) result.push_back(halves().derivative_of_half(function));
    return result;
  }

  Expected<std::shared_ptr<const State<3>>> on_whole_width(const Interrupt& interrupt) const {
    const auto whole = solver_.whole();
    if (!whole) return whole.failure();
    return (*whole)->states({shape_->psi, &shape_->domain}, positions(), interrupt);
  }

  const HalfWidthSolver& solver_;
  RollingModel<3> model_;
  std::shared_ptr<const KeptShape> shape_;
  std::shared_ptr<const State<3>> half_;
  std::vector<double> strain_energy_;
  Matrix observations_;
  std::vector<PhaseTime> phases_;
  std::vector<SurfacePoint<3>> boundary_, edges_;
  std::vector<ContactPatch<3>> contacts_;
  WholeDisplacement displacement_;
  mutable std::once_flag has_harmonics_;
  mutable std::vector<double> energy_by_harmonic_;
};

}  // namespace

bool HalfWidthSolver::can_halve(const RollingModel<3>& model) {
  return model.grid.cells[2] % 2 == 0 && is_axially_symmetric(model);
}

HalfWidthSolver::HalfWidthSolver(const RollingModel<3>& model, RollingProblem<3> half)
    : model_(model), half_(std::move(half)), halves_(model.grid, half_.tread_surface()) {}

Expected<std::shared_ptr<const HalfWidthSolver>> HalfWidthSolver::create(const RollingModel<3>& model) {
  auto half = RollingProblem<3>::create(first_half(model));
  if (!half) return half.failure();
  return std::shared_ptr<const HalfWidthSolver>(new HalfWidthSolver(model, *std::move(half)));
}

Expected<std::shared_ptr<const RollingProblem<3>>> HalfWidthSolver::whole() const {
  std::call_once(has_whole_, [this] {
    auto whole = RollingProblem<3>::create(model_);
    if (whole)
      whole_.emplace(std::make_shared<const RollingProblem<3>>(*std::move(whole)));
    else
      whole_.emplace(whole.failure());
  });
  return *whole_;
}

Expected<std::shared_ptr<const State<3>>> HalfWidthSolver::states(const CutShape<3>& shape,
                                                                  LoadPositions positions,
                                                                  const Interrupt& interrupt) const {
  const bool upright = std::ranges::all_of(positions.grounds, [](const auto& g) { return g.camber == 0; });
  if (positions.on_whole_width || !upright || !is_mirror_symmetric(shape.psi, MirrorPlane::width)) {
    const auto problem = whole();
    if (!problem) return problem.failure();
    return (*problem)->states(shape, std::move(positions), interrupt);
  }
  Stopwatch watch;
  auto domain = shape.domain ? Expected<CutDomain<3>>(*shape.domain)
                             : cut_domain(shape.psi, model_.points_in_cut_cells());
  if (!domain) return domain.failure();
  const CutDomain<3> half_domain = first_half(*domain);
  std::vector<PhaseTime> phases{{phase::cut, watch.lap()}};
  auto half = half_.states({first_half(shape.psi), &half_domain}, std::move(positions), interrupt);
  if (!half) return half.failure();
  auto kept = std::make_shared<const KeptShape>(KeptShape{shape.psi, *std::move(domain)});
  phases.insert(phases.end(), (*half)->phases().begin(), (*half)->phases().end());
  return std::shared_ptr<const State<3>>(std::make_shared<const WholeState>(
      *this, model_, std::move(kept), *std::move(half), std::move(phases)));
}

Expected<StateSolver<3>::TractionMap> HalfWidthSolver::neumann_to_dirichlet(DualNorm norm) const {
  return traction_map<3>(model_, norm);
}

}  // namespace wheelwright
