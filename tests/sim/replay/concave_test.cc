#include <gtest/gtest.h>

#include "planner/criteria/reach.h"
#include "sim/scene/contact_patches.h"
#include "tests/sim/replay/replay_expectations.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace concave_test {

/// Expect that the plan passes and that its fingers touch the object at the planned points.
void ExpectPassesAsPlanned(const object::Object& object, const plan::Plan& plan) {
  const ReplayResult result = ReplayPlan(object, plan, {});
  for (const StepReplay& step : result.steps) {
    EXPECT_EQ(step.reason, plan::Reason::kNone) << "entry " << step.index << ": " << step.detail;
  }
  ExpectTouchesAsPlanned(object, plan, result);
}

TEST(ReplayConcave, TouchesTheInnerCornerFacesOfTheLBlock) {
  const object::ObjectFile file = ReadModel("l_block.obj");
  const object::Object& l = *file.object;
  const grasp::Contact inner_y = ContactAt(l, {0.07, 0.04, 0.002}, {0, -1, 0});
  const grasp::Contact inner_x = ContactAt(l, {0.04, 0.07, -0.002}, {-1, 0, 0});
  ASSERT_GE(inner_y.face, 0);
  ASSERT_GE(inner_x.face, 0);
  plan::Plan plan = MakePlan({{FingerIndex(0), inner_y},
                              {FingerIndex(1), ContactAt(l, {0.068, 0, -0.001}, {0, 1, 0})},
                              {FingerIndex(2), inner_x},
                              {FingerIndex(3), ContactAt(l, {0, 0.069, 0.003}, {1, 0, 0})}},
                             30);
  // Closer to the concave edge than the usual radius of a fingertip.
  plan.steps = {plan::Switch{{{FingerIndex(4), ContactAt(l, {0.0415, 0.04, 0}, {0, -1, 0})}},
                             {FingerIndex(0)}}};
  ExpectPassesAsPlanned(l, plan);
  EXPECT_LT(ReplayPlan(l, plan, {}).settings.fingertip_radius_m, 0.0015);
}

TEST(ReplayConcave, TouchesTheInsideOfAHole) {
  const object::ObjectFile file = ReadModel("hole_block.obj");
  const auto& block = dynamic_cast<const object::Polyhedron&>(*file.object);
  // Faces of the hole: their outward normals point towards the centroid of the block.
  std::vector<grasp::Contact> walls;
  for (FaceIndex f{0}; f < block.face_count(); ++f) {
    const Eigen::Vector3d inward = block.inward_normal(f);
    const Eigen::Vector3d point = block.CentroidOf(f);
    const Eigen::Vector3d away = point - block.mass_properties().centroid;
    if (inward.dot(away) > 0) walls.push_back({point, inward, f});
  }
  ASSERT_GE(walls.size(), 3u) << "the model has no hole";
  // Fingers press outwards on about every third wall of the hole, and one presses along the hole
  // from outside.
  plan::FingerGrasp grasp;
  const std::size_t stride = walls.size() / 3;
  for (FingerIndex i{0}; i < 3; ++i) {
    grasp.push_back({i, walls[i * stride]});
  }
  const Eigen::Vector3d centroid = block.mass_properties().centroid;
  for (FaceIndex f{0}; f < block.face_count() && grasp.size() < 4; ++f) {
    const Eigen::Vector3d n = block.inward_normal(f);
    const bool wall = n.dot(block.CentroidOf(f) - centroid) > 0;
    if (!wall) grasp.push_back({FingerIndex(3), {block.ClosestPoint(f, centroid), n, f}});
  }
  plan::Plan plan = MakePlan(grasp, 50);
  int touching = 0;
  const ReplayResult result = ReplayPlan(block, plan, {});
  for (const plan::FingerState& state : result.steps.at(0).snapshot.fingers) {
    if (state.finger > 2) continue;
    const grasp::Contact& planned = walls[state.finger * stride];
    EXPECT_LT((result.steps[0].snapshot.X_WO.inverse() * state.contact_W - planned.p).norm(),
              kGood * block.diameter());
    EXPECT_GT(state.force_W.dot(planned.n), 0);
    ++touching;
  }
  EXPECT_EQ(touching, 3);
  EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone) << result.steps[0].detail;
}

TEST(ContactPatches, AreARectangleInsideAFaceAndEndAtItsBorder) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const auto& cube = dynamic_cast<const object::Polyhedron&>(*file.object);
  int checked = 0;
  for (const double y : {0.0, 0.0299, 0.03}) {
    const grasp::Contact contact = ContactAt(cube, {0.03, y, 0.001}, {-1, 0, 0});
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

TEST(ContactPatches, CoverTheSurfaceInASharpCornerWithNoMore) {
  const object::ObjectFile file = ReadModel("tetrahedron.obj");
  const auto& body = dynamic_cast<const object::Polyhedron&>(*file.object);
  const double size = 0.002;
  int checked = 0;
  for (FaceIndex face{0}; face < body.face_count(); ++face) {
    // An angle of 60° has no room for a rectangle at its corner.
    const Eigen::Vector3d& apex = body.BordersOf(face).front().a;
    const auto patches = MakeContactPatches(body, {face, apex, apex}, size);
    ASSERT_EQ(patches.size(), 1u);
    EXPECT_FALSE(patches[0].rectangle);
    double nearest = size;
    double farthest = 0;
    for (const Eigen::Vector3d& corner : patches[0].outline) {
      EXPECT_LE((body.ClosestPoint(face, corner) - corner).norm(), 1e-12);
      nearest = std::min(nearest, (corner - apex).norm());
      farthest = std::max(farthest, (corner - apex).norm());
      ++checked;
    }
    EXPECT_LE(nearest, 1e-12);
    EXPECT_GE(farthest, size);
  }
  EXPECT_GE(checked, 12);
}

TEST(ContactPatches, AreRectanglesInTheCornersOfFacesToo) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const auto& cube = dynamic_cast<const object::Polyhedron&>(*file.object);
  int checked = 0;
  // Near a corner, on a border near it, in the corner itself.
  for (const auto& [y, z] : {std::pair{0.0295, 0.0297}, {0.03, 0.0297}, {0.03, 0.03}}) {
    const grasp::Contact contact = ContactAt(cube, {0.03, y, z}, {-1, 0, 0});
    const auto patches = MakeContactPatches(cube, {contact.face, contact.p, contact.p}, 0.002);
    ASSERT_EQ(patches.size(), 1u);
    EXPECT_TRUE(patches[0].rectangle);
    for (const Eigen::Vector3d& corner : patches[0].outline) {
      EXPECT_LE((cube.ClosestPoint(contact.face, corner) - corner).norm(), 1e-12);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 12);
}

/// Replay a grasp of models/body40.obj with finger 1 in the obtuse corner of a face, with and
/// without the required friction.
TEST(ReplayConcave, HoldsWithAFingerInTheCornerOfAFace) {
  const object::ObjectFile file = ReadModel("body40.obj");
  const auto& body = dynamic_cast<const object::Polyhedron&>(*file.object);
  const auto at = [&](int finger, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    const grasp::Contact near = ContactAt(body, p, n);
    return plan::FingerContact{FingerIndex(finger),
                               {body.ClosestPoint(near.face, p), near.n, near.face}};
  };
  const plan::Plan plan =
      MakePlan({at(0, {-0.01888989081479386, -0.045945695692193006, 0.00316316295538566},
                   {0.009995857568062635, 0.9995857575373747, -0.02698881545959375}),
                at(1, {-0.044689062451825384, 0.034815850048827805, 0.03285538143182388},
                   {0.578325978583356, -0.5703214667226197, -0.5833287984412938}),
                at(2, {-0.026751029652762697, 0.014927150394035776, 0.0059301429062058745},
                   {-0.09902788028509035, 0.04001126475399207, 0.9942799292045613}),
                at(3, {0.02381663128383475, 0.0195471974296448, -0.0010204739953278245},
                   {-0.9858319299820424, 0.07898653394404423, 0.1479747724559421})},
               10);
  ASSERT_LT(body.DistanceToBorder(plan.initial[1].contact.face, plan.initial[1].contact.p), 1e-9);
  const ReplayResult held = ReplayPlan(body, plan, {});
  EXPECT_EQ(held.steps.at(0).reason, plan::Reason::kNone) << held.steps[0].detail;
  // With less than the required friction the object must slip.
  plan::Plan slippery = plan;
  slippery.friction_angle = Radians(6);
  EXPECT_NE(ReplayPlan(body, slippery, {}).steps.at(0).reason, plan::Reason::kNone);
}

TEST(Clearance, IsTheDistanceToAWallAtARightAngle) {
  // A sphere in contact with two perpendicular walls touches each at the distance of its radius
  // from the other wall.
  const object::ObjectFile file = ReadModel("l_block.obj");
  const grasp::Contact contact = ContactAt(*file.object, {0.0415, 0.04, 0}, {0, -1, 0});
  EXPECT_NEAR(criteria::ComputeClearance(*file.object, contact, 0.02), 0.0015, 1e-9);
  const grasp::Contact free = ContactAt(*file.object, {0.07, 0, 0}, {0, 1, 0});
  EXPECT_EQ(criteria::ComputeClearance(*file.object, free, 0.02), 0.02);
}

}  // namespace concave_test
}  // namespace regrasp::sim
