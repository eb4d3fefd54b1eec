#include "sim/hand/rolling_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "sim/hand/check_hand.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {
namespace rolling_check_test {

using Eigen::Vector3d;
using plan::Reason;
using testing::HasSubstr;

const std::string kRing = ProjectPath("models/hands/ring4.json");

const object::Polyhedron& RolledCube() {
  static const object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
  return dynamic_cast<const object::Polyhedron&>(*file.object);
}

/// Return a plan that rotates the cube about z.
plan::Plan MakePlan(double degrees, gait::RobustnessLevel robustness, bool rolls) {
  static const kinematics::HandModel hand = kinematics::ReadHand(kRing);
  gait::GaitRequest request;
  request.hand = &hand;
  request.solid = &RolledCube();
  request.scale = 0.8;
  request.criteria.friction_angle = std::atan(0.8);
  request.turn = {Vector3d::UnitZ(), Radians(degrees)};
  request.robustness = robustness;
  request.rolls = rolls;
  const gait::GaitResult found = gait::FindGait(request);
  if (!found.gait) throw std::runtime_error(found.message);
  return gait::PlanOf(*found.gait, request, found.contacts);
}

/// Return a plan with rolling and finger switches, made once.
const plan::Plan& RollingPlan() {
  static const plan::Plan plan = MakePlan(250, gait::RobustnessLevel::kRequired, true);
  return plan;
}

plan::Move& FirstRolling(plan::Plan& plan) {
  for (plan::Step& step : plan.steps) {
    auto* move = std::get_if<plan::Move>(&step);
    if (move != nullptr && !move->contacts.empty()) return *move;
  }
  ADD_FAILURE() << "no rolling";
  static plan::Move none;
  return none;
}

std::vector<plan::HandFault> FaultsOf(const plan::Plan& plan) {
  return CheckHand(kRing, RolledCube(), plan, {});
}

TEST(RollingCheckTest, PlansOfThePlannerRollWithoutSlipping) {
  const plan::Plan& plan = RollingPlan();
  EXPECT_TRUE(plan::HasRolling(plan));
  EXPECT_GT(plan.steps.size(), 1u) << "expected finger switches between motions";
  for (const plan::HandFault& fault : FaultsOf(plan)) ADD_FAILURE() << fault.detail;
  for (const plan::StepCheck& step : plan::CheckPlan(RolledCube(), plan, {}).steps) {
    EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
  }
}

/// A contact rolls by the radius times the rotation of the fingertip about tangential axes. The
/// cube is cut into faces, so contacts of one face move straight.
TEST(RollingCheckTest, ContactsMoveByMillimetres) {
  plan::Plan plan = RollingPlan();
  const plan::Move& move = FirstRolling(plan);
  double farthest = 0;
  for (const plan::FingerContact& held : move.contacts.front()) {
    const auto* end = plan::FindFinger(move.contacts.back(), held.finger);
    farthest = std::max(farthest, plan.scale * (end->contact.p - held.contact.p).norm());
  }
  EXPECT_GT(farthest, 1e-3);
}

TEST(RollingCheckTest, FixedContactsAreNoRolling) {
  // Its joints keep the contacts at their points.
  plan::Plan plan = MakePlan(30, gait::RobustnessLevel::kNone, false);
  EXPECT_TRUE(FaultsOf(plan).empty());
  auto& move = std::get<plan::Move>(plan.steps.at(0));
  move.contacts.assign(move.path.size(), plan.initial);
  const auto faults = FaultsOf(plan);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].reason, Reason::kSlipped);
  EXPECT_THAT(faults[0].detail, HasSubstr("instead of rolling"));
}

TEST(RollingCheckTest, AContactBesideTheFingertipIsAFault) {
  plan::Plan plan = RollingPlan();
  plan::FingerContact& held = FirstRolling(plan).contacts[1].front();
  const Vector3d aside = held.contact.n.unitOrthogonal();
  held.contact.p += 2e-4 / plan.scale * aside;
  const auto faults = FaultsOf(plan);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].reason, Reason::kTipOffContact);
}

/// The fingertip is where contact and normal place it, but another point of the surface is nearer.
TEST(RollingCheckTest, ATiltedNormalIsAFault) {
  plan::Plan plan = RollingPlan();
  plan::Move& move = FirstRolling(plan);
  const kinematics::HandModel hand = kinematics::ReadHand(kRing);
  plan::FingerContact& held = move.contacts[1].front();
  const double radius = hand.fingers[held.finger].tip.radius;
  const Vector3d centre = plan.scale * held.contact.p - radius * held.contact.n;
  const Eigen::AngleAxisd tilt(Radians(10), held.contact.n.unitOrthogonal());
  held.contact.n = tilt * held.contact.n;
  held.contact.p = (centre + radius * held.contact.n) / plan.scale;
  const auto faults = FaultsOf(plan);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].reason, Reason::kTipOffContact);
  EXPECT_THAT(faults[0].detail, HasSubstr("not on the surface"));
  // The analytic check, which does not know the radius, finds it too.
  EXPECT_FALSE(plan::CheckPlan(RolledCube(), plan, {}).passed());
}

/// The contact is on the surface, but the sphere is inside a ridge of the surface next to it.
TEST(RollingCheckTest, AFingertipInsideTheSurfaceBesideItsContactIsAFault) {
  plan::Plan plan = RollingPlan();
  const plan::Move& move = FirstRolling(plan);
  const kinematics::HandFile file = kinematics::ReadHandFile(kRing);
  HandBody body(file);
  std::vector<ConvexBody> surface;
  for (const auto& corners : RolledCube().triangles()) {
    std::vector<Vector3d> points;
    for (const int corner : corners) points.push_back(plan.scale * RolledCube().vertices()[corner]);
    surface.push_back(MakeConvexBody(std::move(points), 0));
  }
  EXPECT_FALSE(RollingCheck(body, surface, plan.scale, move).Check(0, "in state 0", ""));
  const plan::FingerContact& held = move.contacts.front().front();
  const double radius = file.hand.fingers[held.finger].tip.radius;
  const Vector3d aside = held.contact.n.unitOrthogonal();
  const Vector3d side =
      plan.scale * held.contact.p - radius * held.contact.n + 0.8 * radius * aside;
  surface.push_back(MakeConvexBody({side, side + 1e-4 * aside, side + 1e-4 * held.contact.n}, 0));
  const auto finding = RollingCheck(body, surface, plan.scale, move).Check(0, "in state 0", "");
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->reason, Reason::kTipOffContact);
  EXPECT_THAT(finding->detail, HasSubstr("next to its contact"));
}

TEST(RollingCheckTest, AMissingFingerIsAFault) {
  plan::Plan plan = RollingPlan();
  FirstRolling(plan).contacts[1].pop_back();
  const auto faults = FaultsOf(plan);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_THAT(faults[0].detail, HasSubstr("are not those of all holding fingers"));
  EXPECT_FALSE(plan::CheckPlan(RolledCube(), plan, {}).passed());
}

TEST(RollingCheckTest, GraspsOnTheWayMustBeForceClosure) {
  plan::CheckOptions slippery;
  slippery.friction_angle = Radians(5);
  EXPECT_FALSE(plan::CheckPlan(RolledCube(), RollingPlan(), slippery).passed());
  // All contacts of a state on one face: the grasp before and the one after are sound.
  plan::Plan plan = RollingPlan();
  plan::Move& move = FirstRolling(plan);
  const grasp::Contact first = move.contacts[1].front().contact;
  for (plan::FingerContact& held : move.contacts[1]) {
    const Vector3d aside = (1e-3 * held.finger) / plan.scale * first.n.unitOrthogonal();
    held.contact = first;
    held.contact.p += aside;
  }
  const plan::PlanCheck check = plan::CheckPlan(RolledCube(), plan, {});
  EXPECT_FALSE(check.passed());
}

TEST(RollingCheckTest, TheFileKeepsContacts) {
  plan::Plan plan = RollingPlan();
  plan.object_sha256 = std::string(64, 'a');
  const std::string text = plan::FormatPlan(plan);
  const plan::Plan read = plan::ParsePlan(text, "plan");
  ASSERT_EQ(read.steps.size(), plan.steps.size());
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const auto* move = std::get_if<plan::Move>(&plan.steps[i]);
    if (move == nullptr) continue;
    const auto& same = std::get<plan::Move>(read.steps[i]);
    ASSERT_EQ(same.contacts.size(), move->contacts.size());
    for (std::size_t k = 0; k < same.contacts.size(); ++k) {
      ASSERT_TRUE(plan::HaveSameFingers(same.contacts[k], move->contacts[k]));
      EXPECT_TRUE(plan::AreSameGrasp(plan::ContactsOf(same.contacts[k]),
                                     plan::ContactsOf(move->contacts[k]), 1e-12));
    }
  }
}

TEST(RollingCheckTest, AFileWithAGraspForOnlySomeStatesIsBadInput) {
  plan::Plan plan = RollingPlan();
  plan.object_sha256 = std::string(64, 'a');
  FirstRolling(plan).contacts.pop_back();
  EXPECT_THAT([&] { (void)plan::ParsePlan(plan::FormatPlan(plan), "plan"); },
              testing::ThrowsMessage<InputError>(HasSubstr("expected one grasp for each of the")));
  plan = RollingPlan();
  plan.object_sha256 = std::string(64, 'a');
  plan.hand.reset();
  EXPECT_THAT([&] { (void)plan::ParsePlan(plan::FormatPlan(plan), "plan"); },
              testing::ThrowsMessage<InputError>(HasSubstr("require the member hand")));
}

}  // namespace rolling_check_test
}  // namespace regrasp::sim
