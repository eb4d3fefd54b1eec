#include "planner/plan/plan_reach.h"

#include <gtest/gtest.h>

#include "planner/plan/check.h"
#include "sample_plans.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace plan_reach_test {

using Eigen::Vector3d;

FingerContact At(const object::Object& object, int finger, const Vector3d& p, const Vector3d& n) {
  for (const FaceIndex face : object.FacesNear(p, object::kPointTolerance * object.diameter())) {
    if ((object.inward_normal(face) - n).norm() < 1e-9) return {FingerIndex(finger), {p, n, face}};
  }
  ADD_FAILURE() << "no face with normal " << n.transpose() << " at " << p.transpose();
  return {FingerIndex(finger), {p, n, {}}};
}

std::string DetailOf(const std::optional<Obstacle>& found) { return found ? found->detail : ""; }

/// Return [−3, 3]² × [0, 1] with the post [−1/2, 1/2]² × [1, 2] on it.
object::Polyhedron MakePostPlate() {
  object::PolygonSoup soup;
  const auto add_square = [&](double half, double z) {
    soup.vertices.insert(soup.vertices.end(),
                         {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
  };
  for (const auto& [half, z] : {std::pair(3.0, 0.0), {3.0, 1.0}, {0.5, 1.0}, {0.5, 2.0}}) {
    add_square(half, z);
  }
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    for (const int ring : {0, 4, 8}) {
      soup.facets.push_back({ring + i, ring + next, ring + 4 + next, ring + 4 + i});
    }
  }
  soup.facets.push_back({3, 2, 1, 0});
  soup.facets.push_back({12, 13, 14, 15});
  return object::Polyhedron::FromSoup(soup, "post");
}

const Vector3d kDown(0, 0, -1);

TEST(PlanReach, AGraspAtRestNeedsRoomForEachFingerAndBetweenThem) {
  const object::Polyhedron l = MakeLBlock();
  const FingerGrasp grasp = {At(l, 3, {1.2, 1, 0.5}, {0, -1, 0}),
                             At(l, 7, {2, 1, 0.5}, {0, -1, 0})};
  EXPECT_FALSE(FindRestObstacle(l, grasp, 0).has_value());
  EXPECT_FALSE(FindRestObstacle(l, grasp, 0.2).has_value());
  const std::string corner = DetailOf(FindRestObstacle(l, grasp, 0.25));
  EXPECT_NE(corner.find("finger 3: a sphere of radius 0.25"), std::string::npos) << corner;
  const FingerGrasp close = {At(l, 3, {1.6, 1, 0.5}, {0, -1, 0}),
                             At(l, 7, {2, 1, 0.5}, {0, -1, 0})};
  const std::string overlap = DetailOf(FindRestObstacle(l, close, 0.25));
  EXPECT_NE(overlap.find("fingers 3 and 7 overlap: their centres are 0.4 apart"), std::string::npos)
      << overlap;
}

TEST(PlanReach, FingersPlacedInASwitchKeepApartFromThoseThatLeave) {
  const object::Polyhedron cube = MakeCube();
  const FingerGrasp before = {At(cube, 0, {0, 0, 1}, kDown), At(cube, 1, {0, 0, -1}, -kDown)};
  const Step step = Switch{{At(cube, 2, {0.3, 0, 1}, kDown)}, {FingerIndex(0)}};
  EXPECT_FALSE(FindStepObstacle(cube, before, step, 0.1).has_value());
  const auto found = FindStepObstacle(cube, before, step, 0.2);
  ASSERT_TRUE(found.has_value());
  EXPECT_NE(found->detail.find("fingers 0 and 2 overlap"), std::string::npos) << found->detail;
  EXPECT_EQ(found->fault.fingers, (std::vector{FingerIndex(0), FingerIndex(2)}));
  EXPECT_EQ(found->fault.grasp.size(), 3u);
  // After the switch there is no obstacle: only the switch itself is blocked.
  EXPECT_FALSE(FindRestObstacle(cube, GraspAfter(before, step), 0.2).has_value());
}

TEST(PlanReach, AFingerThatSlidesPastAPostNeedsRoomAllTheWay) {
  const object::Polyhedron body = MakePostPlate();
  const FingerGrasp before = {At(body, 0, {-2, 0.8, 1}, kDown)};
  const FingerGrasp after = {At(body, 0, {2, 0.8, 1}, kDown)};
  const Step slide = Align{{before, after}};
  int passes = 0, fails = 0;
  for (const double radius : {0.05, 0.2, 0.29, 0.299, 0.301, 0.31, 0.4}) {
    EXPECT_FALSE(FindRestObstacle(body, before, radius).has_value()) << radius;
    EXPECT_FALSE(FindRestObstacle(body, after, radius).has_value()) << radius;
    const auto found = FindStepObstacle(body, before, slide, radius);
    EXPECT_EQ(found.has_value(), radius > 0.3) << radius << DetailOf(found);
    ++(found ? fails : passes);
  }
  EXPECT_EQ(passes, 4);
  EXPECT_EQ(fails, 3);
}

TEST(PlanReach, FingersThatCrossMeetOnTheWay) {
  const object::Polyhedron cube = MakeCube();
  const FingerGrasp before = {At(cube, 0, {-0.8, -0.1, 1}, kDown),
                              At(cube, 1, {0.8, 0.1, 1}, kDown)};
  const FingerGrasp after = {At(cube, 0, {0.8, -0.1, 1}, kDown),
                             At(cube, 1, {-0.8, 0.1, 1}, kDown)};
  const Step cross = Align{{before, after}};
  EXPECT_FALSE(FindStepObstacle(cube, before, cross, 0.099).has_value());
  const std::string found = DetailOf(FindStepObstacle(cube, before, cross, 0.11));
  EXPECT_NE(found.find("fingers 0 and 1 overlap"), std::string::npos) << found;
  EXPECT_FALSE(FindRestObstacle(cube, before, 0.11).has_value());
}

TEST(PlanReach, AFingerTurnsFreelyAroundAConvexEdge) {
  const object::Polyhedron cube = MakeCube();
  const FingerGrasp top = {At(cube, 0, {0.5, 0, 1}, kDown)};
  const FingerGrasp edge = {At(cube, 0, {1, 0, 1}, kDown)};
  const FingerGrasp turned = {At(cube, 0, {1, 0, 1}, {-1, 0, 0})};
  const FingerGrasp side = {At(cube, 0, {1, 0, 0.5}, {-1, 0, 0})};
  EXPECT_FALSE(FindStepObstacle(cube, top, Align{{top, edge, turned, side}}, 0.5).has_value());
  // Around the edge the finger approaches the finger on the side face.
  const object::Polyhedron l = MakeLBlock();
  const FingerGrasp arm = {At(l, 0, {2.9, 1, 0.5}, {0, -1, 0}),
                           At(l, 1, {3, 0.1, 0.5}, {-1, 0, 0})};
  EXPECT_FALSE(FindRestObstacle(l, arm, 0.4).has_value());
  const FingerGrasp at_edge = {At(l, 0, {3, 1, 0.5}, {0, -1, 0}), arm[1]};
  const FingerGrasp around = {At(l, 0, {3, 1, 0.5}, {-1, 0, 0}), arm[1]};
  EXPECT_FALSE(FindStepObstacle(l, arm, Align{{arm, at_edge, around}}, 0.4).has_value());
  EXPECT_TRUE(FindStepObstacle(l, arm, Align{{arm, at_edge, around}}, 0.46).has_value());
}

TEST(PlanReach, NamesTheFirstEntryOfASequence) {
  const object::Polyhedron cube = MakeCube();
  Plan plan = CubePlan();
  plan = CheckPlan(cube, plan).projected;
  EXPECT_FALSE(FindPlanObstacle(cube, plan.initial, plan.steps, 0.05).has_value());
  plan.steps.insert(plan.steps.begin(),
                    Switch{{{FingerIndex(4),
                             {plan.initial[0].contact.p + Vector3d(0, 0, 0.05),
                              plan.initial[0].contact.n, plan.initial[0].contact.face}}},
                           {FingerIndex(0)}});
  const auto found = FindPlanObstacle(cube, plan.initial, plan.steps, 0.05);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->index, 1);
}

TEST(PlanReach, TheCheckReportsUnreachableAfterForceClosure) {
  const object::Polyhedron cube = MakeCube();
  Plan plan = CubePlan();
  EXPECT_TRUE(CheckPlan(cube, plan).passed());
  EXPECT_TRUE(CheckPlan(cube, plan, {.finger_radius = 0.01}).passed());
  const PlanCheck thick = CheckPlan(cube, plan, {.finger_radius = 3.0});
  ASSERT_FALSE(thick.passed());
  EXPECT_EQ(thick.steps[0].reason, Reason::kUnreachable);
  EXPECT_TRUE(thick.steps[0].force_closure);
  EXPECT_NE(thick.steps[0].detail.find("overlap"), std::string::npos) << thick.steps[0].detail;
  // The plan's own radius is used if the options have none.
  plan.finger_radius = 3.0;
  EXPECT_FALSE(CheckPlan(cube, plan).passed());
  EXPECT_TRUE(CheckPlan(cube, plan, {.finger_radius = 0.01}).passed());
  plan.friction_angle *= 0.1;
  EXPECT_EQ(CheckPlan(cube, plan).steps[0].reason, Reason::kNotForceClosure);
}

TEST(PlanReach, TheCheckReportsAnAlignOnWhoseWayThereIsNoRoom) {
  const object::Polyhedron cube = MakeCube();
  Plan plan = EmptyPlan(3, 5, 40);
  plan.initial = {At(cube, 0, {1, 0, 0}, {-1, 0, 0}), At(cube, 1, {-1, 0, 0}, {1, 0, 0}),
                  At(cube, 2, {-0.8, -0.1, 1}, kDown), At(cube, 3, {0.8, 0.1, 1}, kDown),
                  At(cube, 4, {0, 0, -1}, -kDown)};
  FingerGrasp crossed = plan.initial;
  crossed[2].contact.p.x() = 0.8;
  crossed[3].contact.p.x() = -0.8;
  plan.steps = {Align{{plan.initial, crossed}}};
  plan.goal = ContactsOf(crossed);
  EXPECT_TRUE(CheckPlan(cube, plan, {.finger_radius = 0.099}).passed());
  const StepCheck align = CheckPlan(cube, plan, {.finger_radius = 0.11}).steps[1];
  EXPECT_EQ(align.reason, Reason::kUnreachable);
  EXPECT_TRUE(align.force_closure);
  EXPECT_NE(align.detail.find("fingers 2 and 3 overlap"), std::string::npos) << align.detail;
}

TEST(PlanReach, TheCheckAllowsWhatReadingRounds) {
  // Points have a precision of a millionth of the diameter: fingers with a smaller overlap are in
  // contact.
  const object::Polyhedron cube = MakeCube();
  Plan plan = CubePlan();
  double least = 1e9;
  for (std::size_t i = 0; i < plan.initial.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // Two spheres of radius r, with their centres at a distance r outward along the normals.
      const grasp::Contact& a = plan.initial[i].contact;
      const grasp::Contact& b = plan.initial[j].contact;
      double low = 0, high = 10;
      for (int round = 0; round < 100; ++round) {
        const double r = (low + high) / 2;
        ((a.p - b.p - r * (a.n - b.n)).norm() >= 2 * r ? low : high) = r;
      }
      least = std::min(least, low);
    }
  }
  plan.steps.clear();
  plan.goal = ContactsOf(plan.initial);
  const double tolerance = object::kPointTolerance * cube.diameter();
  EXPECT_TRUE(CheckPlan(cube, plan, {.finger_radius = least + 0.5 * tolerance}).passed());
  EXPECT_FALSE(CheckPlan(cube, plan, {.finger_radius = least + 20 * tolerance}).passed());
}

}  // namespace plan_reach_test
}  // namespace regrasp::plan
