#include "wheelwright/mechanics/heat/conduction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/heat/scalar_element.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {
namespace {

constexpr double largest_residual = 1e-9;  ///< by the terms of the equation

/// The size of the cells of a row across their faces normal to an axis [m].
template <int dim>
double size_across(const PolarGrid<dim>& grid, int row, int axis) {
  return axis == 1 ? grid.column_angle() * grid.middle_of_row(row) : grid.cell_size(row)[axis];
}

template <int dim>
ScalarElement<dim> element_of_row(const PolarGrid<dim>& grid, int degree, int row) {
  return {grid, degree, std::array<int, dim>{row}};
}

/// The forms of one kind on the cells of a sector: one for all full cells of a row, one per cut cell.
template <int dim>
class CellForms {
 public:
  /// `form`: of a cell in a row with a quadrature.
  template <class Form>
  CellForms(const CutDomain<dim>& domain, int points, Form form)
      : domain_(domain), full_(domain.grid.cells[0]), cut_(domain.cut.size()) {
    const auto rule = unit_cell_rule<dim>(points);
    for (int row = 0; row < domain.grid.cells[0]; ++row) full_[row] = form(row, rule);
    parallel_for(static_cast<int>(cut_.size()), [&](int i) {
      cut_[i] = form(domain.grid.cell_position(domain.cut[i].cell)[0], domain.cut[i].material);
    });
  }

  /// Calls visit(cell, form) for every cell with material.
  template <class Visit>
  void for_each(Visit visit) const {
    for (int cell = 0; cell < domain_.grid.n_cells(); ++cell)
      if (domain_.kinds[cell] == CellKind::inside) visit(cell, full_[domain_.grid.cell_position(cell)[0]]);
    for (std::size_t i = 0; i < cut_.size(); ++i)
      if (domain_.active(domain_.cut[i].cell)) visit(domain_.cut[i].cell, cut_[i]);
  }

 private:
  const CutDomain<dim>& domain_;
  std::vector<Matrix> full_, cut_;
};

}  // namespace

template <int dim>
bool has_conductivities(const Materials<dim>& materials) {
  return std::ranges::all_of(materials.layers(),
                             [](const auto& layer) { return layer.law->conductivity().has_value(); });
}

template <int dim>
Conduction<dim>::Conduction(const RollingModel<dim>& model, const CutDomain<dim>& domain)
    : lattice_(domain.grid, model.degree),
      has_given_rim_(model.cooling->rim_temperature.has_value()),
      is_active_(lattice_.n_nodes(), false) {
  for (auto& weights : exchange_) weights.assign(lattice_.n_nodes(), 0.0);
  add_material(model, domain);
  add_surfaces(model, domain);
  if (model.ghost.xi > 0) add_penalties(model, domain);
}

template <int dim>
auto Conduction<dim>::cell_nodes(int cell) const -> Nodes {
  const auto place = lattice_.grid().cell_position(cell);
  Nodes nodes(nodes_per_cell<dim>(lattice_.degree()));
  for (int a = 0; a < static_cast<int>(nodes.size()); ++a)
    nodes[a] = lattice_.node_index(lattice_.cell_node(place, a));
  return nodes;
}

template <int dim>
void Conduction<dim>::add(const Nodes& nodes, double factor, const Matrix& form) {
  for (int j = 0; j < form.columns(); ++j)
    for (int i = 0; i < form.rows(); ++i)
      if (nodes[i] >= nodes[j]) entries_.push_back({nodes[i], nodes[j], factor * form(i, j)});
}

template <int dim>
void Conduction<dim>::add_exchange(CooledSurface surface, const Nodes& nodes, double coefficient,
                                   const Matrix& form) {
  add(nodes, coefficient, form);
  std::vector<double>& weights = exchange_[static_cast<int>(surface)];
  for (int j = 0; j < form.columns(); ++j)  // the shape functions add up to 1
    for (int i = 0; i < form.rows(); ++i) weights[nodes[i]] += coefficient * form(i, j);
}

template <int dim>
void Conduction<dim>::add_material(const RollingModel<dim>& model, const CutDomain<dim>& domain) {
  const PolarGrid<dim>& grid = domain.grid;
  const int points = model.degree + 2;
  const auto element = [&](int row) { return element_of_row(grid, model.degree, row); };
  const CellForms<dim> conduction(domain, points, [&](int row, std::span<const ReferencePoint<dim>> rule) {
    return gradient_form<dim>(element(row), rule);
  });
  conduction.for_each([&](int cell, const Matrix& form) {
    const Nodes nodes = cell_nodes(cell);
    for (const int node : nodes) is_active_[node] = true;
    add(nodes, *model.materials.in_row(grid, grid.cell_position(cell)[0]).conductivity(), form);
  });
  if (dim == 3 || model.cooling->side_faces == 0) return;
  const CellForms<dim> sink(domain, points, [&](int row, std::span<const ReferencePoint<dim>> rule) {
    return mass_form<dim>(element(row), rule);
  });
  sink.for_each([&](int cell, const Matrix& form) {
    add_exchange(CooledSurface::side_faces, cell_nodes(cell), 2 * model.cooling->side_faces / grid.width,
                 form);
  });
}

template <int dim>
void Conduction<dim>::add_surfaces(const RollingModel<dim>& model, const CutDomain<dim>& domain) {
  const PolarGrid<dim>& grid = domain.grid;
  const Cooling& cooling = *model.cooling;
  const int last_row = grid.cells[0] - 1, points = model.degree + 2;
  const auto element = [&](int row) { return element_of_row(grid, model.degree, row); };
  if (cooling.tread > 0) {
    const Matrix form = surface_form<dim>(element(last_row), face_rule<dim>(0, 1, points));
    for (int cell = last_row; cell < grid.n_cells(); cell += grid.cells[0])
      add_exchange(CooledSurface::tread, cell_nodes(cell), cooling.tread, form);
  }
  if (cooling.holes > 0)
    for (const CutCell<dim>& cut : domain.cut)
      if (!cut.boundary.empty())
        add_exchange(CooledSurface::holes, cell_nodes(cut.cell), cooling.holes,
                     surface_form<dim>(element(grid.cell_position(cut.cell)[0]), cut.boundary));
  if constexpr (dim == 3) {
    if (cooling.side_faces == 0) return;
    for (const int end : {0, 1}) {
      const int axial = end == 0 ? 0 : grid.cells[2] - 1;
      const auto add_face = [&](int cell, std::span<const ReferenceSurfacePoint<3>> rule) {
        const auto place = grid.cell_position(cell);
        if (place[2] == axial)
          add_exchange(CooledSurface::side_faces, cell_nodes(cell), cooling.side_faces,
                       surface_form<3>(element(place[0]), rule));
      };
      const auto whole = face_rule<3>(2, end, points);
      for (int cell = 0; cell < grid.n_cells(); ++cell)
        if (domain.kinds[cell] == CellKind::inside) add_face(cell, whole);
      for (const CutCell<3>& cut : domain.cut) add_face(cut.cell, side_face_rule(cut, end));
    }
  }
}

template <int dim>
void Conduction<dim>::add_penalties(const RollingModel<dim>& model, const CutDomain<dim>& domain) {
  const PolarGrid<dim>& grid = domain.grid;
  std::vector<Matrix> of_faces(static_cast<std::size_t>(dim) * grid.cells[0]), fillings(grid.cells[0]);
  const auto rule = unit_cell_rule<dim>(model.degree + 2);
  for (const GhostFace& face : domain.ghost_faces) {
    if (model.ghost.kind == GhostPenaltyKind::paper && !face.crossed) continue;
    const int row = grid.cell_position(face.minus)[0];
    if (face.axis == 0 && model.materials.is_interface(grid, row)) {
      // The derivatives jump: as ElementTable::filling().
      for (const int cell : {face.minus, face.plus}) {
        if (domain.kinds[cell] != CellKind::cut) continue;
        const int of_cell = grid.cell_position(cell)[0];
        Matrix& form = fillings[of_cell];
        if (form.rows() == 0) form = gradient_form<dim>(element_of_row(grid, model.degree, of_cell), rule);
        add(cell_nodes(cell), 1e-6 * *model.materials.in_row(grid, of_cell).conductivity(), form);
      }
      continue;
    }
    Matrix& form = of_faces[dim * row + face.axis];
    if (form.rows() == 0) {
      const int plus = face.axis == 0 ? row + 1 : row;
      form = jump_form<dim>(element_of_row(grid, model.degree, row), element_of_row(grid, model.degree, plus),
                            face.axis, face.axis == 1 ? grid.column_angle() : 0,
                            0.5 * (size_across(grid, row, face.axis) + size_across(grid, plus, face.axis)),
                            model.ghost);
    }
    Nodes nodes = cell_nodes(face.minus);
    const Nodes plus = cell_nodes(face.plus);
    nodes.insert(nodes.end(), plus.begin(), plus.end());
    add(nodes, *model.materials.in_row(grid, row).conductivity(), form);
  }
}

template <int dim>
std::vector<double> Conduction<dim>::times(const std::vector<double>& field) const {
  std::vector<double> result(field.size(), 0.0);
  for (const auto& [row, column, value] : entries_) {
    result[row] += value * field[column];
    if (row != column) result[column] += value * field[row];
  }
  return result;
}

template <int dim>
Expected<ConductionSolver<dim>> ConductionSolver<dim>::create(Conduction<dim> conduction) {
  std::vector<int> unknowns(conduction.lattice().n_nodes(), -1);
  int n = 0;
  for (std::size_t node = 0; node < unknowns.size(); ++node)
    if (conduction.is_active(static_cast<int>(node)) &&
        !(conduction.has_given_rim() && conduction.is_at_rim(static_cast<int>(node))))
      unknowns[node] = n++;
  std::vector<SparseSpd::Entry> entries;
  for (const auto& [row, column, value] : conduction.entries())
    if (unknowns[row] >= 0 && unknowns[column] >= 0)
      entries.push_back({unknowns[row], unknowns[column], value});
  auto factor = SparseSpd::factor(n, entries);
  if (!factor) return factor.failure();
  return ConductionSolver(std::move(conduction), std::move(unknowns), *std::move(factor));
}

template <int dim>
Expected<TemperatureField<dim>> ConductionSolver<dim>::solve(const std::vector<double>& loads,
                                                             const std::vector<double>& at_rim) const {
  TemperatureField<dim> field{conduction_.lattice(), std::vector<double>(unknowns_.size(), 0.0)};
  if (conduction_.has_given_rim())
    for (std::size_t node = 0; node < unknowns_.size(); ++node)
      if (conduction_.is_at_rim(static_cast<int>(node))) field.values[node] = at_rim[node];
  const std::vector<double> of_rim = conduction_.times(field.values);
  std::vector<double> right_hand_side;
  for (std::size_t node = 0; node < unknowns_.size(); ++node)
    if (unknowns_[node] >= 0) right_hand_side.push_back(loads[node] - of_rim[node]);
  const std::vector<double> solution = factor_.solve(right_hand_side);
  for (std::size_t node = 0; node < unknowns_.size(); ++node)
    if (unknowns_[node] >= 0) field.values[node] = solution[unknowns_[node]];

  const std::vector<double> balance = conduction_.times(field.values);
  double residual = 0, largest = 0;
  for (std::size_t node = 0; node < unknowns_.size(); ++node) {
    if (unknowns_[node] < 0) continue;
    largest = std::max(largest, std::abs(loads[node]));
    residual = std::max(residual, std::abs(balance[node] - loads[node]));
  }
  for (const auto& [row, column, value] : conduction_.entries())
    largest = std::max(largest, std::abs(value * field.values[column]));
  if (!std::ranges::all_of(field.values, [](double value) { return std::isfinite(value); }))
    return Failure{FailureReason::not_finite, "a temperature is not a finite number"};
  if (residual > largest_residual * largest)
    return Failure{
        FailureReason::inaccurate_solution,
        fmt::format("the conduction of heat has the relative residual {:.1e}", residual / largest)};
  return field;
}

#define WHEELWRIGHT_INSTANTIATE(dim)    \
  template class Conduction<dim>;       \
  template class ConductionSolver<dim>; \
  template decltype(has_conductivities<dim>) has_conductivities<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
