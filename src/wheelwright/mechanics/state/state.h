#pragma once

#include <functional>
#include <memory>
#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/interrupt.h"
#include "wheelwright/base/phase_time.h"
#include "wheelwright/mechanics/elasticity/dual_norm.h"
#include "wheelwright/mechanics/state/contact_patch.h"
#include "wheelwright/mechanics/state/functional_derivative.h"
#include "wheelwright/mechanics/state/load_positions.h"
#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/mechanics/state/rolling_model.h"
#include "wheelwright/mechanics/state/start_displacements.h"
#include "wheelwright/mechanics/state/topological_derivative.h"
#include "wheelwright/mechanics/state/tread_surface.h"
#include "wheelwright/shape/cut/cut_shape.h"

namespace wheelwright {

/// Number of independent components of an antisymmetric tensor: a rotation about the axle, or about three
/// axes.
template <int dim>
constexpr int n_rotations = dim*(dim - 1) / 2;

/// The displacement of a solved shape everywhere in the ring.
template <int dim>
class Displacement {
 public:
  virtual ~Displacement() = default;

  /// u of one load position at the nodes of the displacement's lattice, the rim's motion included [m];
  /// Cartesian, body frame.
  virtual RingField at_nodes(int position) const = 0;

  /// Strains at points of a cell of the sector's grid, in the axes that the law of the material wants
  /// (MaterialLaw): n_strains rows per point, one column per (position, sector). In the tread they are those
  /// of the grid's own nodes.
  virtual FactoredField strains(int cell, std::span<const Vec<dim>> points) const = 0;

  /// The same strains, each followed by the n_rotations rotations of the material against the rim there: half
  /// the curl of u without the rim's motion, in the same axes [rad].
  virtual FactoredField strains_and_rotations(int cell, std::span<const Vec<dim>> points) const = 0;
};

/// The largest values of every load position, over the quadrature points of the material. The tread is seen
/// through the nodes of the level set's grid, without its refinement.
template <int dim>
struct StrainPeaks {
  std::vector<double> von_mises;           ///< stress [Pa]
  std::vector<Vec<dim>> von_mises_places;  ///< where they are: polar coordinates of the body (m, rad, m)
  std::vector<double> principal;           ///< absolute value of a principal strain
};

/// Shape gradients of several functions.
struct ShapeGradients {
  std::vector<std::vector<double>> densities;       ///< [function][point of State::boundary()]
  std::vector<std::vector<double>> edge_densities;  ///< [function][point of State::edges()]
  /// Derivatives with respect to the radii of the model's design lines, [function][line]. The shape moves
  /// with the rows that a line stretches: its nodal values stay as they are.
  std::vector<std::vector<double>> by_radius;
  std::vector<PhaseTime> phases;  ///< wall times of the adjoint problems and of the densities
};

/// The states of one shape: the solutions of its contact problems (27) at some load positions. Position i is
/// solved in the body frame, with the ground turned to it. The field in sector s is also the field in sector
/// 0 for the load position that lies s sectors back. A functional that keeps a state beyond its evaluation
/// shares its ownership.
template <int dim>
class State : public std::enable_shared_from_this<State<dim>> {
 public:
  virtual ~State() = default;

  /// The solved model: the load, and everything that it shares with the solver's own model.
  virtual const RollingModel<dim>& model() const = 0;

  virtual const CutDomain<dim>& domain() const = 0;

  /// The load positions that were solved for, and how many positions each represents.
  virtual const LoadPositions& positions() const = 0;

  /// The contact of every position.
  virtual const std::vector<ContactPatch<dim>>& contacts() const = 0;

  /// J_e (3) of every position [J/m when dim = 2, J when dim = 3].
  virtual const std::vector<double>& strain_energy() const = 0;

  /// The mean strain energy over a turn of the part of the strains that varies in every material point with
  /// harmonic n of the turn, W_n [J/m when dim = 2, J when dim = 3]; n = 0 ... N / 2, where N is the number
  /// of load cases (TurnHarmonics). Their sum is the mean of strain_energy(). Every position of the sector
  /// must have been solved. The first call computes them; the state remembers them.
  virtual const std::vector<double>& energy_by_harmonic() const = 0;

  /// The observations of the tread of the displacement without the rim's motion: rows as in ObservationRows,
  /// one column per (position, ring column).
  virtual const Matrix& observations() const = 0;

  /// Wall times of the solution's phases.
  virtual const std::vector<PhaseTime>& phases() const = 0;

  /// The displacement everywhere. The first call costs one sweep over the interior unknowns; the state
  /// remembers it.
  virtual const Displacement<dim>& displacement() const = 0;

  /// The first call costs one evaluation of the strains; the state remembers them.
  virtual const StrainPeaks<dim>& strain_peaks() const = 0;

  /// The points of the moving boundary at which shape gradients are given.
  virtual const std::vector<SurfacePoint<dim>>& boundary() const = 0;

  /// Points of the edges in which the moving boundary meets side faces of the wheel; their weights are
  /// lengths. None when dim = 2.
  virtual const std::vector<SurfacePoint<dim>>& edges() const = 0;

  /// The displacements from which the states of a similar shape may be sought (StateSolver::states_near());
  /// none where that saves nothing.
  virtual StartDisplacements start_displacements() const { return {}; }

  /// The densities at boundary() of the shape derivatives (42) of several functions, each summed over its
  /// positions (as often as they count) and over the sectors: M(u) + sigma(u):eps(p) - f.p, and p_0 div p
  /// under a pressure p_0; and those at edges(), -p_0 (p.e) / sqrt(1 - (n.e)^2) with the outward normal e of
  /// the side face. Their adjoint problems (79) are solved as one block of right-hand sides.
  virtual Expected<ShapeGradients> shape_gradients(
      std::span<const FunctionalDerivative<dim>> functions) const = 0;

  /// The topological derivatives of several functions at points of the core, [function][point]: their change
  /// by a small round traction-free hole in every sector, per area (volume when dim = 3), each summed over
  /// its positions (with multiplicity) and over the sectors:
  ///   -sigma(p) : A eps(u) + f.p, and removed_density() of what is integrated over the material,
  /// with A of strain_of_hole(). Fails as shape_gradients() does; with unsupported_model under a pressure in
  /// the holes, and in three dimensions for functions with integrals.
  virtual Expected<std::vector<std::vector<double>>> topological_derivatives(
      std::span<const FunctionalDerivative<dim>> functions,
      std::span<const MaterialPoint<dim>> points) const = 0;

  /// The contacts of the same shape and positions under other models, which may differ from the solver's only
  /// in the loads or the travel of the rim, with their stiffnesses: [model][position]. Each starts from the
  /// last one that was solved. Each fails on its own, as the contact problem does; at large deformation also
  /// as StateSolver::states() does, and with material_overlaps.
  virtual std::vector<Expected<std::vector<ContactPatch<dim>>>> contacts_under(
      std::span<const RollingModel<dim>> models, const Interrupt& interrupt) const = 0;

  /// The states of the same shape and positions under another model, which may differ from this one's only in
  /// its loads. They share the factorization, which does not depend on the load. If the model rotates, the
  /// solver's must rotate or observe the spin (TreadGrid). Fails as StateSolver::states() does.
  virtual Expected<std::shared_ptr<const State<dim>>> under(const RollingModel<dim>& model,
                                                            const Interrupt& interrupt) const = 0;
};

/// Solves the states of shapes: the only interface of a run to the mechanics. Everything independent of the
/// shape is built once. Ownership can be shared as that of a State.
template <int dim>
class StateSolver : public std::enable_shared_from_this<StateSolver<dim>> {
 public:
  virtual ~StateSolver() = default;

  virtual const RollingModel<dim>& model() const = 0;
  virtual const TreadSurface<dim>& tread_surface() const = 0;

  /// The states of a shape at some load positions. Its cells are cut unless it brings them. `interrupt` is
  /// polled between the phases and while the contact problems are solved; once it asks, the failure is
  /// `interrupted`. Fails when the
  /// shape cannot be computed. The solver must outlive the state.
  virtual Expected<std::shared_ptr<const State<dim>>> states(const CutShape<dim>& shape,
                                                             LoadPositions positions,
                                                             const Interrupt& interrupt) const = 0;

  /// The same, sought from the displacements of a similar shape (State::start_displacements()), which a
  /// solver may leave unused. They change the states by less than the tolerance of the solver.
  virtual Expected<std::shared_ptr<const State<dim>>> states_near(const StartDisplacements&,
                                                                  const CutShape<dim>& shape,
                                                                  LoadPositions positions,
                                                                  const Interrupt& interrupt) const {
    return states(shape, std::move(positions), interrupt);
  }

  /// The operator g -> w[g] of (68), or of Poisson's problem in its place, on the full ring, which no shape
  /// changes: tractions on the tread to the displacement there. dim rows per contact point (Cartesian, column
  /// frame), one column per (right-hand side, ring column), both ways. Fails as states() does.
  using TractionMap = std::function<Matrix(const Matrix& tractions)>;
  virtual Expected<TractionMap> neumann_to_dirichlet(DualNorm norm) const = 0;

  /// All load positions of a sector.
  LoadPositions all_positions() const {
    return load_positions(model().grid, model().n_positions, model().camber);
  }

  /// The positions that determine all others: one of each mirror-image pair, if the shape and its loads are
  /// their own mirror image.
  LoadPositions distinct_positions(const LevelSet<dim>& psi) const;
};

}  // namespace wheelwright
