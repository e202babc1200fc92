#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"

namespace wheelwright {
namespace {

using testing::holes;

/// A wheel whose contact reaches farther than a solid disc's: a soft one, pushed far into the ground, on
/// columns that are narrow in comparison. Holes under the tread let the contact reach farther on one side.
RollingModel<2> pressed_model() {
  RollingModel<2> model;
  model.grid = {0.20, 0.34, 0.12, 5, {14, 48}};
  model.materials = Material{30e6, 0.3};
  model.load = 1e5;
  model.travel = 0.03;
  model.n_positions = 3;
  return model;
}

/// The contact of one position in a zone that is given and not widened.
Expected<ContactState<2>, ContactFailure> solved_in(const RollingProblem<2>& problem,
                                                    const RollingSolution<2>& s, int position,
                                                    const RimControl& rim, ContactZone zone) {
  const SurfaceCompliance<2> surface(s.ring, problem.tread(), zone.n_columns - 1);
  const auto contact =
      reduced_contact<2>(surface, problem.tread(), problem.model().grid, s.positions.grounds[position], zone,
                         law_of<2>(problem.model().contact), rim);
  const auto& model = problem.model();
  const ContactUnknowns<2> start = model.travel ? undeformed_start(contact)
                                                : hertz_start(contact, model.load, model.grid.outer_radius,
                                                              model.materials.at_tread().contact_modulus());
  return solve_contact<2>(contact, std::span(&start, 1));
}

/// Columns from the ground's to the farthest that carries pressure, on either side.
struct Reach {
  int back = 0, forward = 0;
};

Reach reach(const ContactState<2>& state, const GroundPosition& ground) {
  Reach result;
  const int per_column = static_cast<int>(state.traction.size()) / state.zone.n_columns;
  for (int i = 0; i < static_cast<int>(state.traction.size()); ++i) {
    if (state.traction[i][0] >= 0) continue;
    const int distance = state.zone.first_column + i / per_column - ground.column;
    result.back = std::max(result.back, -distance);
    result.forward = std::max(result.forward, distance + 1);
  }
  return result;
}

// What a zone leaves out that would touch is missing in the rim's force, so the contact must be that of a
// zone that holds a third of the tread.
void expect_whole_contact(const RollingModel<2>& model, const LevelSet<2>& psi, int& widest) {
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(psi);
  ASSERT_TRUE(s) << s.failure().detail;
  for (int i = 0; i < s->positions.size(); ++i) {
    const GroundPosition ground = s->positions.grounds[i];
    const int half = model.grid.ring_columns() / 6;
    const auto whole = solved_in(*problem, *s, i, rim_control(model), {ground.column - half, 2 * half});
    ASSERT_TRUE(whole) << whole.failure().detail;
    const ContactState<2>& state = s->states[i];
    const Reach expected = reach(*whole, ground), found = reach(state, ground);
    EXPECT_EQ(found.back, expected.back) << i;
    EXPECT_EQ(found.forward, expected.forward) << i;
    EXPECT_NEAR(state.rim.towards_ground, whole->rim.towards_ground, 1e-9 * whole->rim.towards_ground) << i;
    EXPECT_NEAR(state.rim_force.towards_ground, whole->rim_force.towards_ground,
                1e-9 * whole->rim_force.towards_ground)
        << i;
    // A neighbour's solution is shifted by half of the difference of the zones, so both stand about the
    // ground.
    EXPECT_EQ(state.zone.first_column + state.zone.n_columns / 2, ground.column) << i;
    EXPECT_EQ(state.zone.n_columns % 2, 0) << i;
    EXPECT_LT(expected.back, half - 2);
    EXPECT_LT(expected.forward, half - 2);
    widest = std::max(widest, state.zone.n_columns);
  }
}

/// Columns of the zone before it is widened: about a disc's contact, or half of the circle's chord below the
/// ground, and two more on either side.
int first_zone(const RollingModel<2>& model) {
  const double half_chord = 0.5 * std::sqrt(2 * model.grid.outer_radius * *model.travel);
  return 2 *
         (static_cast<int>(std::ceil(half_chord / (model.grid.outer_radius * model.grid.column_angle()))) +
          2);
}

// The zone grows by two columns on either side. A hole beside the contact makes it reach one column farther
// on the hole's other side, and that column is just beyond a zone: one side alone asks for a wider one.
TEST(ContactZone, IsWidenedWhenEitherSideTouchesItsEdge) {
  auto model = pressed_model();
  model.n_positions = 1;
  for (const double azimuth : {0.3, 0.7}) {
    int widest = 0;
    expect_whole_contact(model, holes(model.grid, 2, {{0.258, azimuth * model.grid.sector_angle(), 0.042}}),
                         widest);
    EXPECT_EQ(widest, first_zone(model) + 8) << azimuth;
  }
}

TEST(ContactZone, IsWidenedUnderForcesAlongTheGround) {
  auto model = pressed_model();
  model.contact.friction = 0.8;
  for (const double force : {0.4, -0.4}) {
    model.horizontal_force = force * model.load;
    int widest = 0;
    expect_whole_contact(model, holes(model.grid, 2, {{0.27, 0.4, 0.03}}), widest);
    EXPECT_GT(widest, first_zone(model)) << "no zone was widened";
  }
}

}  // namespace
}  // namespace wheelwright
