#include "wheelwright/shape/cut/boundary_kinks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "wheelwright/linalg/dense.h"
#include "wheelwright/shape/cut/cell_quadrature.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

/// A point where the boundary passes a face, in the coordinates of the face.
template <int dim>
struct FacePoint {
  Vec<dim - 1> at;
  Vec<dim - 1> normal;  ///< of the zero set in the face, in its coordinates
  double weight;        ///< of the line in them; 1 when dim = 2
};

/// The zeros of a polynomial of degree 1 or 2 in (0, 1), from its values at equidistant nodes.
std::vector<FacePoint<2>> zeros(std::span<const double> v) {
  std::vector<FacePoint<2>> found;
  const auto add = [&](double x) {
    if (x > 0 && x < 1) found.push_back({{x}, {1}, 1});
  };
  const double middle = v.size() == 3 ? v[1] : 0.5 * (v[0] + v[1]), last = v.back();
  // a x^2 + b x + c
  const double a = 2 * (v[0] + last - 2 * middle), b = last - v[0] - a, c = v[0];
  const double square = b * b - 4 * a * c;
  if (square <= 0) return found;
  const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));  // without cancellation
  if (a != 0) add(q / a);
  if (q != 0) add(c / q);
  return found;
}

std::vector<FacePoint<2>> zero_set(const LevelSet<2>&, std::span<const double> values) {
  return zeros(values);
}

std::vector<FacePoint<3>> zero_set(const LevelSet<3>& psi, std::span<const double> values) {
  constexpr int points = 5;
  const CellQuadrature<2> quadrature(psi.lattice.degree(), points);
  if (quadrature.classify(values) != CellKind::cut) return {};
  const auto cut = quadrature.split(0, values);
  std::vector<FacePoint<3>> found;
  if (cut)
    for (const auto& q : cut->boundary) found.push_back({q.xi, q.normal, q.weight});
  return found;
}

/// psi in a cell, in the Cartesian frame of the cell.
template <int dim>
class CellLevelSet {
 public:
  CellLevelSet(const LevelSet<dim>& psi, int map_degree, int cell)
      : degree_(psi.lattice.degree()),
        map_degree_(map_degree),
        values_(psi.cell_values(cell)),
        map_(psi.lattice.grid(), map_degree, psi.lattice.grid().cell_position(cell)) {}

  Mat<dim> jacobian(const Vec<dim>& xi) const { return map_.jacobian(ShapeFunctions<dim>(map_degree_, xi)); }
  Vec<dim> gradient(const Vec<dim>& xi) const {
    const ShapeFunctions<dim> shape(degree_, xi);
    Vec<dim> in_unit_cell{};
    for (std::size_t a = 0; a < values_.size(); ++a) in_unit_cell += values_[a] * shape.gradient[a];
    return transpose_times<dim>(inverse<dim>(jacobian(xi)), in_unit_cell);
  }

  /// At the nodes of a face, the first of them along the first axis that is not the face's.
  std::vector<double> on_face(int axis, int end) const {
    std::vector<double> result;
    for (std::size_t a = 0; a < values_.size(); ++a)
      if (local_node_position<dim>(degree_, static_cast<int>(a))[axis] == end * degree_)
        result.push_back(values_[a]);
    return result;
  }

 private:
  int degree_, map_degree_;
  std::vector<double> values_;
  CellMap<dim> map_;
};

template <int dim>
Vec<dim> in_cell(const Vec<dim - 1>& at, int axis, int end) {
  Vec<dim> xi;
  for (int d = 0, f = 0; d < dim; ++d) xi[d] = d == axis ? end : at[f++];
  return xi;
}

/// The length of the image of a unit step along the zero set in the face; 1 when dim = 2.
double stretch(const Mat<2>&, int, const Vec<1>&) { return 1; }
double stretch(const Mat<3>& jacobian, int axis, const Vec<2>& normal) {
  const Vec<3> direction = in_cell<3>({-normal[1], normal[0]}, axis, 0);
  Vec<3> image{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) image[i] += jacobian[i][k] * direction[k];
  return norm<3>(image);
}

/// A functional of dpsi in one cell: the sum of factor dpsi(xi).
template <int dim>
struct Kink {
  Vec<dim> xi;
  double factor;
};

/// The boundary in one cell, by the indices of its points.
struct CellPoints {
  std::vector<std::size_t> points;
  double measure = 0;
};

/// The grid's neighbour of a cell across its last face normal to an axis; -1 if there is none.
template <int dim>
int next_cell(const PolarGrid<dim>& grid, int cell, int axis) {
  auto place = grid.cell_position(cell);
  ++place[axis];
  if (axis == 1) place[1] %= grid.columns();
  return place[axis] < grid.cells[axis] ? grid.cell_index(place) : -1;
}

template <int dim>
class Kinks {
 public:
  using Value = std::function<double(int, const Vec<dim>&)>;

  Kinks(const LevelSet<dim>& psi, int map_degree, std::span<const SurfacePoint<dim>> points,
        const Value& value)
      : psi_(psi), map_degree_(map_degree), points_(points), value_(value), densities_(points.size(), 0.0) {
    for (std::size_t q = 0; q < points.size(); ++q) {
      CellPoints& of_cell = cells_[points[q].cell];
      of_cell.points.push_back(q);
      of_cell.measure += points[q].weight;
    }
  }

  std::vector<double> densities(const CutDomain<dim>& domain) {
    for (const CutCell<dim>& cut : domain.cut) {
      for (int axis = 0; axis < dim; ++axis) add_face(cut.cell, axis);
      if constexpr (dim == 3)
        if (domain.grid.cell_position(cut.cell)[2] == 0) add_end(cut.cell, 2, 0);
    }
    for (const auto& [cell, kinks] : kinks_) distribute(cell, kinks);
    return std::move(densities_);
  }

 private:
  /// The face between a cell and the next one along an axis, or to the side face behind it.
  void add_face(int cell, int axis) {
    const int next = next_cell(psi_.lattice.grid(), cell, axis);
    if (next < 0) {
      if (axis == 2) add_end(cell, axis, 1);
      return;
    }
    const bool first_holds_more = measure(cell) >= measure(next);
    const int owner = first_holds_more ? cell : next;
    if (measure(owner) == 0) return;
    const CellLevelSet<dim> here(psi_, map_degree_, cell), there(psi_, map_degree_, next);
    const double angle = axis == 1 ? psi_.lattice.grid().column_angle() : 0;
    for (const auto& p : zero_set(psi_, here.on_face(axis, 1))) {
      const Vec<dim> xi = in_cell<dim>(p.at, axis, 1), beyond = in_cell<dim>(p.at, axis, 0);
      const Vec<dim> gradient = here.gradient(xi), other = rotated<dim>(there.gradient(beyond), angle);
      add(owner, first_holds_more ? xi : beyond, here.jacobian(xi), axis, 1, gradient,
          gradient / norm<dim>(gradient) - other / norm<dim>(other), p, value_(cell, xi));
    }
  }

  /// A side face of the wheel.
  void add_end(int cell, int axis, int end) {
    if (measure(cell) == 0) return;
    const CellLevelSet<dim> here(psi_, map_degree_, cell);
    for (const auto& p : zero_set(psi_, here.on_face(axis, end))) {
      const Vec<dim> xi = in_cell<dim>(p.at, axis, end);
      const Vec<dim> gradient = here.gradient(xi);
      add(cell, xi, here.jacobian(xi), axis, end, gradient, gradient / norm<dim>(gradient), p,
          value_(cell, xi));
    }
  }

  void add(int owner, const Vec<dim>& xi, const Mat<dim>& jacobian, int axis, int end,
           const Vec<dim>& gradient, const Vec<dim>& jump_of_normals, const FacePoint<dim>& p, double value) {
    Vec<dim> reference_normal{};
    reference_normal[axis] = end == 0 ? -1 : 1;
    const Vec<dim> face_normal = map_surface<dim>(jacobian, reference_normal).normal;
    const double across = dot<dim>(gradient, face_normal);
    const double in_face = std::sqrt(std::max(dot<dim>(gradient, gradient) - across * across, 0.0));
    if (in_face == 0) return;
    kinks_[owner].push_back({xi, value * p.weight * stretch(jacobian, axis, p.normal) *
                                     dot<dim>(face_normal, jump_of_normals) / in_face});
  }

  /// Densities that are a polynomial of the level set's kind and have the sums of the kinks for every dpsi.
  /// Different polynomials may be equal on the boundary: the small diagonal makes one of them unique.
  void distribute(int cell, const std::vector<Kink<dim>>& kinks) {
    constexpr double least = 1e-11;
    const int degree = psi_.lattice.degree(), n = nodes_per_cell<dim>(degree);
    const CellLevelSet<dim> here(psi_, map_degree_, cell);
    const auto& points = cells_.at(cell).points;
    Matrix gram(n, n), coefficients(n, 1);
    for (const std::size_t q : points) {
      const ShapeFunctions<dim> shape(degree, points_[q].xi);
      const double weight = points_[q].weight / norm<dim>(here.gradient(points_[q].xi));
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) gram(a, b) += weight * shape.value[a] * shape.value[b];
    }
    for (const Kink<dim>& kink : kinks) {
      const ShapeFunctions<dim> shape(degree, kink.xi);
      for (int a = 0; a < n; ++a) coefficients(a, 0) -= kink.factor * shape.value[a];
    }
    double trace = 0;
    for (int a = 0; a < n; ++a) trace += gram(a, a);
    for (int a = 0; a < n; ++a) gram(a, a) += least * trace;
    if (!cholesky(gram)) return;
    cholesky_solve(gram, coefficients);
    for (const std::size_t q : points) {
      const ShapeFunctions<dim> shape(degree, points_[q].xi);
      for (int a = 0; a < n; ++a) densities_[q] += coefficients(a, 0) * shape.value[a];
    }
  }

  double measure(int cell) const {
    const auto found = cells_.find(cell);
    return found == cells_.end() ? 0 : found->second.measure;
  }

  const LevelSet<dim>& psi_;
  int map_degree_;
  std::span<const SurfacePoint<dim>> points_;
  const Value& value_;
  std::map<int, CellPoints> cells_;
  std::map<int, std::vector<Kink<dim>>> kinks_;
  std::vector<double> densities_;
};

}  // namespace

template <int dim>
std::vector<double> kink_densities(const LevelSet<dim>& psi, const CutDomain<dim>& domain, int map_degree,
                                   std::span<const SurfacePoint<dim>> points,
                                   const std::function<double(int cell, const Vec<dim>& xi)>& value) {
  return Kinks<dim>(psi, map_degree, points, value).densities(domain);
}

template <int dim>
int points_for_kinks(int degree) {
  const int different = nodes_per_cell<dim>(degree) - 1;  // psi itself is zero
  int n = 1;
  while (std::pow(n, dim - 1) < different) ++n;
  return n;
}

template decltype(kink_densities<2>) kink_densities<2>;
template decltype(kink_densities<3>) kink_densities<3>;
template int points_for_kinks<2>(int);
template int points_for_kinks<3>(int);

}  // namespace wheelwright
