#include "wheelwright/geometry/components.h"

#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// Values of psi at the nodes of a finer lattice.
template <int dim>
class Samples {
 public:
  Samples(const LevelSet<dim>& psi, int per_cell) : psi_(psi), lattice_(psi.lattice.grid(), per_cell) {
    std::vector<ShapeFunctions<dim>> shape;
    for (int k = 0; k < power(per_cell + 1, dim); ++k) {
      const auto p = local_node_position<dim>(per_cell, k);
      Vec<dim> xi;
      for (int d = 0; d < dim; ++d) xi[d] = static_cast<double>(p[d]) / per_cell;
      shape.emplace_back(psi.lattice.degree(), xi);
    }
    values_.resize(lattice_.n_nodes());
    for (int cell = 0; cell < grid().n_cells(); ++cell) {
      const auto c = grid().cell_position(cell);
      const auto nodal = psi.cell_values(cell);
      for (std::size_t k = 0; k < shape.size(); ++k)
        values_[lattice_.node_index(lattice_.cell_node(c, static_cast<int>(k)))] = value(shape[k], nodal);
    }
  }

  const Lattice<dim>& lattice() const { return lattice_; }
  bool is_material(int sample) const { return values_[sample] < 0; }
  bool is_material(const std::array<int, dim>& p) const { return is_material(index(p)); }

  /// As Lattice::node_index(), but faster for azimuths near the sector.
  int index(std::array<int, dim> p) const {
    const int period = lattice_.nodes()[1];
    while (p[1] < 0) p[1] += period;
    while (p[1] >= period) p[1] -= period;
    int index = p[1];
    if constexpr (dim == 3) index = index * lattice_.nodes()[2] + p[2];
    return index * lattice_.nodes()[0] + p[0];
  }

  /// Whether psi < 0 at the centre of the square that p spans with its neighbours along the axes a and b.
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
  static double value(const ShapeFunctions<dim>& shape, const std::vector<double>& nodal) {
    double sum = 0;
    for (std::size_t a = 0; a < nodal.size(); ++a) sum += shape.value[a] * nodal[a];
    return sum;
  }

  const LevelSet<dim>& psi_;
  Lattice<dim> lattice_;
  std::vector<double> values_;
};

template <int dim>
class FloodFill {
 public:
  using Position = std::array<int, dim>;

  explicit FloodFill(const Samples<dim>& samples)
      : samples_(samples),
        lattice_(samples.lattice()),
        result_{lattice_, std::vector<int>(lattice_.n_nodes(), -1), {}} {
    for (int first = 0; first < lattice_.n_nodes(); ++first)
      if (result_.of_sample[first] < 0) fill(first);
  }

  Components<dim> result() && { return std::move(result_); }

 private:
  bool exists(const Position& p) const {
    for (int d = 0; d < dim; ++d)
      if (d != 1 && (p[d] < 0 || p[d] >= lattice_.nodes()[d])) return false;
    return true;
  }

  /// Collects the component of a sample. Azimuthal positions are not wrapped at the faces of the sector, so
  /// that the image stays in one piece.
  void fill(int first) {
    const Vec<dim> origin = lattice_.polar_point(first);
    Component<dim> component{.is_material = samples_.is_material(first),
                             .measure = 0,
                             .centre = {},
                             .innermost = origin,
                             .outermost = origin,
                             .at_rim = false,
                             .at_tread = false};
    mark(lattice_.node_position(first));
    while (!front_.empty()) {
      const Position p = front_.back();
      front_.pop_back();
      add(p, component);
      for_each_neighbour(p, [&](const Position& next) {
        if (result_.of_sample[samples_.index(next)] < 0) mark(next);
      });
    }
    for (double& x : component.centre) x /= component.measure;
    for (Vec<dim>* point : {&component.centre, &component.innermost, &component.outermost})
      (*point)[1] = in_sector((*point)[1]);
    result_.all.push_back(component);
  }

  void mark(const Position& p) {
    result_.of_sample[samples_.index(p)] = static_cast<int>(result_.all.size());
    front_.push_back(p);
  }

  template <class Visit>
  void for_each_neighbour(const Position& p, Visit visit) const {
    const bool material = samples_.is_material(p);
    bool at_edge = false;
    for (int a = 0; a < dim; ++a)
      for (int step : {-1, 1}) {
        const Position next = moved(p, a, step);
        if (!exists(next)) continue;
        if (samples_.is_material(next) == material)
          visit(next);
        else
          at_edge = true;
      }
    if (!at_edge) return;
    for (int a = 0; a < dim; ++a)
      for (int b = a + 1; b < dim; ++b)
        for (int step_a : {-1, 1})
          for (int step_b : {-1, 1})
            if (joined_diagonally(p, a, b, step_a, step_b)) visit(moved(moved(p, a, step_a), b, step_b));
  }

  bool joined_diagonally(const Position& p, int a, int b, int step_a, int step_b) const {
    const bool material = samples_.is_material(p);
    const Position along_a = moved(p, a, step_a), along_b = moved(p, b, step_b),
                   across = moved(along_a, b, step_b);
    return exists(across) && samples_.is_material(across) == material &&
           samples_.is_material(along_a) != material && samples_.is_material(along_b) != material &&
           samples_.is_material_between(p, a, b, step_a, step_b) == material;
  }

  static Position moved(Position p, int axis, int step) {
    p[axis] += step;
    return p;
  }

  void add(const Position& p, Component<dim>& component) const {
    const Vec<dim> x = lattice_.polar_point(p);
    double share = x[0];
    for (int d = 0; d < dim; ++d) {
      const bool at_end = d != 1 && (p[d] == 0 || p[d] + 1 == lattice_.nodes()[d]);
      share *= lattice_.spacing()[d] * (at_end ? 0.5 : 1);
    }
    component.measure += share;
    for (int d = 0; d < dim; ++d) component.centre[d] += share * x[d];
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
  std::vector<Position> front_;
  Components<dim> result_;
};

}  // namespace

template <int dim>
Components<dim> components(const LevelSet<dim>& psi, int samples_per_cell) {
  const Samples<dim> samples(psi, samples_per_cell);
  return FloodFill<dim>(samples).result();
}

template Components<2> components(const LevelSet<2>&, int);
template Components<3> components(const LevelSet<3>&, int);

}  // namespace wheelwright
