#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/run/study/gradient_check.h"

namespace wheelwright {
namespace {

constexpr double balance_tolerance = 1e-9;

StyledText verdict(bool passed) {
  return styled(stdout, passed ? Style::green : Style::red, passed ? "passed" : "FAILED");
}

std::string orders_text(const GradientCheck& check) {
  return std::isinf(check.lowest_order()) ? "rounding" : fmt::format("{:.4f}", check.lowest_order());
}

/// The function, and the radius with respect to which its derivative is tested.
std::string tested(const GradientCheck& check) {
  return check.radius.empty() ? check.function : check.function + ", " + check.radius;
}

/// One row per test. `of`: what is tested. Returns whether all pass.
bool report_checks(const std::string& of, const std::vector<GradientCheck>& checks) {
  size_t width = 8;
  for (const GradientCheck& check : checks) width = std::max(width, tested(check).size());
  print("Taylor tests of {}: error of the linear prediction as the step is halved\n", of);
  print("  {:<{}}  {:>14}  {:>14}  {:>12}  {:>9}  {:>9}\n", "function", width, "value", "derivative",
        "step [m]", "error", "order");
  bool passed = true;
  for (const GradientCheck& check : checks) {
    print("  {:<{}}  {:>14.7g}  {:>14.7g}  {:>12.3e}  {:>9.1e}  {:>9}  {}\n", tested(check), width,
          check.test.value, check.test.derivative, check.test.steps.front(), check.largest_error(),
          orders_text(check), check.is_smoothed ? StyledText{"not tested"} : verdict(check.passed()));
    passed = passed && !check.failed();
  }
  return passed;
}

void explain_checks(const std::vector<GradientCheck>& checks) {
  print("  required: order > {}, and an error of the derivative below {} at the largest step\n",
        GradientCheck::wanted_order, GradientCheck::max_error);
  if (std::ranges::any_of(checks, &GradientCheck::is_smoothed))
    print(
        "  not tested: a maximum, whose gradient is deliberately that of a p-norm or of a smooth maximum\n");
}

/// The ground's forces and moments on the wheel against those on the rim, in the motions that are free.
template <int dim>
bool report_balance(const State<dim>& solution, const RimControl& rim) {
  double worst = 0;
  for (const auto& contact : solution.contacts())
    for (const FreeMotion& motion : rim.free)
      worst = std::max(worst, std::abs(work(contact.rim_force, motion.direction) / motion.force - 1));
  print("Contact forces against loads, worst of {} positions: {:.2e}, required < {:.0e}: {}\n",
        solution.contacts().size(), worst, balance_tolerance, verdict(worst < balance_tolerance));
  return worst < balance_tolerance;
}

class VerifyCommand : public Subcommand {
 public:
  VerifyCommand() : Subcommand("verify", "Test the gradients and the balance of forces on a case") {}

  void declare(Options& options) override {
    add_wheel(options, input_);
    add_threads(options, threads_);
  }

  int run() override {
    const auto wheel = read_wheel_or_report(input_, {name(), threads_});
    if (!wheel) return wheel.failure();
    const auto passed =
        std::visit([](const auto& input) { return verify(input.source, input.shape); }, *wheel);
    if (!passed) return report_failure(name(), passed.failure());
    return *passed ? exit_done : exit_no_solution;
  }

 private:
  /// Whether gradients and, if radii of layers are unknowns, the derivatives with respect to them pass their
  /// tests. Without a boundary that can move there are only these.
  template <int dim>
  static Expected<bool> verify_derivatives(const Study<dim>& study, const LevelSet<dim>& given) {
    const auto radii = check_radii(study, given, print_contact_progress());
    if (!radii) return radii.failure();
    const auto gradients = check_gradients(study, given, print_contact_progress());
    if (!gradients && (radii->empty() || gradients.failure().reason != FailureReason::empty_shape))
      return gradients.failure();
    bool passed = !gradients || report_checks("the shape gradients", *gradients);
    if (!radii->empty())
      passed = report_checks("the derivatives with respect to radii of layers", *radii) && passed;
    explain_checks(gradients ? *gradients : *radii);
    return passed;
  }

  /// Whether the case passes all tests for a shape.
  template <int dim>
  static Expected<bool> verify(const Case& c, const LevelSet<dim>& given) {
    const auto study = make_study<dim>(c);
    if (!study) return study.failure();
    const auto passed = verify_derivatives(*study, given);
    if (!passed) return passed.failure();
    const StateSolver<dim>& solver = *study->solver;
    const auto& cases = study->load_cases;
    const auto states =
        states_of_cases<dim>(solver, cases, given, solver.all_positions(), print_contact_progress());
    if (!states) return states.failure();
    bool balance = true;
    for (size_t k = 0; k < states->size(); ++k) {
      if (!cases.empty()) print("Load case {}. ", cases[k].name);
      balance = report_balance(*(*states)[k], rim_control((*states)[k]->model())) && balance;
    }
    return *passed && balance;
  }

  std::string input_;
  std::optional<int> threads_;
};

}  // namespace

std::unique_ptr<Subcommand> make_verify() { return std::make_unique<VerifyCommand>(); }

}  // namespace wheelwright
