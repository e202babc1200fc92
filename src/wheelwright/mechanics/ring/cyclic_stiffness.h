#pragma once

#include <functional>
#include <memory>

#include "wheelwright/linalg/partial_cholesky.h"
#include "wheelwright/mechanics/elasticity/sector_stiffness.h"
#include "wheelwright/mechanics/ring/harmonic_factor.h"
#include "wheelwright/mechanics/ring/harmonics.h"
#include "wheelwright/mechanics/ring/interface_modes.h"
#include "wheelwright/mechanics/ring/section_stiffness.h"

namespace wheelwright {

/// Which unknowns the harmonics have besides those of the outer line. All ways have one result, up to the
/// tolerance of InterfaceModes.
enum class InterfaceRoute {
  all_unknowns,  ///< of the interfaces
  strong_modes,  ///< of the interfaces; also all of them if most modes are strong
  section,       ///< all of a sector, with a sparse factor: for sectors of one column that are symmetric
};

/// The boundary nodes of a sector, as all sectors number them, and its interior nodes.
template <int dim>
struct BoundaryLayout {
  std::vector<std::array<int, dim>> interface_nodes;  ///< not on the outer line; none twice
  std::vector<int> interior_nodes, trailing_nodes;    ///< node numbers
};

/// The factored stiffness of the ring's core plus the contribution of the tread on its outer line, by cyclic
/// symmetry: one real factorization of one sector, condensed onto its boundary (Schur complement), and a
/// small Hermitian system for every harmonic of the sectors.
///
/// The boundary unknowns of a sector are those that it shares with its neighbours or with the tread: first
/// the interface unknowns, then those of the outer line (azimuth line major, then axial node, then
/// component). Boundary vectors of the ring are matrices with one column for every (right-hand side, sector):
/// column = rhs * n_sectors + sector, its load case. Components are polar, body frame.
template <int dim>
class CyclicStiffness {
 public:
  /// The tread's contribution on the outer line for a harmonic, both triangles. It must be mirror-symmetric,
  /// as a tread of equal columns is.
  using OuterStiffness = std::function<ComplexMatrix(int harmonic)>;

  /// By default the route is the one that takes the least time. Where a route is impossible, all unknowns of
  /// the interfaces are taken. Fails with not_positive_definite or not_finite.
  static Expected<CyclicStiffness> factor(SectorStiffness<dim> sector, const OuterStiffness& outer_stiffness,
                                          const SectorHarmonics& harmonics,
                                          std::optional<InterfaceRoute> route = {});

  const SectorStiffness<dim>& sector() const { return sector_; }
  int n_sectors() const { return harmonics_.n_sectors(); }
  const SectorHarmonics& harmonics() const { return harmonics_; }
  int n_boundary() const { return n_boundary_; }
  int n_outer() const { return n_outer_; }  ///< the last of the boundary unknowns
  const PartialCholesky& sector_factor() const { return sector_factor_; }

  /// Elimination index of a sector dof.
  int row(int dof) const { return row_[dof]; }

  /// Whether the stiffness is its own mirror image in the plane of azimuth 0 up to rounding, whatever the
  /// loads are. Then the equations of all harmonics are real (MirrorBasis).
  bool is_mirror_symmetric() const { return symmetry_->azimuth.has_value(); }
  /// The same in the middle plane of the width. Then the equations of even and odd fields are separate.
  bool is_symmetric_across_width() const { return symmetry_->width.has_value(); }

  /// The unknowns of the interface that the harmonics have.
  int n_interface_of_harmonics() const { return modes_ ? modes_->n_strong() : n_boundary_ - n_outer_; }

  const HarmonicFactor& harmonic_factor(int harmonic) const { return harmonic_factors_[harmonic]; }

  /// Maps loads on a sector's trailing unknowns (one row per load case) to boundary loads of the ring. A node
  /// shared by sectors may carry its load in any of them.
  Matrix boundary_loads(const Matrix& trailing_loads) const;

  /// The loads on the interface unknowns after elimination; only boundary_displacements() reads them. Empty
  /// if no loads act on these unknowns.
  struct InterfaceLoads {
    std::vector<ComplexMatrix> by_harmonic;
    Matrix weak_modes;  ///< InterfaceModes::eliminate()
  };
  /// Boundary loads after elimination of the interface unknowns.
  struct EliminatedInterface {
    InterfaceLoads interface;
    Matrix outer;  ///< condensed loads on the outer line, n_outer x load cases
  };
  EliminatedInterface eliminate_interface(Matrix boundary_loads) const;

  /// Displacements of the outer line for condensed loads on it, both n_outer x load cases.
  Matrix outer_displacements(const Matrix& condensed_loads) const;

  /// The same as matrices, SectorHarmonics::between_sectors(): displacements of the outer line of a sector
  /// for unit loads on that of another.
  std::vector<Matrix> outer_compliance(int farthest, std::optional<int> together = {}) const;
  /// The Hermitian block of a harmonic, of which they are made.
  ComplexMatrix outer_compliance_of(int harmonic) const {
    return harmonic_factors_[harmonic].outer_compliance();
  }

  /// Boundary displacements (n_boundary x load cases) from those of the outer line and the interface loads
  /// returned by eliminate_interface().
  Matrix boundary_displacements(const Matrix& outer, const InterfaceLoads& interface) const;

  /// Displacements of every sector's trailing unknowns, one row per load case.
  Matrix trailing_displacements(const Matrix& boundary) const;

 private:
  /// The condensed stiffness of a sector, split by the number of sectors that the second unknown is ahead of
  /// the first. That for -d is the transpose of that for d, which is kept as symmetric and antisymmetric
  /// parts: lower triangles, column by column.
  class CoupledSectors {
   public:
    CoupledSectors(const std::vector<SharedUnknown>& trailing, const Matrix& schur, int n_boundary);
    /// `by_difference`: from -farthest to farthest.
    explicit CoupledSectors(const std::vector<Matrix>& by_difference);

    int farthest() const { return static_cast<int>(ahead_.size()); }  ///< sectors ahead
    double entry(int difference, int i, int j) const;
    Matrix matrix(int difference) const;
    /// The entry of the sum of all differences d, each with its phase w^d. `twice`: 2 w, 2 w^2, ...
    std::complex<double> sum(const std::vector<std::complex<double>>& twice, int i, int j) const;
    bool commute_with_azimuth(const BoundaryMirror& mirror) const;
    bool commute_with_width(const BoundaryMirror& mirror) const;

   private:
    struct Ahead {
      std::vector<double> symmetric, antisymmetric;
    };
    void resize(int n, int farthest);
    void add(int difference, int i, int j, double value);
    size_t place(int i, int j) const;
    template <class Image>
    bool equals(Image image) const;

    int n_ = 0;
    std::vector<double> own_;   ///< difference 0
    std::vector<Ahead> ahead_;  ///< differences 1, 2, ...
  };

  // The stages of factor(), each made from those before it.
  struct FactoredSector {
    PartialCholesky factor;
    std::vector<int> row;  ///< elimination index of a sector dof
  };
  /// The boundary unknowns, and how they are reflected.
  struct Boundary {
    int n_interface, n_outer;
    std::vector<SharedUnknown> trailing;
    BoundaryMirror azimuth;
    std::optional<BoundaryMirror> width;  ///< absent if an unknown has no image across the width
    int size() const { return n_interface + n_outer; }
  };
  /// What the harmonics are made of: the coupling of the boundary's unknowns, or of the strong modes and the
  /// outer line.
  struct OfHarmonics {
    CoupledSectors coupled;
    std::shared_ptr<const BoundarySymmetry> symmetry;
    std::optional<InterfaceModes> modes;
  };
  static Expected<FactoredSector> factor_sector(const SectorStiffness<dim>& sector,
                                                const BoundaryLayout<dim>& layout);
  /// All factors; fails with the first harmonic that has none, because it is not positive definite.
  static Expected<std::vector<HarmonicFactor>> all_of(std::vector<std::optional<HarmonicFactor>> factors);
  static Boundary boundary_of(const SectorSpace<dim>& space, const BoundaryLayout<dim>& layout);
  static std::shared_ptr<const BoundarySymmetry> symmetry_of(const CoupledSectors& coupled,
                                                             const Boundary& boundary);
  static OfHarmonics reduced_to_modes(CoupledSectors coupled, const Boundary& boundary,
                                      std::shared_ptr<const BoundarySymmetry> symmetry, InterfaceRoute route);

  CyclicStiffness(SectorStiffness<dim> sector, FactoredSector factored, const SectorHarmonics& harmonics,
                  Boundary boundary, std::shared_ptr<const BoundarySymmetry> symmetry,
                  std::optional<InterfaceModes> modes, std::vector<HarmonicFactor> harmonic_factors);

  /// By InterfaceRoute::section; empty if the sectors are not symmetric.
  static std::optional<Expected<CyclicStiffness>> factor_section(SectorStiffness<dim>& sector,
                                                                 const OuterStiffness& outer_stiffness,
                                                                 const SectorHarmonics& harmonics);

  /// The ring's stiffness, with that of the outer line, for every harmonic; it must be positive definite.
  static Expected<std::vector<HarmonicFactor>> factor_harmonics(
      const CoupledSectors& coupled, const std::shared_ptr<const BoundarySymmetry>& of_harmonics,
      const OuterStiffness& outer_stiffness, const SectorHarmonics& harmonics);

  SectorStiffness<dim> sector_;
  PartialCholesky sector_factor_;
  SectorHarmonics harmonics_;
  std::vector<int> row_;
  std::vector<SharedUnknown> trailing_;
  int n_boundary_, n_outer_;
  std::shared_ptr<const BoundarySymmetry> symmetry_;
  std::optional<InterfaceModes> modes_;  ///< absent if the harmonics have all unknowns
  std::vector<HarmonicFactor> harmonic_factors_;
};

}  // namespace wheelwright
