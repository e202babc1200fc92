#include "wheelwright/shape/evolution/transport.h"

#include "wheelwright/linalg/dense.h"
#include "wheelwright/shape/evolution/boundary_motion.h"
#include "wheelwright/shape/evolution/lattice_strides.h"

namespace wheelwright {

namespace {

constexpr double cfl_number = 0.5;
constexpr int n_ghosts = 2;

double minmod(double a, double b) {
  if (a * b <= 0) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

/// Copies the lattice line that starts at node `first` along one axis, with two ghost values at each end.
template <int dim>
void read_line(const Lattice<dim>& lattice, const std::vector<double>& phi, int first, int axis,
               std::vector<double>& line) {
  const int n = lattice.nodes()[axis], stride = lattice_strides(lattice)[axis];
  line.resize(n + 2 * n_ghosts);
  double* value = line.data() + n_ghosts;
  for (int i = 0; i < n; ++i) value[i] = phi[first + i * stride];
  for (int g = 1; g <= n_ghosts; ++g) {
    if (axis == 1) {
      value[-g] = value[((-g) % n + n) % n];
      value[n - 1 + g] = value[(g - 1) % n];
    } else {
      value[-g] = 2 * value[1 - g] - value[2 - g];
      value[n - 1 + g] = 2 * value[n - 2 + g] - value[n - 3 + g];
    }
  }
}

/// One-sided differences of second order at the value in the middle of five.
struct OneSided {
  double backward, forward;
};

/// Of values at the distance 1 from each other.
OneSided one_sided(const double* v) {
  const double curvature = v[-1] - 2 * v[0] + v[1];
  return {v[0] - v[-1] + 0.5 * minmod(v[-2] - 2 * v[-1] + v[0], curvature),
          v[1] - v[0] - 0.5 * minmod(curvature, v[0] - 2 * v[1] + v[2])};
}

/// Of values at the places x.
OneSided one_sided(const double* v, const double* x) {
  const auto slope = [&](int i) { return (v[i + 1] - v[i]) / (x[i + 1] - x[i]); };
  const auto half_curvature = [&](int i) { return (slope(i) - slope(i - 1)) / (x[i + 1] - x[i - 1]); };
  return {slope(-1) + minmod(half_curvature(-1), half_curvature(0)) * (x[0] - x[-1]),
          slope(0) - minmod(half_curvature(0), half_curvature(1)) * (x[1] - x[0])};
}

/// The radii of the nodes of a line along the radius with the ghost values of read_line(); empty if they are
/// equally spaced.
template <int dim>
std::vector<double> unequal_radii(const Lattice<dim>& lattice) {
  std::vector<double> radii;
  if (lattice.grid().fixed_lines.empty()) return radii;
  for (int i = -n_ghosts; i < lattice.nodes()[0] + n_ghosts; ++i) radii.push_back(lattice.radius(i));
  return radii;
}

/// Square of the one-sided derivative that Godunov's scheme selects for a front with this speed.
double upwind_square(double backward, double forward, double speed) {
  const double b = speed > 0 ? std::max(backward, 0.0) : std::min(backward, 0.0);
  const double f = speed > 0 ? std::min(forward, 0.0) : std::max(forward, 0.0);
  return std::max(b * b, f * f);
}

/// |grad phi|^2 at all nodes, upwind with respect to the sign of the velocity.
template <int dim>
std::vector<double> squared_gradient(const Lattice<dim>& lattice, const std::vector<double>& phi,
                                     std::span<const double> velocity) {
  const auto stride = lattice_strides(lattice);
  const auto spacing = lattice.spacing(0);
  const std::vector<double> radii = unequal_radii(lattice);
  std::vector<double> result(phi.size()), line;
  for (int axis = 0; axis < dim; ++axis) {
    const bool is_unequal = axis == 0 && !radii.empty();
    for (const int first : first_nodes(lattice, axis)) {
      read_line(lattice, phi, first, axis, line);
      const double radius = lattice.polar_point(first)[0];
      const double length = is_unequal ? 1 : spacing[axis] * (axis == 1 ? radius : 1);
      for (int i = 0; i < lattice.nodes()[axis]; ++i) {
        const int node = first + i * stride[axis];
        if (velocity[node] == 0) continue;
        const double* v = line.data() + n_ghosts + i;
        const auto [backward, forward] =
            is_unequal ? one_sided(v, radii.data() + n_ghosts + i) : one_sided(v);
        result[node] += upwind_square(backward, forward, velocity[node]) / (length * length);
      }
    }
  }
  return result;
}

/// One explicit Euler step.
template <int dim>
void euler_step(const Lattice<dim>& lattice, std::span<const double> velocity, double dt,
                std::vector<double>& phi) {
  const auto gradient = squared_gradient(lattice, phi, velocity);
  for (std::size_t node = 0; node < phi.size(); ++node)
    phi[node] -= dt * velocity[node] * std::sqrt(gradient[node]);
}

/// Maximum number of nodes that a front crosses per unit of time [1/s].
template <int dim>
double crossing_rate(const Lattice<dim>& lattice, std::span<const double> velocity) {
  double rate = 0;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    if (velocity[node] == 0) continue;
    const int place = lattice.node_position(node)[0];
    Vec<dim> length = lattice.spacing(lattice.row_of(place));
    length[0] = std::min(length[0], lattice.spacing(lattice.row_of(place - 1))[0]);
    length[1] *= lattice.radius(place);
    double inverse_length = 0;
    for (double l : length) inverse_length += 1 / l;
    rate = std::max(rate, std::abs(velocity[node]) * inverse_length);
  }
  return rate;
}

}  // namespace

template <int dim>
LevelSet<dim> transport(const LevelSet<dim>& psi, std::span<const double> velocity, double time) {
  const int n_steps = static_cast<int>(std::ceil(crossing_rate(psi.lattice, velocity) * time / cfl_number));
  const double dt = time / std::max(n_steps, 1);
  std::vector<double> phi = psi.values;
  for (int step = 0; step < n_steps; ++step) {
    std::vector<double> twice = phi;
    euler_step(psi.lattice, velocity, dt, twice);
    euler_step(psi.lattice, velocity, dt, twice);
    for (std::size_t node = 0; node < phi.size(); ++node) phi[node] = 0.5 * (phi[node] + twice[node]);
  }
  return {psi.lattice, std::move(phi)};
}

template <int dim>
LevelSet<dim> smooth_transport(const LevelSet<dim>& psi, std::span<const double> velocity, double time) {
  constexpr double short_move = 0.3;  // cells
  LevelSet<dim> phi = transport<dim>(psi, velocity, time);
  const double moved = time * largest_magnitude(velocity) / (short_move * psi.lattice.grid().resolution());
  const double share = std::exp(-0.5 * moved * moved);
  const auto godunov = squared_gradient(psi.lattice, psi.values, velocity);
  const auto central = gradients_at_nodes<dim>(psi);
  for (std::size_t node = 0; node < phi.values.size(); ++node)
    phi.values[node] += share * time * velocity[node] * (std::sqrt(godunov[node]) - norm<dim>(central[node]));
  return phi;
}

template decltype(smooth_transport<2>) smooth_transport<2>;
template decltype(smooth_transport<3>) smooth_transport<3>;
template decltype(transport<2>) transport<2>;
template decltype(transport<3>) transport<3>;

}  // namespace wheelwright
