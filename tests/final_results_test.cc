#include "wheelwright/run/results/final_results.h"

#include <nlohmann/json.hpp>

#include "tests/run_support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/output/report/comparison_table.h"
#include "wheelwright/output/report/gains.h"
#include "wheelwright/run/observers/expectations.h"
#include "wheelwright/run/observers/run_report.h"
#include "wheelwright/run/results/bounds_on_finer_grid.h"
#include "wheelwright/run/results/finer_wheel.h"
#include "wheelwright/run/results/refined_numbers.h"

namespace wheelwright::testing {
namespace {

const Failure on_purpose{FailureReason::newton_stalled, "on purpose"};
const std::string told = "newton_stalled: on purpose";

/// A solved state that has no solution under other loads.
class StateOfOneLoad : public State<2> {
 public:
  explicit StateOfOneLoad(std::shared_ptr<const State<2>> state) : state_(std::move(state)) {}

  const RollingModel<2>& model() const override { return state_->model(); }
  const CutDomain<2>& domain() const override { return state_->domain(); }
  const LoadPositions& positions() const override { return state_->positions(); }
  const std::vector<ContactPatch<2>>& contacts() const override { return state_->contacts(); }
  const std::vector<double>& strain_energy() const override { return state_->strain_energy(); }
  const std::vector<double>& energy_by_harmonic() const override { return state_->energy_by_harmonic(); }
  const Matrix& observations() const override { return state_->observations(); }
  const std::vector<PhaseTime>& phases() const override { return state_->phases(); }
  const Displacement<2>& displacement() const override { return state_->displacement(); }
  const StrainPeaks<2>& strain_peaks() const override { return state_->strain_peaks(); }
  const std::vector<SurfacePoint<2>>& boundary() const override { return state_->boundary(); }
  const std::vector<SurfacePoint<2>>& edges() const override { return state_->edges(); }
  Expected<ShapeGradients> shape_gradients(
      std::span<const FunctionalDerivative<2>> functions) const override {
    return state_->shape_gradients(functions);
  }
  Expected<std::vector<std::vector<double>>> topological_derivatives(
      std::span<const FunctionalDerivative<2>> functions,
      std::span<const MaterialPoint<2>> points) const override {
    return state_->topological_derivatives(functions, points);
  }
  std::vector<Expected<std::vector<ContactPatch<2>>>> contacts_under(std::span<const RollingModel<2>> models,
                                                                     const Interrupt&) const override {
    return {models.size(), on_purpose};
  }
  Expected<std::shared_ptr<const State<2>>> under(const RollingModel<2>&, const Interrupt&) const override {
    return on_purpose;
  }

 private:
  std::shared_ptr<const State<2>> state_;
};

/// Solves shapes under one load, up to a number of them.
class SolverOfOneLoad : public StateSolver<2> {
 public:
  SolverOfOneLoad(std::shared_ptr<const StateSolver<2>> solver, int most)
      : solver_(std::move(solver)), most_(most) {}

  const RollingModel<2>& model() const override { return solver_->model(); }
  const TreadSurface<2>& tread_surface() const override { return solver_->tread_surface(); }
  Expected<std::shared_ptr<const State<2>>> states(const CutShape<2>& shape, LoadPositions positions,
                                                   const Interrupt& interrupt) const override {
    if (n_solved_ == most_) return on_purpose;
    ++n_solved_;
    auto state = solver_->states(shape, std::move(positions), interrupt);
    if (!state) return state;
    return std::shared_ptr<const State<2>>(std::make_shared<StateOfOneLoad>(*state));
  }
  Expected<TractionMap> neumann_to_dirichlet(DualNorm norm) const override {
    return solver_->neumann_to_dirichlet(norm);
  }

 private:
  std::shared_ptr<const StateSolver<2>> solver_;
  int most_;
  mutable int n_solved_ = 0;
};

/// The results of a run of one shape that ends where it begins.
class ResultsOfARun : public TemporaryFolder {
 protected:
  static Study<2> study(const std::string& more) {
    std::string text = small_wheel + more;
    const std::string holes = "count = 16\ncenter_radius = 0.27\nradius = 0.03\n";
    text.replace(text.find(holes), holes.size(),
                 "count = 24\ncenter_radius = 0.26\nradius = 0.027\n");  // walls of 13.9 mm
    const CaseResult result = parse_case(text, "case.toml");
    if (!result.value) throw std::runtime_error(result.problems.front().text());
    return *make_study<2>(*result.value);
  }

  FinalResults<2> results(Study<2> study, std::optional<int> max_solves) {
    auto state =
        optimizer_of(study).start(study.initial, [](const Trial<2>&, const OptimizationState<2>&) {});
    EXPECT_TRUE(state);
    const InitialShape<2> initial{state->shape, state->evaluation.function("objective").value,
                                  state->measure};
    state->iteration = 1;
    state_ = *state;
    if (max_solves) study.solver = std::make_shared<SolverOfOneLoad>(study.solver, *max_solves);
    return final_results<2>(study, initial, *state, {}, Interrupt());
  }

  std::optional<OptimizationState<2>> state_;
};

TEST_F(ResultsOfARun, AreShownWithoutFailedNumbers) {
  const std::string two_loads =
      "[[load.case]]\nname = \"straight\"\n[[load.case]]\nname = \"kerb\"\nmass = 400\n";
  const Study<2> study = this->study(two_loads);
  const auto all = nlohmann::json::parse(summary_json(results(study, {}).summary));
  const FinalResults<2> some_results = results(study, 2);
  const auto some = nlohmann::json::parse(summary_json(some_results.summary));
  for (const char* shape : {"before", "after"}) {
    for (const auto& [key, value] : all[shape].items()) {
      const bool is_missing = key == "force_variation_N" || key == "force_first_harmonic_N";
      EXPECT_TRUE(some[shape].contains(key)) << key;
      if (key == "load_cases" || key == "errors") continue;
      EXPECT_EQ(some[shape][key], is_missing ? nlohmann::json() : value) << key;
    }
    EXPECT_EQ(some[shape]["missing"]["force_variation_N"], told);
    EXPECT_EQ(some[shape]["missing"].size(), 2u);
    EXPECT_TRUE(some[shape]["load_cases"]["kerb"]["stiffness_N_per_m"].is_null());
    EXPECT_EQ(some[shape]["load_cases"]["kerb"]["missing"]["stiffness_N_per_m"], told);
  }
  const auto lines = missing_lines(some_results.summary);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].ends_with(told)) << lines[0];
  EXPECT_NE(summary_table(some_results.summary).find(lines[0]), std::string::npos);
  EXPECT_TRUE(missing_lines(results(study, {}).summary).empty());
}

TEST_F(ResultsOfARun, AreRefinedFromTheFinerShapeThatIsGiven) {
  const Study<2> study = this->study("");
  const auto& solver = *study.solver;
  const auto states = solver.states(study.initial, solver.all_positions(), Interrupt());
  const auto finer = solved_finer_shape<2>(study.source, solver, study.initial, Interrupt());
  ASSERT_TRUE(states && finer);
  const Interrupt no_more([] { return true; });
  const AccurateNumbers given =
      refined_numbers<2>(study.source, solver, study.initial, states, finer, 1e-12, no_more);
  int n_estimated = 0;
  for (const AccurateNumber& number : given.numbers) n_estimated += number.error.has_value();
  EXPECT_GE(n_estimated, 10);
  EXPECT_EQ(given.numbers.back().reason.find("interrupted") != std::string::npos, true)
      << given.numbers.back().reason;
}

/// One value of a bound on a quantity, on some grid.
std::vector<BoundState> bound_of(char relation, double value, double bound) {
  return {{.name = "mean_travel",
           .value = value,
           .bound = bound,
           .relation = relation,
           .multiplier = 0,
           .violation = 0,
           .unit = UnitKind::length}};
}

/// A bound that is kept on the grid of the run, where the value is `here`.
SummarizedBound checked(char relation, double here, double on_finer, double bound,
                        const Quantity& quantity = built_in("mean_travel")) {
  std::vector<SummarizedBound> bounds{{.name = "mean_travel",
                                       .value = here,
                                       .bound = bound,
                                       .relation = relation,
                                       .multiplier = 0,
                                       .is_kept = true,
                                       .kept_within = 0,
                                       .unit = "m",
                                       .shown = shown_unit(UnitKind::length, 2)}};
  const std::vector<ShapeFunction<2>> functions{{.name = "mean_travel", .terms = {}, .quantity = quantity}};
  add_finer_values<2>(functions, bound_of(relation, here, bound), bound_of(relation, on_finer, bound), 2,
                      bounds);
  return bounds.front();
}

// On the finer grid the error of the first order is the difference of both values, which is doubled for
// safety.
TEST(BoundsOnFinerGrid, AreKeptOnlyByTheValueWithItsError) {
  const auto verdict = [](char relation, double here, double on_finer, double bound) {
    return (*checked(relation, here, on_finer, bound).finer)->verdict;
  };
  EXPECT_NEAR((*checked('<', 4e-3, 4.1e-3, 5e-3).finer)->error, 2e-4, 1e-15);
  EXPECT_EQ(verdict('<', 4e-3, 4.1e-3, 4.31e-3), FinerVerdict::kept);
  EXPECT_EQ(verdict('<', 4e-3, 4.1e-3, 4.29e-3), FinerVerdict::within_error);
  EXPECT_EQ(verdict('<', 4e-3, 4.1e-3, 3.91e-3), FinerVerdict::within_error);
  EXPECT_EQ(verdict('<', 4e-3, 4.1e-3, 3.89e-3), FinerVerdict::broken);
  EXPECT_EQ(verdict('>', 4e-3, 3.9e-3, 3.69e-3), FinerVerdict::kept);
  EXPECT_EQ(verdict('>', 4e-3, 3.9e-3, 4e-3), FinerVerdict::within_error);
  EXPECT_EQ(verdict('>', 4e-3, 3.9e-3, 4.11e-3), FinerVerdict::broken);
  EXPECT_EQ(verdict('=', 4e-3, 3.9e-3, 4e-3), FinerVerdict::within_error);
  EXPECT_EQ(verdict('<', 4e-3, 4.0001e-3, 4e-3), FinerVerdict::kept);  // within 0.1 %, as on the own grid
}

TEST(BoundsOnFinerGrid, OnExtremesNeedTwiceTheMargin) {
  const auto integral = checked('<', 4e-3, 4.1e-3, 5e-3),
             extreme = checked('<', 4e-3, 4.1e-3, 5e-3, built_in("peak_pressure"));
  EXPECT_NEAR((*extreme.finer)->error, 2 * (*integral.finer)->error, 1e-15);
}

TEST(BoundsOnFinerGrid, AreToldWithTheTighterBoundThatWouldKeepThem) {
  EXPECT_EQ(finer_grid_warning(checked('<', 4e-3, 4.1e-3, 5e-3)), "");
  const auto tighter = [](const SummarizedBound& bound) {
    const std::string text = finer_grid_warning(bound);
    return std::stod(text.substr(text.find("tighten it to ") + 14));
  };
  EXPECT_NEAR(tighter(checked('<', 4e-3, 4.1e-3, 4e-3)), 3.7, 1e-9);  // 4.1 + 0.2 is 0.3 beyond it
  EXPECT_NEAR(tighter(checked('<', 4e-3, 4.1e-3, 3.8e-3)), 3.3, 1e-9);
  EXPECT_NEAR(tighter(checked('>', 4e-3, 3.9e-3, 4e-3)), 4.3, 1e-9);
  for (const SummarizedBound& bound : {checked('=', 4e-3, 3.9e-3, 4e-3), checked('<', 4e-3, 6e-3, 4e-3)}) {
    EXPECT_NE(finer_grid_warning(bound), "");
    EXPECT_EQ(finer_grid_warning(bound).find("tighten"), std::string::npos);
  }
  SummarizedBound violated = checked('<', 4e-3, 4.1e-3, 3.8e-3);
  violated.is_kept = false;  // which the program reports without a finer grid
  EXPECT_EQ(finer_grid_warning(violated), "");
}

// A bound at the stiffness that the wheel has on its own grid, and one that it keeps on any.
TEST_F(ResultsOfARun, TellWhichBoundsAFinerGridDoesNotKeep) {
  const auto bounded = [&](double stiffness) {
    return this->study(
        fmt::format("[[constraint]]\nquantity = \"stiffness\"\nat_least = {}\n"
                    "[[constraint]]\nquantity = \"mean_travel\"\nat_most = 0.1\n",
                    stiffness));
  };
  const auto summary = results(bounded(1e6), {}).summary;
  const double here = summary.bounds[0].value, finer = (*summary.bounds[0].finer)->value;
  const double width = summary.after.wheel.grid.width;
  const auto json = nlohmann::json::parse(summary_json(summary));
  // The error of the summary's stiffness on the whole width, from another path: integral, cells halved.
  EXPECT_NEAR(json["after"]["errors"]["stiffness_N_per_m"].get<double>(), 4 * std::abs(here - finer) * width,
              1e-6 * here * width);
  ASSERT_GT(here - finer, 2e-3 * here);  // too stiff, as displacements on coarse grids are too small
  const FinalResults<2> at_bound = results(bounded(here), {});
  const auto bounds = nlohmann::json::parse(summary_json(at_bound.summary))["bounds"];
  EXPECT_EQ(bounds[0]["is_kept"], true);
  EXPECT_EQ(bounds[0]["on_finer_grid"]["verdict"], "within_error");
  EXPECT_NEAR(bounds[0]["on_finer_grid"]["value"], finer, 1e-6 * finer);
  EXPECT_EQ(bounds[1]["on_finer_grid"]["verdict"], "kept");
  const SolvedShape<2> shape{&state_->shape, at_bound.solver.get(), at_bound.shown.get()};
  const ReportRun<2> run = report_of_results<2>(folder(), bounded(here).source, at_bound.summary, shape,
                                                shown_wheel(shape), StopReason::converged);
  const std::string warning = finer_grid_warning(at_bound.summary.bounds[0]);
  EXPECT_NE(std::ranges::find(run.flags, warning), run.flags.end());
  EXPECT_EQ(finer_grid_warning(at_bound.summary.bounds[1]), "");
}

TEST_F(ResultsOfARun, TellNothingOfFinerGridsWithoutErrors) {
  Study<2> study = this->study("[[constraint]]\nquantity = \"stiffness\"\nat_least = 1e6\n");
  study.source.output.errors = ErrorEstimates::none;
  const auto summary = results(study, {}).summary;
  EXPECT_FALSE(summary.bounds[0].finer);
  EXPECT_FALSE(nlohmann::json::parse(summary_json(summary))["bounds"][0].contains("on_finer_grid"));
}

TEST_F(ResultsOfARun, HaveErrorsOfTheLastShapeUnderEveryLoad) {
  const Study<2> study =
      this->study("[[load.case]]\nname = \"straight\"\n[[load.case]]\nname = \"kerb\"\nmass = 400\n");
  const FinalResults<2> of_run = results(study, {});
  const auto finer = finer_shape<2>(study.source, *of_run.solver, state_->shape);
  ASSERT_TRUE(finer);
  const auto states =
      finer->solver->states(finer->shape, finer->solver->distinct_positions(finer->shape), Interrupt());
  const auto wheel = finer_wheel<2>(study.source, study.load_cases, *finer, states);
  ASSERT_TRUE(wheel);
  const auto json = nlohmann::json::parse(summary_json(of_run.summary));
  EXPECT_FALSE(json["before"].contains("errors"));
  const auto expect_errors = [](const nlohmann::json& of, const DescribedWheel<2>& on_finer) {
    for (const WheelNumber<2>& number : wheel_numbers<2>()) {
      if (!of["errors"].contains(number.key)) continue;
      const double value = of[number.key],
                   expected = std::abs(value - **number.value(on_finer)) * 2 * error_safety(number.converges);
      EXPECT_NEAR(of["errors"][number.key].get<double>(), expected, 1e-6 * std::abs(value)) << number.key;
    }
    EXPECT_GE(of["errors"].size(), 10u);
  };
  expect_errors(json["after"], wheel->wheel);
  expect_errors(json["after"]["load_cases"]["kerb"], wheel->wheel.others[0]);
  EXPECT_FALSE(json["after"]["errors"].contains("minimum_wall_m"));
  EXPECT_GT(json["after"]["errors"]["objective_J_per_m"], 0);
  EXPECT_NE(summary_table(of_run.summary).find(" +- "), std::string::npos);
}

TEST_F(ResultsOfARun, SayWhyErrorsAreNotEstimated) {
  const Study<2> study = this->study("");
  RunSummary<2> summary = results(study, {}).summary;
  summary.after.wheel = with_errors<2>(summary.after.wheel, std::string("too large"));
  const auto json = nlohmann::json::parse(summary_json(summary));
  EXPECT_TRUE(json["after"]["errors"]["stiffness_N_per_m"].is_null());
  EXPECT_EQ(json["after"]["missing_errors"]["stiffness_N_per_m"], "too large");
}

TEST_F(ResultsOfARun, AreThoseOfTheLastShapeWhereTheFirstHasNoSolution) {
  const auto all = nlohmann::json::parse(summary_json(results(study("minimum_wall = 0.0175\n"), {}).summary));
  Study<2> widened = this->study("minimum_wall = 0.0175\n");  // the given wheel is another one
  const FinalResults<2> some_results = results(std::move(widened), 1);
  const auto some = nlohmann::json::parse(summary_json(some_results.summary));
  EXPECT_EQ(some["after"]["stiffness_N_per_m"], all["after"]["stiffness_N_per_m"]);
  EXPECT_TRUE(some["before"]["stiffness_N_per_m"].is_null());
  EXPECT_EQ(some["before"]["missing"]["stiffness_N_per_m"], told);
  EXPECT_EQ(some["before"]["volume_fraction"], all["before"]["volume_fraction"]);
  EXPECT_EQ(some["before"]["minimum_wall_m"], all["before"]["minimum_wall_m"]);
}

// A run begins with the widths that are asked for; it is compared with the wheel that was drawn.
TEST_F(ResultsOfARun, CompareWithTheGivenWheel) {
  const FinalResults<2> as_given = results(study(""), {});
  const Study<2> study = this->study("minimum_wall = 0.0175\n");
  const FinalResults<2> widened = results(study, {});
  EXPECT_NE(state_->shape.values, study.initial.values);
  EXPECT_EQ(as_given.summary.changed_start, "");
  EXPECT_NE(widened.summary.changed_start, "");
  const auto expected = nlohmann::json::parse(summary_json(as_given.summary));
  const auto found = nlohmann::json::parse(summary_json(widened.summary));
  for (const auto& [key, value] : expected["before"].items())
    if (value.is_number()) {
      EXPECT_NEAR(found["before"][key].get<double>(), value.get<double>(),
                  1e-9 * std::abs(value.get<double>()))
          << key;
    }
  EXPECT_LT(found["before"]["minimum_wall_m"], 0.016);
  EXPECT_GT(found["after"]["minimum_wall_m"], 0.0165);
  const SolvedShape<2> shape{&state_->shape, widened.solver.get(), widened.shown.get()};
  const ReportRun<2> run = report_of_results<2>(folder(), study.source, widened.summary, shape,
                                                shown_wheel(shape), StopReason::converged);
  ASSERT_TRUE(run.given);
  EXPECT_EQ(run.given->contours, shape_outline(0, 0, study.initial).contours);
}

TEST_F(ResultsOfARun, HaveAPageThatNamesMissingNumbers) {
  const Study<2> study = this->study("");
  const FinalResults<2> some = results(study, 2);
  const SolvedShape<2> shape{&state_->shape, some.solver.get(), some.shown.get()};
  const ReportRun<2> run = report_of_results<2>(folder(), study.source, some.summary, shape,
                                                shown_wheel(shape), StopReason::converged);
  EXPECT_TRUE(std::ranges::any_of(run.flags, [](const std::string& flag) { return flag.ends_with(told); }));
  const std::string json = page_run(run).json;
  EXPECT_NE(json.find("\"force_at_travel_N\":null"), std::string::npos);
}

TEST_F(ResultsOfARun, AreASummaryWithoutAnySolution) {
  const auto none = results(study(""), 0);
  EXPECT_FALSE(none.shown);
  const auto json = nlohmann::json::parse(summary_json(none.summary));
  EXPECT_TRUE(json["after"]["objective_J_per_m"].is_number());
  EXPECT_EQ(json["after"]["missing"]["run_out_m"], told);
}

TEST_F(ResultsOfARun, NearZeroAreNotShownInPercent) {
  RunSummary<2> summary = results(study(""), {}).summary;
  const auto objective_told = [&](double times) {
    summary.after.objective = times * *summary.before.objective;
    const std::string line = gains(summary);
    return line.substr(line.rfind(", ") + 2);
  };
  EXPECT_EQ(objective_told(1.5), "objective 50.0 % higher");
  EXPECT_EQ(objective_told(1e5).find('%'), std::string::npos) << objective_told(1e5);
}

TEST_F(ResultsOfARun, TellThatTheObjectiveIsASumOverLoadCases) {
  RunSummary<2> summary =
      results(study("[[load.case]]\nname = \"straight\"\n[[load.case]]\nname = \"kerb\"\n"), {}).summary;
  EXPECT_TRUE(summary_table(summary).find("objective, weighted sum over the load cases [J/m]") !=
              std::string::npos)
      << summary_table(summary);
  summary.minimized = "peak_temperature";
  summary.objective_kind = UnitKind::temperature;
  summary.objective = shown_unit(UnitKind::temperature, 2);
  summary.before.objective = 0.5;
  summary.after.objective = -1.0;
  EXPECT_NE(
      summary_table(summary).find("objective: peak_temperature, weighted sum over the load cases [deg C]"),
      std::string::npos);
  EXPECT_NE(gains(summary).find("peak_temperature 1.5 K lower"), std::string::npos) << gains(summary);
  EXPECT_EQ(summary_table(results(study(""), {}).summary).find("weighted sum"), std::string::npos);
}

TEST(Expectations, OfTemperaturesMayBeZeroOrLess) {
  Expectation expected;
  expected.quantity = built_in("peak_temperature");
  expected.margin = 0.1;
  expected.value = -20;
  EXPECT_TRUE((Finding{expected, -19.0}.met()));
  EXPECT_FALSE((Finding{expected, -17.9}.met()));
  expected.value = 0;
  EXPECT_TRUE((Finding{expected, -0.09}.met()));
  EXPECT_FALSE((Finding{expected, 0.11}.met()));
  EXPECT_NE((Finding{expected, 0.0}.text().find("0 within 0.1 deg C")), std::string::npos);
}

TEST_F(ResultsOfARun, ReportWhyAnExpectationIsUnknown) {
  const Study<2> study = this->study(
      "[[load.case]]\nname = \"straight\"\n[[load.case]]\nname = \"kerb\"\nmass = 400\n"
      "[[expect]]\nquantity = \"stiffness\"\nvalue = 1\n"
      "[[expect]]\nquantity = \"stiffness\"\nvalue = 1\nload_case = \"kerb\"\n"
      "[[expect]]\nquantity = \"stiffness\"\nvalue = 1\niteration = 9\n");
  for (const int max_solves : {0, 2}) {
    const FinalResults<2> some = results(study, max_solves);
    const auto found =
        findings<2>(study.source.expectations, {}, *study.solver, study.load_cases, *state_, some.own);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(static_cast<bool>(found[0].found), max_solves > 0);
    ASSERT_FALSE(found[1].found);
    EXPECT_EQ(found[1].found.failure(), told);
    EXPECT_NE(found[1].text().find(told), std::string::npos);
    ASSERT_FALSE(found[2].found);  // the run ended with shape 1
    EXPECT_NE(found[2].found.failure(), told);
  }
}

}  // namespace
}  // namespace wheelwright::testing
