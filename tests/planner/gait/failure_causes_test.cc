#include "planner/gait/failure_causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "planner/plan/failure_reasons.h"
#include "planner/plan/reason.h"
#include "tests/fixtures/counted_deadline.h"
#include "tests/planner/gait/gait_requests.h"
#include "tests/planner/gait/gait_world.h"

namespace regrasp::gait {
namespace failure_causes_test {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::Not;

/// A finger without range of motion whose fingertip is fixed.
kinematics::Finger FixedFinger(const Vector3d& tip, const Vector3d& axis, double radius) {
  kinematics::Finger finger;
  finger.joints = {{.name = "joint", .offset = tip, .axis = Vector3d::UnitZ()}};
  finger.drives = 1;
  finger.lower = finger.upper = Eigen::VectorXd::Zero(1);
  finger.tip = {.body = "tip", .radius = radius, .axis = axis};
  return finger;
}

/// Fingertips of 10 mm radius whose centres are 80 mm apart.
kinematics::HandModel TwoFixedFingers(const Vector3d& first_axis) {
  kinematics::HandModel hand;
  hand.fingers = {FixedFinger({-0.04, 0, 0}, first_axis, 0.01),
                  FixedFinger({0.04, 0, 0}, -Vector3d::UnitX(), 0.01)};
  return hand;
}

TEST(GripRangeTest, IsTheDistanceBetweenFixedFingertipsThatFaceEachOther) {
  const GripRange range = MeasureGripRange(TwoFixedFingers(Vector3d::UnitX()));
  EXPECT_NEAR(range.smallest, 0.06, 1e-12);
  EXPECT_NEAR(range.largest, 0.06, 1e-12);
  // A fingertip that points away grips nothing.
  EXPECT_EQ(MeasureGripRange(TwoFixedFingers(-Vector3d::UnitX())).largest, 0);
}

/// Its fingers touch each other, and the bases of two opposed fingers are 120 mm apart.
TEST(GripRangeTest, OfARingHandBeginsAtZero) {
  const GripRange range = MeasureGripRange(Ring());
  EXPECT_EQ(range.smallest, 0);
  EXPECT_GT(range.largest, 0.1);
  EXPECT_LT(range.largest, 0.12 + 2 * kinematics::MaximumReach(Ring().fingers[0]));
}

/// Ring hand whose joints have almost no range: its fingers point straight up.
const kinematics::HandModel& OpenRing() {
  static const kinematics::HandModel hand = [] {
    kinematics::HandModel open = Ring();
    for (kinematics::Finger& finger : open.fingers) {
      finger.lower.setConstant(-1e-3);
      finger.upper.setConstant(1e-3);
    }
    return open;
  }();
  return hand;
}

/// Return the message of a search that is expected to fail.
std::string MessageOf(GaitRequest request) {
  request.names_causes = true;
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  return found.message;
}

/// A search that fails because of its small budget.
GaitRequest ShortSearch() {
  GaitRequest request = RequestFor("cube", 0.8, 270);
  request.robustness = RobustnessLevel::kNone;
  request.most_expanded = 3;
  return request;
}

/// Negative control of most causes: the hand reaches this cube and holds it with any three fingers.
TEST(FailureCausesTest, OfASearchThatEndsEarlyIsItsBudgetAlone) {
  const std::string message = MessageOf(ShortSearch());
  EXPECT_THAT(message, testing::ContainsRegex(
                           "; likely cause: search-budget \\(in all searches [1-9][0-9]* stances "
                           "expanded from 1 initial pose, [0-9]"));
  for (const char* other : {"too-heavy", "too-thick", "too-thin", "out-of-reach",
                            "finger-always-required", "contacts-roll-off", "time-limit"}) {
    EXPECT_THAT(message, Not(HasSubstr(other)));
  }
  GaitRequest silent = ShortSearch();
  EXPECT_THAT(FindGait(silent).message, Not(HasSubstr("likely cause")));
}

TEST(FailureCausesTest, NameAnObjectThatIsTooThick) {
  GaitRequest request = ShortSearch();
  request.scale = 10;
  EXPECT_THAT(MessageOf(request), HasSubstr("too-thick (the object is 60 cm wide, two fingertips "
                                            "grip at most "));
}

/// The fingertips of the open hand are 120 mm and 85 mm apart, and their diameter is 20 mm.
TEST(FailureCausesTest, NameAnObjectThatIsTooThin) {
  GaitRequest request = ShortSearch();
  request.hand = &OpenRing();
  request.scale = 0.3;
  EXPECT_THAT(MessageOf(request),
              HasSubstr("too-thin (the object measures 3.12 cm, two fingertips come no closer than "
                        "6.4"));
  request.scale = 1.2;
  EXPECT_THAT(MessageOf(request), Not(HasSubstr("too-thin")));
}

/// An object in the middle of the open hand: all fingers are long enough, but their joints are not
/// free.
TEST(FailureCausesTest, NameFingersThatDoNotReachTheObject) {
  GaitRequest request = ShortSearch();
  request.scale = 0.3;
  request.start_pose = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.08));
  EXPECT_THAT(MessageOf(request), Not(HasSubstr("out-of-reach")));
  request.hand = &OpenRing();
  EXPECT_THAT(MessageOf(request), HasSubstr("out-of-reach (at 0 % of the path 0 of 4 fingers reach "
                                            "the object, finger finger"));
}

TEST(FailureCausesTest, NameFingersThatNeverChangeTheirContact) {
  kinematics::HandModel stiff = Ring();
  stiff.fingers[0].upper =
      stiff.fingers[0].lower + Eigen::VectorXd::Constant(stiff.fingers[0].drives, 1e-3);
  GaitRequest request = ShortSearch();
  request.hand = &stiff;
  EXPECT_THAT(MessageOf(request),
              testing::ContainsRegex("finger-always-required \\(all [0-9]+ grasps are held by "
                                     "finger1 and finger2 and finger3, which therefore keeps"));
}

SearchEvidence EvidenceOf(std::int64_t evaluated, std::int64_t colliding, std::int64_t rolled) {
  SearchEvidence evidence;
  evidence.searches = 1;
  evidence.counts.evaluated = evaluated;
  evidence.counts.colliding = colliding;
  evidence.counts.rolled = rolled;
  return evidence;
}

/// Return the names of the likely causes of a rotation of a cube.
std::vector<std::string> NamesOf(const SearchEvidence& evidence) {
  const GaitRequest request = ShortSearch();
  const GaitWorld world(request);
  std::vector<std::string> names;
  for (const FailureCause& cause : LikelyCauses(world.setup, request, evidence)) {
    names.push_back(cause.name);
  }
  return names;
}

TEST(FailureCausesTest, NameContactsThatRollOff) {
  SearchEvidence evidence = EvidenceOf(40, 0, 20);
  EXPECT_THAT(NamesOf(evidence), testing::ElementsAre("contacts-roll-off"));
  evidence.counts.rolled = 19;
  EXPECT_THAT(NamesOf(evidence), testing::ElementsAre("search-budget"));
  evidence.counts.execution_failures = {{plan::Reason::kSlipped, 3},
                                        {plan::Reason::kContactLost, 1},
                                        {plan::Reason::kHandCollides, 4}};
  EXPECT_THAT(NamesOf(evidence), testing::ElementsAre("contacts-roll-off"));
  evidence.counts.execution_failures[plan::Reason::kHandCollides] = 5;
  EXPECT_THAT(NamesOf(evidence), testing::ElementsAre("search-budget"));
  evidence.unrolled = 1;
  EXPECT_THAT(NamesOf(evidence), testing::ElementsAre("contacts-roll-off"));
}

TEST(FailureCausesTest, NameAThinObjectWhoseGraspsCollide) {
  const GaitRequest thin = [] {
    GaitRequest request = ShortSearch();
    request.scale = 0.2;  // 12 mm
    return request;
  }();
  const SearchEvidence evidence = EvidenceOf(40, 36, 0);
  const GaitWorld thin_world(thin);
  EXPECT_THAT(CausesText(LikelyCauses(thin_world.setup, thin, evidence)),
              "likely cause: too-thin (fingers collide in 36 of 40 grasps, the object is 1.2 cm "
              "wide and a fingertip 2 cm)");
  EXPECT_THAT(NamesOf(evidence), testing::ElementsAre("search-budget"));  // 48 mm
}

/// Every candidate fails in a simulation with prescribed forces.
TEST(FailureCausesTest, NameAnObjectThatIsTooHeavyForTheActuators) {
  const auto message_with = [](double available) {
    GaitRequest request = RequestFor("cube", 0.8, 30);
    request.robustness = RobustnessLevel::kRequired;
    request.most_expanded = 20;
    request.simulate = [](const plan::Plan&, const Deadline&) {
      return planning::ExecutionResult{.is_held = true, .reason = plan::Reason::kObjectMoved};
    };
    request.measure_force = [&](const plan::Plan& plan, int steps) {
      EXPECT_EQ(steps, 1);  // the first step fails
      EXPECT_FALSE(plan.steps.empty());
      return planning::GraspForceNeed{7.15, 9.3, available};
    };
    return MessageOf(request);
  };
  EXPECT_THAT(message_with(6.1),
              HasSubstr("likely cause: too-heavy (a failed grasp requires a force of 9.3 N to "
                        "support a weight of 7.15 N, the actuators exert 6.1 N)"));
  EXPECT_THAT(message_with(9.3), Not(HasSubstr("too-heavy")));
}

TEST(FailureCausesTest, NameTheTimeLimit) {
  GaitRequest request = ShortSearch();
  request.most_expanded = 1000;
  const CountedDeadline counted(4);
  request.deadline = counted.deadline();
  EXPECT_THAT(MessageOf(request), HasSubstr("time-limit ("));
}

TEST(FailureCausesTest, HaveASectionEach) {
  for (const char* name :
       {"too-heavy", "too-thick", "too-thin", "out-of-reach", "finger-always-required",
        "contacts-roll-off", "time-limit", "search-budget"}) {
    const plan::FailureReason* section = plan::FindFailureReason(name);
    ASSERT_NE(section, nullptr) << name;
    EXPECT_EQ(section->check, plan::FailureCheck::kCause);
  }
  EXPECT_EQ(plan::FindFailureReason("too-wide"), nullptr);
}

TEST(FailureCausesTest, AreListedInOneText) {
  EXPECT_EQ(CausesText({}), "");
  EXPECT_EQ(CausesText({{"a", "1"}, {"b", "2"}}), "likely causes: a (1), b (2)");
}

}  // namespace failure_causes_test
}  // namespace regrasp::gait
