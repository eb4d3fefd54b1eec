#include "planner/criteria/grasp_evaluator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::criteria {
namespace grasp_evaluator_test {

/// Return contacts on bottom and top, at shares of the unit square's width.
grasp::Grasp Across(const object::Polygon& square, double bottom, double top) {
  return {{{bottom, 0, 0}, square.inward_normal(FaceIndex(0)), FaceIndex(0)},
          {{top, 1, 0}, square.inward_normal(FaceIndex(2)), FaceIndex(2)}};
}

TEST(GraspEvaluator, ScoresGoodGraspsByTheirMargin) {
  const object::Polygon square = Square(1);
  const GraspEvaluator evaluator(square, {Radians(30), 0.01});
  EXPECT_TRUE(evaluator.IsGood(Across(square, 0.5, 0.5)));
  EXPECT_NEAR(evaluator.Score(Across(square, 0.5, 0.5)), Radians(30), 1e-4);
  EXPECT_NEAR(evaluator.Score(Across(square, 0.4, 0.6)), Radians(30) - std::atan(0.2), 1e-4);
}

TEST(GraspEvaluator, ScoresGraspsBelowTheQualityNegativelyByTheirQuality) {
  const object::Polygon square = Square(1);
  const GraspEvaluator evaluator(square, {Radians(30), 0.01});
  // tan 30° = 0.577.
  const grasp::Grasp weak = Across(square, 0.22, 0.79);
  const grasp::Grasp weaker = Across(square, 0.22, 0.796);
  EXPECT_FALSE(evaluator.IsGood(weak));
  EXPECT_LT(evaluator.Score(weak), 0);
  EXPECT_LT(evaluator.Score(weaker), evaluator.Score(weak));
  EXPECT_GT(evaluator.Score(weaker), -1);
  const grasp::Grasp open = Across(square, 0.2, 0.8);
  EXPECT_FALSE(evaluator.IsGood(open));
  EXPECT_EQ(evaluator.Score(open), -1);
  // Without a required quality the weak grasp is good.
  EXPECT_TRUE(GraspEvaluator(square, {Radians(30), 0}).IsGood(weak));
  EXPECT_GT(GraspEvaluator(square, {Radians(30), 0}).Score(weak), 0);
}

TEST(GraspEvaluator, TwoContactsAtOnePointAreNoGrasp) {
  const object::Polygon square = Square(1);
  const GraspEvaluator evaluator(square, {Radians(30), 0.01});
  grasp::Grasp grasp = Across(square, 0.5, 0.5);
  grasp.push_back(Across(square, 0.5 + 1e-7, 0.5)[0]);
  EXPECT_FALSE(evaluator.IsGood(grasp));
  EXPECT_EQ(evaluator.Score(grasp), -1);
  grasp.back() = Across(square, 0.5 + 1e-5, 0.5)[0];
  EXPECT_TRUE(evaluator.IsGood(grasp));
}

TEST(GraspEvaluator, FingersOfARadiusNeedClearance) {
  const object::Polygon square = Square(2);
  const grasp::Grasp grasp = {{{0.6, 0, 0}, square.inward_normal(FaceIndex(0)), FaceIndex(0)},
                              {{1.4, 0, 0}, square.inward_normal(FaceIndex(0)), FaceIndex(0)},
                              {{1, 2, 0}, square.inward_normal(FaceIndex(2)), FaceIndex(2)}};
  EXPECT_TRUE(GraspEvaluator(square, {Radians(30), 0.01}).IsReachable(grasp));
  EXPECT_TRUE(
      GraspEvaluator(square, {Radians(30), 0.01}, {.fingertip_radius = 0.39}).IsReachable(grasp));
  EXPECT_FALSE(
      GraspEvaluator(square, {Radians(30), 0.01}, {.fingertip_radius = 0.41}).IsReachable(grasp));
  EXPECT_LT(GraspEvaluator(square, {Radians(30), 0.01}, {.fingertip_radius = 0.41}).Score(grasp),
            0);
  EXPECT_GE(GraspEvaluator(square, {Radians(30), 0.01}, {.fingertip_radius = 0.39}).Score(grasp),
            0);
}

TEST(GraspEvaluator, RemembersTheScoreOfEachGraspApart) {
  const object::Polygon square = Square(1);
  const GraspEvaluator evaluator(square, {Radians(30), 0.01});
  const double first = evaluator.Score(Across(square, 0.5, 0.5));
  const double second = evaluator.Score(Across(square, 0.4, 0.6));
  EXPECT_GT(first, second);
  EXPECT_EQ(evaluator.Score(Across(square, 0.5, 0.5)), first);
  EXPECT_EQ(evaluator.Score(Across(square, 0.4, 0.6)), second);
}

TEST(GraspEvaluator, KnowsAGraspInWhateverOrderItsContactsCome) {
  const object::Polygon square = Square(1);
  const GraspEvaluator evaluator(square, {Radians(30), 0.01});
  const grasp::Grasp grasp = Across(square, 0.4, 0.6);
  const double score = evaluator.Score(grasp);
  const auto tested = evaluator.counts().force_closure;
  EXPECT_EQ(evaluator.Score({grasp[1], grasp[0]}), score);
  EXPECT_EQ(evaluator.counts().force_closure, tested);
  EXPECT_NEAR(evaluator.Score(Across(square, 0.6, 0.4)), score, 1e-9);
  EXPECT_GT(evaluator.counts().force_closure, tested);
}

TEST(GraspEvaluator, OnlyGoodGraspsHaveAMargin) {
  const object::Polygon square = Square(1);
  const GraspEvaluator evaluator(square, {Radians(30), 0.01});
  const grasp::Grasp good = Across(square, 0.4, 0.6);
  EXPECT_EQ(evaluator.Margin(good), evaluator.Score(good));
  EXPECT_EQ(evaluator.Margin(Across(square, 0.22, 0.79)), std::nullopt);  // insufficient quality
  EXPECT_EQ(evaluator.Margin(Across(square, 0.2, 0.8)), std::nullopt);    // not force closure
}

}  // namespace grasp_evaluator_test
}  // namespace regrasp::criteria
