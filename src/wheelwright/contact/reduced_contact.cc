#include "wheelwright/contact/reduced_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// The axes of the ground frame in a column's frame.
template <int dim>
std::array<Vec<dim>, dim> ground_axes(const GroundFrame& frame) {
  std::array<Vec<dim>, dim> axes;
  for (int k = 0; k < dim; ++k) {
    Vec<dim> unit{};
    unit[k] = 1;
    axes[k] = frame.to_body<dim>(unit);
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

/// y += factor x, where the entries of y are `stride` apart.
void add(double factor, const double* x, int n, double* y, int stride) {
  if (stride == 1)
    for (int i = 0; i < n; ++i) y[i] += factor * x[i];
  else
    for (int i = 0; i < n; ++i) y[stride * i] += factor * x[i];
}

/// Height of the axle's middle above the ground that the undeformed tread touches.
template <int dim>
double undeformed_height(const PolarGrid<dim>& grid, double camber) {
  if (dim == 2 || camber == 0) return grid.outer_radius;
  return grid.outer_radius * std::cos(camber) + 0.5 * grid.width * std::abs(std::sin(camber));
}

}  // namespace

template <int dim>
ReducedContact<dim>::ReducedContact(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread,
                                    const PolarGrid<dim>& grid, GroundPosition ground, ContactZone zone,
                                    RimControl rim, const Preload& preload)
    : zone_(zone),
      ring_columns_(tread.n_columns()),
      rim_(std::move(rim)),
      counterpart_(tread.form().counterpart),
      friction_(tread.form().friction),
      tau_(tread.form().tau()),
      theta_(tread.form().theta()),
      ground_(ground.column + ground.offset - zone.first_column),
      preload_resultant_(preload.resultant),
      growth_(preload.growth) {
  const double column_angle = grid.cell_size()[1], height = undeformed_height(grid, ground.camber);
  for (const auto& point : tread.points()) {
    const auto& x = point.position;
    places_.push_back({std::atan2(x[1], x[0]) / column_angle, dim == 3 ? x[dim - 1] : 0.0});
  }
  for (int c = 0; c < zone.n_columns; ++c) {
    const GroundFrame frame{(zone.first_column + c - ground.column - ground.offset) * column_angle,
                            ground.camber};
    for (const auto& point : tread.points()) {
      const Vec<dim> x = frame.to_ground<dim>(from_axle<dim>(grid, point.position));
      points_.push_back({x, is_bonded() ? 0 : height - x[0], point.weight, point.gamma, frame});
    }
  }

  const ObservationRows<dim> rows = observation_rows();
  if (preload.observations.rows() > 0)
    for (int i = 0; i < n_points(); ++i) {
      const double* observed = preload.observations.column(
          wrap(zone.first_column + zone_column(i), preload.observations.columns()));
      const double *displacement = observed + rows.displacement(point_of_column(i)),
                   *traction = observed + rows.traction(point_of_column(i));
      Vec<dim> z;
      for (int d = 0; d < dim; ++d) z[d] = tau_ * traction[d] - points_[i].gamma * displacement[d];
      preload_.push_back(points_[i].frame.template to_ground<dim>(z));
    }

  flexibility_ = std::make_shared<const Matrix>(flexibility(surface, tread));
}

/// Traces of a column (Tread) in the frame of the ground, with the components that contact needs.
template <int dim>
Matrix ReducedContact<dim>::in_ground_frame(const std::vector<Matrix>& traces, int column) const {
  const auto axes = ground_axes<dim>(points_[per_column() * column].frame);
  const int n = components(), n_points = per_column();
  Matrix result(n * n_points, traces.front().columns());
  for (size_t k = 0; k < traces.size(); ++k)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < result.columns(); ++j)
        add(axes[i][k], traces[k].column(j), n_points, result.column(j) + i, n);
  return result;
}

/// The compliance of a column between its seams, in the same way.
template <int dim>
Matrix ReducedContact<dim>::column_compliance(const Tread<dim>& tread, int column) const {
  const auto axes = ground_axes<dim>(points_[per_column() * column].frame);
  const int n = components(), n_points = per_column(), traced = tread.traced_components();
  Matrix result(n * n_points, n * n_points);
  for (int k = 0; k < traced; ++k)
    for (int l = 0; l < traced; ++l) {
      const Matrix& compliance = tread.compliance(k, l);
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          for (int from = 0; from < n_points; ++from)
            add(axes[i][k] * axes[j][l], compliance.column(from), n_points, result.column(n * from + j) + i,
                n);
    }
  return result;
}

/// Displacements of the zone's seams, one below the other from its first azimuth to its last, for unit
/// tractions on one of its columns: H T^T.
template <int dim>
Matrix ReducedContact<dim>::seams_of_column(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread,
                                            int from) const {
  const int n = tread.n_seam(), n_zone = zone_.n_columns, n_column = per_column() * components();
  const auto apart = [&](int seam) {
    return seam == 0 ? difference(0, from, ring_columns_) : difference(seam - 1, from, ring_columns_) + 1;
  };
  int first = 0, last = 0;
  for (int seam = 0; seam <= n_zone; ++seam) {
    first = std::min(first, apart(seam));
    last = std::max(last, apart(seam));
  }
  const Matrix tests = in_ground_frame(tread.tests(), from);
  Matrix by_distance((last + 1 - first) * n, n_column);
  for (int side = 0; side < 2; ++side) {
    const Matrix& responses = surface.responses(wrap(zone_.first_column + from, ring_columns_) + side);
    const int own = surface.width() + 1;
    multiply(1, block(responses, (first - side + own) * n, 0, by_distance.rows(), n), Op::none,
             block(tests, 0, side * n, n_column, n), Op::transpose, 1, by_distance);
  }
  auto result = Matrix::unfilled((n_zone + 1) * n, n_column);
  for (int j = 0; j < n_column; ++j)
    for (int seam = 0; seam <= n_zone; ++seam)
      std::copy_n(by_distance.column(j) + (apart(seam) - first) * n, n, result.column(j) + seam * n);
  return result;
}

/// F = -S H T^T - C: samples S and tests T of the seams, their compliance H, and the compliance C of the
/// columns between them.
template <int dim>
Matrix ReducedContact<dim>::flexibility(const SurfaceCompliance<dim>& surface,
                                        const Tread<dim>& tread) const {
  const int n_zone = zone_.n_columns, n_column = per_column() * components(), n_seam = tread.n_seam();
  auto seams = Matrix::unfilled((n_zone + 1) * n_seam, n_zone * n_column);
  for (int from = 0; from < n_zone; ++from) {
    const Matrix of_column = seams_of_column(surface, tread, from);
    std::copy(of_column.entries().begin(), of_column.entries().end(), seams.column(from * n_column));
  }
  auto result = Matrix::unfilled(n_zone * n_column, n_zone * n_column);
  for (int to = 0; to < n_zone; ++to) {
    multiply_rows(-1, in_ground_frame(tread.samples(), to), seams, to * n_seam, 0, result, to * n_column);
    const Matrix compliance = column_compliance(tread, to);
    for (int j = 0; j < n_column; ++j)
      for (int i = 0; i < n_column; ++i) result(to * n_column + i, to * n_column + j) -= compliance(i, j);
  }
  return result;
}

template <int dim>
ReducedContact<dim> ReducedContact<dim>::under(const RimControl& rim) const {
  ReducedContact contact = *this;
  contact.rim_ = rim;
  return contact;
}

template <int dim>
ReducedContact<dim> ReducedContact<dim>::with_given_friction(std::vector<double> thresholds) const {
  ReducedContact contact = *this;
  contact.thresholds_ = std::move(thresholds);
  return contact;
}

template <int dim>
ReducedContact<dim> ReducedContact<dim>::sliding_along(const Vec<dim>& direction) const {
  ReducedContact contact = *this;
  contact.sliding_ = direction;
  return contact;
}

template <int dim>
ContactResponse<dim> ReducedContact<dim>::response(int point, const Vec<dim>& z) const {
  if (is_bonded()) return bonded_response<dim>(z);
  if (sliding_) return sliding_response<dim>(z, friction_, *sliding_);
  return thresholds_.empty() ? contact_response<dim>(z, friction_)
                             : given_friction_response<dim>(z, thresholds_[point]);
}

template <int dim>
ContactStatus ReducedContact<dim>::status(int point, const Vec<dim>& z) const {
  if (is_bonded()) return {.touches = true, .slides = false};
  if (sliding_) return {.touches = z[0] < 0, .slides = false};
  if (thresholds_.empty()) return contact_status<dim>(z, friction_);
  return {z[0]<0, thresholds_[point]> 0 && tangential_norm<dim>(z) > thresholds_[point]};
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::hertz_start(double load, double radius,
                                                      double reduced_modulus) const {
  const double half_width = 2 * std::sqrt(load * radius / (std::numbers::pi * reduced_modulus));
  const double peak = 2 * load / (std::numbers::pi * half_width);
  ContactUnknowns<dim> x{std::vector<Vec<dim>>(points_.size(), Vec<dim>{}), std::vector<double>(n_free())};
  for (size_t i = 0; i < points_.size(); ++i) {
    const double s = points_[i].position[1] / half_width;
    x.augmented[i][0] = std::abs(s) < 1 ? -peak * std::sqrt(1 - s * s) : points_[i].gamma * points_[i].gap;
  }
  return x;
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::zero_start() const {
  return {std::vector<Vec<dim>>(points_.size(), Vec<dim>{}), std::vector<double>(n_free())};
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::undeformed_start() const {
  const std::vector<double> free(n_free());
  return {without_contact(free), free};
}

template <int dim>
std::vector<Vec<dim>> ReducedContact<dim>::without_contact(const std::vector<double>& free) const {
  const RimMotion rim = rim_motion(free);
  std::vector<Vec<dim>> result;
  for (int i = 0; i < n_points(); ++i) {
    const Point& point = points_[i];
    Vec<dim> z = displacement<dim>(rim, point.position);
    z[0] -= point.gap;
    for (int d = 0; d < dim; ++d) z[d] = (preload_.empty() ? 0.0 : preload_[i][d]) - point.gamma * z[d];
    result.push_back(z);
  }
  return result;
}

/// Finds, for every point of a column, the nearest point `shift` columns ahead, at the same place along the
/// axle.
template <int dim>
std::vector<typename ReducedContact<dim>::Neighbour> ReducedContact<dim>::neighbours(double shift) const {
  std::vector<Neighbour> result;
  for (const Place& from : places_) {
    const double target = from.columns + shift;
    const int whole = static_cast<int>(std::floor(target));
    Neighbour nearest{whole, 0};
    double smallest = std::numeric_limits<double>::infinity();
    for (int columns = whole - 1; columns <= whole + 1; ++columns)
      for (int q = 0; q < per_column(); ++q) {
        if (std::abs(places_[q].along_axle - from.along_axle) > 1e-9) continue;
        const double distance = std::abs(columns + places_[q].columns - target);
        if (distance >= smallest) continue;
        smallest = distance;
        nearest = {columns, q};
      }
    result.push_back(nearest);
  }
  return result;
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::start_from(const ContactState<dim>& other) const {
  const std::vector<Neighbour> nearest = neighbours(other.ground - ground_);
  ContactUnknowns<dim> x{{}, std::vector<double>(n_free())};
  for (int i = 0; i < n_points(); ++i) {
    const Point& point = points_[i];
    Vec<dim> open{};
    open[0] = point.gamma * std::max(0.0, point.gap - displacement<dim>(other.rim, point.position)[0]);
    const auto [columns, q] = nearest[point_of_column(i)];
    const int column = zone_column(i) + columns;
    x.augmented.push_back(
        column >= 0 && column < other.zone.n_columns ? other.augmented[per_column() * column + q] : open);
  }
  return x;
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::touching(ContactUnknowns<dim> guess) const {
  const auto presses = [](const FreeMotion& motion) { return motion.direction.towards_ground != 0; };
  const auto motion = std::ranges::find_if(rim_.free, presses);
  const auto touches = [](const Vec<dim>& z) { return z[0] < 0; };
  if (motion == rim_.free.end() || std::ranges::any_of(guess.augmented, touches)) return guess;
  const double load = motion->force + work(preload_resultant_, motion->direction);
  int nearest = 0;
  const auto distance = [&](int i) {
    return points_[i].gap + (preload_.empty() ? 0.0 : preload_[i][0] / points_[i].gamma);
  };
  for (int i = 1; i < n_points(); ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  guess.augmented[nearest][0] = -load / points_[nearest].weight;
  return guess;
}

template <int dim>
RimMotion ReducedContact<dim>::rim_motion(const std::vector<double>& free) const {
  RimMotion motion = rim_.prescribed;
  for (int k = 0; k < n_free(); ++k) motion = combined(motion, free[k], rim_.free[k].direction);
  return motion;
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::residual(const ContactUnknowns<dim>& x) const {
  const int nc = components();
  Matrix forces(n_points() * nc, 1);
  ContactUnknowns<dim> result{std::vector<Vec<dim>>(points_.size(), Vec<dim>{}), {}};
  for (const FreeMotion& motion : rim_.free)
    result.rim.push_back(-motion.force - work(preload_resultant_, motion.direction));
  for (int i = 0; i < n_points(); ++i) {
    const Vec<dim> traction = response(i, x.augmented[i]).traction;
    if (!is_active(i, x.augmented[i])) continue;
    for (int d = 0; d < nc; ++d) forces(nc * i + d, 0) = points_[i].weight * traction[d];
    for (int k = 0; k < n_free(); ++k)
      result.rim[k] -= points_[i].weight *
                       dot<dim>(traction, displacement<dim>(rim_.free[k].direction, points_[i].position));
  }
  const Matrix reply = replies(forces);
  const RimMotion rim = rim_motion(x.rim);
  for (int i = 0; i < n_points(); ++i) {
    Vec<dim> approach = displacement<dim>(rim, points_[i].position);
    approach[0] -= points_[i].gap;
    for (int d = 0; d < nc; ++d)
      result.augmented[i][d] = x.augmented[i][d] - reply(nc * i + d, 0) + points_[i].gamma * approach[d] -
                               (preload_.empty() ? 0.0 : preload_[i][d]);
  }
  return result;
}

template <int dim>
bool ReducedContact<dim>::is_active(int point, const Vec<dim>& z) const {
  return z[0] < 0 || is_bonded() || (!thresholds_.empty() && thresholds_[point] > 0);
}

/// F forces, one column per load.
template <int dim>
Matrix ReducedContact<dim>::replies(const Matrix& forces) const {
  constexpr int few = 4;  // then passing by the zeros of points without contact pays
  Matrix result(forces.rows(), forces.columns());
  if (forces.columns() >= few) {
    multiply(1, *flexibility_, Op::none, forces, Op::none, 0, result);
    return result;
  }
  for (int j = 0; j < forces.columns(); ++j)
    for (int i = 0; i < forces.rows(); ++i)
      if (forces(i, j) != 0) add(forces(i, j), flexibility_->column(i), result.rows(), result.column(j), 1);
  return result;
}

template <int dim>
std::vector<Mat<dim>> ReducedContact<dim>::tangents(const std::vector<Vec<dim>>& z) const {
  std::vector<Mat<dim>> result(z.size(), Mat<dim>{});
  for (int i = 0; i < n_points(); ++i)
    if (is_active(i, z[i])) result[i] = response(i, z[i]).tangent;
  return result;
}

/// The components of z on which tractions depend: the columns of all others are unit vectors in the Newton
/// matrix.
template <int dim>
std::vector<int> ReducedContact<dim>::active_rows(const std::vector<Mat<dim>>& tangents) const {
  const int nc = components();
  std::vector<int> rows;
  for (int i = 0; i < n_points(); ++i)
    for (int d = 0; d < nc; ++d) {
      bool matters = false;
      for (int k = 0; k < nc; ++k) matters = matters || tangents[i][k][d] != 0;
      if (matters) rows.push_back(nc * i + d);
    }
  return rows;
}

/// The Newton system on the active rows and the rim's free motions.
template <int dim>
Matrix ReducedContact<dim>::active_system(const std::vector<Mat<dim>>& tangents,
                                          const std::vector<int>& active) const {
  const int nc = components(), n = static_cast<int>(active.size());
  Matrix a(n + n_free(), n + n_free());
  for (int j = 0; j < n; ++j) {
    const int index = active[j] / nc, component = active[j] % nc;
    const Point& point = points_[index];
    for (int k = 0; k < nc; ++k) {
      const double weight = point.weight * tangents[index][k][component];
      if (weight == 0) continue;
      const double* f = flexibility_->column(nc * index + k);
      double* column = a.column(j);
      for (int i = 0; i < n; ++i) column[i] -= weight * f[active[i]];
    }
    a(j, j) += 1;
    for (int k = 0; k < n_free(); ++k) {
      const Vec<dim> motion = displacement<dim>(rim_.free[k].direction, point.position);
      for (int d = 0; d < nc; ++d) a(n + k, j) -= point.weight * tangents[index][d][component] * motion[d];
      a(j, n + k) = point.gamma * motion[component];
    }
  }
  return a;
}

template <int dim>
std::optional<ContactTangent<dim>> ReducedContact<dim>::tangent(const ContactUnknowns<dim>& x) const {
  ContactTangent<dim> result;
  result.contact_ = this;
  result.tangents_ = tangents(x.augmented);
  result.active_ = active_rows(result.tangents_);
  auto factor = LuFactor::factor(active_system(result.tangents_, result.active_));
  if (!factor) return {};
  result.factor_ = *std::move(factor);
  return result;
}

template <int dim>
ContactUnknowns<dim> ContactTangent<dim>::solve(const ContactUnknowns<dim>& residual) const {
  return std::move(solve(std::vector{residual}).front());
}

template <int dim>
std::vector<ContactUnknowns<dim>> ContactTangent<dim>::solve(
    std::vector<ContactUnknowns<dim>> residuals) const {
  const ReducedContact<dim>& contact = *contact_;
  const int nc = contact.components(), n_active = static_cast<int>(active_.size()), n_free = contact.n_free();
  auto solutions = Matrix::unfilled(n_active + n_free, static_cast<int>(residuals.size()));
  for (int j = 0; j < solutions.columns(); ++j) {
    for (int i = 0; i < n_active; ++i)
      solutions(i, j) = residuals[j].augmented[active_[i] / nc][active_[i] % nc];
    for (int k = 0; k < n_free; ++k) solutions(n_active + k, j) = residuals[j].rim[k];
  }
  solutions = factor_.solve(std::move(solutions));

  // The other rows follow from the active ones: their columns are unit vectors.
  Matrix forces(contact.n_points() * nc, solutions.columns());
  for (int j = 0; j < solutions.columns(); ++j)
    for (int i = 0; i < n_active; ++i) {
      const int point = active_[i] / nc;
      for (int k = 0; k < nc; ++k)
        forces(nc * point + k, j) +=
            contact.points()[point].weight * tangents_[point][k][active_[i] % nc] * solutions(i, j);
    }
  const Matrix replies = contact.replies(forces);
  for (int j = 0; j < solutions.columns(); ++j) {
    ContactUnknowns<dim>& step = residuals[j];
    for (int k = 0; k < n_free; ++k) step.rim[k] = solutions(n_active + k, j);
    for (int i = 0; i < contact.n_points(); ++i) {
      const auto& point = contact.points()[i];
      for (int k = 0; k < n_free; ++k) {
        const Vec<dim> motion = displacement<dim>(contact.rim().free[k].direction, point.position);
        for (int d = 0; d < nc; ++d) step.augmented[i][d] -= point.gamma * motion[d] * step.rim[k];
      }
      for (int d = 0; d < nc; ++d) step.augmented[i][d] += replies(nc * i + d, j);
    }
    for (int i = 0; i < n_active; ++i) step.augmented[active_[i] / nc][active_[i] % nc] = solutions(i, j);
  }
  return residuals;
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::residual_of(int point, const Vec<dim>& traction) const {
  const int nc = components();
  ContactUnknowns<dim> result{std::vector<Vec<dim>>(points_.size(), Vec<dim>{}), {}};
  for (int d = 0; d < nc; ++d) {
    const double* f = flexibility_->column(nc * point + d);
    for (int i = 0; i < n_points(); ++i)
      for (int k = 0; k < nc; ++k)
        result.augmented[i][k] -= points_[point].weight * traction[d] * f[nc * i + k];
  }
  for (const FreeMotion& motion : rim_.free)
    result.rim.push_back(-points_[point].weight *
                         dot<dim>(traction, displacement<dim>(motion.direction, points_[point].position)));
  return result;
}

template <int dim>
bool ReducedContact<dim>::keeps_rim_near(const ContactUnknowns<dim>& step) const {
  const double longest = norm<dim>(points_.front().position);
  for (int k = 0; k < n_free(); ++k)
    if (!(std::abs(step.rim[k]) * amplitude(rim_.free[k].direction) < longest)) return false;
  return true;
}

template <int dim>
ContactState<dim> ReducedContact<dim>::state(const ContactUnknowns<dim>& x, int newton_iterations) const {
  ContactState<dim> state{zone_, x.augmented, {}, rim_motion(x.rim), {}, newton_iterations};
  state.ground = ground_;
  state.rim_force = scaled(-1, preload_resultant_);
  for (int i = 0; i < n_points(); ++i) {
    state.traction.push_back(response(i, x.augmented[i]).traction);
    const RimForce force = resultant<dim>(state.traction.back(), points_[i].position);
    state.rim_force = sum(state.rim_force, scaled(-points_[i].weight, force));
  }
  return state;
}

template <int dim>
double ReducedContact<dim>::smallest_gap(const ContactState<dim>& state) const {
  double gap = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_points(); ++i) gap = std::min(gap, state.augmented[i][0] / points_[i].gamma);
  return gap;
}

template <int dim>
double ReducedContact<dim>::amplitude(const RimMotion& motion) const {
  double largest = 0;
  for (const Point& point : points_)
    largest = std::max(largest, norm<dim>(displacement<dim>(motion, point.position)));
  return largest;
}

template <int dim>
Matrix ReducedContact<dim>::contact_loads(const ContactState<dim>& state) const {
  const ObservationRows<dim> rows = observation_rows();
  Matrix loads(rows.n_contact(), zone_.n_columns);
  for (int i = 0; i < n_points(); ++i) {
    const Point& point = points_[i];
    const Vec<dim> traction = point.frame.template to_body<dim>(state.traction[i]);
    double* load = loads.column(zone_column(i));
    const int q = point_of_column(i);
    for (int d = 0; d < dim; ++d) {
      load[rows.displacement(q) + d] = point.weight * traction[d];
      load[rows.traction(q) + d] = -theta_ / point.gamma * point.weight * traction[d];
    }
  }
  return loads;
}

template <int dim>
Expected<std::vector<ContactAdjoint>> ReducedContact<dim>::adjoints(
    const ContactState<dim>& state, std::span<const ContactAdjointLoads<dim>> functions) const {
  // With Te p = h + F^T m: m - W Phi'^T F^T m + sum_k beta_k W Phi'^T m_k = Phi'^T (W h + dJ/dPhi) and, for
  // every free motion, sum gamma m.m_k = dJ/d(motion k). m vanishes off the active points; on them the matrix
  // is the tangent's, transposed.
  const int nc = components(), n_functions = static_cast<int>(functions.size());
  const ObservationRows<dim> rows = observation_rows();
  const auto of_law = tangents(state.augmented);
  const auto active = active_rows(of_law);
  const int n_active = static_cast<int>(active.size());
  const Matrix forward = active_system(of_law, active);
  Matrix a(forward.rows(), forward.rows()), m(forward.rows(), n_functions);
  for (int j = 0; j < a.columns(); ++j)
    for (int i = 0; i < a.rows(); ++i) a(i, j) = forward(j, i);
  for (int k = 0; k < n_active; ++k) {
    const int i = active[k] / nc, component = active[k] % nc, q = point_of_column(i);
    const Point& point = points_[i];
    for (int f = 0; f < n_functions; ++f) {
      const double* observed = functions[f].observations.column(zone_column(i));
      Vec<dim> tested;
      for (int d = 0; d < dim; ++d)
        tested[d] =
            theta_ / point.gamma * observed[rows.traction(q) + d] - observed[rows.displacement(q) + d];
      tested = point.frame.template to_ground<dim>(tested);
      const auto& tractions = functions[f].tractions;
      for (int d = 0; d < nc; ++d)
        m(k, f) += of_law[i][d][component] *
                   (point.weight * tested[d] + (tractions.empty() ? 0.0 : tractions[i][d]));
    }
  }
  for (int f = 0; f < n_functions; ++f)
    for (int k = 0; k < n_free(); ++k) m(n_active + k, f) = work(functions[f].rim, rim_.free[k].direction);
  if (!lu_solve(a, m)) return Failure{FailureReason::no_contact, "the adjoint contact system is singular"};

  std::vector<ContactAdjoint> result;
  for (int f = 0; f < n_functions; ++f) {
    std::vector<Vec<dim>> multiplier(n_points(), Vec<dim>{});
    for (int k = 0; k < n_active; ++k) multiplier[active[k] / nc][active[k] % nc] = m(k, f);
    ContactAdjoint adjoint{Matrix(rows.n_contact(), zone_.n_columns), {}, functions[f].rim.towards_ground};
    for (int i = 0; i < n_points(); ++i) {
      const Point& point = points_[i];
      adjoint.by_travel -= point.gamma * multiplier[i][0];
      const Vec<dim> value = point.frame.template to_body<dim>(multiplier[i]);
      double* load = adjoint.loads.column(zone_column(i));
      const int q = point_of_column(i);
      for (int d = 0; d < dim; ++d) {
        load[rows.displacement(q) + d] = point.gamma * value[d];
        load[rows.traction(q) + d] = -tau_ * value[d];
      }
    }
    for (int k = 0; k < n_free(); ++k)
      adjoint.rim = combined(adjoint.rim, -m(n_active + k, f), rim_.free[k].direction);
    result.push_back(std::move(adjoint));
  }
  return result;
}

template <int dim>
ContactPatch<dim> ReducedContact<dim>::patch(const ContactState<dim>& state) const {
  ContactPatch<dim> patch{.points = {},
                          .rim = state.rim,
                          .rim_force = state.rim_force,
                          .newton_iterations = state.newton_iterations,
                          .growth = growth_};
  for (int i = 0; i < n_points(); ++i)
    patch.points.push_back({.column = wrap(zone_.first_column + zone_column(i), ring_columns_),
                            .point = point_of_column(i),
                            .frame = points_[i].frame,
                            .position = points_[i].position,
                            .gap = points_[i].gap,
                            .weight = points_[i].weight,
                            .augmented = state.augmented[i],
                            .traction = state.traction[i]});
  return patch;
}

template class ContactTangent<2>;
template class ContactTangent<3>;
template class ReducedContact<2>;
template class ReducedContact<3>;

}  // namespace wheelwright
