#include "wheelwright/mechanics/equilibrium/ring_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "wheelwright/base/periodic.h"

namespace wheelwright {

template <int dim>
RingForms<dim>::RingForms(const CutDomain<dim>& domain, const HyperelasticTable<dim>& table)
    : domain_(domain), table_(table), space_(domain, table.degree()) {
  const PolarGrid<dim>& grid = domain.grid;
  cut_.reserve(domain.cut.size());
  auto cut = domain.cut.begin();
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const int row = grid.cell_position(cell)[0];
    if (domain.kinds[cell] == CellKind::inside) {
      cells_.push_back({cell, row, &table.full_cell(row)});
    } else if (cut != domain.cut.end() && cut->cell == cell) {
      cut_.push_back(table.element(row).points((cut++)->material));
      cells_.push_back({cell, row, &cut_.back()});
    }
  }
  for (const GhostFace& face : domain.ghost_faces) {
    if (table.ghost().xi == 0 || (table.ghost().kind == GhostPenaltyKind::paper && !face.crossed)) continue;
    const auto place = grid.cell_position(face.minus);
    if (face.axis == 0 && table.is_interface(place[0])) {
      for (const int cell : {face.minus, face.plus})
        if (domain.kinds[cell] == CellKind::cut)
          couplings_.push_back({cell, cell, false, &table.filling(grid.cell_position(cell)[0])});
    } else {
      couplings_.push_back({face.minus, face.plus, face.axis == 1 && place[1] == grid.columns() - 1,
                            &table.face_ghost(place[0], face.axis)});
    }
  }
  build_pattern();
}

template <int dim>
std::vector<int> RingForms<dim>::coupled_nodes(const Coupling& coupling, int sector) const {
  auto nodes = space_.cell_nodes(coupling.minus, sector);
  if (coupling.plus == coupling.minus && !coupling.into_next_sector) return nodes;
  const auto plus = space_.cell_nodes(coupling.plus, sector + coupling.into_next_sector);
  nodes.insert(nodes.end(), plus.begin(), plus.end());
  return nodes;
}

template <int dim>
void RingForms<dim>::build_pattern() {
  const int per_sector = space_.n_nodes_of_sector(), n = space_.n_nodes();
  // What a node of one sector is coupled with, by differences of numbers, which wrap around the ring.
  std::vector<std::vector<int>> differences(per_sector);
  const auto couple = [&](const std::vector<int>& nodes) {
    for (const int a : nodes)
      for (const int b : nodes)
        if (a >= 0 && b >= 0 && a != b) differences[a % per_sector].push_back(wrap(b - a, n));
  };
  for (const Cell& cell : cells_) couple(space_.cell_nodes(cell.cell, 0));
  for (const Coupling& coupling : couplings_) couple(coupled_nodes(coupling, 0));
  for (auto& of_node : differences) {
    std::ranges::sort(of_node);
    of_node.erase(std::unique(of_node.begin(), of_node.end()), of_node.end());
  }
  neighbour_start_.assign(1, 0);
  neighbours_.clear();
  std::vector<int> larger;
  for (int a = 0; a < n; ++a) {
    larger.clear();
    for (const int difference : differences[a % per_sector])
      if (const int b = (a + difference) % n; b > a) larger.push_back(b);
    std::ranges::sort(larger);
    neighbours_.insert(neighbours_.end(), larger.begin(), larger.end());
    neighbour_start_.push_back(static_cast<int>(neighbours_.size()));
  }
  ghost_matrix_.size = space_.n_dofs();
  ghost_matrix_.column_start.assign(1, 0);
  ghost_matrix_.rows.reserve(size_t(dim) * dim * (neighbours_.size() + n));
  for (int a = 0; a < n; ++a)
    for (int c = 0; c < dim; ++c) {
      for (int r = c; r < dim; ++r) ghost_matrix_.rows.push_back(dim * a + r);
      for (int k = neighbour_start_[a]; k < neighbour_start_[a + 1]; ++k)
        for (int r = 0; r < dim; ++r) ghost_matrix_.rows.push_back(dim * neighbours_[k] + r);
      ghost_matrix_.column_start.push_back(static_cast<int>(ghost_matrix_.rows.size()));
    }
  ghost_matrix_.values.assign(ghost_matrix_.rows.size(), 0.0);
  for (int sector = 0; sector < domain_.grid.n_sectors; ++sector)
    for (const Coupling& coupling : couplings_) {
      const auto nodes = coupled_nodes(coupling, sector);
      add_block(nodes, coupling.stiffness->data(), coupling.stiffness->rows(), ghost_matrix_.values);
    }
}

template <int dim>
int RingForms<dim>::neighbour_index(int a, int b) const {
  const auto first = neighbours_.begin() + neighbour_start_[a],
             last = neighbours_.begin() + neighbour_start_[a + 1];
  return static_cast<int>(std::lower_bound(first, last, b) - first);
}

template <int dim>
void RingForms<dim>::add_block(std::span<const int> nodes, const double* block, int stride,
                               std::vector<double>& values) const {
  for (size_t i = 0; i < nodes.size(); ++i) {
    const int a = nodes[i];
    if (a < 0) continue;
    const int* column_start = &ghost_matrix_.column_start[dim * a];
    for (size_t j = 0; j < nodes.size(); ++j) {
      const int b = nodes[j];
      if (b < a) continue;
      const double* from = block + dim * i * stride + dim * j;
      if (a == b && i == j) {
        for (int c = 0; c < dim; ++c)
          for (int r = c; r < dim; ++r) values[column_start[c] + r - c] += from[size_t(c) * stride + r];
      } else if (a == b) {  // a node that both cells of a face have
        if (j > i)
          for (int c = 0; c < dim; ++c)
            for (int r = c; r < dim; ++r)
              values[column_start[c] + r - c] +=
                  from[size_t(c) * stride + r] + block[(dim * i + r) * size_t(stride) + dim * j + c];
      } else {
        const int index = neighbour_index(a, b);
        for (int c = 0; c < dim; ++c) {
          double* to = &values[column_start[c] + dim - c + dim * index];
          for (int r = 0; r < dim; ++r) to[r] += from[size_t(c) * stride + r];
        }
      }
    }
  }
}

template <int dim>
double RingForms<dim>::energy(const std::vector<double>& v) const {
  double sum = 0;
  typename HyperelasticElement<dim>::Dofs dofs;
  for (int sector = 0; sector < domain_.grid.n_sectors; ++sector)
    for (const Cell& cell : cells_) {
      space_.gather(cell.cell, sector, v.data(), dofs.data());
      sum += element(cell).energy(*cell.points, dofs.data());
    }
  return sum;
}

template <int dim>
void RingForms<dim>::add_ghost_forces(const std::vector<double>& v, Forces& forces) const {
  forces.ghost.assign(space_.n_dofs(), 0.0);
  ghost_matrix_.add_product(v.data(), forces.ghost.data());
  forces.ghost_energy = 0;
  for (size_t i = 0; i < v.size(); ++i) forces.ghost_energy += 0.5 * v[i] * forces.ghost[i];
}

template <int dim>
auto RingForms<dim>::forces(const std::vector<double>& v) const -> Forces {
  Forces result{0, 0, std::vector<double>(space_.n_dofs(), 0.0), {}};
  typename HyperelasticElement<dim>::Dofs dofs, of_cell;
  for (int sector = 0; sector < domain_.grid.n_sectors; ++sector)
    for (const Cell& cell : cells_) {
      space_.gather(cell.cell, sector, v.data(), dofs.data());
      result.energy += element(cell).forces(*cell.points, dofs.data(), of_cell);
      if (!result.admissible()) return result;
      space_.scatter(cell.cell, sector, of_cell.data(), result.internal.data());
    }
  add_ghost_forces(v, result);
  return result;
}

template <int dim>
auto RingForms<dim>::tangent(const std::vector<double>& v, SparseSymmetric& matrix) const -> Forces {
  if (matrix.rows.empty()) matrix = ghost_matrix_;
  matrix.values = ghost_matrix_.values;
  Forces result{0, 0, std::vector<double>(space_.n_dofs(), 0.0), {}};
  typename HyperelasticElement<dim>::Dofs dofs, of_cell;
  const auto block = std::make_unique<typename HyperelasticElement<dim>::Block>();
  for (int sector = 0; sector < domain_.grid.n_sectors; ++sector)
    for (const Cell& cell : cells_) {
      const auto nodes = space_.cell_nodes(cell.cell, sector);
      for (size_t a = 0; a < nodes.size(); ++a)
        for (int c = 0; c < dim; ++c) dofs[dim * a + c] = nodes[a] < 0 ? 0 : v[space_.dof(nodes[a], c)];
      result.energy += element(cell).tangent(*cell.points, dofs.data(), of_cell, *block);
      if (!result.admissible()) return result;
      for (size_t a = 0; a < nodes.size(); ++a)
        for (int c = 0; nodes[a] >= 0 && c < dim; ++c)
          result.internal[space_.dof(nodes[a], c)] += of_cell[dim * a + c];
      add_block(nodes, block->data(), element(cell).n_dofs(), matrix.values);
    }
  add_ghost_forces(v, result);
  return result;
}

template class RingForms<2>;
template class RingForms<3>;

}  // namespace wheelwright
