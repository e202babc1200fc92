#include "wheelwright/mechanics/rolling/turned_state.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>

#include "wheelwright/base/periodic.h"
#include "wheelwright/shape/geometry/axle_rotation.h"

namespace wheelwright {
namespace {

/// The columns of a matrix in runs of `n`, each run turned by some of them.
Matrix turned_columns(const Matrix& a, int n, int by) {
  auto result = Matrix::unfilled(a.rows(), a.columns());
  for (int j = 0; j < a.columns(); ++j) {
    const int run = j / n * n;
    std::copy_n(a.column(j), a.rows(), result.column(run + wrap(j - run + by, n)));
  }
  return result;
}

/// The displacement of a wheel, from that of the wheel turned back.
template <int dim>
class TurnedDisplacement : public Displacement<dim> {
 public:
  TurnedDisplacement(const State<dim>& turned, int columns)
      : turned_(turned), lattice_(turned.model().grid, turned.model().degree), columns_(columns) {}

  RingField at_nodes(int position) const override {
    const RingField there = turned_.displacement().at_nodes(position);
    const int by = lattice_.degree() * columns_;
    const AxleRotation forward(columns_ * lattice_.grid().column_angle());
    RingField here = there;
    for (int line = 0; line < lattice_.grid().n_sectors * lattice_.nodes()[1]; ++line) {
      const double* from = &there.values[dim * ring_line(lattice_, line - by)];
      double* to = &here.values[dim * ring_line(lattice_, line)];
      for (int node = 0; node < lattice_.nodes_per_line(); ++node, from += dim, to += dim) {
        Vec<dim> u;
        std::copy_n(from, dim, u.begin());
        u = forward.forward(u);
        std::copy(u.begin(), u.end(), to);
      }
    }
    return here;
  }

  FactoredField strains(int cell, std::span<const Vec<dim>> points) const override {
    return of_turned(&Displacement<dim>::strains, cell, points);
  }

  FactoredField strains_and_rotations(int cell, std::span<const Vec<dim>> points) const override {
    return of_turned(&Displacement<dim>::strains_and_rotations, cell, points);
  }

 private:
  /// A field at points of a cell, in its frame.
  FactoredField of_turned(FactoredField (Displacement<dim>::*field)(int, std::span<const Vec<dim>>) const,
                          int cell, std::span<const Vec<dim>> points) const {
    const PolarGrid<dim>& grid = lattice_.grid();
    auto place = grid.cell_position(cell);
    place[1] -= columns_;
    const int sectors_back = place[1] < 0 ? 1 : 0;
    place[1] += sectors_back * grid.columns();
    FactoredField there = (turned_.displacement().*field)(grid.cell_index(place), points);
    return {std::move(there.map), turned_columns(there.factors, grid.n_sectors, sectors_back)};
  }

  const State<dim>& turned_;
  Lattice<dim> lattice_;
  int columns_;
};

template <int dim>
class TurnedState : public State<dim> {
 public:
  TurnedState(std::shared_ptr<const State<dim>> turned, std::shared_ptr<const CutDomain<dim>> domain,
              LoadPositions positions, int columns, std::vector<PhaseTime> phases)
      : turned_(std::move(turned)),
        domain_(std::move(domain)),
        positions_(std::move(positions)),
        columns_(columns),
        phases_(std::move(phases)),
        observations_(turned_columns(turned_->observations(), ring_columns(), columns)),
        contacts_(turned_->contacts()),
        boundary_(turned_points(turned_->boundary())),
        edges_(turned_points(turned_->edges())),
        displacement_(*turned_, columns) {
    for (auto& contact : contacts_) turn(contact);
  }

  const RollingModel<dim>& model() const override { return turned_->model(); }
  const CutDomain<dim>& domain() const override { return *domain_; }
  const LoadPositions& positions() const override { return positions_; }
  const std::vector<ContactPatch<dim>>& contacts() const override { return contacts_; }
  const std::vector<double>& strain_energy() const override { return turned_->strain_energy(); }
  const std::vector<double>& energy_by_harmonic() const override { return turned_->energy_by_harmonic(); }
  const Matrix& observations() const override { return observations_; }
  const std::vector<PhaseTime>& phases() const override { return phases_; }
  const Displacement<dim>& displacement() const override { return displacement_; }
  const std::vector<SurfacePoint<dim>>& boundary() const override { return boundary_; }
  const std::vector<SurfacePoint<dim>>& edges() const override { return edges_; }

  const StrainPeaks<dim>& strain_peaks() const override {
    std::call_once(has_peaks_, [this] {
      peaks_ = turned_->strain_peaks();
      const PolarGrid<dim>& grid = domain_->grid;
      const double all_round = grid.n_sectors * grid.sector_angle();
      for (auto& place : peaks_.von_mises_places) {
        place[1] += columns_ * grid.column_angle();
        if (place[1] >= all_round) place[1] -= all_round;
      }
    });
    return peaks_;
  }

  Expected<ShapeGradients> shape_gradients(
      std::span<const FunctionalDerivative<dim>> functions) const override {
    return turned_->shape_gradients(turned_back(functions));
  }

  Expected<std::vector<std::vector<double>>> topological_derivatives(
      std::span<const FunctionalDerivative<dim>> functions,
      std::span<const MaterialPoint<dim>> points) const override {
    const PolarGrid<dim>& grid = domain_->grid;
    std::vector<MaterialPoint<dim>> there(points.begin(), points.end());
    for (auto& point : there) {
      auto place = grid.cell_position(point.cell);
      place[1] = wrap(place[1] - columns_, grid.columns());
      point.cell = grid.cell_index(place);
    }
    return turned_->topological_derivatives(turned_back(functions), there);
  }

  std::vector<Expected<std::vector<ContactPatch<dim>>>> contacts_under(
      std::span<const RollingModel<dim>> models, const Interrupt& interrupt) const override {
    auto contacts = turned_->contacts_under(models, interrupt);
    for (auto& of_model : contacts) {
      if (!of_model) continue;
      for (auto& contact : *of_model) turn(contact);
    }
    return contacts;
  }

  Expected<std::shared_ptr<const State<dim>>> under(const RollingModel<dim>& model,
                                                    const Interrupt& interrupt) const override {
    auto there = turned_->under(model, interrupt);
    if (!there) return there;
    auto phases = (*there)->phases();
    return turned_state<dim>(*std::move(there), domain_, positions_, columns_, std::move(phases));
  }

 private:
  int ring_columns() const { return domain_->grid.ring_columns(); }
  std::vector<FunctionalDerivative<dim>> turned_back(
      std::span<const FunctionalDerivative<dim>> functions) const {
    std::vector<FunctionalDerivative<dim>> there(functions.begin(), functions.end());
    for (auto& function : there)
      function.tread_loads = turned_columns(function.tread_loads, ring_columns(), -columns_);
    return there;
  }
  std::vector<SurfacePoint<dim>> turned_points(std::vector<SurfacePoint<dim>> points) const {
    const PolarGrid<dim>& grid = domain_->grid;
    for (auto& point : points) {
      auto place = grid.cell_position(point.cell);
      const int before = place[1];
      place[1] = wrap(before + columns_, grid.columns());
      point.cell = grid.cell_index(place);
      point.normal = rotated<dim>(point.normal, (place[1] - before) * grid.column_angle());
    }
    return points;
  }
  void turn(ContactPatch<dim>& contact) const {
    for (auto& point : contact.points) point.column = wrap(point.column + columns_, ring_columns());
  }

  std::shared_ptr<const State<dim>> turned_;
  std::shared_ptr<const CutDomain<dim>> domain_;
  LoadPositions positions_;
  int columns_;
  std::vector<PhaseTime> phases_;
  Matrix observations_;
  std::vector<ContactPatch<dim>> contacts_;
  std::vector<SurfacePoint<dim>> boundary_, edges_;
  TurnedDisplacement<dim> displacement_;
  mutable std::once_flag has_peaks_;
  mutable StrainPeaks<dim> peaks_;
};

/// The nodes that a sector shares with its neighbours if it begins at `column`: those on its face, and those
/// of derivatives where a ghost penalty acts on it.
template <int dim>
class SharedNodes {
 public:
  SharedNodes(const CutDomain<dim>& domain, const ElementTable<dim>& table, int core_rows)
      : domain_(domain),
        core_rows_(core_rows),
        n_derivatives_(n_compared_derivatives(table.ghost(), table.degree())),
        lattice_(domain.grid, table.degree()) {
    const PolarGrid<dim>& grid = domain.grid;
    penalized_.resize(grid.columns());
    for (const GhostFace& face : domain.ghost_faces)
      if (face.axis == 1 && table.ghost().xi > 0 &&
          (table.ghost().kind == GhostPenaltyKind::full || face.crossed))
        penalized_[grid.cell_position(face.plus)[1]].push_back(face.plus);
  }

  int count(int column) const {
    const PolarGrid<dim>& grid = domain_.grid;
    std::vector<int> active;
    for (int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.cell_position(cell)[1] == column && domain_.active(cell)) active.push_back(cell);
    return on_face(active) + n_derivatives_ * on_face(penalized_[column]);
  }

 private:
  /// The nodes on the first azimuth of these cells of the core, all of one column.
  int on_face(std::span<const int> cells) const {
    std::vector<char> found(lattice_.n_nodes(), 0);
    for (const int cell : cells) {
      const auto place = domain_.grid.cell_position(cell);
      if (place[0] >= core_rows_) continue;
      for (int a = 0; a < nodes_per_cell<dim>(lattice_.degree()); ++a)
        if (local_node_position<dim>(lattice_.degree(), a)[1] == 0)
          if (const auto node = lattice_.cell_node(place, a); node[0] > 0)
            found[lattice_.node_index(node)] = 1;
    }
    return static_cast<int>(std::ranges::count(found, 1));
  }

  const CutDomain<dim>& domain_;
  int core_rows_, n_derivatives_;
  Lattice<dim> lattice_;
  std::vector<std::vector<int>>
      penalized_;  ///< by columns: cells whose face to the column before has a ghost penalty
};

}  // namespace

template <int dim>
std::vector<int> possible_first_columns(const PolarGrid<dim>& grid, bool is_mirror_symmetric) {
  const int n = grid.columns();
  if (is_mirror_symmetric) return n % 2 == 0 ? std::vector<int>{0, n / 2} : std::vector<int>{0};
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

template <int dim>
int best_first_column(const CutDomain<dim>& domain, const ElementTable<dim>& table, int core_rows,
                      std::span<const int> columns) {
  constexpr double worth_turning = 0.95;
  const SharedNodes<dim> nodes(domain, table, core_rows);
  const int here = nodes.count(0);
  int best = 0, fewest = here;
  for (const int column : columns.subspan(1))
    if (const int n = nodes.count(column); n < fewest && n <= worth_turning * here) {
      fewest = n;
      best = column;
    }
  return best;
}

template <int dim>
TurnedShape<dim> turned_back(const LevelSet<dim>& psi, const CutDomain<dim>& domain, int columns) {
  const PolarGrid<dim>& grid = domain.grid;
  const auto cell = [&](int from, int by) {
    auto place = grid.cell_position(from);
    place[1] = wrap(place[1] + by, grid.columns());
    return grid.cell_index(place);
  };
  TurnedShape<dim> result{psi, domain};
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    auto p = psi.lattice.node_position(node);
    p[1] += psi.lattice.degree() * columns;
    result.psi.values[node] = psi.values[psi.lattice.node_index(p)];
  }
  for (int i = 0; i < grid.n_cells(); ++i) result.domain.kinds[i] = domain.kinds[cell(i, columns)];
  for (CutCell<dim>& cut : result.domain.cut) cut.cell = cell(cut.cell, -columns);
  std::ranges::sort(result.domain.cut, {}, &CutCell<dim>::cell);
  for (GhostFace& face : result.domain.ghost_faces) {
    face.minus = cell(face.minus, -columns);
    face.plus = cell(face.plus, -columns);
  }
  return result;
}

template <int dim>
LoadPositions turned_back(LoadPositions positions, const PolarGrid<dim>& grid, int columns) {
  for (auto& ground : positions.grounds) ground.column = wrap(ground.column - columns, grid.ring_columns());
  return positions;
}

template <int dim>
std::shared_ptr<const State<dim>> turned_state(std::shared_ptr<const State<dim>> turned,
                                               std::shared_ptr<const CutDomain<dim>> domain,
                                               LoadPositions positions, int columns,
                                               std::vector<PhaseTime> phases) {
  return std::make_shared<const TurnedState<dim>>(std::move(turned), std::move(domain), std::move(positions),
                                                  columns, std::move(phases));
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                       \
  template decltype(possible_first_columns<dim>) possible_first_columns<dim>;              \
  template decltype(best_first_column<dim>) best_first_column<dim>;                        \
  template TurnedShape<dim> turned_back(const LevelSet<dim>&, const CutDomain<dim>&, int); \
  template LoadPositions turned_back(LoadPositions, const PolarGrid<dim>&, int);           \
  template decltype(turned_state<dim>) turned_state<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
