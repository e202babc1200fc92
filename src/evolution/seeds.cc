#include "evolution/seeds.h"

#include <limits>

#include "evolution/closest_point.h"

namespace wheelwright {

namespace {

constexpr int samples_per_axis = 3;

/// Root of psi on the lattice edge from `node` along `axis`, whose ends differ in sign: Newton, kept in a
/// shrinking bracket.
template <int dim>
Vec<dim> edge_root(const CubicInterpolant<dim>& psi, const std::array<int, dim>& node, int axis) {
  Vec<dim> x;
  for (int d = 0; d < dim; ++d) x[d] = node[d];
  double low = node[axis], high = node[axis] + 1;
  const bool negative_at_low = psi(x).value < 0;
  double length = psi.lattice().spacing()[axis];
  if (axis == 1) length *= psi.lattice().grid().inner_radius + node[0] * psi.lattice().spacing()[0];
  x[axis] = 0.5 * (low + high);
  for (int k = 0; k < 60; ++k) {
    const Jet<dim> jet = psi(x);
    ((jet.value < 0) == negative_at_low ? low : high) = x[axis];
    double next = x[axis] - jet.value / (jet.gradient[axis] * length);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::abs(next - x[axis]);
    x[axis] = next;
    if (change < 1e-12) break;
  }
  return x;
}

template <int dim>
bool is_negative(const LevelSet<dim>& psi, const std::array<int, dim>& node) {
  return psi.values[psi.lattice.node_index(node)] < 0;
}

}  // namespace

template <int dim>
std::vector<Vec<dim>> zero_seeds(const CubicInterpolant<dim>& psi) {
  const auto& lattice = psi.lattice();
  std::vector<Vec<dim>> seeds;
  for (int index = 0; index < lattice.n_nodes(); ++index) {
    const auto node = lattice.node_position(index);
    const bool negative = is_negative<dim>(psi.level_set(), node);
    std::array<bool, dim> has_next;
    bool is_element = true;
    for (int d = 0; d < dim; ++d) {
      has_next[d] = d == 1 || node[d] + 1 < lattice.nodes()[d];
      is_element = is_element && has_next[d];
    }
    for (int axis = 0; axis < dim; ++axis) {
      auto neighbour = node;
      ++neighbour[axis];
      if (has_next[axis] && is_negative<dim>(psi.level_set(), neighbour) != negative)
        seeds.push_back(edge_root<dim>(psi, node, axis));
    }
    if (!is_element) continue;
    bool is_cut = false;
    for (int corner = 1; corner < power(2, dim); ++corner) {
      auto p = local_node_position<dim>(1, corner);
      for (int d = 0; d < dim; ++d) p[d] += node[d];
      is_cut = is_cut || is_negative<dim>(psi.level_set(), p) != negative;
    }
    if (!is_cut) continue;
    for (int sample = 0; sample < power(samples_per_axis, dim); ++sample) {
      const auto p = local_node_position<dim>(samples_per_axis - 1, sample);
      Vec<dim> start;
      for (int d = 0; d < dim; ++d) start[d] = node[d] + (p[d] + 0.5) / samples_per_axis;
      if (const auto seed = project_to_zero<dim>(psi, start)) seeds.push_back(*seed);
    }
  }
  return seeds;
}

template <int dim>
SeedIndex<dim>::SeedIndex(const Lattice<dim>& lattice, const std::vector<Vec<dim>>& seeds)
    : lattice_(lattice), seeds_(seeds.size()), bin_start_(lattice.n_nodes() + 1) {
  const int n_azimuths = lattice.nodes()[1];
  std::vector<Vec<dim>> points = seeds;
  std::vector<int> bin(seeds.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k][1] -= n_azimuths * std::floor(points[k][1] / n_azimuths);
    std::array<int, dim> element;
    for (int d = 0; d < dim; ++d)
      element[d] = std::clamp(static_cast<int>(points[k][d]), 0, lattice.nodes()[d] - 1);
    bin[k] = lattice.node_index(element);
    ++bin_start_[bin[k] + 1];
  }
  for (int b = 0; b < lattice.n_nodes(); ++b) bin_start_[b + 1] += bin_start_[b];
  std::vector<int> next = bin_start_;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Vec<dim> polar;
    for (int d = 0; d < dim; ++d) polar[d] = points[k][d] * lattice.spacing()[d];
    polar[0] += lattice.grid().inner_radius;
    seeds_[next[bin[k]]++] = {points[k], cartesian<dim>(polar)};
  }
}

template <int dim>
Vec<dim> SeedIndex<dim>::nearest(const std::array<int, dim>& node) const {
  const int last_shell = *std::max_element(lattice_.nodes().begin(), lattice_.nodes().end());
  Candidate best{std::numeric_limits<double>::infinity(), {}};
  for (int shell = 1; shell <= last_shell; ++shell) {
    search_shell(shell, node, best);
    const double unreached = distance_outside(shell);
    if (best.distance2 <= unreached * unreached) break;
  }
  return best.point;
}

/// Lower bound of a node's distance to the elements beyond this shell.
template <int dim>
double SeedIndex<dim>::distance_outside(int shell) const {
  const Vec<dim> spacing = lattice_.spacing();
  const double half_angle = std::min(0.5 * shell * spacing[1], 0.5 * std::numbers::pi);
  double distance = std::min(shell * spacing[0], 2 * lattice_.grid().inner_radius * std::sin(half_angle));
  if constexpr (dim == 3) distance = std::min(distance, shell * spacing[2]);
  return distance;
}

/// The elements whose lattice distance from the node is shell - 1: shell 1 are those that touch it.
template <int dim>
void SeedIndex<dim>::search_shell(int shell, const std::array<int, dim>& node, Candidate& best) const {
  const auto& n = lattice_.nodes();
  const auto is_edge = [shell](int offset) { return offset == -shell || offset == shell - 1; };
  const int half_turn = (n[1] + 1) / 2;
  const int first = -std::min(shell, half_turn), last = std::min(shell, half_turn) - 1;
  const Vec<dim> polar = lattice_.polar_point(node);
  for (int azimuth = first; azimuth <= last; ++azimuth) {
    const auto search_row = [&](int axial) {
      const int stride = is_edge(azimuth) || is_edge(axial) ? 1 : 2 * shell - 1;
      for (int radial = -shell; radial < shell; radial += stride) {
        std::array<int, dim> element;
        element[0] = node[0] + radial;
        element[1] = node[1] + azimuth;
        if constexpr (dim == 3) element[2] = node[2] + axial;
        if (element[0] >= 0 && element[0] < n[0]) search_element(element, polar, best);
      }
    };
    if constexpr (dim == 2) {
      search_row(0);
    } else {
      for (int axial = -shell; axial < shell; ++axial)
        if (node[2] + axial >= 0 && node[2] + axial < n[2]) search_row(axial);
    }
  }
}

template <int dim>
void SeedIndex<dim>::search_element(const std::array<int, dim>& element, const Vec<dim>& node_polar,
                                    Candidate& best) const {
  const int bin = lattice_.node_index(element);
  if (bin_start_[bin] == bin_start_[bin + 1]) return;
  // The node's image next to the seeds' own sector.
  const int n_azimuths = lattice_.nodes()[1];
  const int sector = (element[1] >= 0 ? element[1] : element[1] - n_azimuths + 1) / n_azimuths;
  Vec<dim> image = node_polar;
  image[1] -= sector * lattice_.grid().sector_angle();
  image = cartesian<dim>(image);
  for (int k = bin_start_[bin]; k < bin_start_[bin + 1]; ++k) {
    double distance2 = 0;
    for (int d = 0; d < dim; ++d)
      distance2 += (image[d] - seeds_[k].position[d]) * (image[d] - seeds_[k].position[d]);
    if (distance2 >= best.distance2) continue;
    best = {distance2, seeds_[k].point};
    best.point[1] += sector * n_azimuths;
  }
}

template std::vector<Vec<2>> zero_seeds<2>(const CubicInterpolant<2>&);
template std::vector<Vec<3>> zero_seeds<3>(const CubicInterpolant<3>&);
template class SeedIndex<2>;
template class SeedIndex<3>;

}  // namespace wheelwright
