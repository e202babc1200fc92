#include "wheelwright/shape/evolution/velocity.h"

#include "wheelwright/shape/evolution/multilinear.h"
#include "wheelwright/shape/geometry/finite.h"

namespace wheelwright {

namespace {

std::vector<double> negated(std::vector<double> v) {
  for (double& x : v) x = -x;
  return v;
}

void clear_fixed(std::vector<double>& v, const std::vector<bool>& fixed) {
  for (std::size_t node = 0; node < v.size(); ++node)
    if (fixed[node]) v[node] = 0;
}

template <int dim>
Expected<std::vector<double>> finite(const Lattice<dim>& lattice, std::vector<double> velocity) {
  if (auto failure = check_finite<dim>(lattice, velocity, "the velocity")) return *failure;
  return velocity;
}

template <int dim>
class H1Extension final : public VelocityExtension<dim> {
 public:
  H1Extension(const Lattice<dim>& lattice, const ProtectedBands<dim>& bands, double length)
      : lattice_(lattice),
        fixed_(bands.nodes()),
        factor_(*SparseSpd::factor(
            lattice.n_nodes(),
            with_fixed_nodes(multilinear_form<dim>(lattice, 1, length * length), bands.nodes()))) {}

  Expected<std::vector<double>> operator()(std::span<const SurfaceSample<dim>> gradient) const override {
    auto load = negated(boundary_load<dim>(lattice_, gradient));
    clear_fixed(load, fixed_);
    return finite(lattice_, factor_.solve(load));
  }

 private:
  Lattice<dim> lattice_;
  std::vector<bool> fixed_;
  SparseSpd factor_;
};

template <int dim>
class HarmonicExtension final : public VelocityExtension<dim> {
 public:
  HarmonicExtension(const Lattice<dim>& lattice, const ProtectedBands<dim>& bands)
      : lattice_(lattice), fixed_(bands.nodes()), laplacian_(regularized_laplacian(lattice)) {}

  Expected<std::vector<double>> operator()(std::span<const SurfaceSample<dim>> gradient) const override {
    const double penalty = 10 / lattice_.grid().resolution();
    auto matrix = laplacian_;
    for (const auto& sample : gradient) add_penalty(matrix, sample, penalty);
    auto load = negated(boundary_load<dim>(lattice_, gradient));
    for (double& x : load) x *= penalty;
    clear_fixed(load, fixed_);
    const auto factor = SparseSpd::factor(lattice_.n_nodes(), with_fixed_nodes(matrix, fixed_));
    if (!factor) return factor.failure();
    return finite(lattice_, factor->solve(load));
  }

 private:
  /// The mass term is negligible at the scale of the ring. It keeps the operator regular if there are neither
  /// bands nor boundary samples.
  static std::vector<SparseSpd::Entry> regularized_laplacian(const Lattice<dim>& lattice) {
    const double far = 1e3 * lattice.grid().outer_radius;
    return multilinear_form<dim>(lattice, 1 / (far * far), 1);
  }

  void add_penalty(std::vector<SparseSpd::Entry>& matrix, const SurfaceSample<dim>& sample,
                   double penalty) const {
    const auto at = node_weights<dim>(lattice_, sample.cell, sample.xi);
    for (std::size_t a = 0; a < at.node.size(); ++a)
      for (std::size_t b = 0; b < at.node.size(); ++b)
        if (at.node[a] >= at.node[b])
          matrix.push_back({at.node[a], at.node[b], penalty * sample.weight * at.weight[a] * at.weight[b]});
  }

  Lattice<dim> lattice_;
  std::vector<bool> fixed_;
  std::vector<SparseSpd::Entry> laplacian_;
};

}  // namespace

template <int dim>
std::unique_ptr<VelocityExtension<dim>> make_velocity_extension(const Lattice<dim>& lattice,
                                                                const ProtectedBands<dim>& bands,
                                                                const VelocityOptions& options) {
  if (options.kind == ExtensionKind::harmonic)
    return std::make_unique<HarmonicExtension<dim>>(lattice, bands);
  return std::make_unique<H1Extension<dim>>(lattice, bands, options.length * lattice.grid().resolution());
}

template <int dim>
Expected<std::vector<double>> measure_preserving_velocity(const Lattice<dim>& lattice,
                                                          const VelocityExtension<dim>& extension,
                                                          std::span<const SurfaceSample<dim>> gradient) {
  std::vector<SurfaceSample<dim>> ones(gradient.begin(), gradient.end());
  for (auto& sample : ones) sample.value = 1;
  auto velocity = extension(gradient);
  if (!velocity) return velocity;
  auto shrinking = extension(ones);
  if (!shrinking) return shrinking;
  const double rate = boundary_integral<dim>(lattice, ones, *shrinking);
  if (rate == 0) return velocity;
  const double multiplier = boundary_integral<dim>(lattice, ones, *velocity) / rate;
  for (std::size_t node = 0; node < velocity->size(); ++node)
    (*velocity)[node] -= multiplier * (*shrinking)[node];
  return finite(lattice, *std::move(velocity));
}

template <int dim>
std::vector<SurfaceSample<dim>> movable_samples(const Lattice<dim>& lattice, const ProtectedBands<dim>& bands,
                                                std::span<const SurfaceSample<dim>> gradient,
                                                std::span<const double> velocity) {
  std::vector<SurfaceSample<dim>> result;
  for (const auto& sample : gradient) {
    const bool is_blocked = bands.touches(sample) &&
                            interpolate(node_weights<dim>(lattice, sample.cell, sample.xi), velocity) < 0;
    if (!is_blocked) result.push_back(sample);
  }
  return result;
}

template decltype(make_velocity_extension<2>) make_velocity_extension<2>;
template decltype(make_velocity_extension<3>) make_velocity_extension<3>;
template decltype(measure_preserving_velocity<2>) measure_preserving_velocity<2>;
template decltype(measure_preserving_velocity<3>) measure_preserving_velocity<3>;
template decltype(movable_samples<2>) movable_samples<2>;
template decltype(movable_samples<3>) movable_samples<3>;

}  // namespace wheelwright
