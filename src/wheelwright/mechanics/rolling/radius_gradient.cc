#include "wheelwright/mechanics/rolling/radius_gradient.h"

#include <memory>
#include <numeric>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/rolling/distributed_loads.h"
#include "wheelwright/mechanics/rolling/energy_weights.h"
#include "wheelwright/mechanics/rolling/integrands.h"
#include "wheelwright/mechanics/state/material_rule.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

/// The core of the same shape in the unit cells on a grid with a moved line.
template <int dim>
class StretchedCore {
 public:
  StretchedCore(const RollingProblem<dim>& problem, const RollingSolution<dim>& s, const PolarGrid<dim>& grid)
      : domain_(s.domain),
        elements_(grid, problem.model().degree, problem.model().materials, problem.model().ghost,
                  cell_stiffness<dim>, problem.model().side_faces, problem.model().dilatation) {
    domain_.grid = grid;
    sector_ = std::make_unique<const SectorStiffness<dim>>(
        sector_stiffness(domain_, elements_, problem.core_rows()));
  }

  const CutDomain<dim>& domain() const { return domain_; }
  const ElementTable<dim>& elements() const { return elements_; }
  const SectorStiffness<dim>& sector() const { return *sector_; }  ///< refers to the elements

 private:
  CutDomain<dim> domain_;
  ElementTable<dim> elements_;
  std::unique_ptr<const SectorStiffness<dim>> sector_;
};

void add_scaled_values(double factor, const std::vector<double>& values, std::vector<double>& sum) {
  if (sum.empty()) sum.assign(values.size(), 0.0);
  for (size_t i = 0; i < values.size(); ++i) sum[i] += factor * values[i];
}

/// Of the entries.
double sum_of_products(const Matrix& a, const Matrix& b) {
  return std::inner_product(a.entries().begin(), a.entries().end(), b.entries().begin(), 0.0);
}

/// The derivatives of the core's forms with respect to the radius of a line.
template <int dim>
class FormsByRadius {
 public:
  FormsByRadius(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                const SectorFields& displacement, std::span<const FunctionalDerivative<dim>> functions,
                int line)
      : s_(s), displacement_(displacement), integrals_(functions.size(), 0.0) {
    const auto rows = rows_at_fixed_line(problem.model().grid, line);
    for (const auto& [grid, factor] : differences_by_radius(problem.model().grid, line)) {
      const StretchedCore<dim> core(problem, s, grid);
      add_stiffness(factor, core.sector());
      if (!s.core_loads.empty()) add_loads(factor, problem, core);
      for (size_t f = 0; f < functions.size(); ++f)
        if (!functions[f].integrals.empty())
          integrals_[f] += factor * integral(core, functions[f].integrals, rows.below.first, rows.above.end);
    }
  }

  /// sum over the modes of a.(dK/dr) b.
  double by_stiffness(const Matrix& a, const Matrix& b) const {
    const SparseSymmetric& k = stiffness_;
    double sum = 0;
    for (int j = 0; j < k.size; ++j)
      for (int entry = k.column_start[j]; entry < k.column_start[j + 1]; ++entry) {
        if (k.values[entry] == 0) continue;
        const int i = k.rows[entry];
        sum += k.values[entry] *
               (product_of_unknowns(a, i, b, j) + (i != j ? product_of_unknowns(a, j, b, i) : 0));
      }
    return sum;
  }

  /// sum over the modes of a.(dG/dr) b.
  double by_ghost(const Matrix& a, const Matrix& b) const {
    double sum = 0;
    for (const auto& [nodes, derivative] : ghosts_) {
      Matrix local_a(a.rows(), dim * static_cast<int>(nodes.size())), local_b = local_a;
      gather(s_.ring, nodes, a, local_a);
      gather(s_.ring, nodes, b, local_b);
      sum += sum_of_products(product(local_a, Op::none, derivative, Op::none), local_b);
    }
    return sum;
  }

  /// The derivative of the loads times the adjoint, and times its motions of the rim.
  double by_loads(const Adjoint& adjoint) const {
    if (s_.core_loads.empty()) return 0;
    const Matrix on_modes = product(scaled_rows(case_multiplicities(s_), displacement_.weights),
                                    Op::transpose, s_.core_loads.weights, Op::none);
    double sum = sum_of_products(product(on_modes, Op::none, loads_, Op::none), adjoint.modes);
    for (size_t i = 0; i < on_the_rim_.size(); ++i)
      sum += s_.positions.multiplicities[i] * work(on_the_rim_[i], adjoint.rim[i]);
    return sum;
  }

  double by_integrals(size_t function) const { return integrals_[function]; }

 private:
  struct GhostByRadius {
    std::vector<int> nodes;
    Matrix derivative;
  };

  double product_of_unknowns(const Matrix& a, int i, const Matrix& b, int j) const {
    const double* x = a.column(s_.ring.row(i));
    return std::inner_product(x, x + a.rows(), b.column(s_.ring.row(j)), 0.0);
  }

  void add_stiffness(double factor, const SectorStiffness<dim>& sector) {
    if (stiffness_.size == 0) {
      stiffness_ = sector.matrix;
      stiffness_.values.clear();
    }
    add_scaled_values(factor, sector.matrix.values, stiffness_.values);
    for (size_t g = 0; g < sector.ghosts.size(); ++g) {
      const auto& [nodes, stiffness] = sector.ghosts[g];
      if (g == ghosts_.size()) ghosts_.push_back({nodes, Matrix(stiffness->rows(), stiffness->columns())});
      Matrix& sum = ghosts_[g].derivative;
      for (size_t i = 0; i < sum.entries().size(); ++i) sum.data()[i] += factor * stiffness->data()[i];
    }
  }

  void add_loads(double factor, const RollingProblem<dim>& problem, const StretchedCore<dim>& core) {
    const AppliedLoads applied = applied_loads<dim>(s_.model.distributed, core.domain(), core.elements(),
                                                    s_.ring, problem.tread(), s_.positions.grounds);
    if (loads_.rows() == 0) loads_ = Matrix(applied.core.modes.rows(), applied.core.modes.columns());
    for (size_t i = 0; i < loads_.entries().size(); ++i)
      loads_.data()[i] += factor * applied.core.modes.data()[i];
    on_the_rim_.resize(applied.on_the_rim.size());
    for (size_t i = 0; i < on_the_rim_.size(); ++i)
      on_the_rim_[i] = wheelwright::sum(on_the_rim_[i], scaled(factor, applied.on_the_rim[i]));
  }

  /// sum over the load cases of m_j factor_i M(u_j), integrated over the material of some rows of a sector.
  double integral(const StretchedCore<dim>& core,
                  std::span<const typename FunctionalDerivative<dim>::Integral> all, int first_row,
                  int end_row) const {
    const PolarGrid<dim>& grid = core.domain().grid;
    double sum = 0;
    MaterialRule<dim>(core.domain(), core.elements().degree() + 2)
        .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> rule) {
          const int row = grid.cell_position(cell)[0];
          if (row < first_row || row >= end_row) return;
          const auto covering = integrals_in_row<dim>(all, grid, row);
          if (covering.empty()) return;
          const auto& element = core.elements().element(row);
          std::vector<typename ElasticElement<dim>::Point> points;
          for (const auto& q : rule) points.push_back(element.at(q.xi));
          Matrix u(displacement_.modes.rows(), element.n_dofs());
          gather(s_.ring, s_.ring.sector().space.cell_nodes(cell), displacement_.modes, u);
          const auto values = integrands<dim>(
              s_.positions,
              {strains_of_cases(u, displacement_.weights, strain_maps<dim>(element, points)),
               s_.ring.n_sectors(), core.elements().law(row), grid.cell_position(cell), places_of<dim>(rule)},
              covering);
          for (size_t q = 0; q < points.size(); ++q)
            sum += rule[q].weight * points[q].determinant * values[q];
        });
    return sum;
  }

  const RollingSolution<dim>& s_;
  const SectorFields& displacement_;
  SparseSymmetric stiffness_;
  std::vector<GhostByRadius> ghosts_;
  Matrix loads_;  ///< of the core, as SectorFields::modes
  std::vector<RimForce> on_the_rim_;
  std::vector<double> integrals_;  ///< of every function
};

/// a + b / 2.
Matrix with_half(Matrix a, const Matrix& b) {
  for (size_t i = 0; i < b.entries().size(); ++i) a.data()[i] += 0.5 * b.data()[i];
  return a;
}

}  // namespace

template <int dim>
std::vector<std::vector<double>> radius_gradients(const RollingProblem<dim>& problem,
                                                  const RollingSolution<dim>& s,
                                                  const SectorFields& displacement,
                                                  std::span<const FunctionalDerivative<dim>> functions,
                                                  std::span<const Adjoint> adjoints) {
  const Matrix& u = displacement.modes;
  std::vector<std::vector<double>> derivatives(functions.size());
  for (const int line : problem.model().design_lines) {
    const FormsByRadius<dim> forms(problem, s, displacement, functions, line);
    for (size_t f = 0; f < functions.size(); ++f) {
      const EnergyWeights<dim> energy(s, functions[f]);
      double sum = forms.by_integrals(f) - forms.by_loads(adjoints[f]);
      if (energy.empty()) {
        sum += forms.by_stiffness(u, adjoints[f].modes);
      } else {
        const Matrix weighted = energy.of_modes(u);
        sum +=
            forms.by_stiffness(u, with_half(adjoints[f].modes, weighted)) - 0.5 * forms.by_ghost(u, weighted);
      }
      derivatives[f].push_back(sum);
    }
  }
  return derivatives;
}

template <int dim>
Expected<AdjointGradients> adjoint_gradients(const RollingProblem<dim>& problem,
                                             const RollingSolution<dim>& s,
                                             std::span<const FunctionalDerivative<dim>> functions) {
  Stopwatch watch;
  const bool wants_radii = !problem.model().design_lines.empty();
  const SectorFields displacement = wants_radii ? complete_displacement(s) : SectorFields();
  auto adjoints =
      wants_radii ? solve_adjoints(problem, s, functions, displacement, s.ring.sector_factor().full_sweep())
                  : solve_adjoints(problem, s, functions);
  if (!adjoints) return adjoints.failure();
  const double adjoint_seconds = watch.lap();
  AdjointGradients result{{}, shape_gradients<dim>(problem, s, functions, *adjoints)};
  if (wants_radii)
    result.gradients.by_radius = radius_gradients<dim>(problem, s, displacement, functions, *adjoints);
  result.adjoints = *std::move(adjoints);
  result.gradients.phases = {{phase::adjoint, adjoint_seconds}, {phase::gradient, watch.lap()}};
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                \
  template std::vector<std::vector<double>> radius_gradients(                       \
      const RollingProblem<dim>&, const RollingSolution<dim>&, const SectorFields&, \
      std::span<const FunctionalDerivative<dim>>, std::span<const Adjoint>);        \
  template Expected<AdjointGradients> adjoint_gradients(                            \
      const RollingProblem<dim>&, const RollingSolution<dim>&, std::span<const FunctionalDerivative<dim>>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
