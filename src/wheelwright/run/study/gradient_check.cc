#include "wheelwright/run/study/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "wheelwright/case/design_radii.h"
#include "wheelwright/run/study/bounded_functions.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

constexpr int n_paths = 4;
constexpr int halvings = 3;

/// The largest step, in units of the resolution. In 3D the cut quadrature is less accurate, so that the last
/// remainders of smaller steps would be quadrature errors.
template <int dim>
constexpr double largest_step = dim == 2 ? 1e-3 : 4e-3;

/// The same of radii.
constexpr double largest_step_of_radius = 1e-2;

/// A field with several wavelengths, equal in all sectors, of size 1.
template <int dim>
std::vector<double> smooth_field(const Lattice<dim>& lattice, int number) {
  const PolarGrid<dim>& grid = lattice.grid();
  std::vector<double> field;
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    const Vec<dim> p = lattice.polar_point(i);
    const double height = (p[0] - grid.inner_radius) / (grid.outer_radius - grid.inner_radius);
    double value = 1 + 0.4 * std::cos(grid.n_sectors * p[1] + number) + 0.3 * std::sin(6 * height + number);
    if constexpr (dim == 3) value += 0.2 * std::sin(4 * p[2] / grid.width + number);
    field.push_back(value);
  }
  return field;
}

template <int dim>
LevelSet<dim> moved(LevelSet<dim> psi, std::span<const double> direction, double t) {
  for (size_t i = 0; i < direction.size(); ++i) psi.values[i] += t * direction[i];
  return psi;
}

template <int dim>
std::vector<int> nodes_of(const Lattice<dim>& lattice, int cell) {
  const auto position = lattice.grid().cell_position(cell);
  std::vector<int> nodes;
  for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a)
    nodes.push_back(lattice.node_index(lattice.cell_node(position, a)));
  return nodes;
}

/// How a shape cuts the cells of its grid.
template <int dim>
struct Cuts {
  std::vector<CellKind> kinds;
  std::set<std::tuple<int, int, int>> crossed;  ///< faces that the boundary crosses: minus, plus, axis
};

template <int dim>
std::optional<Cuts<dim>> cuts(const LevelSet<dim>& psi) {
  const auto domain = cut_domain(psi, 2);
  if (!domain) return {};
  Cuts<dim> result{domain->kinds, {}};
  for (const GhostFace& face : domain->ghost_faces)
    if (face.crossed) result.crossed.insert({face.minus, face.plus, face.axis});
  return result;
}

/// The cells that are cut differently by two shapes.
template <int dim>
std::set<int> differing_cells(const Cuts<dim>& a, const Cuts<dim>& b) {
  std::set<int> cells;
  for (size_t cell = 0; cell < a.kinds.size(); ++cell)
    if (a.kinds[cell] != b.kinds[cell]) cells.insert(static_cast<int>(cell));
  for (const auto& [some, others] : {std::pair(&a.crossed, &b.crossed), {&b.crossed, &a.crossed}})
    for (const auto& face : *some)
      if (!others->contains(face)) cells.insert({std::get<0>(face), std::get<1>(face)});
  return cells;
}

/// Whether a change moves the boundary anywhere.
template <int dim>
bool moves_boundary(const LevelSet<dim>& psi, const std::vector<double>& direction) {
  const auto here = cuts(psi);
  if (!here) return false;
  for (size_t cell = 0; cell < here->kinds.size(); ++cell)
    if (here->kinds[cell] == CellKind::cut)
      for (const int node : nodes_of(psi.lattice, static_cast<int>(cell)))
        if (direction[node] != 0) return true;
  return false;
}

/// The points in contact, and whether they slide.
template <int dim>
std::set<std::tuple<int, int, int, bool>> contact_status(const Evaluated<dim>& evaluated) {
  std::set<std::tuple<int, int, int, bool>> status;
  int position = 0;
  const auto add = [&](const State<dim>& state) {
    for (const ContactPatch<dim>& patch : state.contacts()) {
      for (const auto& point : patch.points) {
        if (point.augmented[0] >= 0) continue;
        bool slides = false;
        for (int d = 1; d < dim; ++d) slides = slides || point.augmented[d] != point.traction[d];
        status.insert({position, point.column, point.point, slides});
      }
      ++position;
    }
  };
  add(*evaluated.state);
  for (const auto& other : evaluated.others) add(*other);
  return status;
}

/// A path of shapes, or of radii, on which functions are tested.
template <int dim>
struct TestPath {
  std::function<Expected<Evaluated<dim>>(double)> at;  ///< a place of the path, which starts at 0
  std::function<std::vector<double>(const Evaluation<dim>&)> derivatives;  ///< of all functions at the start
  double step;                                                             ///< the largest one
};

/// The largest tried step within which no point changes its contact status, or else the smallest one.
template <int dim>
Expected<double> step_of_one_status(const TestPath<dim>& path, const Evaluated<dim>& start) {
  constexpr int most_reductions = 3;
  double step = path.step;
  for (int k = 0; k < most_reductions; ++k, step /= 4) {
    const auto trial = path.at(step);
    if (!trial) return trial.failure();
    if (contact_status(*trial) == contact_status(start)) break;
  }
  return step;
}

template <int dim>
Expected<std::vector<TaylorTest>> tests_on(const TestPath<dim>& path) {
  const auto start = path.at(0);
  if (!start) return start.failure();
  const auto step = step_of_one_status(path, *start);
  if (!step) return step.failure();
  const std::function<Expected<Evaluation<dim>>(double)> evaluation_at =
      [&](double t) -> Expected<Evaluation<dim>> {
    auto evaluated = path.at(t);
    if (!evaluated) return evaluated.failure();
    return std::move(evaluated->evaluation);
  };
  return taylor_tests<dim>(evaluation_at, start->evaluation, path.derivatives(start->evaluation), *step,
                           halvings);
}

/// Whether a function has the gradient of a smooth approximation.
template <int dim>
bool is_smoothed(const ShapeFunction<dim>& function) {
  return function.quantity->is_maximum || function.over == Over::maximum || function.over == Over::minimum;
}

bool is_better(const GradientCheck& a, const GradientCheck& b) {
  return std::pair(a.passed(), a.lowest_order()) > std::pair(b.passed(), b.lowest_order());
}

/// The best test of every function on paths by number, until all pass. `failure`: the result if there is no
/// path.
template <int dim>
Expected<std::vector<GradientCheck>> best_checks(
    const std::vector<ShapeFunction<dim>>& functions,
    const std::function<std::optional<TestPath<dim>>(int)>& path_of_number, Failure failure) {
  std::vector<GradientCheck> best;
  for (int k = 0; k < n_paths && (best.empty() || std::ranges::any_of(best, &GradientCheck::failed)); ++k) {
    const auto path = path_of_number(k);
    if (!path) continue;
    const auto tests = tests_on(*path);
    if (!tests) {
      failure = tests.failure();
      continue;
    }
    for (size_t i = 0; i < tests->size(); ++i) {
      GradientCheck check{functions[i].name, (*tests)[i], is_smoothed(functions[i])};
      if (best.size() <= i)
        best.push_back(std::move(check));
      else if (is_better(check, best[i]))
        best[i] = std::move(check);
    }
  }
  if (best.empty()) return failure;
  return best;
}

template <int dim>
Expected<Evaluated<dim>> evaluated(const Study<dim>& study, const LevelSet<dim>& psi,
                                   const Interrupt& interrupt) {
  return evaluate<dim>(*study.solver, study.functions, psi, nullptr, interrupt, study.load_cases);
}

/// The same with one of the design lines at another radius, in whose rows the shape keeps its place.
template <int dim>
Expected<Evaluated<dim>> evaluated_at_radius(const Study<dim>& study, const LevelSet<dim>& shape, int line,
                                             double radius, const Interrupt& interrupt) {
  const PolarGrid<dim> grid = with_fixed_line_at(shape.lattice.grid(), line, radius);
  const auto c = with_radii_of(study.source, grid, study.level);
  if (!c) return Failure{FailureReason::unsupported_model, "the grid does not have the lines of the case"};
  const auto moved = make_study<dim>(*c, study.level);
  if (!moved) return moved.failure();
  return evaluated(*moved, {Lattice<dim>(grid, shape.lattice.degree()), shape.values}, interrupt);
}

}  // namespace

bool GradientCheck::is_rounding(size_t step) const {
  constexpr double rounding = 1e-10;
  return test.remainders[step] <= rounding * std::abs(test.value);
}

double GradientCheck::lowest_order() const {
  double lowest = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < test.orders.size(); ++k)
    if (!is_rounding(k + 1)) lowest = std::min(lowest, test.orders[k]);
  return lowest;
}

double GradientCheck::largest_error() const {
  double largest = 0;
  for (size_t k = 0; k < test.steps.size(); ++k)
    if (!is_rounding(k))
      largest = std::max(largest, test.remainders[k] / (test.steps[k] * std::abs(test.derivative)));
  return largest;
}

bool GradientCheck::passed() const { return lowest_order() > wanted_order && largest_error() < max_error; }

template <int dim>
std::vector<double> test_direction(const LevelSet<dim>& psi, int number, double step) {
  constexpr int most_passes = 20;
  std::vector<double> direction = smooth_field(psi.lattice, number);
  const auto here = cuts(psi);
  if (!here) return std::vector<double>(direction.size(), 0.0);
  for (int pass = 0; pass < most_passes; ++pass) {
    std::set<int> differing;
    for (const double t : {step, -step}) {
      const auto there = cuts(moved<dim>(psi, direction, t));
      if (!there) return std::vector<double>(direction.size(), 0.0);
      differing.merge(differing_cells(*here, *there));
    }
    if (differing.empty()) break;
    for (const int cell : differing)
      for (const int node : nodes_of(psi.lattice, cell)) direction[node] = 0;
  }
  return direction;
}

template <int dim>
LevelSet<dim> generic_shape(LevelSet<dim> psi, std::span<const double> direction, double step) {
  return moved<dim>(std::move(psi), direction, 2 * step);
}

template <int dim>
double largest_test_step(const PolarGrid<dim>& grid) {
  return largest_step<dim> * grid.resolution();
}

template <int dim>
Expected<std::vector<GradientCheck>> check_gradients(const Study<dim>& study, const LevelSet<dim>& shape,
                                                     const Interrupt& interrupt) {
  const double step = largest_test_step(shape.lattice.grid());
  const auto path_of_number = [&](int number) -> std::optional<TestPath<dim>> {
    const std::vector<double> direction = test_direction(shape, number, 3 * step);
    if (!moves_boundary(shape, direction)) return {};
    const LevelSet<dim> beside = generic_shape<dim>(shape, direction, step);
    return TestPath<dim>{
        [=, &study](double t) { return evaluated(study, moved<dim>(beside, direction, t), interrupt); },
        [=, &study](const Evaluation<dim>& start) {
          return directional_derivatives(start, beside, direction, study.model().degree);
        },
        step};
  };
  return best_checks<dim>(
      study.functions, path_of_number,
      {FailureReason::empty_shape,
       "the wheel has no boundary that can move: no holes, or only holes on protected bands"});
}

template <int dim>
Expected<std::vector<GradientCheck>> check_radii(const Study<dim>& study, const LevelSet<dim>& shape,
                                                 const Interrupt& interrupt) {
  std::vector<GradientCheck> all;
  const auto radii = design_radii(study.computed());
  const std::vector<int>& lines = study.model().design_lines;
  for (size_t k = 0; k < lines.size(); ++k) {
    const double step = largest_step_of_radius * shape.lattice.grid().resolution(),
                 radius = radius_of_fixed_line(shape.lattice.grid(), lines[k]);
    const auto path_of_number = [&](int number) {
      return std::optional(TestPath<dim>{[&, from = radius + 2 * number * step](double t) {
                                           return evaluated_at_radius(study, shape, lines[k], from + t,
                                                                      interrupt);
                                         },
                                         [&](const Evaluation<dim>& start) {
                                           std::vector<double> derivatives;
                                           for (const FunctionValue& function : start.functions)
                                             derivatives.push_back(function.by_radius[k]);
                                           return derivatives;
                                         },
                                         step});
    };
    auto checks = best_checks<dim>(study.functions, path_of_number, {});
    if (!checks) return checks.failure();
    for (GradientCheck& check : *checks) {
      check.radius = radii[k].name;
      all.push_back(std::move(check));
    }
  }
  return all;
}

template decltype(test_direction<2>) test_direction<2>;
template decltype(generic_shape<2>) generic_shape<2>;
template decltype(largest_test_step<2>) largest_test_step<2>;
template decltype(check_gradients<2>) check_gradients<2>;
template decltype(check_radii<2>) check_radii<2>;
template decltype(test_direction<3>) test_direction<3>;
template decltype(generic_shape<3>) generic_shape<3>;
template decltype(largest_test_step<3>) largest_test_step<3>;
template decltype(check_gradients<3>) check_gradients<3>;
template decltype(check_radii<3>) check_radii<3>;

}  // namespace wheelwright
