#include "wheelwright/quantities/analysis/deformation_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>

#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {
namespace {

template <int dim>
Lattice<dim> displacement_lattice(const StateSolver<dim>& solver) {
  return {solver.model().grid, solver.model().degree};
}

/// A point of an edge, with the nodes of its cell and the values of their shape functions.
struct EdgePoint {
  Vec<2> x;
  RingCellNodes<2> nodes;
  std::array<double, ShapeFunctions<2>::max_nodes> shape;
};

EdgePoint edge_point(const Vec<2>& x, const Lattice<2>& lattice) {
  const PolarGrid<2>& grid = lattice.grid();
  const double azimuth = std::atan2(x[1], x[0]),
               turn = azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth;
  const double along[2] = {grid.line_at(norm<2>(x)), turn / grid.column_angle()};
  const int cells[2] = {grid.cells[0], grid.ring_columns()};
  std::array<int, 2> cell;
  Vec<2> xi;
  for (int d = 0; d < 2; ++d) {
    cell[d] = std::clamp(static_cast<int>(along[d]), 0, cells[d] - 1);
    xi[d] = std::clamp(along[d] - cell[d], 0.0, 1.0);
  }
  return {x, ring_cell_nodes<2>(lattice, cell), ShapeFunctions<2>(lattice.degree(), xi).value};
}

Vec<2> deformed(const EdgePoint& point, const RingField& u, int n_nodes) {
  const std::span nodes(point.nodes.data(), static_cast<size_t>(n_nodes));
  const std::span shape(point.shape.data(), static_cast<size_t>(n_nodes));
  return {point.x[0] + interpolate(u, nodes, shape, 0), point.x[1] + interpolate(u, nodes, shape, 1)};
}

struct Side {
  Vec<2> from, to;
  size_t curve, index;  ///< of its curve, and along it
};

double turn(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) { return cross(b - a, c - a); }

/// Whether the inner parts of two sides cross.
bool cross(const Side& a, const Side& b) {
  return turn(a.from, a.to, b.from) * turn(a.from, a.to, b.to) < 0 &&
         turn(b.from, b.to, a.from) * turn(b.from, b.to, a.to) < 0;
}

/// Whether sides of closed polylines cross, other than neighbours. Sides are sorted into squares as wide as
/// the longest of them, so that each meets those of nine squares at most.
bool any_cross(const std::vector<std::vector<Vec<2>>>& curves) {
  std::vector<Side> sides;
  double longest = 0;
  for (size_t c = 0; c < curves.size(); ++c)
    for (size_t k = 0; k < curves[c].size(); ++k) {
      const Side side{curves[c][k], curves[c][(k + 1) % curves[c].size()], c, k};
      longest = std::max(longest, distance(side.from, side.to));
      sides.push_back(side);
    }
  const auto square = [&](double x) { return static_cast<std::int64_t>(std::floor(x / longest)); };
  const auto key = [](std::int64_t i, std::int64_t j) { return i * 4294967291 + j; };
  std::unordered_map<std::int64_t, std::vector<size_t>> squares;
  for (size_t s = 0; s < sides.size(); ++s) {
    const std::int64_t i = square(sides[s].from[0]), j = square(sides[s].from[1]);
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        if (const auto found = squares.find(key(i + di, j + dj)); found != squares.end())
          for (const size_t t : found->second)
            if (cross(sides[s], sides[t])) return true;
    squares[key(i, j)].push_back(s);
  }
  return false;
}

using Edge = std::vector<EdgePoint>;

/// The edges of the material in 2D; not implemented in 3D.
std::vector<Edge> edges(const LevelSet<2>& psi, const Lattice<2>& lattice) {
  std::vector<Edge> result;
  for (const Contour& contour : material_contours(psi, 2)) {
    Edge& edge = result.emplace_back();
    for (const Vec<2>& x : contour.points) edge.push_back(edge_point(x, lattice));
  }
  return result;
}
std::vector<Edge> edges(const LevelSet<3>&, const Lattice<3>&) { return {}; }

/// Whether edges that a field of the ring deforms cross each other or themselves.
bool cross_deformed(const std::vector<Edge>& edges, const RingField& u, int nodes_per_cell) {
  std::vector<std::vector<Vec<2>>> curves;
  for (const Edge& edge : edges) {
    auto& curve = curves.emplace_back();
    for (const EdgePoint& point : edge) curve.push_back(deformed(point, u, nodes_per_cell));
  }
  return any_cross(curves);
}

}  // namespace

template <int dim>
bool edges_overlap(const StateSolver<dim>& solver, const LevelSet<dim>& psi, const State<dim>& state) {
  const Lattice<dim> lattice = displacement_lattice(solver);
  const auto all_edges = edges(psi, lattice);
  const int n_nodes = nodes_per_cell<dim>(lattice.degree());
  for (int position = 0; position < state.positions().size(); ++position)
    if (cross_deformed(all_edges, state.displacement().at_nodes(position), n_nodes)) return true;
  return false;
}

template <int dim>
double travel_by_thickness(const StateSolver<dim>& solver, const State<dim>& state) {
  double largest = 0;
  for (const ContactPatch<dim>& contact : state.contacts())
    largest = std::max(largest, std::abs(contact.travel()));
  const PolarGrid<dim>& grid = solver.model().grid;
  return largest / (grid.outer_radius - grid.inner_radius);
}

template <int dim>
DeformationSize deformation_size(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                 const State<dim>& state, std::span<const PositionDeformation> positions) {
  DeformationSize size{.strain = std::ranges::max(state.strain_peaks().principal),
                       .rotation = 0,
                       .travel = travel_by_thickness(solver, state),
                       .error = {},
                       .edges_overlap = edges_overlap(solver, psi, state),
                       .of_linear_theory = solver.model().materials.are_linear()};
  for (const PositionDeformation& position : positions) {
    size.rotation = std::max(size.rotation, position.largest_rotation);
    if (position.neglected.size() > size.error.size()) size.error = position.neglected;
  }
  return size;
}

template <int dim>
DeformationSize deformation_size(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                 const State<dim>& state) {
  return deformation_size<dim>(solver, psi, state, position_deformations(solver, state));
}

template <int dim>
std::optional<Failure> material_overlaps(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                         const State<dim>& state) {
  constexpr double least_travel = 0.05;
  const double travel = travel_by_thickness(solver, state);
  if (travel < least_travel || !edges_overlap<dim>(solver, psi, state)) return {};
  return Failure{FailureReason::material_overlaps,
                 fmt::format("deformed edges of holes cross each other at a rim travel of {:.3g} % of the "
                             "ring's thickness: the load is too large for this material and shape",
                             100 * travel)};
}

double share_of_small_load(const DeformationSize& size) {
  return std::min(
      {small_strain / size.strain, small_travel / size.travel, share_within(size.error, small_error)});
}

std::string deformation_warning(const DeformationSize& size) {
  if (!size.of_linear_theory)
    return size.edges_overlap ? "edges of holes cross each other: their contact is not computed" : "";
  if (size.strain <= small_strain && size.travel <= small_travel && size.error.size() <= small_error &&
      !size.edges_overlap)
    return "";
  const double share = share_of_small_load(size);
  const std::string remedy =
      share < 1
          ? fmt::format(
                "About {:.2g} % of the load would stay within that, or a material {:.2g} times as stiff.",
                100 * share, 1 / share)
          : "A smaller load or a stiffer material helps.";
  return fmt::format(
      "large deformation: strains reach {:.3g} %, the material turns by up to {:.2g} deg, the rim travels "
      "{:.3g} % of the ring's thickness, and linear theory errs by about {:.2g} % in travel and stiffness{}. "
      "Linear elasticity holds up to about {:.0f} % of strain, {:.0f} % of travel and {:.0f} % of that "
      "error; "
      "beyond, travel, pressures and stresses of the real wheel are different. {}",
      100 * size.strain, size.rotation * 180 / std::numbers::pi, 100 * size.travel, 100 * size.error.size(),
      size.edges_overlap ? ", and edges of holes cross each other" : "", 100 * small_strain,
      100 * small_travel, 100 * small_error, remedy);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                            \
  template DeformationSize deformation_size<dim>(const StateSolver<dim>&, const LevelSet<dim>&, \
                                                 const State<dim>&);                            \
  template DeformationSize deformation_size<dim>(const StateSolver<dim>&, const LevelSet<dim>&, \
                                                 const State<dim>&, std::span<const PositionDeformation>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE
template decltype(travel_by_thickness<2>) travel_by_thickness<2>;
template decltype(edges_overlap<2>) edges_overlap<2>;
template decltype(material_overlaps<2>) material_overlaps<2>;
template decltype(travel_by_thickness<3>) travel_by_thickness<3>;
template decltype(edges_overlap<3>) edges_overlap<3>;
template decltype(material_overlaps<3>) material_overlaps<3>;

}  // namespace wheelwright
