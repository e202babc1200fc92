#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/evolution/protected_bands.h"

namespace wheelwright {

/// The method that extends the shape gradient to a velocity at all lattice nodes.
enum class ExtensionKind {
  h1,        ///< Riesz representative in H1: smooth and a descent direction by construction
  harmonic,  ///< harmonic extension of the boundary values, as in the paper (section 4)
};

struct VelocityOptions {
  ExtensionKind kind = ExtensionKind::h1;
  double length = 2;  ///< regularization length of h1, in units of the resolution of the grid
};

/// Maps the density G of a shape derivative, given on the boundary, to a descent velocity V along the outward
/// normal at all lattice nodes (the material grows where V > 0). V is linear in G and vanishes in the
/// protected bands. Fails with not_positive_definite, or with not_finite if G is not finite.
template <int dim>
class VelocityExtension {
 public:
  virtual ~VelocityExtension() = default;
  virtual Expected<std::vector<double>> operator()(std::span<const SurfaceSample<dim>> gradient) const = 0;
};

/// ExtensionKind::h1 solves int length^2 grad V . grad w + V w = - int_boundary G w for all w that vanish in
/// the bands. ExtensionKind::harmonic solves Laplace V = 0 with V = 0 in the bands, and V = -G on the
/// boundary imposed by a penalty.
template <int dim>
std::unique_ptr<VelocityExtension<dim>> make_velocity_extension(const Lattice<dim>& lattice,
                                                                const ProtectedBands<dim>& bands,
                                                                const VelocityOptions& options);

/// Returns V = V_G - mu V_1, where V_G is the velocity of the gradient and V_1 that of G = 1, which is the
/// gradient of the measure. mu is chosen such that the measure of the material is preserved to first order:
/// int_boundary V = 0.
template <int dim>
Expected<std::vector<double>> measure_preserving_velocity(const Lattice<dim>& lattice,
                                                          const VelocityExtension<dim>& extension,
                                                          std::span<const SurfaceSample<dim>> gradient);

/// The samples of a gradient that can move with a velocity: all except those on the edge of a band that would
/// move into it.
template <int dim>
std::vector<SurfaceSample<dim>> movable_samples(const Lattice<dim>& lattice, const ProtectedBands<dim>& bands,
                                                std::span<const SurfaceSample<dim>> gradient,
                                                std::span<const double> velocity);

}  // namespace wheelwright
