#include <gtest/gtest.h>

#include "replay_cases.h"
#include "sim/clearance.h"
#include "sim/contact_patches.h"

namespace regrasp {
namespace {

/// A finger touches where it was planned, within this share of the size.
constexpr double kTouch = 1e-4;

void ExpectTouchesAsPlanned(const Object& object, const Plan& plan) {
  const ReplayResult result = ReplayPlan(object, plan, {});
  ASSERT_EQ(result.steps.size(), plan.steps.size() + 1);
  FingerGrasp grasp = plan.initial;
  for (std::size_t i = 0; i < result.steps.size(); ++i) {
    if (i > 0) grasp = GraspAfter(grasp, plan.steps[i - 1]);
    const StepReplay& step = result.steps[i];
    EXPECT_EQ(step.reason, Reason::kNone) << "entry " << i << ": " << step.detail;
    std::size_t touching = 0;
    for (const FingerContact& held : grasp) {
      for (const FingerState& state : step.snapshot.fingers) {
        if (state.finger != held.finger) continue;
        EXPECT_LT((step.snapshot.X_WO.inverse() * state.contact_W - held.contact.p).norm(),
                  kTouch * object.diameter());
        EXPECT_GT(state.force_W.dot(held.contact.n), 0) << "finger " << held.finger;
        ++touching;
      }
    }
    EXPECT_EQ(touching, grasp.size());
  }
}

TEST(ReplayConcave, TouchesTheInnerCornerFacesOfTheLBlock) {
  const ObjectFile file = ReadModel("l_block.obj");
  const Object& l = *file.object;
  const Contact inner_y = ContactAt(l, {0.07, 0.04, 0.002}, {0, -1, 0});
  const Contact inner_x = ContactAt(l, {0.04, 0.07, -0.002}, {-1, 0, 0});
  ASSERT_GE(inner_y.face, 0);
  ASSERT_GE(inner_x.face, 0);
  Plan plan = MakePlan({{0, inner_y},
                        {1, ContactAt(l, {0.068, 0, -0.001}, {0, 1, 0})},
                        {2, inner_x},
                        {3, ContactAt(l, {0, 0.069, 0.003}, {1, 0, 0})}},
                       30);
  // Closer to the concave edge than a fingertip is usually thick.
  plan.steps = {Switch{{{4, ContactAt(l, {0.0415, 0.04, 0}, {0, -1, 0})}}, {0}}};
  ExpectTouchesAsPlanned(l, plan);
  EXPECT_LT(ReplayPlan(l, plan, {}).settings.fingertip_radius_m, 0.0015);
}

TEST(ReplayConcave, TouchesTheInsideOfAHole) {
  const ObjectFile file = ReadModel("hole_block.obj");
  const auto& block = dynamic_cast<const Polyhedron&>(*file.object);
  // The faces of the hole: those whose outward normal points at the middle of the block.
  std::vector<Contact> walls;
  for (int f = 0; f < block.face_count(); ++f) {
    const Eigen::Vector3d inward = block.inward_normal(f);
    const Eigen::Vector3d point = block.faces()[f].point;
    const Eigen::Vector3d away = point - block.mass_properties().centroid;
    if (inward.dot(away) > 0) walls.push_back({point, inward, f});
  }
  ASSERT_GE(walls.size(), 3u) << "the model has no hole";
  // Pressed outwards from inside the hole by every third wall or so, and along it from outside.
  FingerGrasp grasp;
  const std::size_t stride = walls.size() / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    grasp.push_back({static_cast<int>(i), walls[i * stride]});
  }
  const Eigen::Vector3d centroid = block.mass_properties().centroid;
  for (int f = 0; f < block.face_count() && grasp.size() < 4; ++f) {
    const Eigen::Vector3d n = block.inward_normal(f);
    const bool wall = n.dot(block.faces()[f].point - centroid) > 0;
    if (!wall) grasp.push_back({3, {block.ClosestPoint(f, centroid), n, f}});
  }
  Plan plan = MakePlan(grasp, 50);
  int touching = 0;
  const ReplayResult result = ReplayPlan(block, plan, {});
  for (const FingerState& state : result.steps.at(0).snapshot.fingers) {
    if (state.finger > 2) continue;
    const Contact& planned = walls[state.finger * stride];
    EXPECT_LT((result.steps[0].snapshot.X_WO.inverse() * state.contact_W - planned.p).norm(),
              kTouch * block.diameter());
    EXPECT_GT(state.force_W.dot(planned.n), 0);
    ++touching;
  }
  EXPECT_EQ(touching, 3);
  EXPECT_EQ(result.steps[0].reason, Reason::kNone) << result.steps[0].detail;
}

TEST(ContactPatches, AreARectangleInsideAFaceAndEndAtItsBorder) {
  const ObjectFile file = ReadModel("cube.obj");
  const auto& cube = dynamic_cast<const Polyhedron&>(*file.object);
  int checked = 0;
  for (const double y : {0.0, 0.0299, 0.03}) {
    const Contact contact = ContactAt(cube, {0.03, y, 0.001}, {-1, 0, 0});
    const auto patches = MakeContactPatches(cube, {contact.face, contact.p, contact.p}, 0.002);
    ASSERT_EQ(patches.size(), 1u);
    EXPECT_TRUE(patches[0].rectangle);
    for (const Eigen::Vector3d& corner : patches[0].outline) {
      EXPECT_LE((cube.ClosestPoint(contact.face, corner) - corner).norm(), 1e-15);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 12);
}

TEST(ContactPatches, CoverTheSurfaceAroundACornerWithNoMore) {
  const ObjectFile file = ReadModel("cube.obj");
  const auto& cube = dynamic_cast<const Polyhedron&>(*file.object);
  const Contact contact = ContactAt(cube, {0.03, 0.0295, 0.0297}, {-1, 0, 0});
  const auto patches = MakeContactPatches(cube, {contact.face, contact.p, contact.p}, 0.002);
  ASSERT_EQ(patches.size(), 1u);
  double largest_y = 0;
  for (const Eigen::Vector3d& corner : patches[0].outline) {
    EXPECT_LE((cube.ClosestPoint(contact.face, corner) - corner).norm(), 1e-12);
    largest_y = std::max(largest_y, corner.y());
  }
  EXPECT_NEAR(largest_y, 0.03, 1e-12);
}

TEST(Clearance, IsTheDistanceToAWallAtARightAngle) {
  // A ball that touches two walls at right angles touches each at its radius from the other.
  const ObjectFile file = ReadModel("l_block.obj");
  const Contact contact = ContactAt(*file.object, {0.0415, 0.04, 0}, {0, -1, 0});
  EXPECT_NEAR(ComputeClearance(*file.object, contact, 0.02), 0.0015, 1e-9);
  const Contact free = ContactAt(*file.object, {0.07, 0, 0}, {0, 1, 0});
  EXPECT_EQ(ComputeClearance(*file.object, free, 0.02), 0.02);
}

}  // namespace
}  // namespace regrasp
