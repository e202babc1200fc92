#include "wheelwright/mechanics/rolling/adjoint.h"

#include <algorithm>
#include <numeric>

#include "wheelwright/base/periodic.h"
#include "wheelwright/mechanics/contact/contact_adjoint.h"
#include "wheelwright/mechanics/rolling/energy_weights.h"
#include "wheelwright/mechanics/rolling/material_loads.h"

namespace wheelwright {
namespace {

/// Some columns of a matrix, in place of as many of another from `first` on.
void put_columns(const Matrix& from, int first, Matrix& to) {
  std::copy(from.entries().begin(), from.entries().end(), to.column(first));
}

/// Matrices with equally many columns, one below the other.
Matrix stacked(std::vector<Matrix> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  int rows = 0;
  for (const Matrix& part : parts) rows += part.rows();
  auto result = Matrix::unfilled(rows, parts.front().columns());
  for (int j = 0; j < result.columns(); ++j) {
    double* to = result.column(j);
    for (const Matrix& part : parts) to = std::copy_n(part.column(j), part.rows(), to);
  }
  return result;
}

/// The n equal parts that a matrix was stacked from.
std::vector<Matrix> unstacked(Matrix all, int n) {
  std::vector<Matrix> parts;
  if (n == 1) {
    parts.push_back(std::move(all));
    return parts;
  }
  const int rows = all.rows() / n;
  for (int k = 0; k < n; ++k) parts.push_back(block(all, k * rows, 0, rows, all.columns()));
  return parts;
}

/// The functions' shares of the strain energies.
template <int dim>
std::vector<EnergyWeights<dim>> energy_weights(const RollingSolution<dim>& s,
                                               std::span<const FunctionalDerivative<dim>> functions) {
  std::vector<EnergyWeights<dim>> weights;
  for (const auto& function : functions) weights.emplace_back(s, function);
  return weights;
}

/// The sums over the load cases along the displacement's modes: W^T M x, with one row of x per load case.
template <int dim>
Matrix on_modes(const RollingSolution<dim>& s, const Matrix& x) {
  return product(scaled_rows(case_multiplicities(s), s.displacement.weights), Op::transpose, x, Op::none);
}

/// The adjoint loads of several functions that do not come from the contact.
template <int dim>
class Loads {
 public:
  Loads(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
        std::span<const FunctionalDerivative<dim>> functions, std::span<const EnergyWeights<dim>> energies)
      : functions_(functions), energies_(energies), s_(s) {
    const int n_functions = static_cast<int>(functions.size()), per_function = s.observations.columns();
    tread.on_observations = Matrix(s.observations.rows(), n_functions * per_function);
    boundary = Matrix(s.ring.n_boundary(), n_functions * n_cases());
    for (int f = 0; f < n_functions; ++f) {
      add_on_observations(problem, f);
      if (!functions[f].integrals.empty()) add_material(problem, f);
    }
    add_ghost();
  }

  int n_cases() const { return s_.displacement.weights.rows(); }

  TreadForces tread;  ///< of all functions, one after the other
  Matrix boundary;    ///< loads in the core, condensed onto the ring's boundary

  /// The functions' loads in the core along the displacement's modes, as elimination leaves them.
  std::vector<Matrix> core() && {
    std::vector<Matrix> loads;
    for (size_t f = 0; f < functions_.size(); ++f) {
      if (energies_[f].empty())
        loads.emplace_back(ghost_.rows(), ghost_.columns());
      else
        loads.push_back(
            energies_[f].of_modes(f + 1 == functions_.size() ? std::move(ghost_) : Matrix(ghost_)));
      if (materials_[f]) loads.back() = sum(std::move(loads.back()), on_modes(s_, *materials_[f]));
    }
    return loads;
  }

 private:
  /// The tread's own loads, and what the strain energy leaves there: dJ_e/dv is K v less the ghost penalty
  /// and Nitsche's symmetric term.
  void add_on_observations(const RollingProblem<dim>& problem, int f) {
    materials_.emplace_back();
    const int per_function = s_.observations.columns();
    const Matrix& loads = functions_[f].tread_loads;
    if (loads.columns() > 0) put_columns(loads, f * per_function, tread.on_observations);
    if (energies_[f].empty()) return;
    std::vector<int> all(per_function);
    std::iota(all.begin(), all.end(), 0);
    energies_[f].add_observations(1, problem.nitsche_loads(s_.observations), all, f * per_function,
                                  tread.on_observations);
  }

  void add_material(const RollingProblem<dim>& problem, int f) {
    MaterialLoads loads = material_loads<dim>(problem, s_, functions_[f].integrals);
    const int per_function = s_.observations.columns(), n_functions = static_cast<int>(functions_.size());
    if (tread.on_nodes.columns() == 0) {
      tread.on_base = Matrix(loads.tread.on_base.rows(), n_functions * per_function);
      tread.on_nodes = Matrix(loads.tread.on_nodes.rows(), n_functions * per_function);
    }
    put_columns(loads.tread.on_base, f * per_function, tread.on_base);
    put_columns(loads.tread.on_nodes, f * per_function, tread.on_nodes);
    const PartialCholesky& factor = s_.ring.sector_factor();
    factor.eliminate(factor.full_sweep(), loads.core);
    put_columns(s_.ring.boundary_loads(trailing(loads.core)), f * n_cases(), boundary);
    materials_[f] = std::move(loads.core);
  }

  /// The ghost penalty's share of dJ_e/dv: its modes are the same for all functions.
  void add_ghost() {
    ghost_ = s_.ghost_loads;
    if (std::ranges::all_of(energies_, [](const auto& energy) { return energy.empty(); })) return;
    s_.ring.sector_factor().eliminate(s_.sweep, ghost_);
    const Matrix on_boundary = trailing(ghost_);
    for (size_t f = 0; f < functions_.size(); ++f) {
      if (energies_[f].empty()) continue;
      const Matrix weights = energies_[f].of_cases(s_.displacement.weights);
      const Matrix loads = s_.ring.boundary_loads(product(weights, Op::none, on_boundary, Op::none));
      double* to = boundary.column(static_cast<int>(f) * n_cases());
      for (size_t k = 0; k < loads.entries().size(); ++k) to[k] += loads.entries()[k];
    }
  }

  Matrix trailing(const Matrix& loads) const {
    const PartialCholesky& factor = s_.ring.sector_factor();
    return block(loads, 0, factor.n_interior(), loads.rows(), factor.n_trailing());
  }

  std::span<const FunctionalDerivative<dim>> functions_;
  std::span<const EnergyWeights<dim>> energies_;
  const RollingSolution<dim>& s_;
  Matrix ghost_;                                  ///< ghost penalty applied to the modes of v, eliminated
  std::vector<std::optional<Matrix>> materials_;  ///< of every function, by load cases, eliminated
};

/// The columns of all functions' observations in the contact zones, one function and position after the
/// other.
template <int dim>
std::vector<int> zone_columns(const RollingSolution<dim>& s, int n_functions, int n_columns) {
  std::vector<int> columns;
  const int n_positions = s.positions.size();
  for (int k = 0; k < n_functions * n_positions; ++k) {
    const ContactZone& zone = s.contacts[k % n_positions].zone();
    for (int c = 0; c < zone.n_columns; ++c)
      columns.push_back(k * n_columns + wrap(zone.first_column + c, n_columns));
  }
  return columns;
}

/// The contact's part of the adjoints of all functions at all positions.
struct ContactParts {
  Matrix loads;                                ///< -S^T m, all round
  std::vector<std::vector<RimMotion>> rim;     ///< [function]
  std::vector<std::vector<double>> by_travel;  ///< [function]
};

/// From what is observed of p without them in `columns`, those of zone_columns().
template <int dim>
Expected<ContactParts> contact_adjoints(const RollingSolution<dim>& s,
                                        std::span<const FunctionalDerivative<dim>> functions,
                                        const Matrix& observed, std::span<const int> columns) {
  const int n_functions = static_cast<int>(functions.size());
  ContactParts parts{Matrix(s.observations.rows(), n_functions * s.observations.columns()),
                     std::vector<std::vector<RimMotion>>(n_functions),
                     std::vector<std::vector<double>>(n_functions)};
  const int per_function = static_cast<int>(columns.size()) / n_functions;
  int first = 0;
  for (size_t i = 0; i < s.contacts.size(); ++i) {
    const int n = s.contacts[i].zone().n_columns;
    std::vector<ContactAdjointLoads<dim>> of_functions;
    for (int f = 0; f < n_functions; ++f) {
      of_functions.push_back({block(observed, 0, f * per_function + first, observed.rows(), n)});
      if (!functions[f].rim.empty()) of_functions.back().rim = functions[f].rim[i];
      if (!functions[f].tractions.empty()) of_functions.back().tractions = functions[f].tractions[i];
    }
    const auto adjoints = contact_multipliers<dim>(s.contacts[i], s.states[i], of_functions);
    if (!adjoints) return adjoints.failure();
    for (int f = 0; f < n_functions; ++f) {
      const ContactAdjoint& adjoint = (*adjoints)[f];
      parts.rim[f].push_back(adjoint.rim);
      parts.by_travel[f].push_back(adjoint.by_travel);
      for (int c = 0; c < n; ++c)
        std::copy_n(adjoint.loads.column(c), adjoint.loads.rows(),
                    parts.loads.column(columns[f * per_function + first + c]));
    }
    first += n;
  }
  return parts;
}

/// Takes the states' share off what is observed of q in `columns`: p = q - T v.
template <int dim>
void subtract_states(const RollingSolution<dim>& s, std::span<const EnergyWeights<dim>> energies,
                     std::span<const int> columns, Matrix& observed) {
  const int per_function = s.observations.columns();
  const size_t n = columns.size() / energies.size();
  for (size_t f = 0; f < energies.size(); ++f) {
    if (energies[f].empty()) continue;
    std::vector<int> of_states;
    for (const int column : columns.subspan(f * n, n)) of_states.push_back(column % per_function);
    energies[f].add_observations(-1, s.observations, of_states, static_cast<int>(f * n), observed);
  }
}

/// Takes the weighted modes of the displacement off those of q: p = q - T v.
template <int dim>
void subtract_states(const EnergyWeights<dim>& energy, const Matrix& states, Matrix& modes) {
  if (energy.empty()) return;
  if (const auto factor = energy.common_factor()) {
    for (size_t k = 0; k < states.entries().size(); ++k) modes.entries()[k] -= *factor * states.entries()[k];
    return;
  }
  const Matrix weighted = energy.of_modes(states);
  for (size_t k = 0; k < states.entries().size(); ++k) modes.entries()[k] -= weighted.entries()[k];
}

}  // namespace

template <int dim>
Expected<std::vector<Adjoint>> solve_adjoints(const RollingProblem<dim>& problem,
                                              const RollingSolution<dim>& s,
                                              std::span<const FunctionalDerivative<dim>> functions,
                                              const SectorFields& displacement,
                                              const PartialCholesky::Sweep& sweep) {
  if (functions.empty()) return std::vector<Adjoint>{};
  const Tread<dim>& tread = problem.tread();
  const CyclicStiffness<dim>& ring = s.ring;
  const int n_functions = static_cast<int>(functions.size());
  // p = q - T v with K q = T (G v + Nitsche's term) + the functions' own loads - S^T m.
  const auto energies = energy_weights(s, functions);
  Loads<dim> loads(problem, s, functions, energies);
  const TreadLoads on_tread = tread_loads(tread, loads.tread);
  const auto [interface, condensed_loads] = ring.eliminate_interface(loads.boundary);
  const Matrix without_contact = ring.outer_displacements(sum(condensed_loads, base_loads(tread, on_tread)));
  const auto columns = zone_columns(s, n_functions, tread.n_columns());
  Matrix observed = observations(tread, tread_field(tread, without_contact, on_tread), on_tread, columns);
  subtract_states<dim>(s, energies, columns, observed);
  auto contact = contact_adjoints(s, functions, observed, columns);
  if (!contact) return contact.failure();

  const Matrix outer =
      sum(without_contact, ring.outer_displacements(base_loads(tread, tread_loads(tread, contact->loads))));
  const auto of_cases =
      unstacked(ring.trailing_displacements(ring.boundary_displacements(outer, interface)), n_functions);
  std::vector<Matrix> of_functions = std::move(loads).core();
  for (int f = 0; f < n_functions; ++f) {
    const Matrix trailing = on_modes(s, of_cases[f]);
    std::copy(trailing.entries().begin(), trailing.entries().end(),
              of_functions[f].column(ring.sector_factor().n_interior()));
  }
  Matrix modes = stacked(std::move(of_functions));
  ring.sector_factor().substitute(sweep, modes);
  of_functions = unstacked(std::move(modes), n_functions);
  std::vector<Adjoint> adjoints;
  for (int f = 0; f < n_functions; ++f) {
    subtract_states(energies[f], displacement.modes, of_functions[f]);
    adjoints.push_back({std::move(of_functions[f]), contact->rim[f], contact->by_travel[f]});
  }
  return adjoints;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                       \
  template Expected<std::vector<Adjoint>> solve_adjoints(                                                  \
      const RollingProblem<dim>&, const RollingSolution<dim>&, std::span<const FunctionalDerivative<dim>>, \
      const SectorFields&, const PartialCholesky::Sweep&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
