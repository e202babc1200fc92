#include "wheelwright/optimization/optimizer/convergence.h"

#include <gtest/gtest.h>

namespace wheelwright {
namespace {

constexpr double tolerance = 0.01, violated = 0.1;

int trials_since(const std::vector<AcceptedShape>& history) { return trials_since_gain(history, tolerance); }

TEST(Convergence, CountsTrialsSinceTheObjectiveLastFellByTheTolerance) {
  EXPECT_EQ(trials_since({{100}}), 0);
  EXPECT_EQ(trials_since({{100, 0, 2}, {98, 0, 0}}), 0);
  EXPECT_EQ(trials_since({{100, 0, 2}, {99.5, 0, 0}}), 2);
  EXPECT_EQ(trials_since({{100, 0, 2}, {98, 0, 3}, {97.5, 0, 1}, {97.3, 0, 0}}), 4);
}

TEST(Convergence, AddsSmallGainsUp) {
  EXPECT_EQ(trials_since({{100, 0, 1}, {99.4, 0, 1}, {98.8, 0, 1}, {98.2, 0, 0}}), 1);
}

TEST(Convergence, ComparesWithTheBestShape) {
  EXPECT_EQ(trials_since({{98, 0, 1}, {100, 0, 1}, {98.5, 0, 0}}), 2);
}

TEST(Convergence, CountsGainsOfNegativeObjectives) {
  EXPECT_EQ(trials_since({{-100, 0, 1}, {-100.5, 0, 1}, {-102, 0, 1}, {-102.5, 0, 0}}), 1);
}

TEST(Convergence, CountsOnlyShapesThatKeepTheirBounds) {
  EXPECT_EQ(trials_since({{90, violated, 3}, {100, 0, 0}}), 0);
  EXPECT_EQ(trials_since({{100, 0, 2}, {90, violated, 1}, {99.9, 0, 0}}), 3);
  EXPECT_EQ(trials_since({{100, violated, 2}, {90, violated, 1}, {80, violated, 0}}), 3);
}

}  // namespace
}  // namespace wheelwright
