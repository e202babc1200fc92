#pragma once

#include "wheelwright/mechanics/ring/tread_ring.h"
#include "wheelwright/mechanics/rolling/preload.h"
#include "wheelwright/mechanics/rolling/rolled_contact.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The direct problems of some load positions for one shape. Load cases of the core are numbered position *
/// n_sectors + sector; matrices of the tread have one column per (position, ring column). Position i
/// is solved with the ground turned to it, in the body frame; the field in sector s is also the field in
/// sector 0 for the load position that lies s sectors back. The rim's motion is left out: u = v +
/// motion.
template <int dim>
struct RollingSolution {
  std::shared_ptr<const FactoredShape<dim>> shape;
  const CutDomain<dim>& domain;      ///< that of the shape
  const CyclicStiffness<dim>& ring;  ///< that of the shape
  RollingModel<dim> model;           ///< the load
  /// Of the ring; as wide as the widest contact zone.
  std::shared_ptr<const SurfaceCompliance<dim>> surface;
  LoadPositions positions;
  std::vector<ReducedContact<dim>> contacts;
  std::vector<ContactState<dim>> states;
  PartialCholesky::Sweep sweep;   ///< through the unknowns of the core that the gradient needs
  SectorFields displacement;      ///< v in those unknowns; complete_displacement() finds the others
  Matrix outer_line;              ///< v on the core's outer line (CyclicStiffness)
  SectorFields core_loads;        ///< of body force and pressure, in the core; empty: none
  Matrix tread_loads;             ///< of ground and body force, on the tread's observations
  std::vector<Preload> preloads;  ///< of every position
  std::vector<StandingPoint<dim>> standing;  ///< of every position if the wheel rotates; else empty
  Matrix observations;                       ///< of v on the tread
  Matrix ghost_loads;                        ///< ghost penalty applied to the modes of v
  std::vector<double> strain_energy;         ///< J_e (3) of every position
  std::vector<PhaseTime> phases;
};

/// How many of a sector's positions each load case represents.
template <int dim>
std::vector<double> case_multiplicities(const RollingSolution<dim>& solution);

/// v in all unknowns of the core.
template <int dim>
SectorFields complete_displacement(const RollingSolution<dim>& solution);

/// The rolling problem of a cyclic, linearly elastic ring: what no shape changes is built once; every shape
/// is then one call.
template <int dim>
class RollingProblem : public StateSolver<dim> {
 public:
  /// Fails with not_positive_definite when theta and gamma_0 do not go together, and with unsupported_model
  /// for plane stress when dim = 3.
  static Expected<RollingProblem> create(const RollingModel<dim>& model);

  const RollingModel<dim>& model() const override { return model_; }
  const TreadSurface<dim>& tread_surface() const override { return tread_.surface(); }
  Expected<std::shared_ptr<const State<dim>>> states(const CutShape<dim>& shape, LoadPositions positions,
                                                     const Interrupt& interrupt) const override;
  Expected<typename StateSolver<dim>::TractionMap> neumann_to_dirichlet(DualNorm norm) const override;

  const ElementTable<dim>& elements() const { return *elements_; }
  const Tread<dim>& tread() const { return tread_; }
  int core_rows() const { return model_.grid.cells[0] - model_.tread.rows; }

  /// Rows of cells that must stay full at the rim and at the tread: the tread and one row below it.
  int protected_rim_rows() const { return 1; }
  int protected_tread_rows() const { return model_.tread.rows + 1; }

  /// The direct problems of all positions, or of some of them; as states(), with the solver's own solution.
  Expected<RollingSolution<dim>> solve(const CutShape<dim>& shape) const {
    return solve(shape, this->all_positions());
  }
  Expected<RollingSolution<dim>> solve(const CutShape<dim>& shape, LoadPositions positions,
                                       const Interrupt& interrupt = {}) const;

  /// The direct problems of the same shape and positions under another model, which differs from the
  /// solution's only in loads, with the same factor. Fails like solve().
  Expected<RollingSolution<dim>> solve_under(const RollingModel<dim>& model,
                                             const RollingSolution<dim>& solution,
                                             const Interrupt& interrupt = {}) const;

  /// The same shape and positions of the wheel that rotates as `solution`'s, off the ground and without any
  /// other load. Fails as solve() does.
  Expected<RollingSolution<dim>> without_load(const RollingSolution<dim>& solution) const;

  /// Nitsche's symmetric term of the tread applied to what is observed: loads on the tractions.
  Matrix nitsche_loads(const Matrix& observations) const;

  /// The factors -theta/gamma dS of that term, one per observation; zero for those that are no tractions.
  std::vector<double> nitsche_factors() const;

 private:
  RollingProblem(const RollingModel<dim>& model, std::unique_ptr<ElementTable<dim>> elements,
                 Tread<dim> tread);

  Expected<std::shared_ptr<const FactoredShape<dim>>> factor(const CutShape<dim>& shape,
                                                             const Interrupt& interrupt) const;
  /// Whether the wheel must touch the ground at every position.
  enum class Ground { touched, out_of_reach };
  Expected<RollingSolution<dim>> roll(const RollingModel<dim>& model,
                                      std::shared_ptr<const FactoredShape<dim>> shape,
                                      std::shared_ptr<const SurfaceCompliance<dim>> surface,
                                      LoadPositions positions, Ground reach,
                                      const Interrupt& interrupt) const;

  RollingModel<dim> model_;
  std::unique_ptr<ElementTable<dim>> elements_;
  SectorHarmonics harmonics_;
  Tread<dim> tread_;
};

}  // namespace wheelwright
