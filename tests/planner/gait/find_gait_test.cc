#include "planner/gait/find_gait.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "planner/base/angle.h"
#include "planner/gait/gait_planner.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/plan/check.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace find_gait_test {

using Eigen::Vector3d;

Eigen::Isometry3d LastPose(const Gait& gait) {
  return gait.segments.empty() ? gait.start.pose : gait.segments.back().path.back().pose;
}

/// Without reserve a turn may begin anywhere: ways onwards and backwards are joined.
class TurnTest : public testing::TestWithParam<Reserve> {};

INSTANTIATE_TEST_SUITE_P(Reserves, TurnTest, testing::Values(Reserve::kNone, Reserve::kPreferred),
                         [](const auto& info) {
                           return info.param == Reserve::kNone ? "None" : "Preferred";
                         });

TEST_P(TurnTest, TheObjectIsTurnedAsFarAsIsAskedAndStaysAboutWhereItIs) {
  const Reserve reserve = GetParam();
  for (const double degrees : {60.0, -60.0, 270.0}) {
    GaitRequest request = RequestFor("cube", 0.8, degrees);
    request.reserve = reserve;
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    const Eigen::Isometry3d last = LastPose(*found.gait);
    const Eigen::Matrix3d turned = found.gait->start.pose.linear().transpose() * last.linear();
    const Eigen::Matrix3d asked =
        Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_LT((turned - asked).norm(), 1e-12);
    const Vector3d centre = request.scale * request.solid->mass_properties().centroid;
    EXPECT_LT((last * centre - found.gait->start.pose * centre).norm(), 0.03);
  }
}

TEST_P(TurnTest, StretchesFollowEachOtherAndTipsStayAtTheirContacts) {
  GaitRequest request = RequestFor("prism", 0.5, 150);
  request.reserve = GetParam();
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  ContactAssignment holding = found.gait->initial;
  const Keyframe* last = &found.gait->start;
  int tips = 0;
  for (const PlanSegment& stretch : found.gait->segments) {
    EXPECT_EQ(stretch.path.front().pose.matrix(), last->pose.matrix());
    EXPECT_EQ(stretch.path.front().postures, last->postures);
    const bool changes =
        stretch.kind == PlanSegment::Kind::kPlace || stretch.kind == PlanSegment::Kind::kRelease;
    if (changes) holding[stretch.finger] = kNone;
    for (const PlanSegment::Slid& slid : stretch.slid) holding[slid.finger] = kNone;
    for (const Keyframe& frame : stretch.path) {
      for (FingerIndex finger{0}; finger < std::ssize(holding); ++finger) {
        if (holding[finger] == kNone) continue;
        const kinematics::Finger& chain = Ring().fingers[finger];
        const grasp::Contact& contact = found.contacts[holding[finger]];
        const Vector3d ball =
            frame.pose * (request.scale * contact.p - chain.tip.radius * contact.n);
        EXPECT_LT((kinematics::TipAt(chain, frame.postures[finger]).centre - ball).norm(), 1e-8);
        ++tips;
      }
    }
    if (stretch.kind == PlanSegment::Kind::kPlace) holding[stretch.finger] = stretch.contact;
    for (const PlanSegment::Slid& slid : stretch.slid) holding[slid.finger] = slid.to;
    last = &stretch.path.back();
  }
  EXPECT_GT(tips, 100);
}

/// Each with its own grasp, and somewhere to go.
TEST_P(TurnTest, NoMoveFollowsAnother) {
  int moves = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    GaitRequest request = RequestFor("l_block", 0.7, 180);
    request.seed = seed;
    request.reserve = GetParam();
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    bool was_move = false;
    for (const PlanSegment& stretch : found.gait->segments) {
      const bool is_move = stretch.kind == PlanSegment::Kind::kMove;
      EXPECT_FALSE(is_move && was_move);
      was_move = is_move;
      moves += static_cast<int>(is_move);
    }
  }
  EXPECT_GT(moves, 4);
}

TEST(FindGaitTest, PlansAreRightAsPlansOfContacts) {
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

/// The contacts that are held before one of the stretches.
grasp::Grasp GraspBefore(const GaitResult& found, std::size_t end) {
  ContactAssignment holding = found.gait->initial;
  for (std::size_t i = 0; i < end; ++i) {
    const PlanSegment& stretch = found.gait->segments[i];
    if (stretch.kind == PlanSegment::Kind::kPlace) holding[stretch.finger] = stretch.contact;
    if (stretch.kind == PlanSegment::Kind::kRelease) holding[stretch.finger] = kNone;
    for (const PlanSegment::Slid& slid : stretch.slid) holding[slid.finger] = slid.to;
  }
  grasp::Grasp grasp;
  for (const int contact : holding) {
    if (contact != kNone) grasp.push_back(found.contacts[contact]);
  }
  return grasp;
}

grasp::Grasp LastGrasp(const GaitResult& found) {
  return GraspBefore(found, found.gait->segments.size());
}

grasp::Grasp FirstGrasp(const GaitResult& found) { return GraspBefore(found, 0); }

/// No gait gives reserve to a grasp that has none; time is not spent on it.
TEST(FindGaitTest, AGivenGraspWithoutReserveIsNamed) {
  const GaitRequest turn = RequestFor("cube", 0.8, 30);
  const GaitResult turned = FindGait(turn);
  ASSERT_TRUE(turned.gait) << turned.message;
  GaitRequest request = turn;
  request.start_grasp = FirstGrasp(turned);
  // Of all friction that it needs, a little more than none.
  const auto needed =
      grasp::ComputeRequiredHalfAngle(request.start_grasp, request.solid->wrench_frame());
  ASSERT_TRUE(needed);
  request.criteria.half_angle = 1.05 * needed->upper;
  request.reserve = Reserve::kRequired;
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  EXPECT_THAT(found.message, testing::HasSubstr("the start grasp has no reserve"));
}

TEST_P(TurnTest, TheSameRequestGivesTheSameGait) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  request.reserve = GetParam();
  const GaitResult first = FindGait(request);
  const GaitResult second = FindGait(request);
  ASSERT_TRUE(first.gait && second.gait);
  ASSERT_EQ(first.gait->segments.size(), second.gait->segments.size());
  for (std::size_t i = 0; i < first.gait->segments.size(); ++i) {
    const auto& a = first.gait->segments[i].path;
    const auto& b = second.gait->segments[i].path;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].postures, b[k].postures);
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

/// What a turn came by without being asked is asked for: its last pose and grasp, from its first
/// ones; and the way back.
TEST(FindGaitTest, PosesAndGraspsThatAreGivenAreKept) {
  const GaitRequest turn = RequestFor("cube", 0.5, 90);
  const GaitResult turned = FindGait(turn);
  ASSERT_TRUE(turned.gait) << turned.message;
  for (const bool back : {false, true}) {
    GaitRequest request = RequestFor("cube", 0.5, 0);
    request.start_pose = turned.gait->start.pose;
    request.goal_pose = LastPose(*turned.gait);
    request.start_grasp = FirstGrasp(turned);
    request.goal_grasp = LastGrasp(turned);
    if (back) {
      std::swap(request.start_pose, request.goal_pose);
      std::swap(request.start_grasp, request.goal_grasp);
    }
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    EXPECT_EQ(found.gait->start.pose.matrix(), request.start_pose->matrix());
    EXPECT_LT((LastPose(*found.gait).matrix() - request.goal_pose->matrix()).norm(), 1e-12);
    EXPECT_EQ(Sorted(FirstGrasp(found)), Sorted(request.start_grasp));
    EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
  }
}

/// From one grasp to another one at the same pose, each drawn alone.
GaitRequest PairAtOnePose(std::uint64_t seed) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  request.seed = seed;
  const GaitResult first = FindGait(request);
  EXPECT_TRUE(first.gait) << first.message;
  request.start_pose = first.gait->start.pose;
  request.seed = seed + 1000;
  const GaitResult second = FindGait(request);
  EXPECT_TRUE(second.gait) << second.message;
  request.goal_pose = request.start_pose;
  request.start_grasp = FirstGrasp(first);
  request.goal_grasp = FirstGrasp(second);
  return request;
}

/// In a hand whose fingers are alike each of them may hold each contact.
TEST(FindGaitTest, BeginsWithTheFingersThatAreAskedFor) {
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
  // The other way round no finger reaches its contact.
  std::swap(request.start_fingers[0], request.start_fingers[1]);
  EXPECT_FALSE(FindGait(request).gait);
  request.start_fingers.pop_back();
  EXPECT_THROW((void)FindGait(request), std::invalid_argument);
}

TEST(FindGaitTest, FingersThatHoldSlideAlongTheSurface) {
  int slides = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const GaitRequest request = PairAtOnePose(seed);
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << seed << found.message;
    EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
    for (const PlanSegment& stretch : found.gait->segments) {
      if (stretch.kind != PlanSegment::Kind::kSlide) continue;
      ASSERT_EQ(stretch.along.size(), stretch.along_at.size());
      EXPECT_EQ(stretch.along_at.back() + 1, std::ssize(stretch.path));
      for (std::size_t i = 0; i < stretch.slid.size(); ++i) {
        const auto& [finger, from, to] = stretch.slid[i];
        ++slides;
        EXPECT_EQ(stretch.along.front()[i].p, found.contacts[from].p);
        EXPECT_EQ(stretch.along.back()[i].p, found.contacts[to].p);
        const kinematics::Finger& chain = Ring().fingers[finger];
        for (const Keyframe& frame : stretch.path) {
          // A ball at the cube's surface, wherever on it.
          const Vector3d centre =
              frame.pose.inverse() * kinematics::TipAt(chain, frame.postures[finger]).centre;
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

/// A grasp for one whose contacts are 1.2 mm away (0.0015 of the cube's unit), at one pose.
GaitRequest PairAnAlignApart(Reserve reserve) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  request.reserve = reserve;
  const GaitResult first = FindGait(request);
  EXPECT_TRUE(first.gait) << first.message;
  request.start_pose = request.goal_pose = first.gait->start.pose;
  request.start_grasp = request.goal_grasp = FirstGrasp(first);
  for (grasp::Contact& contact : request.goal_grasp) {
    contact.p += 0.0015 * contact.n.unitOrthogonal();
  }
  return request;
}

/// No finger has to wait for another one where all go to a grasp near by.
TEST(FindGaitTest, FingersSlideAllAtOnce) {
  const GaitRequest request = PairAnAlignApart(Reserve::kNone);  // with it no finger slides
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  ASSERT_EQ(found.gait->segments.size(), 1u);
  EXPECT_EQ(found.gait->segments[0].slid.size(), 3u);
  EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
  const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
  EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
}

/// A grasp that is an align away is not worth ten switches.
TEST(FindGaitTest, APreferredReserveDoesNotMakeAGaitMuchLonger) {
  GaitRequest request = PairAnAlignApart(Reserve::kRequired);
  const GaitResult with = FindGait(request);
  ASSERT_TRUE(with.gait) << with.message;
  EXPECT_GT(with.gait->segments.size(), 15u);
  request.reserve = Reserve::kPreferred;
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_EQ(found.gait->segments.size(), 1u);
}

TEST(FindGaitTest, AGivenGraspFindsAPoseWhereFingersReachIt) {
  const GaitResult turned = FindGait(RequestFor("prism", 0.5, 30));
  ASSERT_TRUE(turned.gait) << turned.message;
  GaitRequest request = RequestFor("prism", 0.5, 30);
  request.start_grasp = FirstGrasp(turned);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_EQ(Sorted(FirstGrasp(found)), Sorted(request.start_grasp));
  EXPECT_NE(found.gait->start.pose.matrix(), turned.gait->start.pose.matrix());
}

/// A pose, three fingers that hold there, and these with a fourth one.
struct ThreeAndFour {
  GaitRequest request;
  grasp::Grasp three;
  grasp::Grasp four;
};

ThreeAndFour FindThreeAndFour() {
  ThreeAndFour found{RequestFor("cube", 0.8, 0), {}, {}};
  GaitRequest turn = RequestFor("cube", 0.8, 150);
  for (turn.seed = 1; turn.seed < 20; ++turn.seed) {
    const GaitResult turned = FindGait(turn);
    EXPECT_TRUE(turned.gait) << turned.message;
    if (!turned.gait) break;
    const std::vector<PlanSegment>& segments = turned.gait->segments;
    // Some need no finger to be placed.
    const auto place = std::ranges::find(segments, PlanSegment::Kind::kPlace, &PlanSegment::kind);
    if (place == segments.end()) continue;
    found.request.start_pose = found.request.goal_pose = place->path.back().pose;
    found.three = GraspBefore(turned, place - segments.begin());
    found.four = found.three;
    found.four.push_back(turned.contacts[place->contact]);
    break;
  }
  return found;
}

/// Four fingers, then three of them, then four again: a finger leaves alone and comes alone.
TEST(FindGaitTest, GraspsMayHaveMoreFingersBeforeOrAfter) {
  auto [request, three, four] = FindThreeAndFour();
  ASSERT_EQ(four.size(), 4U);
  for (const bool leaves : {true, false}) {
    request.start_grasp = leaves ? four : three;
    request.goal_grasp = leaves ? three : four;
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    EXPECT_EQ(Sorted(LastGrasp(found)), Sorted(request.goal_grasp));
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    EXPECT_TRUE(plan::CheckPlan(*request.solid, plan).passed());
    EXPECT_EQ(plan.initial.size(), request.start_grasp.size());
    EXPECT_EQ(plan.goal.size(), request.goal_grasp.size());
  }
}

/// Two fingertips balance no third one that slides, and where the hand is asked none does.
TEST(FindGaitTest, WhereTheHandIsAskedAFingerSlidesBesideThreeOthersOnly) {
  const ThreeAndFour hold = FindThreeAndFour();
  ASSERT_EQ(hold.four.size(), 4U);
  const auto slides = [&](const grasp::Grasp& start, bool is_asked) {
    GaitRequest request = hold.request;
    request.start_grasp = request.goal_grasp = start;
    request.goal_grasp[0].p += 0.0015 * start[0].n.unitOrthogonal();
    request.most_expanded = 60;
    if (is_asked) {
      request.carry_out = [](const plan::Plan&, const Deadline&) { return planning::CarriedOut{}; };
    }
    const GaitResult found = FindGait(request);
    return found.gait && std::ranges::count(found.gait->segments, PlanSegment::Kind::kSlide,
                                            &PlanSegment::kind) > 0;
  };
  EXPECT_TRUE(slides(hold.three, false));
  EXPECT_FALSE(slides(hold.three, true));
  EXPECT_TRUE(slides(hold.four, true));
}

/// No hand is as long as that.
TEST(FindGaitTest, AGraspOutOfReachIsNamed) {
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

/// Goal poses 20, 50 and 90 mm above the start; up to 35 mm the hand holds the cube there.
TEST(FindGaitTest, SaysWhetherTheObjectIsHeldAtItsGoalPoseOrOnlyNearIt) {
  GaitRequest request = RequestFor("cube", 0.8, 0);
  const GaitResult first = FindGait(request);
  ASSERT_TRUE(first.gait) << first.message;
  request.start_pose = first.gait->start.pose;
  request.most_expanded = 20;
  const auto message_at = [&](double height) {
    request.goal_pose = Eigen::Translation3d(0, 0, height) * *request.start_pose;
    const GaitResult found = FindGait(request);
    return found.gait ? std::string("found") : found.message;
  };
  EXPECT_EQ(message_at(0.020), "found");
  EXPECT_THAT(message_at(0.050), testing::HasSubstr("no grasp is found that holds it there"));
  EXPECT_THAT(message_at(0.090), testing::HasSubstr("% of the way to its goal pose"));
}

/// A cube of 13 cm is too large
/// for this hand, and no tilt of the palm makes it smaller.
TEST(ExplainGaitTest, NamesTheSizeThatHelpsAndWhatDoesNot) {
  GaitRequest large = RequestFor("cube", 2.2, 90);
  large.most_expanded = 12;
  ASSERT_FALSE(FindGait(large).gait);
  const std::string text = ExplainGait(large);
  EXPECT_THAT(text, testing::MatchesRegex("would do, each alone: the object 0\\.[0-9]+ times as "
                                          "large \\(--scale [0-9.]+\\); not found to help: more "
                                          "friction, a tilt of the palm"));
}

/// As large as a house it is in no hand; with next to no friction nothing holds it.
TEST(FindGaitTest, SaysWhatStoppedIt) {
  const GaitResult large = FindGait(RequestFor("cube", 100, 90));
  EXPECT_FALSE(large.gait);
  EXPECT_THAT(large.message, testing::HasSubstr("0 of 90 degrees"));
  GaitRequest slippery = RequestFor("cube", 0.8, 90);
  slippery.criteria.half_angle = Radians(0.01);
  const GaitResult none = FindGait(slippery);
  EXPECT_FALSE(none.gait);
  EXPECT_THAT(none.message, testing::HasSubstr("0 of 90 degrees"));
}

/// A fiftieth of the diameter off the borders of their facets there is next to no place on these.
TEST(FindGaitTest, BodiesOfSmallFacetsHaveContacts) {
  for (const auto& [model, scale] : {std::pair("duck1000", 0.63), {"spanner1000", 0.59}}) {
    GaitRequest request = RequestFor(model, scale, 20);
    request.reserve = Reserve::kNone;
    const GaitResult found = FindGait(request);
    EXPECT_TRUE(found.gait) << model << ": " << found.message;
    EXPECT_EQ(found.contacts.size(), 400U);
  }
}

}  // namespace find_gait_test
}  // namespace regrasp::gait
