#include "wheelwright/mechanics/elasticity/sector_stiffness.h"

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/elasticity/cord.h"

namespace wheelwright {
namespace {

/// The law whose stress enters the ghost penalty in place of that of a nearly incompressible material. The
/// penalty must control displacements on slivers, for which the stress of a compressible material is enough:
/// that of lambda itself would stiffen cells far more, and J would jump where faces with ghost penalty
/// appear.
template <int dim>
std::optional<IsotropicLaw<dim>> compressible_law(const MaterialLaw<dim>& law) {
  constexpr double largest = 0.48;
  if (!law.isotropic() || law.isotropic()->plane_strain_equivalent().poissons_ratio <= largest) return {};
  Material material = *law.isotropic();
  material.poissons_ratio = largest;
  return IsotropicLaw<dim>(material);
}

/// Adds a stiffness, which may be empty.
void add(const Matrix& more, Matrix& sum) {
  for (size_t i = 0; i < more.entries().size(); ++i) sum.data()[i] += more.data()[i];
}

}  // namespace

template <int dim>
ElementTable<dim>::ElementTable(const PolarGrid<dim>& grid, int degree, const Materials<dim>& materials,
                                const GhostPenalty& ghost, CellStiffness<dim>* bulk, SideFaces sides,
                                DilatationKind dilatation)
    : grid_(grid),
      degree_(degree),
      materials_(materials),
      ghost_(ghost),
      bulk_(bulk),
      sides_(sides),
      dilatation_(dilatation) {
  const auto rule = unit_cell_rule<dim>(degree + 2);
  for (int radial = 0; radial < grid.cells[0]; ++radial) {
    elements_.emplace_back(grid, degree, std::array<int, dim>{radial}, law(radial), dilatation);
    stiffness_.push_back(bulk(elements_.back(), law(radial), rule));
    fillings_.push_back(stiffness_.back());
    for (double& x : fillings_.back().entries()) x *= 1e-6;
    const double cords = materials.cords_on(grid, radial);
    cords_.push_back(cords > 0 ? wheelwright::cord_stiffness<dim>(elements_.back(), cords) : Matrix());
    add(cords_.back(), stiffness_.back());
  }
  const double column_angle = grid.column_angle();
  for (int radial = 0; radial < grid.cells[0]; ++radial) {
    const auto compressible = compressible_law<dim>(law(radial));
    const MaterialLaw<dim>& ghost_law = compressible ? *compressible : law(radial);
    for (int axis = 0; axis < dim; ++axis) {
      const int plus = axis == 0 ? std::min(radial + 1, grid.cells[0] - 1) : radial;
      ghosts_.push_back(ghost_stiffness<dim>(elements_[radial], elements_[plus], axis,
                                             axis == 1 ? column_angle : 0.0, ghost_law, ghost));
    }
    divided_ghosts_.push_back(
        divided_ghost_stiffness<dim>(elements_[radial], column_angle, ghost_law, ghost));
    if constexpr (dim == 3)
      ghosts_at_middle_.push_back(half_of_symmetric_pair(face_ghost(radial, 2), degree));
  }
}

template <int dim>
SectorStiffness<dim> sector_stiffness(const CutDomain<dim>& domain, const ElementTable<dim>& table,
                                      int core_rows) {
  const PolarGrid<dim>& grid = domain.grid;
  SectorStiffness<dim> sector{
      SectorSpace<dim>(domain, table.degree(), core_rows, table.sides(), table.ghost()), {}, {}};
  using Face = typename SectorSpace<dim>::Face;
  const SectorSpace<dim>& space = sector.space;

  typename StencilMatrix<dim>::Pattern pattern(space);
  std::vector<std::vector<int>> cell_nodes(grid.n_cells());
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    if (!domain.active(cell) || grid.cell_position(cell)[0] >= core_rows) continue;
    cell_nodes[cell] = space.cell_nodes(cell);
    pattern.couple(cell_nodes[cell]);
  }
  for (const GhostFace& face : domain.ghost_faces) {
    if (!space.penalizes(face) || table.ghost().xi == 0) continue;
    const int radial = grid.cell_position(face.minus)[0];
    const auto add = [&](std::vector<int> nodes, const Matrix& stiffness) {
      pattern.couple(nodes);
      sector.ghosts.push_back({std::move(nodes), &stiffness});
    };
    const bool derivatives_jump =
        table.materials().is_interface(grid, radial) || !table.cord_stiffness(radial).entries().empty();
    if (face.axis == 0 && derivatives_jump) {
      for (const int cell : {face.minus, face.plus})
        if (domain.kinds[cell] == CellKind::cut)
          add(space.cell_nodes(cell), table.filling(grid.cell_position(cell)[0]));
      continue;
    }
    if (space.wraps(face)) {
      const GhostHalves& halves = table.divided_face_ghost(radial);
      add(space.cell_and_face_nodes(face.minus, Face::last), halves.minus);
      add(space.cell_and_face_nodes(face.plus, Face::first), halves.plus);
      continue;
    }
    auto nodes = space.cell_nodes(face.minus);
    if (face.axis == 2 && face.minus == face.plus) {
      add(std::move(nodes), table.ghost_at_middle(radial));
      continue;
    }
    const auto plus = space.cell_nodes(face.plus);
    nodes.insert(nodes.end(), plus.begin(), plus.end());
    add(std::move(nodes), table.face_ghost(radial, face.axis));
  }

  StencilMatrix<dim> matrix(std::move(pattern));
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    if (domain.kinds[cell] == CellKind::inside && !cell_nodes[cell].empty())
      matrix.add(cell_nodes[cell], table.full_cell_stiffness(grid.cell_position(cell)[0]));
  std::vector<Matrix> cut_stiffness(domain.cut.size());
  parallel_for(static_cast<int>(domain.cut.size()), [&](int i) {
    const CutCell<dim>& cut = domain.cut[i];
    const int radial = grid.cell_position(cut.cell)[0];
    cut_stiffness[i] = table.bulk_stiffness(table.element(radial), table.law(radial), cut.material);
    add(table.cord_stiffness(radial), cut_stiffness[i]);
  });
  for (size_t i = 0; i < domain.cut.size(); ++i) matrix.add(cell_nodes[domain.cut[i].cell], cut_stiffness[i]);
  for (const auto& ghost : sector.ghosts) matrix.add(ghost.nodes, *ghost.stiffness);
  matrix.hold(table.held_stiffness());
  sector.matrix = std::move(matrix).release();
  return sector;
}

template class ElementTable<2>;
template class ElementTable<3>;
template decltype(sector_stiffness<2>) sector_stiffness<2>;
template decltype(sector_stiffness<3>) sector_stiffness<3>;

}  // namespace wheelwright
