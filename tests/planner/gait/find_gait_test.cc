#include "planner/gait/find_gait.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/gait/gait_planner.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/gait/request.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "tests/fixtures/solids.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace find_gait_test {

using Eigen::Vector3d;

Eigen::Isometry3d LastPose(const Gait& gait) {
  return gait.segments.empty() ? gait.start.pose : gait.segments.back().path.back().pose;
}

/// Without margins a rotation may begin at any angle: forward and backward paths are joined.
class TurnTest : public testing::TestWithParam<RobustnessLevel> {};

INSTANTIATE_TEST_SUITE_P(RobustnessLevels, TurnTest,
                         testing::Values(RobustnessLevel::kNone, RobustnessLevel::kPreferred),
                         [](const auto& info) {
                           return info.param == RobustnessLevel::kNone ? "None" : "Preferred";
                         });

TEST_P(TurnTest, TheObjectRotatesByTheRequiredAngleInPlace) {
  const RobustnessLevel robustness = GetParam();
  for (const double degrees : {60.0, -60.0, 270.0}) {
    GaitRequest request = RequestFor("cube", 0.8, degrees);
    request.robustness = robustness;
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    const Eigen::Isometry3d last = LastPose(*found.gait);
    const Eigen::Matrix3d rotated = found.gait->start.pose.linear().transpose() * last.linear();
    const Eigen::Matrix3d required =
        Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_LT((rotated - required).norm(), 1e-12);
    const Vector3d centre = request.scale * request.solid->mass_properties().centroid;
    EXPECT_LT((last * centre - found.gait->start.pose * centre).norm(), 0.03);
  }
}

TEST_P(TurnTest, SegmentsAreContinuousAndFingertipsStayOnTheirContacts) {
  GaitRequest request = RequestFor("prism", 0.5, 150);
  request.robustness = GetParam();
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  ContactAssignment assignment = found.gait->initial;
  const Keyframe* last = &found.gait->start;
  int tips = 0;
  for (const PlanSegment& segment : found.gait->segments) {
    EXPECT_EQ(segment.path.front().pose.matrix(), last->pose.matrix());
    EXPECT_EQ(segment.path.front().configurations, last->configurations);
    const bool changes =
        segment.kind == PlanSegment::Kind::kPlace || segment.kind == PlanSegment::Kind::kRelease;
    if (changes) assignment[segment.finger] = kNone;
    for (const PlanSegment::Slid& slid : segment.slid) assignment[slid.finger] = kNone;
    for (const Keyframe& frame : segment.path) {
      for (FingerIndex finger{0}; finger < std::ssize(assignment); ++finger) {
        if (assignment[finger] == kNone) continue;
        const kinematics::Finger& chain = Ring().fingers[finger];
        const grasp::Contact& contact = found.contacts[assignment[finger]];
        const Vector3d ball =
            frame.pose * (request.scale * contact.p - chain.tip.radius * contact.n);
        EXPECT_LT((kinematics::TipAt(chain, frame.configurations[finger]).centre - ball).norm(),
                  1e-8);
        ++tips;
      }
    }
    if (segment.kind == PlanSegment::Kind::kPlace) assignment[segment.finger] = segment.contact;
    for (const PlanSegment::Slid& slid : segment.slid) assignment[slid.finger] = slid.to;
    last = &segment.path.back();
  }
  EXPECT_GT(tips, 100);
}

/// Consecutive motions are merged.
TEST_P(TurnTest, NoMotionFollowsAnother) {
  int moves = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    GaitRequest request = RequestFor("l_block", 0.7, 180);
    request.seed = seed;
    request.robustness = GetParam();
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    bool was_move = false;
    for (const PlanSegment& segment : found.gait->segments) {
      const bool is_move = segment.kind == PlanSegment::Kind::kMove;
      EXPECT_FALSE(is_move && was_move);
      was_move = is_move;
      moves += static_cast<int>(is_move);
    }
  }
  EXPECT_GT(moves, 4);
}

TEST(FindGaitTest, PlansPassTheChecker) {
  for (const char* model : {"cube", "l_block"}) {
    const GaitRequest request = RequestFor(model, 0.8, 120);
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << model << ": " << found.message;
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    const plan::PlanCheck check = plan::CheckPlan(*request.solid, plan);
    for (const plan::StepCheck& step : check.steps) {
      EXPECT_EQ(step.reason, plan::Reason::kNone) << model << " " << step.index << step.detail;
    }
  }
}

/// Contacts before segment number `end`.
grasp::Grasp GraspBefore(const GaitResult& found, std::size_t end) {
  ContactAssignment assignment = found.gait->initial;
  for (std::size_t i = 0; i < end; ++i) {
    const PlanSegment& segment = found.gait->segments[i];
    if (segment.kind == PlanSegment::Kind::kPlace) assignment[segment.finger] = segment.contact;
    if (segment.kind == PlanSegment::Kind::kRelease) assignment[segment.finger] = kNone;
    for (const PlanSegment::Slid& slid : segment.slid) assignment[slid.finger] = slid.to;
  }
  grasp::Grasp grasp;
  for (const int contact : assignment) {
    if (contact != kNone) grasp.push_back(found.contacts[contact]);
  }
  return grasp;
}

grasp::Grasp LastGrasp(const GaitResult& found) {
  return GraspBefore(found, found.gait->segments.size());
}

grasp::Grasp FirstGrasp(const GaitResult& found) { return GraspBefore(found, 0); }

/// A given grasp whose quality is too low is rejected before the search.
TEST(FindGaitTest, ANonRobustStartGraspIsReported) {
  const GaitRequest turn = RequestFor("cube", 0.8, 30);
  const GaitResult rotated = FindGait(turn);
  ASSERT_TRUE(rotated.gait) << rotated.message;
  GaitRequest request = turn;
  request.start_grasp = FirstGrasp(rotated);
  // Friction just above the requirement of the grasp.
  const auto needed =
      grasp::ComputeRequiredFrictionAngle(request.start_grasp, request.solid->wrench_frame());
  ASSERT_TRUE(needed);
  request.criteria.friction_angle = 1.05 * needed->upper;
  request.robustness = RobustnessLevel::kRequired;
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  EXPECT_THAT(found.message, testing::HasSubstr("the start grasp has no robustness margin"));
}

/// Fingers exert little torque about the axis of a rod. At low friction, some of its grasps do not
/// have the quality that a robust gait requires of a compact object (at least 0.02).
TEST(FindGaitTest, ARobustGaitRequiresLessQualityOfASlenderObject) {
  const object::Polyhedron rod = MakeBox({0.012, 0.012, 0.14});
  GaitRequest request = RequestFor("cube", 1, 60);
  request.solid = &rod;
  request.turn.axis = Eigen::Vector3d::UnitX();
  request.criteria.friction_angle = std::atan(0.2);
  request.robustness = RobustnessLevel::kRequired;
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  double least = 1;
  for (std::size_t i = 0; i <= found.gait->segments.size(); ++i) {
    least = std::min(least, grasp::BoundQuality(GraspBefore(found, i), rod.wrench_frame(),
                                                request.criteria.friction_angle)
                                .upper);
  }
  EXPECT_GT(least, 0.005);
  EXPECT_LT(least, 0.02);
}

TEST_P(TurnTest, EqualRequestsGiveEqualGaits) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  request.robustness = GetParam();
  const GaitResult first = FindGait(request);
  const GaitResult second = FindGait(request);
  ASSERT_TRUE(first.gait && second.gait);
  ASSERT_EQ(first.gait->segments.size(), second.gait->segments.size());
  for (std::size_t i = 0; i < first.gait->segments.size(); ++i) {
    const auto& a = first.gait->segments[i].path;
    const auto& b = second.gait->segments[i].path;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].configurations, b[k].configurations);
  }
}

std::vector<std::vector<double>> Sorted(const grasp::Grasp& grasp) {
  std::vector<std::vector<double>> points;
  for (const grasp::Contact& contact : grasp) {
    points.push_back({contact.p.x(), contact.p.y(), contact.p.z()});
  }
  std::ranges::sort(points);
  return points;
}

/// Poses and grasps of a first gait become requirements of a second one, in both directions.
TEST(FindGaitTest, GivenPosesAndGraspsAreKept) {
  const GaitRequest turn = RequestFor("cube", 0.5, 90);
  const GaitResult rotated = FindGait(turn);
  ASSERT_TRUE(rotated.gait) << rotated.message;
  for (const bool is_backward : {false, true}) {
    GaitRequest request = RequestFor("cube", 0.5, 0);
    Eigen::Isometry3d start = rotated.gait->start.pose;
    Eigen::Isometry3d goal = LastPose(*rotated.gait);
    if (is_backward) std::swap(start, goal);
    request.start_pose = start;
    request.goal.emplace(goal);
    request.start_grasp = FirstGrasp(rotated);
    request.goal_grasp = LastGrasp(rotated);
    if (is_backward) {
      std::swap(request.start_grasp, request.goal_grasp);
    }
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    EXPECT_EQ(found.gait->start.pose.matrix(), request.start_pose->matrix());
    EXPECT_LT((LastPose(*found.gait).matrix() - goal.matrix()).norm(), 1e-12);
    EXPECT_EQ(Sorted(FirstGrasp(found)), Sorted(request.start_grasp));
    EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
  }
}

/// Two independent grasps at the same pose.
GaitRequest PairAtOnePose(std::uint64_t seed) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  request.seed = seed;
  const GaitResult first = FindGait(request);
  EXPECT_TRUE(first.gait) << first.message;
  request.start_pose = first.gait->start.pose;
  request.seed = seed + 1000;
  const GaitResult second = FindGait(request);
  EXPECT_TRUE(second.gait) << second.message;
  request.goal.emplace(*request.start_pose);
  request.start_grasp = FirstGrasp(first);
  request.goal_grasp = FirstGrasp(second);
  return request;
}

/// All fingers of this hand are alike, so each may hold each contact.
TEST(FindGaitTest, StartsWithTheRequiredFingers) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  const GaitResult first = FindGait(request);
  ASSERT_TRUE(first.gait) << first.message;
  request.start_pose = first.gait->start.pose;
  request.turn = {Eigen::Vector3d::UnitZ(), 0.3};
  request.start_grasp = FirstGrasp(first);
  for (FingerIndex finger{0}; finger < std::ssize(first.gait->initial); ++finger) {
    if (first.gait->initial[finger] != kNone) request.start_fingers.push_back(finger);
  }
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  for (std::size_t i = 0; i < request.start_fingers.size(); ++i) {
    const int contact = found.gait->initial[request.start_fingers[i]];
    ASSERT_NE(contact, kNone);
    EXPECT_EQ(found.contacts[contact].p, request.start_grasp[i].p);
  }
  // With swapped fingers none reaches its contact.
  std::swap(request.start_fingers[0], request.start_fingers[1]);
  EXPECT_FALSE(FindGait(request).gait);
  request.start_fingers.pop_back();
  EXPECT_THROW((void)FindGait(request), std::invalid_argument);
}

TEST(FindGaitTest, EndsWithTheRequiredFingers) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  const GaitResult first = FindGait(request);
  ASSERT_TRUE(first.gait) << first.message;
  request.start_pose = first.gait->start.pose;
  request.turn = {};
  request.goal.emplace(first.gait->start.pose);
  request.goal_grasp = FirstGrasp(first);
  for (FingerIndex finger{0}; finger < std::ssize(first.gait->initial); ++finger) {
    if (first.gait->initial[finger] != kNone) request.goal_fingers.push_back(finger);
  }
  EXPECT_TRUE(FindGait(request).gait);
  // With swapped fingers none reaches its contact.
  std::swap(request.goal_fingers[0], request.goal_fingers[1]);
  EXPECT_FALSE(FindGait(request).gait);
  request.goal_fingers.pop_back();
  EXPECT_THROW((void)FindGait(request), std::invalid_argument);
}

TEST(FindGaitTest, HoldingFingersSlideAlongTheSurface) {
  int slides = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const GaitRequest request = PairAtOnePose(seed);
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << seed << found.message;
    EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
    for (const PlanSegment& segment : found.gait->segments) {
      if (segment.kind != PlanSegment::Kind::kSlide) continue;
      ASSERT_EQ(segment.waypoints.size(), segment.waypoint_frames.size());
      EXPECT_EQ(segment.waypoint_frames.back() + 1, std::ssize(segment.path));
      for (std::size_t i = 0; i < segment.slid.size(); ++i) {
        const auto& [finger, from, to] = segment.slid[i];
        ++slides;
        EXPECT_EQ(segment.waypoints.front()[i].p, found.contacts[from].p);
        EXPECT_EQ(segment.waypoints.back()[i].p, found.contacts[to].p);
        const kinematics::Finger& chain = Ring().fingers[finger];
        for (const Keyframe& frame : segment.path) {
          // The fingertip sphere touches the surface of the cube.
          const Vector3d centre =
              frame.pose.inverse() * kinematics::TipAt(chain, frame.configurations[finger]).centre;
          const Vector3d outside = (centre.cwiseAbs().array() - 0.8 * 0.03).max(0.0);
          EXPECT_NEAR(outside.norm(), chain.tip.radius, 1e-8);
        }
      }
    }
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
  }
  EXPECT_GT(slides, 0);
}

/// A start grasp and a goal grasp whose contacts are 1.2 mm apart (0.0015 cube units), at one pose.
GaitRequest PairOneSlideApart(RobustnessLevel robustness) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  request.robustness = robustness;
  const GaitResult first = FindGait(request);
  EXPECT_TRUE(first.gait) << first.message;
  request.start_pose = first.gait->start.pose;
  request.goal.emplace(*request.start_pose);
  request.start_grasp = request.goal_grasp = FirstGrasp(first);
  for (grasp::Contact& contact : request.goal_grasp) {
    contact.p += 0.0015 * contact.n.unitOrthogonal();
  }
  return request;
}

/// Fingers slide simultaneously to a nearby grasp.
TEST(FindGaitTest, FingersSlideSimultaneously) {
  const GaitRequest request =
      PairOneSlideApart(RobustnessLevel::kNone);  // with margins no finger slides
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  ASSERT_EQ(found.gait->segments.size(), 1u);
  EXPECT_EQ(found.gait->segments[0].slid.size(), 3u);
  EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
  const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
  EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
}

/// A grasp one sliding step away does not justify ten finger switches.
TEST(FindGaitTest, PreferredRobustnessDoesNotMakeAGaitMuchLonger) {
  GaitRequest request = PairOneSlideApart(RobustnessLevel::kRequired);
  const GaitResult with = FindGait(request);
  ASSERT_TRUE(with.gait) << with.message;
  EXPECT_GT(with.gait->segments.size(), 15u);
  request.robustness = RobustnessLevel::kPreferred;
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_EQ(found.gait->segments.size(), 1u);
}

TEST(FindGaitTest, AGivenGraspDeterminesTheInitialPose) {
  const GaitResult rotated = FindGait(RequestFor("prism", 0.5, 30));
  ASSERT_TRUE(rotated.gait) << rotated.message;
  GaitRequest request = RequestFor("prism", 0.5, 30);
  request.start_grasp = FirstGrasp(rotated);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_EQ(Sorted(FirstGrasp(found)), Sorted(request.start_grasp));
  EXPECT_NE(found.gait->start.pose.matrix(), rotated.gait->start.pose.matrix());
}

/// A pose with a grasp of three fingers, and the same grasp with a fourth one.
struct ThreeAndFour {
  GaitRequest request;
  grasp::Grasp three;
  grasp::Grasp four;
};

ThreeAndFour FindThreeAndFour() {
  ThreeAndFour found{RequestFor("cube", 0.8, 0), {}, {}};
  GaitRequest turn = RequestFor("cube", 0.8, 150);
  for (turn.seed = 1; turn.seed < 20; ++turn.seed) {
    const GaitResult rotated = FindGait(turn);
    EXPECT_TRUE(rotated.gait) << rotated.message;
    if (!rotated.gait) break;
    const std::vector<PlanSegment>& segments = rotated.gait->segments;
    // Some gaits place no finger.
    const auto placement =
        std::ranges::find(segments, PlanSegment::Kind::kPlace, &PlanSegment::kind);
    if (placement == segments.end()) continue;
    found.request.start_pose = placement->path.back().pose;
    found.request.goal.emplace(*found.request.start_pose);
    found.three = GraspBefore(rotated, placement - segments.begin());
    found.four = found.three;
    found.four.push_back(rotated.contacts[placement->contact]);
    break;
  }
  return found;
}

/// From four fingers to three of them and back: one finger is released or placed alone.
TEST(FindGaitTest, TheNumberOfHoldingFingersMayChange) {
  auto [request, three, four] = FindThreeAndFour();
  ASSERT_EQ(four.size(), 4U);
  for (const bool releases : {true, false}) {
    request.start_grasp = releases ? four : three;
    request.goal_grasp = releases ? three : four;
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
    plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
    EXPECT_EQ(plan.initial.size(), request.start_grasp.size());
    EXPECT_EQ(plan.goal.size(), request.goal_grasp.size());
    plan.object_sha256 = plan.hand->sha256 = std::string(64, '0');
    const std::string text = plan::FormatPlan(plan);
    EXPECT_EQ(plan::FormatPlan(plan::ParsePlan(text, "plan")), text);
  }
}

/// A sliding finger requires three other holding fingers: two fingertips do not balance it.
TEST(FindGaitTest, WithSimulationAFingerSlidesBesideThreeOthersOnly) {
  const ThreeAndFour grasps = FindThreeAndFour();
  ASSERT_EQ(grasps.four.size(), 4U);
  const auto slides = [&](const grasp::Grasp& start, bool is_simulated) {
    GaitRequest request = grasps.request;
    request.start_grasp = request.goal_grasp = start;
    request.goal_grasp[0].p += 0.0015 * start[0].n.unitOrthogonal();
    request.most_expanded = 60;
    if (is_simulated) {
      request.simulate = [](const plan::Plan&, const Deadline&) {
        return planning::ExecutionResult{};
      };
    }
    const GaitResult found = FindGait(request);
    return found.gait && std::ranges::count(found.gait->segments, PlanSegment::Kind::kSlide,
                                            &PlanSegment::kind) > 0;
  };
  EXPECT_TRUE(slides(grasps.three, false));
  EXPECT_FALSE(slides(grasps.three, true));
  EXPECT_TRUE(slides(grasps.four, true));
}

/// The object is larger than the reach of any hand.
TEST(FindGaitTest, AGoalGraspOutOfReachIsReported) {
  GaitRequest request = RequestFor("cube", 0.5, 0);
  const double far = 0.0299;
  request.goal_grasp = {{{0.03, far, far}, -Vector3d::UnitX(), {}},
                        {{-0.03, far, far}, Vector3d::UnitX(), {}},
                        {{0.03, -far, -far}, -Vector3d::UnitX(), {}}};
  request.scale = 20;
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  EXPECT_THAT(found.message, testing::HasSubstr("held by the goal grasp"));
}

/// Goal poses 20, 45 and 85 mm above the start. The hand holds the cube up to 35 mm and reaches it
/// up to 48 mm.
TEST(FindGaitTest, ReportsHowNearTheObjectGetsToItsGoalPose) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  const GaitResult first = FindGait(request);
  ASSERT_TRUE(first.gait) << first.message;
  request.start_pose = first.gait->start.pose;
  request.most_expanded = 20;
  const auto message_at = [&](double height) {
    request.goal.emplace(Eigen::Translation3d(0, 0, height) * *request.start_pose);
    const GaitResult found = FindGait(request);
    return found.gait ? std::string("found") : found.message;
  };
  EXPECT_EQ(message_at(0.020), "found");
  EXPECT_THAT(message_at(0.045),
              testing::AnyOf(testing::HasSubstr("no stable grasp is found there"),
                             testing::HasSubstr("% of the path to its goal pose")));
  EXPECT_THROW(message_at(0.085), InputError);
}

/// A cube of 13 cm is too large for this hand, and no tilt of the palm helps.
TEST(ExplainGaitTest, ReportsTheSizeThatHelpsAndTheChangesThatDoNot) {
  GaitRequest large = RequestFor("cube", 2.2, 90);
  large.most_expanded = 12;
  ASSERT_FALSE(FindGait(large).gait);
  const std::string text = ExplainGait(large);
  EXPECT_THAT(text, testing::MatchesRegex(
                        "any one of these changes yields a plan: the object 0\\.[0-9]+ times as "
                        "large \\(--scale [0-9.]+\\); no effect: more "
                        "friction, a tilt of the palm"));
}

/// An object as large as a house, and one with almost no friction.
TEST(FindGaitTest, ReportsTheReasonOfAFailure) {
  const GaitResult large = FindGait(RequestFor("cube", 100, 90));
  EXPECT_FALSE(large.gait);
  EXPECT_THAT(large.message, testing::HasSubstr("0 of 90 degrees"));
  GaitRequest slippery = RequestFor("cube", 0.8, 90);
  slippery.criteria.friction_angle = Radians(0.01);
  const GaitResult none = FindGait(slippery);
  EXPECT_FALSE(none.gait);
  EXPECT_THAT(none.message, testing::HasSubstr("0 of 90 degrees"));
}

/// Faces narrower than the clearance from borders (2 % of the diameter) still have contacts.
TEST(FindGaitTest, ObjectsWithSmallTrianglesHaveContacts) {
  for (const auto& [model, scale] : {std::pair("duck1000", 0.63), {"spanner1000", 0.59}}) {
    GaitRequest request = RequestFor(model, scale, 20);
    request.robustness = RobustnessLevel::kNone;
    const GaitResult found = FindGait(request);
    EXPECT_TRUE(found.gait) << model << ": " << found.message;
    EXPECT_EQ(found.contacts.size(), 400U);
  }
}

}  // namespace find_gait_test
}  // namespace regrasp::gait
