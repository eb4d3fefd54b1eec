#include "planner/gait/with_reserve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/gait/plan_of_gait.h"
#include "planner/gait/rolling.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan_io.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace {

using Eigen::Vector3d;

/// What forces that hold the object's weight have to spare where balls roll, the least all along a
/// gait's moves, seen by keyframes.
double ForceMarginWhereItRolls(const Gait& gait, const GaitRequest& request,
                               const std::vector<grasp::Contact>& contacts) {
  const collision::BallContact surface(*request.solid, request.scale);
  const object::WrenchFrame frame = request.solid->wrench_frame();
  std::vector<std::optional<SurfacePoint>> rolled(gait.initial.size());
  const auto take = [&](FingerIndex finger, int contact) {
    rolled[finger] = {request.scale * contacts[contact].p, contacts[contact].n};
  };
  for (FingerIndex f{0}; f < std::ssize(gait.initial); ++f) {
    if (gait.initial[f] != kNone) take(f, gait.initial[f]);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Stretch& stretch : gait.stretches) {
    if (stretch.kind == Stretch::Kind::kPlace) take(stretch.finger, stretch.contact);
    if (stretch.kind == Stretch::Kind::kRelease) rolled[stretch.finger].reset();
    if (stretch.kind != Stretch::Kind::kMove) continue;
    for (std::size_t i = 1; i < stretch.path.size(); ++i) {
      grasp::Grasp grasp;
      for (FingerIndex f{0}; f < std::ssize(rolled); ++f) {
        if (!rolled[f]) continue;
        const kinematics::Finger& chain = request.hand->fingers[f];
        const auto ball = [&](const Keyframe& at) {
          return BallIn(chain, at.postures[f], at.pose);
        };
        rolled[f] = Rolled(*rolled[f], ball(stretch.path[i]) * ball(stretch.path[i - 1]).inverse(),
                           chain.tip.radius, surface);
        grasp.push_back({rolled[f]->p / request.scale, rolled[f]->n, {}});
      }
      const Vector3d weight = -(stretch.path[i].pose.linear().transpose() * request.hand->up);
      least = std::min(least, grasp::ComputeGraspForces(grasp, frame, request.criteria.half_angle,
                                                        {weight, Vector3d::Zero()}, kSqueeze)
                                  .margin);
    }
  }
  return least;
}

TEST(WithReserveTest, GraspsOfAGaitWithReserveHoldWhereTheirContactsRollTo) {
  double worst_without = 1;
  for (int seed = 1; seed <= 4; ++seed) {
    GaitRequest request = RequestFor("cube", 0.8, 90);
    request.seed = seed;
    request.reserve = Reserve::kRequired;
    const GaitResult with = FindGait(request);
    ASSERT_TRUE(with.gait) << with.message;
    // Followed at poses of the grid: between them a little less.
    EXPECT_GT(ForceMarginWhereItRolls(*with.gait, request, with.contacts), 0.15);
    for (const Stretch& stretch : with.gait->stretches) {
      EXPECT_NE(stretch.kind, Stretch::Kind::kSlide);
    }
    request.reserve = Reserve::kNone;
    const GaitResult without = FindGait(request);
    ASSERT_TRUE(without.gait);
    worst_without =
        std::min(worst_without, ForceMarginWhereItRolls(*without.gait, request, without.contacts));
  }
  EXPECT_LT(worst_without, 0);
}

TEST(WithReserveTest, WhereNothingIsToSpareARequiredReserveIsToldOf) {
  GaitRequest request = RequestFor("cube", 0.8, 90);
  request.criteria.half_angle = std::atan(0.15);
  request.reserve = Reserve::kRequired;
  request.most_expanded = 60;
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  EXPECT_THAT(found.message, testing::HasSubstr("without reserve there may be a plan"));
}

/// What a request's test is told of gaits, and what it says.
struct Tried {
  std::vector<plan::Plan> plans = {};
  std::function<std::optional<bool>()> answer;

  void AskFor(GaitRequest& request) {
    request.is_carried_out = [this](const plan::Plan& plan) {
      plans.push_back(plan);
      return answer();
    };
  }
};

TEST(WithReserveTest, OfSeveralGaitsTheFirstIsTakenThatTheHandCarriesOut) {
  GaitRequest request = RequestFor("cube", 0.8, 90);
  Tried tried;
  tried.AskFor(request);
  tried.answer = [&] { return std::optional(tried.plans.size() == 4); };
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait);
  EXPECT_EQ(found.is_carried_out, true);
  ASSERT_EQ(tried.plans.size(), 4U);
  const auto text = [](const plan::Plan& plan) { return plan::FormatPlan(plan); };
  EXPECT_EQ(text(PlanOf(*found.gait, request, found.contacts)), text(tried.plans.back()));
  std::set<std::string> different;
  for (const plan::Plan& plan : tried.plans) different.insert(text(plan));
  EXPECT_GE(different.size(), 3U);
}

TEST(WithReserveTest, WhereTheHandCarriesNoneOutThereIsAGaitUnlessThatIsRequired) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  Tried tried{.answer = [] { return std::optional(false); }};
  tried.AskFor(request);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait);
  EXPECT_EQ(found.is_carried_out, false);
  EXPECT_GT(tried.plans.size(), 3U);
  const auto slides = [](const plan::Plan& plan) {
    return std::ranges::count(plan.steps, std::string("align"), plan::StepKind) > 0;
  };
  // The one without reserve.
  EXPECT_LE(std::ranges::count_if(tried.plans, slides), 1);
  request.reserve = Reserve::kRequired;
  const GaitResult none = FindGait(request);
  EXPECT_FALSE(none.gait);
  EXPECT_THAT(none.message, testing::HasSubstr("the hand's motors carry none out"));
  request.reserve = Reserve::kNone;
  tried.plans.clear();
  EXPECT_TRUE(FindGait(request).gait);
  EXPECT_TRUE(tried.plans.empty());
}

TEST(WithReserveTest, WhereItCanNotBeToldTheFirstGaitWithReserveIsTaken) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  const GaitResult usual = FindGait(request);
  Tried tried{.answer = [] { return std::nullopt; }};
  tried.AskFor(request);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(usual.gait && found.gait);
  EXPECT_EQ(found.is_carried_out, std::nullopt);
  EXPECT_EQ(tried.plans.size(), 1U);
  EXPECT_EQ(plan::FormatPlan(PlanOf(*found.gait, request, found.contacts)),
            plan::FormatPlan(PlanOf(*usual.gait, request, usual.contacts)));
}

}  // namespace
}  // namespace regrasp::gait
