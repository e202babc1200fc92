#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/run/study.h"
#include "wheelwright/sensitivity/taylor_test.h"

namespace wheelwright {
namespace {

constexpr double least_order = 1.9;
constexpr double balance_tolerance = 1e-9;
constexpr int halvings = 3;

/// The largest step of the Taylor test, by the resolution of the grid. In 3D the cut quadrature is less
/// exact, so that the last remainders of smaller steps would be its own.
template <int dim>
constexpr double largest_step = dim == 2 ? 1e-3 : 4e-3;

/// A direction with several wave lengths, equal in all sectors, of size 1.
template <int dim>
std::vector<double> test_direction(const Lattice<dim>& lattice) {
  const PolarGrid<dim>& grid = lattice.grid();
  std::vector<double> direction;
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    const Vec<dim> p = lattice.polar_point(i);
    const double height = (p[0] - grid.inner_radius) / (grid.outer_radius - grid.inner_radius);
    double value = 1 + 0.4 * std::cos(grid.n_sectors * p[1]) + 0.3 * std::sin(6 * height);
    if constexpr (dim == 3) value += 0.2 * std::sin(4 * p[2] / grid.width);
    direction.push_back(value);
  }
  return direction;
}

template <int dim>
LevelSet<dim> moved(LevelSet<dim> psi, const std::vector<double>& direction, double t) {
  for (size_t i = 0; i < direction.size(); ++i) psi.values[i] += t * direction[i];
  return psi;
}

template <int dim>
std::optional<std::vector<CellKind>> cell_kinds(const LevelSet<dim>& psi) {
  const auto domain = cut_domain(psi, 2);
  if (!domain) return {};
  return domain->kinds;
}

/// The case's shape with its boundary moved by a fraction of a cell, so that no cell begins or ends to be cut
/// within the test's steps: circles that touch grid lines are no place for a derivative.
template <int dim>
std::optional<LevelSet<dim>> generic_shape(const LevelSet<dim>& psi, const std::vector<double>& direction,
                                           double step) {
  const double h = psi.lattice.grid().resolution();
  for (int attempt = 1; attempt <= 40; ++attempt) {
    const double offset = h * std::fmod(0.618 * attempt, 1.0) * 0.5;
    LevelSet<dim> shape = psi;
    for (double& value : shape.values) value -= offset;
    const auto here = cell_kinds(shape);
    if (here && cell_kinds(moved(shape, direction, step)) == here &&
        cell_kinds(moved(shape, direction, -step)) == here)
      return shape;
  }
  return {};
}

StyledText verdict(bool passed) {
  return styled(stdout, passed ? Style::green : Style::red, passed ? "passed" : "FAILED");
}

double lowest_order(const TaylorTest& test) {
  return *std::min_element(test.orders.begin(), test.orders.end());
}

template <int dim>
void report_remainders(const TaylorTest& test) {
  print("Taylor test of the shape gradient: J = {:.8g} {}, derivative {:.8g}\n", test.value,
        unit<dim>(kind(Quantity::objective)), test.derivative);
  for (size_t k = 0; k < test.steps.size(); ++k)
    print("  step {:.3e} m  remainder {:.4e}{}\n", test.steps[k], test.remainders[k],
          k == 0 ? "" : fmt::format("  order {:.4f}", test.orders[k - 1]));
}

bool report_order(const TaylorTest& test) {
  const double lowest = lowest_order(test);
  print("  lowest order {:.4f}, wanted > {}: {}\n", lowest, least_order, verdict(lowest > least_order));
  return lowest > least_order;
}

/// The ground's forces and moments on the wheel against those on the rim, in the motions that are free.
template <int dim>
bool report_balance(const State<dim>& solution, const RimControl& rim) {
  double worst = 0;
  for (const auto& contact : solution.contacts())
    for (const FreeMotion& motion : rim.free)
      worst = std::max(worst, std::abs(work(contact.rim_force, motion.direction) / motion.force - 1));
  print("Contact forces against loads, worst of {} positions: {:.2e}, wanted < {:.0e}: {}\n",
        solution.contacts().size(), worst, balance_tolerance, verdict(worst < balance_tolerance));
  return worst < balance_tolerance;
}

/// The objective of a case and its Taylor test at a shape.
template <int dim>
Expected<TaylorTest> test_gradient(const Case& c, const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                                   const std::vector<double>& direction, double step) {
  const auto functions = shape_functions<dim>(c, solver);
  if (!functions) return functions.failure();
  const auto cases = load_cases<dim>(c);
  const auto evaluation = [&](const LevelSet<dim>& psi) -> Expected<Evaluation<dim>> {
    auto evaluated = evaluate<dim>(solver, *functions, psi, nullptr, {}, cases);
    if (!evaluated) return evaluated.failure();
    return std::move(evaluated->evaluation);
  };
  return taylor_test<dim>(evaluation, shape, direction, c.grid.degree, step, halvings);
}

/// With the quadrature of a run.
template <int dim>
Expected<bool> report_taylor(const Case& c, const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                             const std::vector<double>& direction, double step) {
  const auto test = test_gradient(c, solver, shape, direction, step);
  if (!test) return test.failure();
  report_remainders<dim>(*test);
  return report_order(*test);
}

class VerifyCommand : public Subcommand {
 public:
  VerifyCommand() : Subcommand("verify", "Test the shape gradient and the balance of forces on a case") {}

  void declare(Options& options) override {
    add_wheel(options, input_);
    add_threads(options, threads_);
  }

  int run() override {
    const auto wheel = read_wheel_or_tell(input_, {name(), threads_});
    if (!wheel) return wheel.failure();
    const auto passed =
        std::visit([](const auto& input) { return verify(input.source, input.shape); }, *wheel);
    if (!passed) return tell_failure(name(), passed.failure());
    return *passed ? exit_done : exit_no_solution;
  }

 private:
  /// Whether the case passes both tests at a shape.
  template <int dim>
  static Expected<bool> verify(const Case& c, const LevelSet<dim>& given) {
    const auto made = make_solver(rolling_model<dim>(c));
    if (!made) return made.failure();
    const StateSolver<dim>& solver = **made;
    const auto direction = test_direction(given.lattice);
    const double step = largest_step<dim> * given.lattice.grid().resolution();
    const auto shape = generic_shape(given, direction, step);
    if (!shape || boundary_samples(*shape).empty())
      return Failure{FailureReason::empty_shape,
                     "the shape has no boundary that can move without changing its cut cells"};

    const auto taylor = report_taylor(c, solver, *shape, direction, step);
    if (!taylor) return taylor.failure();
    const auto cases = load_cases<dim>(c);
    const auto states =
        states_of_cases<dim>(solver, cases, *shape, solver.all_positions(), tell_contact_progress());
    if (!states) return states.failure();
    bool balance = true;
    for (size_t k = 0; k < states->size(); ++k) {
      if (!cases.empty()) print("Load case {}. ", cases[k].name);
      balance = report_balance(*(*states)[k], rim_control((*states)[k]->model())) && balance;
    }
    return *taylor && balance;
  }

  std::string input_;
  std::optional<int> threads_;
};

}  // namespace

std::unique_ptr<Subcommand> make_verify() { return std::make_unique<VerifyCommand>(); }

}  // namespace wheelwright
