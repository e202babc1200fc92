#include "app/commands/verify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/commands/model.h"
#include "app/exit_code.h"
#include "app/terminal.h"
#include "cut/measure.h"
#include "sensitivity/taylor_test.h"

namespace wheelwright {
namespace {

constexpr double least_order = 1.9;
constexpr double balance_tolerance = 1e-9;
constexpr int halvings = 3;

/// A direction with several wave lengths, equal in all sectors, of size 1.
std::vector<double> test_direction(const Lattice<2>& lattice) {
  const PolarGrid<2>& grid = lattice.grid();
  std::vector<double> direction;
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    const Vec<2> p = lattice.polar_point(i);
    const double height = (p[0] - grid.inner_radius) / (grid.outer_radius - grid.inner_radius);
    direction.push_back(1 + 0.4 * std::cos(grid.n_sectors * p[1]) + 0.3 * std::sin(6 * height));
  }
  return direction;
}

LevelSet<2> moved(LevelSet<2> psi, const std::vector<double>& direction, double t) {
  for (size_t i = 0; i < direction.size(); ++i) psi.values[i] += t * direction[i];
  return psi;
}

std::optional<std::vector<CellKind>> cell_kinds(const LevelSet<2>& psi) {
  const auto domain = cut_domain(psi, 2);
  if (!domain) return {};
  return domain->kinds;
}

/// The case's shape with its boundary moved by a fraction of a cell, so that no cell begins or ends to be cut
/// within the test's steps: circles that touch grid lines are no place for a derivative.
std::optional<LevelSet<2>> generic_shape(const LevelSet<2>& psi, const std::vector<double>& direction,
                                         double step) {
  const double h = psi.lattice.grid().resolution();
  for (int attempt = 1; attempt <= 40; ++attempt) {
    const double offset = h * std::fmod(0.618 * attempt, 1.0) * 0.5;
    LevelSet<2> shape = psi;
    for (double& value : shape.values) value -= offset;
    const auto here = cell_kinds(shape);
    if (here && cell_kinds(moved(shape, direction, step)) == here &&
        cell_kinds(moved(shape, direction, -step)) == here)
      return shape;
  }
  return {};
}

std::string verdict(bool passed) {
  return styled(stdout, passed ? Style::green : Style::red, passed ? "passed" : "FAILED");
}

bool report_taylor(const TaylorTest& test) {
  const double lowest = *std::min_element(test.orders.begin(), test.orders.end());
  fmt::print("Taylor test of the shape gradient: J = {:.8g} J/m, derivative {:.8g}\n", test.objective,
             test.derivative);
  for (size_t k = 0; k < test.steps.size(); ++k)
    fmt::print("  step {:.3e} m  remainder {:.4e}{}\n", test.steps[k], test.remainders[k],
               k == 0 ? "" : fmt::format("  order {:.4f}", test.orders[k - 1]));
  fmt::print("  lowest order {:.4f}, wanted > {}: {}\n", lowest, least_order, verdict(lowest > least_order));
  return lowest > least_order;
}

/// The ground's forces and moments on the wheel against those on the rim, in the motions that are free.
bool report_balance(const RollingSolution<2>& solution, const RimControl& rim) {
  double worst = 0;
  for (const auto& state : solution.states)
    for (const FreeMotion& motion : rim.free)
      worst = std::max(worst, std::abs(work(state.rim_force, motion.direction) / motion.force - 1));
  fmt::print("Contact forces against loads, worst of {} positions: {:.2e}, wanted < {:.0e}: {}\n",
             solution.states.size(), worst, balance_tolerance, verdict(worst < balance_tolerance));
  return worst < balance_tolerance;
}

int give_up(const Failure& failure) {
  tell("wheelwright verify: {}: {}\n", to_string(failure.reason), failure.detail);
  return exit_no_solution;
}

}  // namespace

int verify_command(const Case& c, const RunOptions&) {
  const auto problem = RollingProblem<2>::create(rolling_model(c));
  if (!problem) return give_up(problem.failure());
  const auto objective = criteria(c, *problem);
  if (!objective) return give_up(objective.failure());
  const LevelSet<2> initial = initial_shape(c);
  const auto direction = test_direction(initial.lattice);
  const double step = 1e-3 * initial.lattice.grid().resolution();
  const auto shape = generic_shape(initial, direction, step);
  if (!shape || boundary_samples(*shape).empty())
    return give_up({FailureReason::empty_shape,
                    "the case has no boundary that can move without changing its cut cells"});

  const auto test =
      taylor_test<2>([&](const LevelSet<2>& psi) { return evaluate<2>(*problem, *objective, psi); }, *shape,
                     direction, c.grid.degree, step, halvings);
  if (!test) return give_up(test.failure());
  const auto solution = problem->solve(*shape);
  if (!solution) return give_up(solution.failure());
  const bool taylor = report_taylor(*test),
             balance = report_balance(*solution, rim_control(problem->model()));
  return taylor && balance ? exit_done : exit_no_solution;
}

}  // namespace wheelwright
