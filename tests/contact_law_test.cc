#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "wheelwright/mechanics/contact/contact_responses.h"
#include "wheelwright/mechanics/elasticity/contact_form.h"

namespace wheelwright {
namespace {

constexpr double friction = 0.4;

template <int dim>
double tangential_norm(const Vec<dim>& z) {
  double sum = 0;
  for (int d = 1; d < dim; ++d) sum += z[d] * z[d];
  return std::sqrt(sum);
}

enum class Regime { separated, sticking, sliding };

/// Random augmented tractions, at least 1e-3 away from where the regime changes.
template <int dim>
class Tractions {
 public:
  Vec<dim> draw(Regime regime) {
    while (true) {
      Vec<dim> z;
      for (double& x : z) x = uniform_(random_);
      const double slack = friction * negative_part(z[0]) - tangential_norm<dim>(z);
      if (regime == Regime::separated && z[0] > 1e-3) return z;
      if (regime == Regime::sticking && z[0] < -1e-3 && slack > 1e-3) return z;
      if (regime == Regime::sliding && z[0] < -1e-3 && slack < -1e-3) return z;
    }
  }

  /// Uniform in the tangential ball of this radius; the normal component is zero.
  Vec<dim> draw_tangential(double radius) {
    while (true) {
      Vec<dim> v{};
      for (int d = 1; d < dim; ++d) v[d] = radius * uniform_(random_);
      if (tangential_norm<dim>(v) <= radius) return v;
    }
  }

 private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

template <class Dimension>
class ContactLaw : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ContactLaw, Dimensions);

/// Compares the tangent of a law at z with central differences of its traction.
template <int dim, class Law>
void expect_tangent_is_the_derivative(const Vec<dim>& z, Law law) {
  constexpr double step = 1e-6;
  const auto response = law(z);
  for (int j = 0; j < dim; ++j) {
    Vec<dim> forward = z, backward = z;
    forward[j] += step;
    backward[j] -= step;
    const auto after = law(forward).traction, before = law(backward).traction;
    for (int i = 0; i < dim; ++i)
      EXPECT_NEAR(response.tangent[i][j], (after[i] - before[i]) / (2 * step), 1e-6);
  }
}

TYPED_TEST(ContactLaw, TangentIsTheDerivative) {
  constexpr int dim = TypeParam::value;
  Tractions<dim> tractions;
  for (Regime regime : {Regime::separated, Regime::sticking, Regime::sliding})
    for (double f : {0.0, friction})
      for (int k = 0; k < 50; ++k) {
        const Vec<dim> z = tractions.draw(regime);
        expect_tangent_is_the_derivative<dim>(
            z, [&](const Vec<dim>& at) { return contact_response<dim>(at, f); });
      }
}

// Given friction: the same law where its threshold is the one that Coulomb's law has, and its own derivative.
TYPED_TEST(ContactLaw, GivenFrictionAgreesWithCoulombsAtItsThreshold) {
  constexpr int dim = TypeParam::value;
  Tractions<dim> tractions;
  for (Regime regime : {Regime::separated, Regime::sticking, Regime::sliding})
    for (int k = 0; k < 50; ++k) {
      const Vec<dim> z = tractions.draw(regime);
      const double threshold = friction * negative_part(z[0]);
      const auto response = given_friction_response<dim>(z, threshold);
      const auto coulomb = contact_response<dim>(z, friction).traction;
      for (int i = 0; i < dim; ++i) EXPECT_NEAR(response.traction[i], coulomb[i], 1e-15);
      expect_tangent_is_the_derivative<dim>(
          z, [&](const Vec<dim>& at) { return given_friction_response<dim>(at, threshold); });
    }
}

// What slides everywhere is Coulomb's law where the tangential part is far beyond the threshold.
TYPED_TEST(ContactLaw, SlidingEverywhereIsCoulombsLawFarBeyondItsThreshold) {
  constexpr int dim = TypeParam::value;
  Tractions<dim> tractions;
  for (const Regime regime : {Regime::separated, Regime::sliding}) {
    Vec<dim> z = tractions.draw(regime), along{};
    for (int d = 1; d < dim; ++d) along[d] = z[d] / tangential_norm<dim>(z);
    const auto response = sliding_response<dim>(z, friction, along);
    for (int d = 0; d < dim; ++d)
      EXPECT_NEAR(response.traction[d], contact_response<dim>(z, friction).traction[d], 1e-14);
    expect_tangent_is_the_derivative<dim>(
        z, [&](const Vec<dim>& at) { return sliding_response<dim>(at, friction, along); });
  }
}

TYPED_TEST(ContactLaw, NormalTractionIsTheNegativePart) {
  constexpr int dim = TypeParam::value;
  Tractions<dim> tractions;
  for (Regime regime : {Regime::separated, Regime::sticking, Regime::sliding})
    for (double f : {0.0, friction}) {
      const Vec<dim> z = tractions.draw(regime);
      EXPECT_EQ(contact_response<dim>(z, f).traction[0], std::min(z[0], 0.0));
    }
}

// The projection p of z on the ball is its point with (z - p).(v - p) <= 0 for every v of the ball.
TYPED_TEST(ContactLaw, TangentialTractionIsTheProjectionOnTheFrictionBall) {
  constexpr int dim = TypeParam::value;
  Tractions<dim> tractions;
  for (Regime regime : {Regime::separated, Regime::sticking, Regime::sliding})
    for (int k = 0; k < 50; ++k) {
      const Vec<dim> z = tractions.draw(regime);
      const Vec<dim> traction = contact_response<dim>(z, friction).traction;
      const double radius = friction * negative_part(z[0]);
      EXPECT_LE(tangential_norm<dim>(traction), radius * (1 + 1e-14));
      for (int sample = 0; sample < 20; ++sample) {
        const Vec<dim> v = tractions.draw_tangential(radius);
        double product = 0;
        for (int d = 1; d < dim; ++d) product += (z[d] - traction[d]) * (v[d] - traction[d]);
        EXPECT_LE(product, 1e-14);
      }
    }
}

TYPED_TEST(ContactLaw, IsIdempotentAndHomogeneous) {
  constexpr int dim = TypeParam::value;
  Tractions<dim> tractions;
  for (Regime regime : {Regime::separated, Regime::sticking, Regime::sliding})
    for (int k = 0; k < 50; ++k) {
      const Vec<dim> z = tractions.draw(regime);
      const Vec<dim> once = contact_response<dim>(z, friction).traction;
      const Vec<dim> twice = contact_response<dim>(once, friction).traction;
      Vec<dim> scaled = z;
      for (double& x : scaled) x *= 1e6;
      scaled = contact_response<dim>(scaled, friction).traction;
      for (int d = 0; d < dim; ++d) {
        EXPECT_NEAR(twice[d], once[d], 1e-15);
        EXPECT_NEAR(scaled[d], 1e6 * once[d], 1e-9);
      }
    }
}

TYPED_TEST(ContactLaw, WithoutFrictionThereIsNoTangentialTraction) {
  constexpr int dim = TypeParam::value;
  Tractions<dim> tractions;
  for (Regime regime : {Regime::separated, Regime::sticking, Regime::sliding}) {
    const auto response = contact_response<dim>(tractions.draw(regime), 0);
    for (int i = 1; i < dim; ++i) {
      EXPECT_EQ(response.traction[i], 0);
      for (int j = 0; j < dim; ++j) EXPECT_EQ(response.tangent[i][j], 0);
    }
  }
}

TEST(ContactForm, PenaltyIsNitscheWithoutStress) {
  const ContactForm nitsche{ContactMethod::nitsche, 1, 1, 0}, penalty{ContactMethod::penalty, 1, 1, 0};
  EXPECT_EQ(nitsche.tau(), 1);
  EXPECT_EQ(nitsche.theta(), 1);
  EXPECT_EQ(penalty.tau(), 0);
  EXPECT_EQ(penalty.theta(), 0);
}

}  // namespace
}  // namespace wheelwright
