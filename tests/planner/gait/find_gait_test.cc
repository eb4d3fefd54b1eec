#include "planner/gait/find_gait.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "planner/base/angle.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/check.h"

namespace regrasp::gait {
namespace {

using Eigen::Vector3d;

const object::Polyhedron& Model(const std::string& name) {
  static std::map<std::string, object::ObjectFile> files;
  auto& file = files[name];
  if (!file.object) {
    file = object::ReadObject(std::string(REGRASP_SOURCE_DIR) + "/models/" + name + ".obj");
  }
  return dynamic_cast<const object::Polyhedron&>(*file.object);
}

const kinematics::HandModel& Ring() {
  static const kinematics::HandModel hand =
      kinematics::ReadHand(std::string(REGRASP_SOURCE_DIR) + "/models/hands/ring4.json");
  return hand;
}

GaitRequest RequestFor(const std::string& model, double scale, double degrees) {
  GaitRequest request;
  request.hand = &Ring();
  request.solid = &Model(model);
  request.scale = scale;
  request.criteria.half_angle = std::atan(0.8);
  request.turn = {Vector3d::UnitZ(), Radians(degrees)};
  request.seed = 2;
  return request;
}

Eigen::Isometry3d LastPose(const Gait& gait) {
  return gait.stretches.empty() ? gait.start.pose : gait.stretches.back().path.back().pose;
}

TEST(FindGaitTest, TheObjectIsTurnedAsFarAsIsAskedAndStaysWhereItIs) {
  for (const double degrees : {60.0, -60.0, 270.0}) {
    const GaitRequest request = RequestFor("cube", 0.8, degrees);
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << found.message;
    const Eigen::Isometry3d last = LastPose(*found.gait);
    const Eigen::Matrix3d turned = found.gait->start.pose.linear().transpose() * last.linear();
    const Eigen::Matrix3d asked =
        Eigen::AngleAxisd(Radians(degrees), Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_LT((turned - asked).norm(), 1e-12);
    const Vector3d centre = request.scale * request.solid->mass_properties().centroid;
    EXPECT_LT((last * centre - found.gait->start.pose * centre).norm(), 1e-12);
  }
}

TEST(FindGaitTest, StretchesFollowEachOtherAndTipsStayAtTheirContacts) {
  const GaitRequest request = RequestFor("prism", 0.5, 150);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  Holding holding = found.gait->initial;
  const Keyframe* last = &found.gait->start;
  int tips = 0;
  for (const Stretch& stretch : found.gait->stretches) {
    EXPECT_EQ(stretch.path.front().pose.matrix(), last->pose.matrix());
    EXPECT_EQ(stretch.path.front().postures, last->postures);
    if (stretch.kind == Stretch::Kind::kRelease) holding[stretch.finger] = kNone;
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
    if (stretch.kind == Stretch::Kind::kPlace) holding[stretch.finger] = stretch.contact;
    last = &stretch.path.back();
  }
  EXPECT_GT(tips, 100);
}

TEST(FindGaitTest, PlansAreRightAsPlansOfContacts) {
  for (const char* model : {"cube", "l_block"}) {
    const GaitRequest request = RequestFor(model, 0.5, 120);
    const GaitResult found = FindGait(request);
    ASSERT_TRUE(found.gait) << model << ": " << found.message;
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    const plan::PlanCheck check = plan::CheckPlan(*request.solid, plan);
    for (const plan::StepCheck& step : check.steps) {
      EXPECT_EQ(step.reason, plan::Reason::kNone) << model << " " << step.index << step.detail;
    }
  }
}

TEST(FindGaitTest, TheSameRequestGivesTheSameGait) {
  const GaitRequest request = RequestFor("cube", 0.8, 120);
  const GaitResult first = FindGait(request);
  const GaitResult second = FindGait(request);
  ASSERT_TRUE(first.gait && second.gait);
  ASSERT_EQ(first.gait->stretches.size(), second.gait->stretches.size());
  for (std::size_t i = 0; i < first.gait->stretches.size(); ++i) {
    const auto& a = first.gait->stretches[i].path;
    const auto& b = second.gait->stretches[i].path;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].postures, b[k].postures);
  }
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

}  // namespace
}  // namespace regrasp::gait
