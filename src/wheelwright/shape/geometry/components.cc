#include "wheelwright/shape/geometry/components.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// Signs of psi at the nodes of a finer lattice.
template <int dim>
class Samples {
 public:
  Samples(const LevelSet<dim>& psi, int per_cell)
      : psi_(psi), lattice_(psi.lattice.grid(), per_cell), material_(lattice_.n_nodes()) {
    const int n = power(per_cell + 1, dim), n_nodes = nodes_per_cell<dim>(psi.lattice.degree());
    std::vector<std::array<int, dim>> position;
    std::vector<double> weight(n_nodes * n), sum(n);  // of the nodes at the samples of a cell, by node
    for (int k = 0; k < n; ++k) {
      position.push_back(local_node_position<dim>(per_cell, k));
      Vec<dim> xi;
      for (int d = 0; d < dim; ++d) xi[d] = static_cast<double>(position[k][d]) / per_cell;
      const ShapeFunctions<dim> shape(psi.lattice.degree(), xi);
      for (int a = 0; a < n_nodes; ++a) weight[a * n + k] = shape.value[a];
    }
    for (int cell = 0; cell < grid().n_cells(); ++cell) {
      const auto c = grid().cell_position(cell);
      const auto nodal = psi.cell_values(cell);
      if (has_one_sign(nodal)) {
        std::ranges::fill(sum, nodal.front());
      } else {
        std::ranges::fill(sum, 0.0);
        for (int a = 0; a < n_nodes; ++a)
          for (int k = 0; k < n; ++k) sum[k] += weight[a * n + k] * nodal[a];
      }
      for (int k = 0; k < n; ++k) material_[index_of(c, position[k])] = sum[k] < 0;
    }
  }

  const Lattice<dim>& lattice() const { return lattice_; }
  bool is_material(int sample) const { return material_[sample]; }

  /// Whether psi < 0 at the centre of the square spanned by p and its neighbours along the axes a and b.
  bool is_material_between(std::array<int, dim> p, int a, int b, int step_a, int step_b) const {
    const int period = lattice_.nodes()[1];
    p[1] = wrap(p[1], period);
    Vec<dim> x;
    for (int d = 0; d < dim; ++d) x[d] = p[d];
    x[a] += 0.5 * step_a;
    x[b] += 0.5 * step_b;
    if (x[1] < 0) x[1] += period;
    std::array<int, dim> cell;
    Vec<dim> xi;
    for (int d = 0; d < dim; ++d) {
      x[d] /= lattice_.degree();
      cell[d] = std::min(static_cast<int>(x[d]), grid().cells[d] - 1);
      xi[d] = x[d] - cell[d];
    }
    return value({psi_.lattice.degree(), xi}, psi_.cell_values(grid().cell_index(cell))) < 0;
  }

 private:
  const PolarGrid<dim>& grid() const { return lattice_.grid(); }

  /// Whether the cell's polynomial is so far from zero at all nodes that it has their sign everywhere: it
  /// leaves the range of its nodal values by at most half of the range on either side.
  static bool has_one_sign(const std::vector<double>& nodal) {
    const auto [low, high] = std::ranges::minmax(nodal);
    return std::abs(low + high) > 2 * (high - low);
  }

  /// The index of a cell's sample at this position in the cell.
  int index_of(const std::array<int, dim>& cell, std::array<int, dim> position) const {
    for (int d = 0; d < dim; ++d) position[d] += lattice_.degree() * cell[d];
    if (position[1] == lattice_.nodes()[1]) position[1] = 0;
    return position[1] * lattice_.nodes_per_line() + lattice_.index_on_line(position);
  }

  static double value(const ShapeFunctions<dim>& shape, const std::vector<double>& nodal) {
    double sum = 0;
    for (std::size_t a = 0; a < nodal.size(); ++a) sum += shape.value[a] * nodal[a];
    return sum;
  }

  const LevelSet<dim>& psi_;
  Lattice<dim> lattice_;
  std::vector<char> material_;
};

template <int dim>
class FloodFill {
 public:
  explicit FloodFill(const Samples<dim>& samples)
      : samples_(samples),
        lattice_(samples.lattice()),
        node_angle_(lattice_.node_angle()),
        result_{lattice_, std::vector<int>(lattice_.n_nodes(), -1), {}} {
    stride_[0] = 1;
    if constexpr (dim == 3) stride_[2] = lattice_.nodes()[0];
    stride_[1] = lattice_.nodes_per_line();
    for (int sample = 0; sample < lattice_.nodes_per_line(); ++sample)
      on_line_.push_back({.share = share_of(lattice_.node_position(sample)),
                          .polar = lattice_.polar_point(lattice_.node_position(sample))});
    front_.reserve(lattice_.n_nodes());
    for (int first = 0; first < lattice_.n_nodes(); ++first)
      if (result_.of_sample[first] < 0) fill(first);
  }

  Components<dim> result() && { return std::move(result_); }

 private:
  /// Azimuthal positions are not wrapped at the faces of the sector, so that an image remains in one piece;
  /// the index is that of the sample in the sector.
  struct Place {
    std::array<int, dim> position;
    int index;
  };

  /// Collects the component of a sample.
  void fill(int first) {
    const Place begin{lattice_.node_position(first), first};
    const Vec<dim> origin = lattice_.polar_point(begin.position);
    Component<dim> component{.is_material = samples_.is_material(first),
                             .measure = 0,
                             .centre = {},
                             .innermost = origin,
                             .outermost = origin,
                             .at_rim = false,
                             .at_tread = false};
    mark(begin);
    while (!front_.empty()) {
      const Place place = front_.back();
      front_.pop_back();
      add(place.position, component);
      mark_neighbours(place, component.is_material);
    }
    for (double& x : component.centre) x /= component.measure;
    for (Vec<dim>* point : {&component.centre, &component.innermost, &component.outermost})
      (*point)[1] = in_sector((*point)[1]);
    result_.all.push_back(component);
  }

  void mark(const Place& place) {
    result_.of_sample[place.index] = static_cast<int>(result_.all.size());
    front_.push_back(place);
  }
  bool is_marked(int sample) const { return result_.of_sample[sample] >= 0; }

  bool has_neighbour(const Place& place, int axis, int step) const {
    const int p = place.position[axis] + step;
    return axis == 1 || (p >= 0 && p < lattice_.nodes()[axis]);
  }

  /// The index of the neighbour of a sample along an axis.
  int neighbour(int sample, int axis, int step) const {
    const int next = sample + step * stride_[axis];
    if (axis != 1) return next;
    return next < 0                     ? next + lattice_.n_nodes()
           : next >= lattice_.n_nodes() ? next - lattice_.n_nodes()
                                        : next;
  }

  Place moved(Place place, int axis, int step) const {
    place.index = neighbour(place.index, axis, step);
    place.position[axis] += step;
    return place;
  }

  void mark_neighbours(const Place& place, bool material) {
    bool at_edge = false;
    for (int a = 0; a < dim; ++a)
      for (int step : {-1, 1}) {
        if (!has_neighbour(place, a, step)) continue;
        const int next = neighbour(place.index, a, step);
        if (samples_.is_material(next) != material)
          at_edge = true;
        else if (!is_marked(next))
          mark(moved(place, a, step));
      }
    if (!at_edge) return;
    for (int a = 0; a < dim; ++a)
      for (int b = a + 1; b < dim; ++b)
        for (int step_a : {-1, 1})
          for (int step_b : {-1, 1})
            if (joined_diagonally(place, material, a, b, step_a, step_b)) {
              const Place across = moved(moved(place, a, step_a), b, step_b);
              if (!is_marked(across.index)) mark(across);
            }
  }

  bool joined_diagonally(const Place& place, bool material, int a, int b, int step_a, int step_b) const {
    if (!has_neighbour(place, a, step_a) || !has_neighbour(place, b, step_b)) return false;
    const int along_a = neighbour(place.index, a, step_a), along_b = neighbour(place.index, b, step_b);
    return samples_.is_material(neighbour(along_a, b, step_b)) == material &&
           samples_.is_material(along_a) != material && samples_.is_material(along_b) != material &&
           samples_.is_material_between(place.position, a, b, step_a, step_b) == material;
  }

  /// The measure that belongs to a sample: half of the way to each of its neighbours.
  double share_of(const std::array<int, dim>& p) const {
    double share = lattice_.radius(p[0]);
    const Vec<dim> below = lattice_.spacing(lattice_.row_of(p[0] - 1)),
                   above = lattice_.spacing(lattice_.row_of(p[0]));
    for (int d = 0; d < dim; ++d) {
      const bool is_first = d != 1 && p[d] == 0, is_last = d != 1 && p[d] + 1 == lattice_.nodes()[d];
      share *= 0.5 * ((is_first ? 0 : below[d]) + (is_last ? 0 : above[d]));
    }
    return share;
  }

  void add(const std::array<int, dim>& p, Component<dim>& component) const {
    auto [share, x] = on_line_[lattice_.index_on_line(p)];
    x[1] = p[1] * node_angle_;
    component.measure += share;
    component.centre += share * x;
    if (x[0] < component.innermost[0]) component.innermost = x;
    if (x[0] > component.outermost[0]) component.outermost = x;
    component.at_rim = component.at_rim || p[0] == 0;
    component.at_tread = component.at_tread || p[0] + 1 == lattice_.nodes()[0];
  }

  double in_sector(double azimuth) const {
    const double sector = lattice_.grid().sector_angle();
    const double result = azimuth - sector * std::floor(azimuth / sector);
    return result < sector ? result : 0;  // rounding can give the sector angle itself
  }

  const Samples<dim>& samples_;
  const Lattice<dim>& lattice_;
  std::array<int, dim> stride_;  ///< of the samples' indices
  struct OnLine {
    double share;    ///< share_of() the sample
    Vec<dim> polar;  ///< (radius, 0[, axial])
  };
  std::vector<OnLine> on_line_;  ///< the samples at the first azimuth
  double node_angle_;            ///< of the samples [rad]
  std::vector<Place> front_;
  Components<dim> result_;
};

}  // namespace

template <int dim>
Components<dim> components(const LevelSet<dim>& psi, int samples_per_cell) {
  const Samples<dim> samples(psi, samples_per_cell);
  return FloodFill<dim>(samples).result();
}

template decltype(components<2>) components<2>;
template decltype(components<3>) components<3>;

}  // namespace wheelwright
