// Contact laws of a program's own, in the contact problem of a wheel.

#include <gtest/gtest.h>

#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_responses.h"

namespace wheelwright {
namespace {

/// Coulomb's law, of which the solver knows nothing but tractions and tangents.
class OwnFriction : public ContactLaw<2> {
 public:
  explicit OwnFriction(double friction) : friction_(friction) {}
  ContactResponse<2> response(int, const Vec<2>& z) const override {
    return contact_response<2>(z, friction_);
  }
  bool is_tangential() const override { return true; }

 private:
  double friction_;
};

/// A ground that yields: the traction is a fraction of what unyielding ground would exert.
class YieldingGround : public ContactLaw<2> {
 public:
  explicit YieldingGround(double fraction) : fraction_(fraction) {}
  ContactResponse<2> response(int, const Vec<2>& z) const override {
    ContactResponse<2> r{};
    if (z[0] >= 0) return r;
    r.traction[0] = fraction_ * z[0];
    r.tangent[0][0] = fraction_;
    return r;
  }
  bool is_tangential() const override { return false; }

 private:
  double fraction_;
};

/// A ground that is soft at first: the pressure for p = -z_n is p^2 / (p + p_0), with friction that does not
/// reach its limit.
class SoftGround : public ContactLaw<2> {
 public:
  explicit SoftGround(double p_0) : p_0_(p_0) {}
  ContactResponse<2> response(int, const Vec<2>& z) const override {
    ContactResponse<2> r{};
    if (z[0] >= 0) return r;
    const double p = -z[0], hard = p / (p + p_0_), by_p = p_0_ / ((p + p_0_) * (p + p_0_));
    r.traction = {-p * hard, z[1] * hard};
    r.tangent[0][0] = hard + p * by_p;
    r.tangent[1][0] = -z[1] * by_p;
    r.tangent[1][1] = hard;
    return r;
  }
  bool is_tangential() const override { return true; }

 private:
  double p_0_;
};

RollingModel<2> wheel() {
  RollingModel<2> model = testing::paper_model(14, 192);
  model.n_positions = 3;
  return model;
}

RollingModel<2> penalty_wheel(double gamma_0) {
  RollingModel<2> model = wheel();
  model.contact.method = ContactMethod::penalty;
  model.contact.gamma_0 = gamma_0;
  return model;
}

void expect_the_same(const RollingModel<2>& a, const RollingModel<2>& b) {
  std::vector<Evaluation<2>> evaluations;
  for (const auto& model : {a, b}) {
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    auto evaluation = testing::evaluate_objective<2>(*problem, testing::strain_energy_alone(),
                                                     testing::generic_hole(model.grid));
    ASSERT_TRUE(evaluation) << evaluation.failure().detail;
    evaluations.push_back(*std::move(evaluation));
  }
  const FunctionValue &one = evaluations[0].functions[0], &other = evaluations[1].functions[0];
  EXPECT_NEAR(one.value, other.value, 1e-10 * other.value);
  EXPECT_LT(testing::relative_difference(one.gradient, other.gradient), 1e-8);
}

TEST(OwnContactLaw, GivesWhatTheBuiltInLawOfTheSameFrictionGives) {
  RollingModel<2> built_in = wheel(), own = wheel();
  built_in.contact.friction = 0.3;
  own.contact_law = std::make_shared<OwnFriction>(0.3);
  expect_the_same(own, built_in);
}

TEST(OwnContactLaw, YieldingGroundIsAPenaltyOfAnotherParameter) {
  RollingModel<2> own = penalty_wheel(20);
  own.contact_law = std::make_shared<YieldingGround>(0.4);
  expect_the_same(own, penalty_wheel(8));
}

TEST(OwnContactLaw, TheTangentOfTheTestIsThatOfDifferences) {
  const SoftGround law(2e5);
  for (const Vec<2>& z : {Vec<2>{-3e5, 1e5}, Vec<2>{-1e4, -2e5}, Vec<2>{1e5, 1e5}}) {
    const auto response = law.response(0, z);
    constexpr double h = 1;
    for (int j = 0; j < 2; ++j) {
      Vec<2> more = z, less = z;
      more[j] += h;
      less[j] -= h;
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR((law.response(0, more).traction[i] - law.response(0, less).traction[i]) / (2 * h),
                    response.tangent[i][j], 1e-8);
    }
  }
}

TEST(OwnContactLaw, TheShapeGradientIsExact) {
  RollingModel<2> model = penalty_wheel(20);
  model.contact_law = std::make_shared<SoftGround>(1e6);
  for (const double torque : {0.0, 200.0}) {
    model.torque = torque;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto test = testing::generic_taylor_test(*problem, testing::strain_energy_alone());
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders) EXPECT_GT(order, 1.9);
  }
}

TEST(OwnContactLaw, SoftGroundLetsTheWheelSink) {
  std::vector<double> travels;
  for (const double p_0 : {1e3, 1e6}) {
    RollingModel<2> model = penalty_wheel(20);
    model.contact_law = std::make_shared<SoftGround>(p_0);
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto state = testing::all_states<2>(*problem, testing::generic_hole(model.grid));
    ASSERT_TRUE(state) << state.failure().detail;
    const ContactPatch<2>& patch = (*state)->contacts()[0];
    double force = 0;
    for (const auto& point : patch.points) force -= point.weight * point.traction[0];
    EXPECT_NEAR(force, model.load, 1e-8 * model.load);
    travels.push_back(patch.rim.towards_ground);
  }
  EXPECT_GT(travels[1], travels[0]);
}

}  // namespace
}  // namespace wheelwright
