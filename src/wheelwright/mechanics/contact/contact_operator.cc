#include "wheelwright/mechanics/contact/contact_operator.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/mechanics/state/axle_height.h"

namespace wheelwright {
namespace {

/// The axes of the frame of a point's contact in its column's frame.
template <int dim>
std::array<Vec<dim>, dim> contact_axes(const GroundFrame& frame) {
  std::array<Vec<dim>, dim> axes;
  for (int k = 0; k < dim; ++k) {
    Vec<dim> unit{};
    unit[k] = 1;
    axes[k] = frame.contact_to_body<dim>(unit);
  }
  return axes;
}

/// The signed distance of two columns of the ring.
int difference(int to, int from, int ring_columns) {
  return wrap(to - from + ring_columns / 2, ring_columns) - ring_columns / 2;
}

/// A position in a column relative to the middle of the axle.
template <int dim>
Vec<dim> from_axle(const PolarGrid<dim>& grid, Vec<dim> position) {
  if constexpr (dim == 3) position[2] -= 0.5 * grid.width;
  return position;
}

void add(double factor, const double* x, int n, double* y) {
  for (int i = 0; i < n; ++i) y[i] += factor * x[i];
}

/// y_i += factor factors_i x_i, where the entries of y are `stride` apart.
void add(double factor, const std::vector<double>& factors, const double* x, double* y, int stride) {
  const int n = static_cast<int>(factors.size());
  if (stride == 1)
    for (int i = 0; i < n; ++i) y[i] += factors[i] * factor * x[i];
  else
    for (int i = 0; i < n; ++i) y[stride * i] += factors[i] * factor * x[i];
}

/// Assembles the flexibility of a zone.
template <int dim>
class Flexibility {
 public:
  Flexibility(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread, const ContactPoints<dim>& at,
              int components)
      : surface_(surface), tread_(tread), at_(at), components_(components) {}

  /// F = -S H T^T - C: samples S and tests T of the seams, their compliance H, and the compliance C of the
  /// columns between them.
  Matrix assemble() const {
    const int n_zone = at_.zone.n_columns, n_column = at_.per_column() * components_,
              n_seam = tread_.n_seam();
    auto seams = Matrix::unfilled((n_zone + 1) * n_seam, n_zone * n_column);
    parallel_for(n_zone, [&](int from) {
      const Matrix of_column = seams_of_column(from);
      std::copy(of_column.entries().begin(), of_column.entries().end(), seams.column(from * n_column));
    });
    auto result = Matrix::unfilled(n_zone * n_column, n_zone * n_column);
    parallel_for(n_zone, [&](int to) {
      multiply_rows(-1, in_contact_frames(tread_.samples(), to), seams, to * n_seam, 0, result,
                    to * n_column);
      const Matrix compliance = column_compliance(to);
      for (int j = 0; j < n_column; ++j)
        for (int i = 0; i < n_column; ++i) result(to * n_column + i, to * n_column + j) -= compliance(i, j);
    });
    return result;
  }

 private:
  /// [i][k][point]: component k, in the column's frame, of axis i of the contact frames of a column's points.
  using Axes = std::array<std::array<std::vector<double>, dim>, dim>;
  Axes axes_of(int column) const {
    Axes axes;
    for (int q = 0; q < at_.per_column(); ++q) {
      const auto of_point = contact_axes<dim>(at_.points[at_.per_column() * column + q].frame);
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k) axes[i][k].push_back(of_point[i][k]);
    }
    return axes;
  }

  /// Traces of a column (Tread) in the frames of the contact, with the components that contact needs.
  Matrix in_contact_frames(const std::vector<Matrix>& traces, int column) const {
    const Axes axes = axes_of(column);
    const int n = components_, n_points = at_.per_column();
    Matrix result(n * n_points, traces.front().columns());
    for (size_t k = 0; k < traces.size(); ++k)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < result.columns(); ++j)
          add(1, axes[i][k], traces[k].column(j), result.column(j) + i, n);
    return result;
  }

  /// The compliance of a column between its seams, in the same way.
  Matrix column_compliance(int column) const {
    const Axes axes = axes_of(column);
    const int n = components_, n_points = at_.per_column(), traced = tread_.traced_components();
    Matrix result(n * n_points, n * n_points);
    for (int k = 0; k < traced; ++k)
      for (int l = 0; l < traced; ++l) {
        const Matrix& compliance = tread_.compliance(k, l);
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            for (int from = 0; from < n_points; ++from)
              add(axes[j][l][from], axes[i][k], compliance.column(from), result.column(n * from + j) + i, n);
      }
    return result;
  }

  /// Displacements of the zone's seams, one below the other from its first azimuth to its last, for unit
  /// tractions on one of its columns: H T^T.
  Matrix seams_of_column(int from) const {
    const int n = tread_.n_seam(), n_zone = at_.zone.n_columns, n_column = at_.per_column() * components_;
    const auto apart = [&](int seam) {
      return seam == 0 ? difference(0, from, at_.ring_columns)
                       : difference(seam - 1, from, at_.ring_columns) + 1;
    };
    int first = 0, last = 0;
    for (int seam = 0; seam <= n_zone; ++seam) {
      first = std::min(first, apart(seam));
      last = std::max(last, apart(seam));
    }
    const Matrix tests = in_contact_frames(tread_.tests(), from);
    Matrix by_distance((last + 1 - first) * n, n_column);
    for (int side = 0; side < 2; ++side) {
      const Matrix& responses =
          surface_.responses(wrap(at_.zone.first_column + from, at_.ring_columns) + side);
      const int own = surface_.width() + 1;
      multiply(1, block(responses, (first - side + own) * n, 0, by_distance.rows(), n), Op::none,
               block(tests, 0, side * n, n_column, n), Op::transpose, 1, by_distance);
    }
    auto result = Matrix::unfilled((n_zone + 1) * n, n_column);
    for (int j = 0; j < n_column; ++j)
      for (int seam = 0; seam <= n_zone; ++seam)
        std::copy_n(by_distance.column(j) + (apart(seam) - first) * n, n, result.column(j) + seam * n);
    return result;
  }

  const SurfaceCompliance<dim>& surface_;
  const Tread<dim>& tread_;
  const ContactPoints<dim>& at_;
  int components_;
};

}  // namespace

template <int dim>
ContactPoints<dim> contact_points(const Tread<dim>& tread, const PolarGrid<dim>& grid, GroundPosition ground,
                                  ContactZone zone, const Ground& shape) {
  const double column_angle = grid.column_angle();
  const double height = axle_height(grid, shape, ground.camber);
  const bool has_gaps = tread.form().counterpart == Counterpart::ground;
  ContactPoints<dim> at{zone, shape, tread.n_columns(), ground.column + ground.offset - zone.first_column,
                        {},   {}};
  for (const auto& point : tread.points()) {
    const auto& x = point.position;
    at.places.push_back({std::atan2(x[1], x[0]) / column_angle, dim == 3 ? x[dim - 1] : 0.0});
  }
  for (int c = 0; c < zone.n_columns; ++c) {
    const GroundFrame frame{(zone.first_column + c - ground.column - ground.offset) * column_angle,
                            ground.camber};
    for (const auto& point : tread.points()) {
      const Vec<dim> x = frame.to_ground<dim>(from_axle<dim>(grid, point.position));
      const auto [gap, tilt] = has_gaps ? shape.nearest({x[1], height - x[0]}) : Ground::Nearest{0, 0};
      at.points.push_back({x, gap, point.weight, point.gamma, {frame.angle, frame.camber, tilt}});
    }
  }
  return at;
}

template <int dim>
Matrix ContactOperator<dim>::replies(const Matrix& forces) const {
  constexpr int few = 4;  // then passing by the zeros of points without contact pays
  Matrix result(forces.rows(), forces.columns());
  if (forces.columns() >= few) {
    multiply(1, flexibility, Op::none, forces, Op::none, 0, result);
    return result;
  }
  for (int j = 0; j < forces.columns(); ++j)
    for (int i = 0; i < forces.rows(); ++i)
      if (forces(i, j) != 0) add(forces(i, j), flexibility.column(i), result.rows(), result.column(j));
  return result;
}

template <int dim>
std::shared_ptr<const ContactOperator<dim>> contact_operator(const SurfaceCompliance<dim>& surface,
                                                             const Tread<dim>& tread,
                                                             ContactPoints<dim> points, int components) {
  Matrix flexibility = Flexibility<dim>(surface, tread, points, components).assemble();
  return std::make_shared<const ContactOperator<dim>>(ContactOperator<dim>{
      std::move(points), components, tread.form().tau(), tread.form().theta(), std::move(flexibility)});
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                   \
  template ContactPoints<dim> contact_points(const Tread<dim>&, const PolarGrid<dim>&, GroundPosition, \
                                             ContactZone, const Ground&);                              \
  template struct ContactOperator<dim>;                                                                \
  template std::shared_ptr<const ContactOperator<dim>> contact_operator(                               \
      const SurfaceCompliance<dim>&, const Tread<dim>&, ContactPoints<dim>, int);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
