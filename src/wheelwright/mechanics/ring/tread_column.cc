#include "wheelwright/mechanics/ring/tread_column.h"

#include <fmt/format.h>

#include <map>

namespace wheelwright {
namespace {

/// A layer of equal cells across the column.
struct Layer {
  double inner_radius, outer_radius;
  int rows, level;
};

/// Lower half halved once, next quarter twice, ..., last part `levels` times: two rows of its cells.
std::vector<Layer> layers(double inner_radius, double outer_radius, const TreadGrid& tread) {
  if (tread.levels == 0) return {{inner_radius, outer_radius, tread.rows, 0}};
  std::vector<Layer> result;
  double r = inner_radius, height = outer_radius - inner_radius;
  for (int level = 1; level < tread.levels; ++level) {
    height /= 2;
    result.push_back({r, r + height, tread.rows, level});
    r += height;
  }
  result.push_back({r, outer_radius, 2 * tread.rows, tread.levels});
  return result;
}

/// The polar displacement of a node as a combination of displacements of free nodes.
template <int dim>
using NodeMap = std::vector<std::pair<int, Mat<dim>>>;

/// The nodes of a column: free ones are numbered base, first azimuth, last azimuth, inner.
template <int dim>
class ColumnNodes {
 public:
  ColumnNodes(const PolarGrid<dim>& grid, int degree, const TreadGrid& tread)
      : degree_(degree), column_angle_(grid.column_angle()), rows_(tread.rows) {
    if constexpr (dim == 3) axial_nodes_ = degree * grid.cells[2] + 1;
    const double height = grid.height_of_rows(grid.cells[0] - tread.rows, grid.cells[0]);
    layers_ = layers(grid.outer_radius - height, grid.outer_radius, tread);
    // Free lines upward: the base, then every line of every layer except its lowest, which is the top line of
    // the layer below.
    intervals_.push_back(degree);
    for (const Layer& layer : layers_) {
      first_line_.push_back(static_cast<int>(intervals_.size()) - 1);
      for (int j = 1; j <= degree * layer.rows; ++j) intervals_.push_back(degree << layer.level);
    }
    int next = 0;
    const auto number = [&](size_t line, int across, int axial) {
      numbers_[{int(line), across, axial}] = next++;
    };
    for (int across = 0; across <= degree; ++across)
      for (int axial = 0; axial < axial_nodes_; ++axial) number(0, across, axial);
    for (int side = 0; side < 2; ++side)
      for (int axial = 0; axial < axial_nodes_; ++axial)
        for (size_t line = 1; line < intervals_.size(); ++line) number(line, side * intervals_[line], axial);
    for (size_t line = 1; line < intervals_.size(); ++line)
      for (int across = 1; across < intervals_[line]; ++across)
        for (int axial = 0; axial < axial_nodes_; ++axial) number(line, across, axial);
    n_nodes_ = next;
  }

  const std::vector<Layer>& all_layers() const { return layers_; }
  int n_base() const { return dim * (degree_ + 1) * axial_nodes_; }
  int n_line() const { return dim * (static_cast<int>(intervals_.size()) - 1) * axial_nodes_; }
  int n_dofs() const { return dim * n_nodes_; }

  /// The node of a layer at (line above the layer's bottom, node across the column, axial).
  NodeMap<dim> node(int layer, int line, int across, int axial) const {
    const int free_line = first_line_[layer] + line;
    const int intervals = degree_ << layers_[layer].level;
    if (intervals_[free_line] == intervals) return {{numbers_.at({free_line, across, axial}), turn(0)}};
    // Hanging: interpolate the coarser cell's displacement along its edge.
    const int coarse_intervals = intervals_[free_line];
    const double position = static_cast<double>(across) * coarse_intervals / intervals;  // in coarse nodes
    const int cell = std::min(static_cast<int>(position) / degree_, coarse_intervals / degree_ - 1);
    const Lagrange1D basis(degree_, position / degree_ - cell);
    NodeMap<dim> map;
    for (int a = 0; a <= degree_; ++a) {
      const int coarse = degree_ * cell + a;
      if (basis.value[a] == 0) continue;
      Mat<dim> weight = turn((coarse - position) * column_angle_ / coarse_intervals);
      for (auto& weights : weight)
        for (double& w : weights) w *= basis.value[a];
      map.push_back({numbers_.at({free_line, coarse, axial}), weight});
    }
    return map;
  }

  /// The free dofs fixed by the side faces.
  std::vector<int> held_dofs(SideFaces sides) const {
    std::vector<int> dofs;
    for (const auto& [place, number] : numbers_)
      for (int c = 0; c < dim; ++c)
        if (is_held<dim>(sides, place[2], axial_nodes_ - 1, c)) dofs.push_back(dim * number + c);
    return dofs;
  }

  /// The free node at a node of the level set's grid: `row_node` and `across` in units of its node spacing.
  int grid_node(int row_node, int across, int axial) const {
    const double height = static_cast<double>(row_node) / (degree_ * rows_);
    const double r0 = layers_.front().inner_radius, r1 = layers_.back().outer_radius;
    for (size_t i = 0; i < layers_.size(); ++i) {
      const Layer& layer = layers_[i];
      const double line = (r0 + height * (r1 - r0) - layer.inner_radius) /
                          (layer.outer_radius - layer.inner_radius) * degree_ * layer.rows;
      const int nearest = static_cast<int>(std::lround(line));
      if (nearest < 1 || nearest > degree_ * layer.rows || std::abs(line - nearest) > 1e-6) continue;
      return numbers_.at({first_line_[i] + nearest, across << layer.level, axial});
    }
    return -1;
  }

 private:
  /// Maps polar components at one azimuth to those at another, `angle` further back.
  static Mat<dim> turn(double angle) {
    Mat<dim> m{};
    for (int d = 0; d < dim; ++d) m[d][d] = 1;
    m[0][0] = m[1][1] = std::cos(angle);
    m[0][1] = -std::sin(angle);
    m[1][0] = std::sin(angle);
    return m;
  }

  int degree_, axial_nodes_ = 1, n_nodes_ = 0;
  double column_angle_;
  int rows_;
  std::vector<Layer> layers_;
  std::vector<int> intervals_;   ///< of each free line, across the column
  std::vector<int> first_line_;  ///< of each layer: its lowest
  std::map<std::array<int, 3>, int> numbers_;
};

/// Adds rows of a linear map of a cell's dofs to a matrix on the free dofs.
template <int dim, class Map>
void add_rows(const Map& map, std::span<const NodeMap<dim>> nodes, int first_row, double angle,
              Matrix& result) {
  for (size_t a = 0; a < nodes.size(); ++a)
    for (const auto& [node, weight] : nodes[a])
      for (int c = 0; c < dim; ++c) {
        Vec<dim> value{};
        for (int k = 0; k < dim; ++k)
          for (int d = 0; d < dim; ++d) value[d] += map[d][dim * a + k] * weight[k][c];
        value = rotated<dim>(value, angle);
        for (int d = 0; d < dim; ++d) result(first_row + d, dim * node + c) += value[d];
      }
}

/// Adds a linear function of a cell's dofs, on its free dofs.
template <int dim, class Row>
void add_number(const Row& function, std::span<const NodeMap<dim>> nodes, int row, Matrix& result) {
  for (size_t a = 0; a < nodes.size(); ++a)
    for (const auto& [node, weight] : nodes[a])
      for (int c = 0; c < dim; ++c)
        for (int k = 0; k < dim; ++k) result(row, dim * node + c) += function[dim * a + k] * weight[k][c];
}

/// Adds a cell's stiffness on its free dofs.
template <int dim>
void add_stiffness(const Matrix& k, std::span<const NodeMap<dim>> nodes, Matrix& result) {
  std::vector<int> dofs;
  std::map<int, int> position;
  for (const auto& map : nodes)
    for (const auto& entry : map)
      if (position.emplace(entry.first, static_cast<int>(position.size())).second)
        for (int c = 0; c < dim; ++c) dofs.push_back(dim * entry.first + c);
  Matrix expand(k.rows(), static_cast<int>(dofs.size()));
  for (size_t a = 0; a < nodes.size(); ++a)
    for (const auto& [node, weight] : nodes[a])
      for (int i = 0; i < dim; ++i)
        for (int c = 0; c < dim; ++c)
          expand(dim * static_cast<int>(a) + i, dim * position[node] + c) += weight[i][c];
  const Matrix free = product(expand, Op::transpose, product(k, Op::none, expand, Op::none), Op::none);
  for (int j = 0; j < free.columns(); ++j)
    for (int i = 0; i < free.rows(); ++i) result(dofs[i], dofs[j]) += free(i, j);
}

/// The uncondensed column.
template <int dim>
struct FreeColumn {
  TreadSurface<dim> surface;
  double volume;
  Vec<dim> moment;
  Matrix stiffness, observation, nodal;
};

/// Picks the nodes of the level set's grid above the base out of the free ones: TreadColumn::nodal before
/// condensation.
template <int dim>
Matrix grid_nodes(const ColumnNodes<dim>& nodes, int degree, int rows, int axial_cells) {
  const int axial_nodes = dim == 3 ? degree * axial_cells + 1 : 1, height = degree * rows;
  Matrix result(dim * degree * axial_nodes * height, nodes.n_dofs());
  for (int across = 0; across < degree; ++across)
    for (int axial = 0; axial < axial_nodes; ++axial)
      for (int line = 1; line <= height; ++line)
        for (int c = 0; c < dim; ++c)
          result(dim * ((across * axial_nodes + axial) * height + line - 1) + c,
                 dim * nodes.grid_node(line, across, axial) + c) = 1;
  return result;
}

/// Index of each point's mirror image along an axis, for a symmetric rule.
template <int dim>
std::vector<int> mirror_images(const std::vector<ReferencePoint<dim>>& rule, int axis) {
  std::vector<int> images;
  for (const auto& point : rule) {
    const auto distance = [&](const ReferencePoint<dim>& other) {
      double sum = 0;
      for (int d = 0; d < dim; ++d)
        sum += std::abs(other.xi[d] - (d == axis ? 1 - point.xi[d] : point.xi[d]));
      return sum;
    };
    images.push_back(static_cast<int>(std::ranges::min_element(rule, {}, distance) - rule.begin()));
  }
  return images;
}

/// The Gauss points of a contact face. Along the axle the pressure is as smooth as the displacement, and
/// degree + 1 points resolve it; along the ground it starts and ends inside faces.
template <int dim>
std::vector<ReferencePoint<dim - 1>> contact_rule(int points, int degree) {
  if constexpr (dim == 2) return unit_cell_rule<1>(points);
  const GaussRule along_ground = gauss_rule(points), along_axle = gauss_rule(std::min(points, degree + 1));
  std::vector<ReferencePoint<dim - 1>> rule;
  for (size_t k = 0; k < along_axle.points.size(); ++k)
    for (int i = 0; i < points; ++i) {
      ReferencePoint<dim - 1> point{{along_ground.points[i]},
                                    along_ground.weights[i] * along_axle.weights[k]};
      point.xi[dim - 2] = along_axle.points[k];
      rule.push_back(point);
    }
  return rule;
}

/// A cell of a column.
template <int dim>
struct ColumnCell {
  const ElasticElement<dim>& element;
  const MaterialLaw<dim>& law;
  std::vector<NodeMap<dim>> nodes;
  double angle;      ///< of its frame in the column's
  int to_image;      ///< cells from here to the mirror image in the column
  int axial;         ///< cell along the axle
  Matrix stiffness;  ///< on its own dofs
};

/// Assembles a column cell by cell.
template <int dim>
class ColumnAssembly {
 public:
  ColumnAssembly(const ElementTable<dim>& table, const ColumnNodes<dim>& nodes, const TreadGrid& tread,
                 const ContactForm& form, int points_per_direction)
      : table_(table),
        grid_(table.grid()),
        materials_(table.materials()),
        nodes_(nodes),
        form_(form),
        degree_(table.degree()),
        contact_points_(points_per_direction),
        annulus_points_(tread.annulus_points),
        volume_rule_(unit_cell_rule<dim>(degree_ + 2)),
        face_rule_(contact_rule<dim>(points_per_direction, degree_)),
        annulus_rule_(unit_cell_rule<dim>(tread.annulus_points)) {
    if constexpr (dim == 3) axial_cells_ = grid_.cells[2];
    int n_cells = 0;
    for (const Layer& layer : nodes.all_layers()) n_cells += layer.rows * (1 << layer.level) * axial_cells_;
    rows_ = {(1 << nodes.all_layers().back().level) * axial_cells_ * static_cast<int>(face_rule_.size()),
             n_cells * static_cast<int>(annulus_rule_.size()), tread.observes_spin};
    column_.stiffness = Matrix(nodes.n_dofs(), nodes.n_dofs());
    column_.observation = Matrix(rows_.size(), nodes.n_dofs());
    column_.surface.annulus_thickness = grid_.height_of_rows(grid_.cells[0] - tread.rows, grid_.cells[0]);
    column_.surface.n_columns = grid_.ring_columns();
    column_.surface.has_spin = tread.observes_spin;
    column_.nodal = grid_nodes<dim>(nodes, degree_, tread.rows, axial_cells_);
  }

  FreeColumn<dim> run() && {
    const int n_layers = static_cast<int>(nodes_.all_layers().size());
    for (int layer = 0; layer < n_layers; ++layer)
      for (int row = 0; row < nodes_.all_layers()[layer].rows; ++row) add_row(layer, row);
    for (const int dof : nodes_.held_dofs(table_.sides())) {
      for (int i = 0; i < nodes_.n_dofs(); ++i) column_.stiffness(i, dof) = column_.stiffness(dof, i) = 0;
      column_.stiffness(dof, dof) = table_.held_stiffness();
    }
    column_.surface.mirror_images = all_mirror_images();
    return std::move(column_);
  }

 private:
  void add_row(int layer_index, int row) {
    const Layer& layer = nodes_.all_layers()[layer_index];
    PolarGrid<dim> fine = grid_;
    fine.inner_radius = layer.inner_radius;
    fine.outer_radius = layer.outer_radius;
    fine.cells[0] = layer.rows;
    fine.fixed_lines.clear();
    fine.cells[1] <<= layer.level;
    const MaterialLaw<dim>& law = materials_.in_row(fine, row);
    const ElasticElement<dim> element(fine, degree_, {row}, law, table_.dilatation());
    const Matrix stiffness = table_.bulk_stiffness(element, law, volume_rule_);
    const bool at_tread = &layer == &nodes_.all_layers().back() && row + 1 == layer.rows;
    add_face_rows(1 << layer.level, at_tread);
    for (int axial = 0; axial < axial_cells_; ++axial)
      for (int across = 0; across < (1 << layer.level); ++across) {
        ColumnCell<dim> cell{.element = element,
                             .law = law,
                             .nodes = cell_nodes(layer_index, row, across, axial),
                             .angle = across * fine.column_angle(),
                             .to_image = (1 << layer.level) - 1 - 2 * across,
                             .axial = axial,
                             .stiffness = stiffness};
        if (at_tread) add_contact_face(cell);
        if (at_tread && element.projects_dilatation())
          add_pressure_jumps(cell, layer_index, row, across, fine);
        add_annulus(cell);
        add_volume(cell);
        add_stiffness<dim>(cell.stiffness, cell.nodes, column_.stiffness);
      }
  }

  /// The penalty of the traction's jump on the faces between a cell at the tread and the next ones in the
  /// column, and its mirror image beyond the middle of the wheel. Where contact fixes the normal
  /// displacement, pressures that rise with the same slope in every cell and drop between cells do no work on
  /// it: without the penalty they grow with lambda. It has its whole weight where all of lambda is projected.
  void add_pressure_jumps(const ColumnCell<dim>& cell, int layer, int row, int across,
                          const PolarGrid<dim>& fine) {
    const double projected = cell.element.projected_lambda(), lambda = cell.law.isotropic()->lambda();
    const double weight = projected < lambda ? 0.1 * projected / lambda : 0.1;
    for (int axis = 1; axis < dim; ++axis) {
      const int next_across = across + (axis == 1 ? 1 : 0), next_axial = cell.axial + (axis == 2 ? 1 : 0);
      const bool at_middle = next_axial == axial_cells_ && is_half(table_.sides());
      if (next_across == 1 << nodes_.all_layers()[layer].level) continue;
      if (next_axial == axial_cells_ && !at_middle) continue;
      const Matrix jump = traction_jump_stiffness<dim>(
          cell.element, cell.element, axis, axis == 1 ? fine.column_angle() : 0.0, cell.law, weight);
      auto nodes = cell.nodes;
      if (at_middle) {
        add_stiffness<dim>(half_of_symmetric_pair(jump, degree_), nodes, column_.stiffness);
        continue;
      }
      const auto next = cell_nodes(layer, row, next_across, next_axial);
      nodes.insert(nodes.end(), next.begin(), next.end());
      add_stiffness<dim>(jump, nodes, column_.stiffness);
    }
  }

  /// TreadSurface::face_rows of the cells that are added next.
  void add_face_rows(int cells_across, bool at_tread) {
    auto& rows = column_.surface.face_rows;
    const int axial_lines = dim == 3 ? annulus_points_ : 1, per_cell = static_cast<int>(annulus_rule_.size());
    const int first = rows_.annulus_traction(static_cast<int>(column_.surface.annulus_weights.size())) / dim;
    for (int axial = 0; axial < axial_cells_; ++axial) {
      for (int line = 0; line < axial_lines; ++line)
        for (int radial = 0; radial < annulus_points_; ++radial)
          rows.push_back({cells_across, annulus_points_,
                          first + axial * cells_across * per_cell + power(annulus_points_, 2) * line + radial,
                          per_cell, annulus_points_});
      if (!at_tread) continue;
      const int per_face = static_cast<int>(face_rule_.size());
      for (int line = 0; line < per_face / contact_points_; ++line)
        for (const int part : {0, 1})
          rows.push_back({cells_across, contact_points_,
                          2 * (axial * cells_across * per_face + contact_points_ * line) + part, 2 * per_face,
                          2});
    }
  }

  std::vector<NodeMap<dim>> cell_nodes(int layer, int row, int across, int axial) const {
    std::vector<NodeMap<dim>> result;
    for (int a = 0; a < nodes_per_cell<dim>(degree_); ++a) {
      const auto p = local_node_position<dim>(degree_, a);
      int axial_node = 0;
      if constexpr (dim == 3) axial_node = degree_ * axial + p[2];
      result.push_back(nodes_.node(layer, degree_ * row + p[0], degree_ * across + p[1], axial_node));
    }
    return result;
  }

  /// The images of a cell's points, from those of its rule.
  static void append_images(const std::vector<int>& of_rule, const ColumnCell<dim>& cell,
                            std::vector<int>& images) {
    const int n = static_cast<int>(of_rule.size()), first = static_cast<int>(images.size());
    for (const int image : of_rule) images.push_back(first + n * cell.to_image + image);
  }

  /// TreadSurface::mirror_images from those of the points.
  std::vector<int> all_mirror_images() const {
    std::vector<int> images;
    for (const int point : point_images_)
      for (const int part : {0, 1}) images.push_back(2 * point + part);
    for (const int point : annulus_images_) images.push_back(rows_.annulus_traction(point) / dim);
    images.push_back(static_cast<int>(images.size()));
    return images;
  }

  void add_contact_face(ColumnCell<dim>& cell) {
    const double gamma = form_.gamma_0 * cell.law.scaling_modulus() / cell.element.plane_diameter();
    append_images(mirror_images(face_rule_, 0), cell, point_images_);
    for (const auto& q : face_rule_) {
      Vec<dim> xi{}, outward{};
      xi[0] = outward[0] = 1;
      for (int d = 1; d < dim; ++d) xi[d] = q.xi[d - 1];
      const auto at = cell.element.at(xi);
      const auto surface = map_surface<dim>(at.jacobian, outward);
      const auto traction = traction_map<dim>(cell.element, cell.law, at, surface.normal);
      const double weight = q.weight * surface.scale;
      const int q_of_column = static_cast<int>(column_.surface.points.size());
      add_rows<dim>(at.displacement, cell.nodes, rows_.displacement(q_of_column), cell.angle,
                    column_.observation);
      add_rows<dim>(traction, cell.nodes, rows_.traction(q_of_column), cell.angle, column_.observation);
      const double nitsche = -form_.theta() / gamma * weight;
      for (int j = 0; j < cell.element.n_dofs(); ++j)
        for (int i = 0; i < cell.element.n_dofs(); ++i)
          for (int d = 0; d < dim; ++d) cell.stiffness(i, j) += nitsche * traction[d][i] * traction[d][j];
      Vec<dim> position = rotated<dim>(at.position, cell.angle);
      if constexpr (dim == 3) position[2] += cell.axial * grid_.axial_size();
      column_.surface.points.push_back({position, weight, gamma});
    }
  }

  void add_annulus(const ColumnCell<dim>& cell) {
    append_images(mirror_images(annulus_rule_, 1), cell, annulus_images_);
    for (const auto& q : annulus_rule_) {
      const auto at = cell.element.at(q.xi);
      Vec<dim> radial{at.position[0], at.position[1]};
      const double radius = norm<dim>(radial);
      for (double& x : radial) x /= radius;
      add_rows<dim>(traction_map<dim>(cell.element, cell.law, at, radial), cell.nodes,
                    rows_.annulus_traction(static_cast<int>(column_.surface.annulus_weights.size())),
                    cell.angle, column_.observation);
      column_.surface.annulus_weights.push_back(q.weight * at.determinant);
    }
  }

  void add_volume(const ColumnCell<dim>& cell) {
    for (const auto& q : volume_rule_) {
      auto at = cell.element.at(q.xi);
      const double weight = q.weight * at.determinant;
      if (rows_.has_spin) add_spin(cell, at, weight * cell.law.density().value_or(0));
      for (auto& component : at.displacement)
        for (double& value : component) value *= weight;
      add_rows<dim>(at.displacement, cell.nodes, rows_.integral(), cell.angle, column_.observation);
      column_.volume += weight;
      const Vec<dim> position = rotated<dim>(at.position, cell.angle);
      for (int d = 0; d < dim; ++d) column_.moment[d] += weight * position[d];
    }
  }

  void add_spin(const ColumnCell<dim>& cell, const typename ElasticElement<dim>::Point& at, double mass) {
    using Row = std::array<double, ElasticElement<dim>::max_dofs>;
    Row work{};
    for (int d = 0; d < 2; ++d)
      for (int i = 0; i < cell.element.n_dofs(); ++i)
        work[i] += mass * at.position[d] * at.displacement[d][i];
    add_number<dim>(work, cell.nodes, rows_.spin(), column_.observation);
  }

  const ElementTable<dim>& table_;
  const PolarGrid<dim>& grid_;
  const Materials<dim>& materials_;
  const ColumnNodes<dim>& nodes_;
  const ContactForm& form_;
  int degree_, contact_points_, annulus_points_, axial_cells_ = 1;
  ObservationRows<dim> rows_;
  std::vector<ReferencePoint<dim>> volume_rule_;
  std::vector<ReferencePoint<dim - 1>> face_rule_;
  std::vector<ReferencePoint<dim>> annulus_rule_;
  std::vector<int> point_images_, annulus_images_;
  FreeColumn<dim> column_{};
};

}  // namespace

template <int dim>
Expected<TreadColumn<dim>> tread_column(const ElementTable<dim>& table, const TreadGrid& tread,
                                        const ContactForm& form, int points_per_direction) {
  const ColumnNodes<dim> nodes(table.grid(), table.degree(), tread);
  FreeColumn<dim> free = ColumnAssembly<dim>(table, nodes, tread, form, points_per_direction).run();
  const int n = nodes.n_dofs(), n_retained = nodes.n_base() + 2 * nodes.n_line(), n_inner = n - n_retained;
  const int n_observations = free.observation.rows(), n_nodal = free.nodal.rows();

  TreadColumn<dim> column{.surface = std::move(free.surface),
                          .volume = free.volume,
                          .moment = free.moment,
                          .n_base = nodes.n_base(),
                          .n_line = nodes.n_line(),
                          .stiffness = block(free.stiffness, 0, 0, n_retained, n_retained),
                          .observation = block(free.observation, 0, 0, n_observations, n_retained),
                          .compliance = Matrix(n_observations, n_observations),
                          .nodal = block(free.nodal, 0, 0, n_nodal, n_retained),
                          .nodal_compliance = Matrix(n_nodal, n_observations)};
  if (n_inner == 0) return column;

  Matrix inner = block(free.stiffness, n_retained, n_retained, n_inner, n_inner);
  if (!cholesky(inner))
    return Failure{
        FailureReason::not_positive_definite,
        fmt::format("Nitsche's method with theta = {:g} needs a larger gamma_0 than {:g}: its contact "
                    "term makes the tread's stiffness indefinite",
                    form.theta(), form.gamma_0)};
  const Matrix coupling = block(free.stiffness, 0, n_retained, n_retained, n_inner);
  const Matrix observed = block(free.observation, 0, n_retained, n_observations, n_inner);
  const Matrix nodal = block(free.nodal, 0, n_retained, n_nodal, n_inner);
  Matrix from_retained = transposed(coupling), from_observed = transposed(observed);
  cholesky_solve(inner, from_retained);
  cholesky_solve(inner, from_observed);
  multiply(-1, coupling, Op::none, from_retained, Op::none, 1, column.stiffness);
  multiply(-1, observed, Op::none, from_retained, Op::none, 1, column.observation);
  multiply(1, observed, Op::none, from_observed, Op::none, 0, column.compliance);
  multiply(-1, nodal, Op::none, from_retained, Op::none, 1, column.nodal);
  multiply(1, nodal, Op::none, from_observed, Op::none, 0, column.nodal_compliance);
  return column;
}

template decltype(tread_column<2>) tread_column<2>;
template decltype(tread_column<3>) tread_column<3>;

}  // namespace wheelwright
