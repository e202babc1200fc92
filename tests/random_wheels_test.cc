#include "tests/random_wheels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <stdexcept>

#include "wheelwright/base/parallel.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/quantities/analysis/fatigue_results.h"
#include "wheelwright/quantities/analysis/heat_results.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/quantities/analysis/rolling_losses.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/study/predicted_deformation.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

using testing::AnyWheels;
using testing::LayeredWheels;
using testing::OrthotropicWheels;
using testing::RandomWheels;
using testing::WheelsOnGrounds;

/// Changes a case as the remedy of a problem says: "take KEY = VALUE", "take at most LOAD N" or "remove one
/// of the two" rings. Returns whether it could be followed.
bool follow(const std::string& remedy, Case& c) {
  std::smatch match;
  if (std::regex_search(remedy, match, std::regex(R"(grid\.tread_levels = (\d+))")))
    c.grid.tread_levels = std::stoi(match[1]);
  else if (std::regex_search(remedy, match, std::regex(R"(contact\.quadrature_points = (\d+))")))
    c.contact.quadrature_points = std::stoi(match[1]);
  else if (std::regex_search(remedy, match, std::regex(R"(degree = (\d))")))
    c.grid.degree = std::stoi(match[1]);
  else if (std::regex_search(remedy, match, std::regex(R"((?:at most|value <=) ([0-9.e+-]+) N)"))) {
    const double factor = std::min(1.0, std::stod(match[1]) / c.load.force);
    c.load.force *= factor;
    c.load.horizontal_force *= factor;
    c.load.torque *= factor;
  } else if (remedy.find("remove one of the two") != std::string::npos)
    c.holes.rings.pop_back();
  else
    return false;
  return true;
}

/// The case changed as all of its problems say at once.
std::optional<Case> repaired(Case c, const std::vector<Diagnostic>& problems) {
  for (const Diagnostic& problem : problems)
    if (!follow(problem.remedy + problem.problem, c)) return {};
  return c;
}

/// How one wheel ended, and what is wrong with that; empty: nothing.
struct End {
  enum Kind { solved, refused, failed } kind;
  std::string complaint;
};

std::string unbalanced(const State<2>& state, double load) {
  for (const auto& contact : state.contacts()) {
    double force = 0;
    for (const auto& point : contact.points) force -= point.weight * point.traction[0];
    if (!(std::abs(force - load) <= 1e-9 * load))
      return "the contact carries " + std::to_string(force / load);
  }
  return "";
}

/// Whether the rim of a wheel that could not be solved would travel by less than 5 % of the ring's thickness
/// on the coarse grid of `check`, or is not known to travel farther: then its failure needs mending. Heavier
/// loads are beyond linear elasticity.
bool is_lightly_loaded(const Case& c) {
  const auto size = predicted_size(c);
  if (size) return size->travel < 0.05;
  return size.failure().reason != FailureReason::rim_under_ground &&
         size.failure().reason != FailureReason::material_overlaps;
}

End end_of(const Case& drawn) {
  const CaseResult read = parse_case(to_toml(drawn), "random.toml");
  if (!read.value) {
    const std::string text = read.problems.front().text();
    if (read.problems.front().key.empty()) return {End::refused, "names no key: " + text};
    const auto changed = repaired(drawn, read.problems);
    if (!changed) return {End::refused, "no remedy that can be followed: " + text};
    const End after = end_of(*changed);
    if (after.kind == End::solved) return {End::refused, after.complaint};
    return {End::refused,
            text + ", then " + (after.kind == End::refused ? "refused again " : "failed ") + after.complaint};
  }
  const Case& c = *read.value;
  const auto solver = make_solver(rolling_model<2>(c));
  if (!solver) return {End::failed, to_string(solver.failure().reason)};
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto state = (*solver)->states(shape, (*solver)->distinct_positions(shape), Interrupt());
  if (state) {
    if (const auto failure = material_overlaps(**solver, shape, **state)) return {End::failed, ""};
    return {End::solved, unbalanced(**state, (*solver)->model().load)};
  }
  const Failure& failure = state.failure();
  switch (failure.reason) {
    case FailureReason::rim_under_ground:
    case FailureReason::tread_cut_off:
    case FailureReason::disconnected_material:
    case FailureReason::protected_band:
      return {End::failed, ""};
    case FailureReason::no_contact:
    case FailureReason::not_positive_definite:
    case FailureReason::newton_stalled:
      if (!is_lightly_loaded(c)) return {End::failed, ""};
      [[fallthrough]];
    default:
      return {End::failed, std::string(to_string(failure.reason)) + ": " + failure.detail};
  }
}

/// Every wheel is solved and balanced, refused with remedies that help, or fails for a physical reason, and
/// each in less than 20 s of processor time.
void expect_an_end_of_each(int n, unsigned seed) {
  const ThreadLimit one_thread(1);  // waiting threads would count as processor time
  RandomWheels wheels(seed);
  std::map<End::Kind, int> count;
  double longest = 0;
  for (int k = 0; k < n; ++k) {
    const Case c = wheels.draw();
    const std::clock_t begin = std::clock();
    const End end = end_of(c);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    longest = std::max(longest, seconds);
    ++count[end.kind];
    EXPECT_LT(seconds, 20) << "wheel " << k;
    if (end.complaint.empty()) continue;
    ADD_FAILURE() << "wheel " << k << ": " << end.complaint << "\n" << to_toml(c);
  }
  std::cout << count[End::solved] << " solved, " << count[End::refused] << " refused, " << count[End::failed]
            << " failed; at most " << longest << " s each\n";
  EXPECT_GE(count[End::solved], 0.8 * n);
  EXPECT_LE(count[End::refused], 0.1 * n);
}

TEST(RandomWheels, AreSolvedOrFailWithAReason) { expect_an_end_of_each(12, 2); }
TEST(RandomWheels, AreSolvedOrFailWithAReasonSlow) { expect_an_end_of_each(300, 1); }

/// What the losses of one wheel cost, solved anew; nothing if it is not accepted or not solved.
std::optional<RollingLosses> losses_of(const Case& drawn) {
  const CaseResult read = parse_case(to_toml(drawn), "random.toml");
  if (!read.value) return {};
  const auto solver = make_solver(rolling_model<2>(*read.value));
  if (!solver) return {};
  const LevelSet<2> shape = initial_shape<2>(*read.value);
  const auto state = (*solver)->states(shape, (*solver)->distinct_positions(shape), Interrupt());
  if (!state) return {};
  const auto losses = rolling_losses<2>(**solver, shape, **state);
  return losses && *losses ? std::optional(**losses) : std::nullopt;
}

/// Every wheel that is solved has a rolling resistance that is finite, positive and the same when it is
/// solved again. The harmonics of single layers may be differences of larger ones.
template <class Wheels>
void expect_finite_resistances(int n, unsigned seed) {
  Wheels wheels(seed);
  int n_solved = 0;
  for (int k = 0; k < n; ++k) {
    Case c = wheels.draw();
    c.material.loss_factor = 0.1;
    for (std::size_t i = 0; i < c.layers.size(); ++i)
      c.layers[i].loss_factor = 0.05 * static_cast<double>(i + 1);
    const auto losses = losses_of(c);
    if (!losses) continue;
    ++n_solved;
    SCOPED_TRACE(k);
    EXPECT_TRUE(std::isfinite(losses->resistance) && std::isfinite(losses->beyond));
    EXPECT_TRUE(losses->resistance > 0 || total_load_positions(c) == 1) << losses->resistance << "\n"
                                                                        << to_toml(c);
    for (const double force : losses->by_harmonic) EXPECT_GE(force, -1e-6 * losses->resistance);
    EXPECT_EQ(losses_of(c)->by_harmonic, losses->by_harmonic);
  }
  std::cout << n_solved << " of " << n << " solved\n";
  EXPECT_GE(n_solved, 0.5 * n);
}

TEST(RandomWheels, HaveARollingResistance) { expect_finite_resistances<RandomWheels>(6, 2); }
TEST(RandomWheels, HaveARollingResistanceSlow) { expect_finite_resistances<RandomWheels>(200, 1); }
TEST(LayeredWheels, HaveARollingResistanceSlow) { expect_finite_resistances<LayeredWheels>(60, 3); }

/// What a wheel's turns wear and how warm they make it, solved anew; nothing if it is not accepted or not
/// solved.
struct WearAndHeat {
  double utilization, temperature, heat, given_away;
};
std::optional<WearAndHeat> wear_and_heat(const Case& drawn) {
  const CaseResult read = parse_case(to_toml(drawn), "random.toml");
  if (!read.value) return {};
  const auto solver = make_solver(rolling_model<2>(*read.value));
  if (!solver) return {};
  const LevelSet<2> shape = initial_shape<2>(*read.value);
  const auto state = (*solver)->states(shape, (*solver)->all_positions(), Interrupt());
  if (!state) return {};
  const auto fatigue = fatigue_results<2>(**solver, shape, **state);
  const auto heat = heat_results<2>(**solver, shape, **state);
  if (!fatigue || !heat) throw std::runtime_error("numbers without constants");
  if (!*fatigue || !*heat) throw std::runtime_error((*fatigue ? heat->failure() : fatigue->failure()).detail);
  const HeatResults& h = **heat;
  return WearAndHeat{(*fatigue)->worst.utilization, h.peak.temperature, h.heat,
                     h.through_rim + h.through_tread + h.through_holes + h.through_side_faces};
}

/// Every wheel that is solved has a utilization and a temperature that are finite, not less than nothing and
/// than the air's, and the same when it is solved again; and it gives its heat away.
void expect_wear_and_heat(int n, unsigned seed) {
  constexpr FatigueMeasure measures[] = {FatigueMeasure::crossland, FatigueMeasure::dang_van,
                                         FatigueMeasure::goodman, FatigueMeasure::principal_strain,
                                         FatigueMeasure::strain_energy};
  RandomWheels wheels(seed);
  int n_solved = 0;
  for (int k = 0; k < n; ++k) {
    Case c = wheels.draw();
    c.material.loss_factor = 0.1;
    c.material.density = 1200;
    c.material.conductivity = 0.2;
    const FatigueMeasure measure = c.material.fatigue_measure = measures[k % std::size(measures)];
    if (measure == FatigueMeasure::principal_strain)
      c.material.fatigue_strain = 0.01;
    else
      c.material.fatigue_limit = 1e4;
    if (measure == FatigueMeasure::crossland || measure == FatigueMeasure::dang_van)
      c.material.fatigue_pressure_factor = 0.3;
    if (measure == FatigueMeasure::goodman) c.material.ultimate_strength = 1e8;
    c.load.speed = 0.1;
    c.heat.convection = 10;
    const auto found = wear_and_heat(c);
    if (!found) continue;
    ++n_solved;
    SCOPED_TRACE(to_toml(c));
    EXPECT_TRUE(std::isfinite(found->utilization) && found->utilization > 0);
    EXPECT_TRUE(std::isfinite(found->temperature) && found->temperature >= 20);
    EXPECT_NEAR(found->given_away, found->heat, 1e-6 * found->heat);
    const auto again = wear_and_heat(c);
    EXPECT_EQ(again->utilization, found->utilization);
    EXPECT_EQ(again->temperature, found->temperature);
  }
  std::cout << n_solved << " of " << n << " solved\n";
  EXPECT_GE(n_solved, 0.5 * n);
}

TEST(RandomWheels, HaveALifeAndATemperature) { expect_wear_and_heat(5, 2); }
TEST(RandomWheels, HaveALifeAndATemperatureSlow) { expect_wear_and_heat(200, 1); }

/// Whether a failure says what is wrong with the case: by its reason, or by a key.
bool is_explained(const Failure& failure) {
  switch (failure.reason) {
    case FailureReason::sliding:
    case FailureReason::overload:
    case FailureReason::no_contact:
    case FailureReason::rim_under_ground:
    case FailureReason::disconnected_material:
    case FailureReason::tread_cut_off:
    case FailureReason::protected_band:
      return true;
    default:
      return std::regex_search(failure.detail, std::regex(R"((load|contact|material|grid|wheel)\.[a-z_]+)"));
  }
}

/// How a case ended: solved under all its loads and analyzed, refused, or failed.
struct AnyEnd {
  std::string kind;  ///< "solved", "refused" or the reason of the failure
  std::string complaint;
};

AnyEnd failed(const Failure& failure) {
  std::string text = to_string(failure.reason) + (": " + failure.detail);
  const bool is_accepted = is_explained(failure) && failure.reason != FailureReason::newton_stalled;
  return {to_string(failure.reason), is_accepted ? "" : text};
}

template <int dim>
AnyEnd any_end_of(const Case& c) {
  const auto solver = make_solver(rolling_model<dim>(c));
  if (!solver) return failed(solver.failure());
  const LevelSet<dim> shape = initial_shape<dim>(c);
  const auto cases = load_cases<dim>(c);
  const auto states =
      states_of_cases<dim>(**solver, cases, shape, distinct_positions(**solver, cases, shape), Interrupt());
  if (!states) return failed(states.failure());
  for (const auto& state : *states) {
    const RollingAnalysis analysis = rolling_analysis<dim>(**solver, *state);
    for (const auto* values : {&analysis.travel_at_load, &analysis.force_at_travel})
      if (!*values && !is_explained(values->failure())) return failed(values->failure());
    const double stiffness = shape_summary<dim>(**solver, *state).stiffness;
    const auto& others = state->model().distributed;  // which may lift or inflate the wheel, as friction may
    const RollingModel<dim>& model = state->model();
    const bool is_pressed_only = norm<dim>(others.body_force) == 0 && others.hole_pressure == 0 &&
                                 std::hypot(model.horizontal_force, model.lateral_force) <= model.load;
    if (!(stiffness > 0) && is_pressed_only && c.contact.with == Counterpart::ground)
      return {"solved", "stiffness " + std::to_string(stiffness)};
  }
  return {"solved", ""};
}

AnyEnd any_end_of(const Case& drawn) {
  const CaseResult read = parse_case(to_toml(drawn), "random.toml");
  if (read.value) return in_dimension_of(*read.value, [&](auto dim) { return any_end_of<dim>(*read.value); });
  for (const Diagnostic& problem : read.problems)
    if (problem.key.empty()) return {"refused", "names no key: " + problem.text()};
  return {"refused", ""};
}

/// Every wheel is solved, or told why not in words of the case or of physics, in 60 s of processor time.
template <class Wheels>
void expect_a_reason_of_each(int first, int n, unsigned seed) {
  const ThreadLimit one_thread(1);
  Wheels wheels(seed);
  std::map<std::string, int> count;
  double longest = 0;
  for (int k = 0; k < first + n; ++k) {
    const Case c = wheels.draw();
    if (k < first) continue;
    const std::clock_t begin = std::clock();
    const AnyEnd end = any_end_of(c);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    longest = std::max(longest, seconds);
    ++count[end.kind];
    if (seconds > 5)
      std::cout << "wheel " << k << ": " << end.kind << " after " << seconds << " s" << std::endl;
    EXPECT_LT(seconds, 60) << "wheel " << k << "\n" << to_toml(c);
    if (!end.complaint.empty()) ADD_FAILURE() << "wheel " << k << ": " << end.complaint << "\n" << to_toml(c);
  }
  for (const auto& [kind, number] : count) std::cout << number << " " << kind << ", ";
  std::cout << "at most " << longest << " s each\n";
  EXPECT_GE(count["solved"], 0.4 * n);
  EXPECT_EQ(count["newton_stalled"], 0);
}

// Without a refined tread the ground touches two columns of cells of this wheel, under 64 % of the torque
// that friction can hold.
TEST(AnyWheels, ContactOfTooFewColumnsIsNamed) {
  constexpr int number = 195;
  AnyWheels wheels(21);
  for (int k = 0; k < number; ++k) wheels.draw();
  Case c = wheels.draw();
  c.grid.tread_levels = 0;
  c.grid.level_set_degree = 1;
  EXPECT_EQ(any_end_of(c).kind, to_string(FailureReason::inaccurate_solution));
}

TEST(AnyWheels, EndSolvedOrWithAReason) { expect_a_reason_of_each<AnyWheels>(0, 8, 3); }
TEST(AnyWheels, EndSolvedOrWithAReasonSlow) { expect_a_reason_of_each<AnyWheels>(0, 300, 4); }
TEST(AnyWheels, OthersEndSolvedOrWithAReasonSlow) { expect_a_reason_of_each<AnyWheels>(0, 300, 5); }
TEST(AnyWheels, MoreEndSolvedOrWithAReasonSlow) { expect_a_reason_of_each<AnyWheels>(0, 300, 21); }

// A torque of ninety times what friction can hold, in a drum of nearly the radius of the wheel: all of the
// tread may touch, and a search for a state that holds would visit hundreds of thousands.
TEST(WheelsOnGrounds, ATorqueFarBeyondFrictionIsSliding) {
  constexpr int number = 214;
  WheelsOnGrounds wheels(6);
  for (int k = 0; k < number; ++k) wheels.draw();
  const Case c = wheels.draw();
  EXPECT_EQ(c.load.ground, "internal_drum");
  EXPECT_EQ(any_end_of(c).kind, to_string(FailureReason::sliding));
}

TEST(WheelsOnGrounds, EndSolvedOrWithAReason) { expect_a_reason_of_each<WheelsOnGrounds>(0, 8, 2); }
TEST(WheelsOnGrounds, EndSolvedOrWithAReasonSlow) { expect_a_reason_of_each<WheelsOnGrounds>(0, 100, 6); }
TEST(WheelsOnGrounds, OthersEndSolvedOrWithAReasonSlow) {
  expect_a_reason_of_each<WheelsOnGrounds>(100, 100, 6);
}
TEST(WheelsOnGrounds, MoreEndSolvedOrWithAReasonSlow) {
  expect_a_reason_of_each<WheelsOnGrounds>(200, 100, 6);
}

TEST(LayeredWheels, EndSolvedOrWithAReason) { expect_a_reason_of_each<LayeredWheels>(0, 8, 3); }
TEST(LayeredWheels, EndSolvedOrWithAReasonSlow) { expect_a_reason_of_each<LayeredWheels>(0, 300, 7); }

TEST(OrthotropicWheels, EndSolvedOrWithAReason) { expect_a_reason_of_each<OrthotropicWheels>(0, 8, 3); }
TEST(OrthotropicWheels, EndSolvedOrWithAReasonSlow) { expect_a_reason_of_each<OrthotropicWheels>(0, 300, 7); }

}  // namespace
}  // namespace wheelwright
