#include "wheelwright/shape/cut/cut_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "wheelwright/shape/cut/cell_quadrature.h"
#include "wheelwright/shape/geometry/finite.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {
namespace {

/// Moves nodal values away from zero, since a boundary that lies in a face of two cells would be integrated
/// twice.
template <int dim>
LevelSet<dim> nudged(const LevelSet<dim>& psi) {
  LevelSet<dim> result = psi;
  const double smallest = 1e-9 * psi.lattice.grid().resolution();
  for (double& value : result.values)
    if (std::abs(value) < smallest) value = value < 0 ? -smallest : smallest;
  return result;
}

/// Pieces of material below this fraction of the cell are neglected, because their quadrature is not
/// reliable.
constexpr double smallest_fraction = 1e-13;

template <int dim>
double material_fraction(const CutCell<dim>& cell) {
  double sum = 0;
  for (const auto& point : cell.material) sum += point.weight;
  return sum;
}

/// Calls visit(neighbour) for the face neighbours of a cell. At the faces of the sector these are images of
/// cells of the same sector.
template <int dim, class Visit>
void for_each_neighbour(const PolarGrid<dim>& grid, int cell, Visit visit) {
  const auto position = grid.cell_position(cell);
  for (int axis = 0; axis < dim; ++axis) {
    for (int step : {-1, 1}) {
      auto p = position;
      p[axis] += step;
      if (axis == 1) p[1] = (p[1] + grid.cells[1]) % grid.cells[1];
      if (p[axis] >= 0 && p[axis] < grid.cells[axis]) visit(grid.cell_index(p));
    }
  }
}

template <int dim>
std::string place(const PolarGrid<dim>& grid, int cell) {
  Vec<dim> middle;
  middle.fill(0.5);
  return place_text<dim>(grid.polar_point(grid.cell_position(cell), middle));
}

template <int dim>
std::optional<Failure> check_bands(const CutDomain<dim>& domain, int rim_rows, int tread_rows) {
  const PolarGrid<dim>& grid = domain.grid;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const int row = grid.cell_position(cell)[0];
    const bool at_rim = row < rim_rows, at_tread = row >= grid.cells[0] - tread_rows;
    if ((at_rim || at_tread) && domain.kinds[cell] != CellKind::inside)
      return Failure{FailureReason::protected_band,
                     fmt::format("a hole reaches the protected band at the {}: {}", at_rim ? "rim" : "tread",
                                 place(grid, cell))};
  }
  return {};
}

template <int dim>
std::optional<Failure> check_connected(const CutDomain<dim>& domain) {
  const PolarGrid<dim>& grid = domain.grid;
  std::vector<char> reached(domain.kinds.size(), 0);
  std::vector<int> front;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    if (grid.cell_position(cell)[0] > 0 || !domain.active(cell)) continue;
    reached[cell] = 1;
    front.push_back(cell);
  }
  while (!front.empty()) {
    const int cell = front.back();
    front.pop_back();
    for_each_neighbour(grid, cell, [&](int next) {
      if (domain.active(next) && !reached[next]) {
        reached[next] = 1;
        front.push_back(next);
      }
    });
  }
  int islands = 0, first = -1;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    if (!domain.active(cell) || reached[cell]) continue;
    if (grid.cell_position(cell)[0] + 1 == grid.cells[0])
      return Failure{FailureReason::tread_cut_off,
                     "holes join all around and cut the tread off from the rim"};
    if (islands++ == 0) first = cell;
  }
  if (islands == 0) return {};
  return Failure{
      FailureReason::disconnected_material,
      fmt::format("{} cells of a sector contain material that is not attached to the rim, the first at {}",
                  islands, place(grid, first))};
}

/// Whether the nodal values of psi change sign on the last face of `cell` along `axis`.
template <int dim>
bool face_is_crossed(const LevelSet<dim>& psi, int cell, int axis) {
  const int degree = psi.lattice.degree();
  const auto values = psi.cell_values(cell);
  bool negative = false, positive = false;
  for (int a = 0; a < static_cast<int>(values.size()); ++a) {
    if (local_node_position<dim>(degree, a)[axis] != degree) continue;
    (values[a] < 0 ? negative : positive) = true;
  }
  return negative && positive;
}

template <int dim>
std::vector<GhostFace> find_ghost_faces(const LevelSet<dim>& psi, const CutDomain<dim>& domain) {
  const PolarGrid<dim>& grid = domain.grid;
  std::vector<GhostFace> faces;
  for (int minus = 0; minus < grid.n_cells(); ++minus) {
    if (!domain.active(minus)) continue;
    for (int axis = 0; axis < dim; ++axis) {
      auto p = grid.cell_position(minus);
      p[axis] += 1;
      if (axis == 1) p[1] %= grid.cells[1];
      if (p[axis] >= grid.cells[axis]) continue;
      const int plus = grid.cell_index(p);
      if (!domain.active(plus)) continue;
      if (domain.kinds[minus] == CellKind::cut || domain.kinds[plus] == CellKind::cut)
        faces.push_back(
            {.minus = minus, .plus = plus, .axis = axis, .crossed = face_is_crossed(psi, minus, axis)});
    }
  }
  return faces;
}

/// Whether a shape has the same values at the nodes of a cell and of its mirror image in the middle of the
/// width.
template <int dim>
bool equals_image(const LevelSet<dim>& psi, int cell, int image) {
  const auto values = psi.cell_values(cell), there = psi.cell_values(image);
  const int degree = psi.lattice.degree();
  for (int a = 0; a < static_cast<int>(values.size()); ++a) {
    auto p = local_node_position<dim>(degree, a);
    p[dim - 1] = degree - p[dim - 1];
    int b = 0;
    for (int d = dim - 1; d >= 0; --d) b = b * (degree + 1) + p[d];
    if (values[a] != there[b]) return false;
  }
  return true;
}

/// The unit normal along the gradient of a cell's polynomial, in the coordinates of the unit cell.
template <int dim>
Vec<dim> reference_normal(std::span<const double> values, int degree, const Vec<dim>& xi) {
  const ShapeFunctions<dim> shape(degree, xi);
  Vec<dim> gradient{};
  for (std::size_t a = 0; a < values.size(); ++a) gradient += values[a] * shape.gradient[a];
  return gradient / norm(gradient);
}

/// The edges of the boundary in the side faces of the wheel, in one cell, by the quadrature of its faces.
/// False if it cannot be found.
bool add_edges(const LevelSet<2>&, const CellQuadrature<2>&, CutCell<2>&) { return true; }
bool add_edges(const LevelSet<3>& psi, const CellQuadrature<2>& faces, CutCell<3>& cut) {
  const int degree = psi.lattice.degree(), n_nodes = nodes_per_cell<2>(degree);
  const PolarGrid<3>& grid = psi.lattice.grid();
  const auto values = psi.cell_values(cut.cell);
  for (const int end : {0, 1}) {
    if (grid.cell_position(cut.cell)[2] != (end == 0 ? 0 : grid.cells[2] - 1)) continue;
    const auto on_face = std::span(values).subspan(end * degree * n_nodes, n_nodes);
    if (faces.classify(on_face) != CellKind::cut) continue;
    const auto split = faces.split(cut.cell, on_face);
    if (!split) return false;
    for (const auto& q : split->boundary) {
      const Vec<3> xi{q.xi[0], q.xi[1], static_cast<double>(end)};
      cut.edges.push_back({xi, reference_normal<3>(values, degree, xi), end == 0 ? -1.0 : 1.0, q.weight});
    }
  }
  return true;
}

/// The quadrature of a cell's mirror image in the middle of the width.
template <int dim>
CutCell<dim> reflected(CutCell<dim> cut, int image) {
  cut.cell = image;
  for (auto& point : cut.material) point.xi[dim - 1] = 1 - point.xi[dim - 1];
  for (auto& point : cut.boundary) {
    point.xi[dim - 1] = 1 - point.xi[dim - 1];
    point.normal[dim - 1] = -point.normal[dim - 1];
  }
  for (auto& point : cut.edges) {
    point.xi[dim - 1] = 1 - point.xi[dim - 1];
    point.normal[dim - 1] = -point.normal[dim - 1];
    point.outward = -point.outward;
  }
  return cut;
}

/// In 3D, an earlier cell of the same shape that is the cell's mirror image in the middle of the width, if
/// there is one. Reusing its quadrature makes both symmetric to the last bit.
template <int dim>
std::optional<int> earlier_image(const LevelSet<dim>& psi, int cell) {
  if constexpr (dim == 2) return {};
  const int image = mirror_image(psi.lattice.grid(), cell, MirrorPlane::width);
  return image < cell && equals_image(psi, cell, image) ? std::optional(image) : std::nullopt;
}

}  // namespace

template <int dim>
Expected<CutDomain<dim>> cut_domain(const LevelSet<dim>& given, int points) {
  if (auto failure = check_finite<dim>(given.lattice, given.values, "the level set")) return *failure;
  const LevelSet<dim> psi = nudged(given);
  const PolarGrid<dim>& grid = psi.lattice.grid();
  CutDomain<dim> domain{
      .grid = grid, .kinds = std::vector<CellKind>(grid.n_cells()), .cut = {}, .ghost_faces = {}};
  const CellQuadrature<dim> quadrature(psi.lattice.degree(), points);
  const CellQuadrature<2> faces(psi.lattice.degree(), points);
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    if (const auto image = earlier_image(psi, cell)) {
      domain.kinds[cell] = domain.kinds[*image];
      if (domain.kinds[cell] == CellKind::cut)
        domain.cut.push_back(
            reflected(*std::ranges::lower_bound(domain.cut, *image, {}, &CutCell<dim>::cell), cell));
      continue;
    }
    const auto values = psi.cell_values(cell);
    domain.kinds[cell] = quadrature.classify(values);
    if (domain.kinds[cell] != CellKind::cut) continue;
    auto split = quadrature.split(cell, values);
    if (!split || !add_edges(psi, faces, *split))
      return Failure{
          FailureReason::cut_quadrature,
          fmt::format("the quadrature of the cell at {} misses the divergence theorem", place(grid, cell))};
    const double fraction = material_fraction(*split);
    if (fraction < smallest_fraction) {
      domain.kinds[cell] = CellKind::outside;
    } else if (split->boundary.empty() && fraction > 1 - 1e-9) {
      domain.kinds[cell] = CellKind::inside;
    } else {
      domain.cut.push_back(*std::move(split));
    }
  }
  domain.ghost_faces = find_ghost_faces(psi, domain);
  return domain;
}

CutDomain<3> first_half(const CutDomain<3>& whole) {
  CutDomain<3> half{.grid = first_half(whole.grid), .kinds = {}, .cut = {}, .ghost_faces = {}};
  const auto number = [&](int cell) {
    const auto p = whole.grid.cell_position(cell);
    return p[2] < half.grid.cells[2] ? half.grid.cell_index(p) : -1;
  };
  for (int cell = 0; cell < whole.grid.n_cells(); ++cell)
    if (number(cell) >= 0) half.kinds.push_back(whole.kinds[cell]);
  for (CutCell<3> cut : whole.cut) {
    cut.cell = number(cut.cell);
    if (cut.cell >= 0) half.cut.push_back(std::move(cut));
  }
  for (GhostFace face : whole.ghost_faces) {
    const int minus = number(face.minus), plus = number(face.plus);
    if (minus < 0) continue;
    face.minus = minus;
    face.plus = plus < 0 ? minus : plus;
    half.ghost_faces.push_back(face);
  }
  return half;
}

template <int dim>
std::optional<Failure> check_attached(const CutDomain<dim>& domain, int rim_rows, int tread_rows) {
  if (auto failure = check_bands(domain, rim_rows, tread_rows)) return failure;
  return check_connected(domain);
}

template decltype(cut_domain<2>) cut_domain<2>;
template decltype(cut_domain<3>) cut_domain<3>;
template decltype(check_attached<2>) check_attached<2>;
template decltype(check_attached<3>) check_attached<3>;

}  // namespace wheelwright
