#include "planner/criteria/grasp_evaluator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/object/polygon.h"
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

namespace grasp_memory_test {

constexpr int kSteps = 8;

object::Polygon UnitSquare() {
  return object::Polygon::FromRings({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, "square");
}

/// Return contacts at kSteps positions on the bottom of the unit square, then as many on its top.
std::vector<grasp::Contact> BottomAndTop(const object::Polygon& square) {
  std::vector<grasp::Contact> contacts;
  for (const FaceIndex face : {FaceIndex(0), FaceIndex(2)}) {
    for (int i = 1; i <= kSteps; ++i) {
      const Eigen::Vector3d p(i / (kSteps + 1.0), face == 0 ? 0 : 1, 0);
      contacts.push_back({p, square.inward_normal(face), face});
    }
  }
  return contacts;
}

class GraspMemoryTest : public testing::Test {
 protected:
  [[nodiscard]] GraspMemory Memory(double degrees, double min_quality, const hand::Hand& hand = {},
                                   QualityTest quality = QualityTest::kExact) const {
    GraspMemory memory(square_, {Radians(degrees), min_quality}, hand, quality);
    memory.Append(contacts_);
    return memory;
  }
  /// Return all pairs of contacts, including pairs on one face or at one point.
  [[nodiscard]] std::vector<ContactSet> Pairs() const {
    std::vector<ContactSet> pairs;
    for (int a = 0; a < static_cast<int>(contacts_.size()); ++a) {
      for (int b = 0; b < a; ++b) pairs.push_back(ContactSet().With(a).With(b));
    }
    return pairs;
  }
  [[nodiscard]] bool IsGood(const ContactSet& pair, double degrees, double min_quality) const {
    const grasp::Grasp grasp = {contacts_[pair[0]], contacts_[pair[1]]};
    const object::WrenchFrame frame = square_.wrench_frame();
    return grasp::IsForceClosure(grasp, frame, Radians(degrees)) &&
           grasp::QualityAtLeast(grasp, frame, Radians(degrees), min_quality);
  }

  const object::Polygon square_ = UnitSquare();
  const std::vector<grasp::Contact> contacts_ = BottomAndTop(square_);
};

TEST_F(GraspMemoryTest, AdmitsWhatMeetsTheCriteriaAndTestsEachGraspOnce) {
  GraspMemory memory = Memory(20, 0.05);
  int good = 0;
  int weak = 0;
  for (int round = 0; round < 2; ++round) {
    for (const ContactSet& pair : Pairs()) {
      const bool expected = IsGood(pair, 20, 0.05);
      EXPECT_EQ(memory.Admits(pair), expected);
      EXPECT_EQ(memory.IsAdmitted(memory.GraspOf(pair)), expected);
      good += expected ? 1 : 0;
      weak += !expected && IsGood(pair, 20, 0) ? 1 : 0;
    }
  }
  EXPECT_GT(good, 10);
  EXPECT_GT(weak, 3);
  // Each grasp is tested once by its numbers, and in both rounds without numbers.
  EXPECT_EQ(memory.counts().force_closure, 3 * std::ssize(Pairs()));
}

TEST_F(GraspMemoryTest, KnowsAtOneFrictionAndQualityWhatItSawAtOthers) {
  GraspMemory memory = Memory(20, 0.05);
  for (const ContactSet& pair : Pairs()) (void)memory.Admits(pair);
  const auto tests = memory.counts().force_closure;
  const auto criteria = memory.counts().criteria;
  // Lower quality: force closure is known, and without a required quality there is no other test.
  memory.SetShare(0);
  for (const ContactSet& pair : Pairs()) EXPECT_EQ(memory.Admits(pair), IsGood(pair, 20, 0));
  EXPECT_EQ(memory.counts().force_closure, tests);
  EXPECT_EQ(memory.counts().criteria, criteria);
  // More friction: only grasps that were not force closure are tested.
  memory.SetFrictionAngle(Radians(30));
  int more = 0;
  for (const ContactSet& pair : Pairs()) {
    EXPECT_EQ(memory.Admits(pair), IsGood(pair, 30, 0));
    more += IsGood(pair, 20, 0) ? 0 : 1;
  }
  EXPECT_EQ(memory.counts().force_closure, tests + more);
  // Back to the initial friction.
  memory.SetFrictionAngle(Radians(20));
  for (const ContactSet& pair : Pairs()) EXPECT_EQ(memory.Admits(pair), IsGood(pair, 20, 0));
  EXPECT_EQ(memory.counts().force_closure, tests + more);
}

TEST_F(GraspMemoryTest, AcceptsTheEndsOfASequenceWhateverTheyAreWorth) {
  GraspMemory memory = Memory(20, 0.05);
  const ContactSet bottom = ContactSet().With(0).With(1);
  EXPECT_FALSE(memory.Admits(bottom));
  memory.Accept(bottom);
  EXPECT_TRUE(memory.Admits(bottom));
  memory.SetShare(20);
  EXPECT_TRUE(memory.Admits(bottom));
}

TEST_F(GraspMemoryTest, AdmitsNoGraspWhoseFingersOverlap) {
  const double step = 1 / (kSteps + 1.0);
  // Two contacts on the bottom, and one on the top between them.
  const ContactSet triple = ContactSet().With(3).With(4).With(kSteps + 3);
  EXPECT_TRUE(Memory(20, 0, {.fingertip_radius = 0.49 * step}).Admits(triple));
  GraspMemory thick = Memory(20, 0, {.fingertip_radius = 0.51 * step});
  EXPECT_FALSE(thick.Admits(triple));
  EXPECT_FALSE(thick.IsAdmitted(thick.GraspOf(triple)));
  EXPECT_FALSE(thick.CanMeet(3, 4));
  EXPECT_TRUE(thick.CanMeet(3, 5));
}

TEST_F(GraspMemoryTest, TheQuickTestAdmitsNothingThatTheExactOneDoesNot) {
  GraspMemory exact = Memory(20, 0.05);
  GraspMemory quick = Memory(20, 0.05, {}, QualityTest::kQuick);
  int both = 0;
  for (const ContactSet& pair : Pairs()) {
    if (!quick.Admits(pair)) continue;
    EXPECT_TRUE(exact.Admits(pair));
    ++both;
  }
  EXPECT_GT(both, 10);
}

TEST_F(GraspMemoryTest, ToldContactsAgainHaveTheirOldNumbers) {
  GraspMemory memory = Memory(20, 0);
  EXPECT_EQ(memory.Add(contacts_[5]), 5);
  grasp::Contact other = contacts_[5];
  other.p.x() += 1e-3;
  EXPECT_EQ(memory.Add(other), std::ssize(contacts_));
  EXPECT_EQ(memory.count(), std::ssize(contacts_) + 1);
}

TEST_F(GraspMemoryTest, RequiredHalfAngleIsTheAngleOfTheLineBetweenTwoContacts) {
  GraspMemory memory = Memory(20, 0);
  const double lean = 2 / (kSteps + 1.0);
  const ContactSet pair = ContactSet().With(2).With(kSteps + 4);
  EXPECT_NEAR(memory.RequiredFrictionAngle(pair), std::atan(lean), 2e-5);
  EXPECT_THROW(Memory(90, 0), std::invalid_argument);
}

}  // namespace grasp_memory_test
}  // namespace regrasp::criteria
