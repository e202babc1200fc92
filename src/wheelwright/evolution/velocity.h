#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/evolution/protected_bands.h"

namespace wheelwright {

/// How the shape gradient becomes a velocity on all lattice nodes.
enum class ExtensionKind {
  h1,        ///< Riesz representative in H1: smooth, and a descent direction by construction
  harmonic,  ///< harmonic extension of the boundary values, the paper's (section 4)
};

struct VelocityOptions {
  ExtensionKind kind = ExtensionKind::h1;
  double length = 2;  ///< regularization length of h1, in units of the grid's resolution
};

/// Takes the density G of a shape derivative, given on the boundary, to a descent velocity V along the
/// outward normal at all lattice nodes (V > 0: the material grows). Linear in G; V = 0 in the protected
/// bands. Fails with not_positive_definite or not_finite where G is not finite.
template <int dim>
class VelocityExtension {
 public:
  virtual ~VelocityExtension() = default;
  virtual Expected<std::vector<double>> operator()(std::span<const SurfaceSample<dim>> gradient) const = 0;
};

/// h1: int length^2 grad V . grad w + V w = - int_boundary G w for all w that vanish in the bands.
/// harmonic: Laplace V = 0 with V = -G on the boundary by a penalty and V = 0 in the bands.
template <int dim>
std::unique_ptr<VelocityExtension<dim>> make_velocity_extension(const Lattice<dim>& lattice,
                                                                const ProtectedBands<dim>& bands,
                                                                const VelocityOptions& options);

/// V_J - mu V_1, with V_1 the velocity of G = 1 (the measure's own gradient) and mu such that the measure of
/// the material stays the same to first order: int_boundary V = 0.
template <int dim>
Expected<std::vector<double>> measure_preserving_velocity(const Lattice<dim>& lattice,
                                                          const VelocityExtension<dim>& extension,
                                                          std::span<const SurfaceSample<dim>> gradient);

/// The samples of a gradient that can follow a velocity: without those on the edge of a band that it would
/// push into the band.
template <int dim>
std::vector<SurfaceSample<dim>> movable_samples(const Lattice<dim>& lattice, const ProtectedBands<dim>& bands,
                                                std::span<const SurfaceSample<dim>> gradient,
                                                std::span<const double> velocity);

}  // namespace wheelwright
