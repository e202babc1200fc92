#pragma once

#include <vector>

#include "wheelwright/linalg/sparse_spd.h"
#include "wheelwright/mechanics/heat/temperature_field.h"
#include "wheelwright/mechanics/state/rolling_model.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The surfaces that give heat to the air.
enum class CooledSurface { tread, holes, side_faces };
inline constexpr int n_cooled_surfaces = 3;

/// The form of steady conduction in the material of one sector, with the sectors next to it equal to it, for
/// the rise theta of the temperature over that of the air [K]:
///   a(theta, v) = int k grad theta . grad v + int h theta v over tread, moving boundary and side faces
/// on the nodes of a lattice of the displacement's degree, with the ghost penalty of the displacement, scaled
/// by k. When dim = 2 it is per metre of width, and the side faces are a sink 2 h / width in the material.
template <int dim>
class Conduction {
 public:
  /// The model must have a cooling and all its materials a conductivity. The domain may be on a grid of the
  /// model with moved lines.
  Conduction(const RollingModel<dim>& model, const CutDomain<dim>& domain);

  const Lattice<dim>& lattice() const { return lattice_; }
  bool has_given_rim() const { return has_given_rim_; }
  bool is_at_rim(int node) const { return lattice_.node_position(node)[0] == 0; }
  /// Whether a node belongs to a cell with material.
  bool is_active(int node) const { return is_active_[node]; }

  /// Of the lower triangle, on the nodes; some positions occur several times.
  std::span<const SparseSpd::Entry> entries() const { return entries_; }

  /// a(field, N_a) for the shape function of every node.
  std::vector<double> times(const std::vector<double>& field) const;

  /// h int N_a over a surface, for every node [W/K, per metre of width when dim = 2].
  const std::vector<double>& exchange(CooledSurface surface) const {
    return exchange_[static_cast<int>(surface)];
  }

 private:
  using Nodes = std::vector<int>;
  Nodes cell_nodes(int cell) const;
  void add(const Nodes& nodes, double factor, const Matrix& form);
  /// With what the surface takes.
  void add_exchange(CooledSurface surface, const Nodes& nodes, double coefficient, const Matrix& form);
  void add_material(const RollingModel<dim>& model, const CutDomain<dim>& domain);
  void add_surfaces(const RollingModel<dim>& model, const CutDomain<dim>& domain);
  void add_penalties(const RollingModel<dim>& model, const CutDomain<dim>& domain);

  Lattice<dim> lattice_;
  bool has_given_rim_;
  std::vector<char> is_active_;
  std::vector<SparseSpd::Entry> entries_;
  std::array<std::vector<double>, n_cooled_surfaces> exchange_;
};

/// The factored form, without the nodes of a rim of given temperature.
template <int dim>
class ConductionSolver {
 public:
  /// Fails with not_positive_definite, e.g. if nothing takes the heat.
  static Expected<ConductionSolver> create(Conduction<dim> conduction);

  const Conduction<dim>& conduction() const { return conduction_; }

  /// The field with a(field, N_a) = load_a at all nodes but those of a rim of given temperature, where it has
  /// the values of `at_rim`. Both have one entry per node. Fails with not_finite and inaccurate_solution.
  Expected<TemperatureField<dim>> solve(const std::vector<double>& loads,
                                        const std::vector<double>& at_rim) const;

 private:
  ConductionSolver(Conduction<dim> conduction, std::vector<int> unknowns, SparseSpd factor)
      : conduction_(std::move(conduction)), unknowns_(std::move(unknowns)), factor_(std::move(factor)) {}

  Conduction<dim> conduction_;
  std::vector<int> unknowns_;  ///< number of the unknown of every node; -1: none
  SparseSpd factor_;
};

/// Whether the conductivity of every material is known.
template <int dim>
bool has_conductivities(const Materials<dim>& materials);

}  // namespace wheelwright
