#include "planner/plan/gravity_support.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "sample_plans.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace gravity_support_test {

using Eigen::Vector3d;

/// Radius of the circle of the fingers below the cube, as a share of half its side.
constexpr double kShare = 0.7;

HandState Turned(const HandState& from, const Vector3d& axis, double degrees) {
  HandState state = from;
  state.pose = state.pose * Eigen::AngleAxisd(Radians(degrees), axis.normalized());
  return state;
}

HandPath TurnPath(const HandState& from, const Vector3d& axis, double degrees, int steps) {
  HandPath path;
  for (int i = 0; i <= steps; ++i) path.push_back(Turned(from, axis, degrees * i / steps));
  return path;
}

/// A cube on three fingers, which carry it against gravity along −z.
struct CarriedCube {
  object::Polyhedron cube = MakeCube();
  Plan plan = EmptyPlan(3, 5, 30);

  CarriedCube() {
    const Eigen::AlignedBox3d box = Box();
    const double radius = kShare * box.sizes().x() / 2;
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * std::numbers::pi * i / 3 + 0.2;
      const Vector3d p(box.center().x() + radius * std::cos(angle),
                       box.center().y() + radius * std::sin(angle), box.min().z());
      plan.initial.push_back({FingerIndex{i}, {p, Vector3d::UnitZ(), {}}});
    }
    plan.goal = ContactsOf(plan.initial);
    plan.hand = HandUse{"table", "table.json", std::string(64, '0'), {}};
    plan.hand->initial.joints.resize(static_cast<std::size_t>(plan.fingers));
    plan.hand->up = Vector3d::UnitZ();
    plan.hand->gravity_support = GravitySupport();
  }

  [[nodiscard]] Eigen::AlignedBox3d Box() const {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : cube.vertices()) box.extend(vertex);
    return box;
  }
  void Move(const HandPath& path) { plan.steps.emplace_back(plan::Move{path}); }
  [[nodiscard]] PlanCheck Check() const { return CheckPlan(cube, plan); }
};

TEST(GravitySupportTest, FingersBelowAnObjectHoldItOnlyIfThePlanPermits) {
  CarriedCube carried;
  const PlanCheck check = carried.Check();
  EXPECT_TRUE(check.passed()) << check.steps.front().detail;
  EXPECT_FALSE(check.steps.front().force_closure);
  EXPECT_TRUE(check.steps.front().is_supported);
  EXPECT_TRUE(check.steps.front().ends_supported);
  EXPECT_GE(check.steps.front().resistance.value(), 0.1);
  carried.plan.hand->gravity_support.reset();
  EXPECT_EQ(carried.Check().steps.front().reason, Reason::kNotForceClosure);
}

TEST(GravitySupportTest, TheDirectionOfGravityCounts) {
  CarriedCube carried;
  for (const Vector3d& up : {Vector3d(-Vector3d::UnitZ()), Vector3d(Vector3d::UnitX())}) {
    carried.plan.hand->up = up;
    const PlanCheck check = carried.Check();
    EXPECT_EQ(check.steps.front().reason, Reason::kNotForceClosure);
    EXPECT_NE(check.steps.front().detail.find("resists disturbances of 0 weights"),
              std::string::npos)
        << check.steps.front().detail;
  }
}

TEST(GravitySupportTest, TheRequiredDisturbanceAndForceCount) {
  CarriedCube carried;
  const double resistance = carried.Check().steps.front().resistance.value();
  carried.plan.hand->gravity_support->disturbance = 0.97 * resistance;
  EXPECT_TRUE(carried.Check().passed());
  carried.plan.hand->gravity_support->disturbance = 1.05 * resistance;
  EXPECT_FALSE(carried.Check().passed());
  carried.plan.hand->gravity_support = GravitySupport{0.1, 1.0};
  EXPECT_FALSE(carried.Check().passed()) << "a disturbance adds to the weight";
}

TEST(GravitySupportTest, ARotationAboutTheVerticalChangesNothing) {
  CarriedCube carried;
  carried.Move(TurnPath({}, Vector3d::UnitZ(), 170, 1));
  const PlanCheck check = carried.Check();
  EXPECT_TRUE(check.passed()) << check.steps.back().detail;
  EXPECT_NEAR(check.steps[0].resistance.value(), check.steps[1].resistance.value(), 1e-2);
}

TEST(GravitySupportTest, AnObjectTiltsUntilItFallsOver) {
  // The centroid moves towards the edge of the triangle of fingers.
  for (const auto& [degrees, passes] : {std::pair(5, true), {15, false}, {60, false}}) {
    CarriedCube carried;
    carried.Move(TurnPath({}, Vector3d::UnitX(), degrees, 20));
    EXPECT_EQ(carried.Check().passed(), passes) << degrees;
  }
}

/// Both ends of the motion are upright, but the object tilts in between.
TEST(GravitySupportTest, StatesBetweenTheEndsOfAMotionCount) {
  CarriedCube carried;
  HandPath path = TurnPath({}, Vector3d::UnitX(), 45, 10);
  for (int i = 9; i >= 0; --i) path.push_back(path[i]);
  carried.Move(path);
  EXPECT_TRUE(carried.Check().steps[0].reason == Reason::kNone);
  EXPECT_EQ(carried.Check().steps[1].reason, Reason::kNotForceClosure);
}

Vector3d Tilted(double x_degrees, double y_degrees) {
  return Vector3d(std::tan(Radians(x_degrees)), std::tan(Radians(y_degrees)), 1).normalized();
}

/// During a half turn the direction of gravity in the object's frame passes through a larger tilt
/// than those of both ends.
TEST(GravitySupportTest, PosesBetweenTwoStatesCount) {
  CarriedCube carried;
  grasp::Grasp contacts;
  for (int i = 0; i < 8; ++i) {
    const double angle = std::numbers::pi * i / 4;
    contacts.push_back({{0.7 * std::cos(angle), 0.7 * std::sin(angle), -1}, Vector3d::UnitZ(), {}});
  }
  const auto carrier_at = [&](double disturbance) {
    return WeightCarrier(carried.cube.wrench_frame(), Radians(40), {disturbance, 9},
                         Vector3d::UnitZ());
  };
  HandState from;
  from.pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Tilted(8, 6), Vector3d::UnitZ()).toRotationMatrix();
  int tested = 0;
  for (const double degrees : {178.0, -178.0}) {
    const HandState to = Turned(from, Tilted(0, 6), degrees);
    const auto resists = [&](const HandState& state) {
      return carrier_at(0.01).ResistanceAt(contacts, state.pose);
    };
    const double at_ends = std::min(resists(from).lower, resists(to).lower);
    const double between = resists(StateBetween(from, to, 0.5)).upper;
    EXPECT_TRUE(
        carrier_at(0.9 * std::min(at_ends, between)).HoldsBetween(contacts, from.pose, to.pose));
    if (between > 0.95 * at_ends) continue;
    ++tested;
    const WeightCarrier carrier = carrier_at((at_ends + between) / 2);
    EXPECT_TRUE(carrier.HoldsAt(contacts, from.pose));
    EXPECT_TRUE(carrier.HoldsAt(contacts, to.pose));
    EXPECT_FALSE(carrier.HoldsBetween(contacts, from.pose, to.pose));
  }
  EXPECT_EQ(tested, 1);
}

TEST(GravitySupportTest, TheRequiredFrictionAngleIsThatOfTheTiltAndTheDisturbance) {
  CarriedCube carried;
  const grasp::Grasp contacts = ContactsOf(carried.plan.initial);
  const WeightCarrier carrier(carried.cube.wrench_frame(), Radians(40), {0.05, 9},
                              Vector3d::UnitZ());
  const HandState tilted = Turned({}, Vector3d::UnitX(), 10);
  const auto required = carrier.RequiredFrictionAngleAt(contacts, tilted.pose);
  EXPECT_LE(required.lower, required.upper);
  EXPECT_GT(Degrees(required.upper), 10);
  EXPECT_LT(Degrees(required.upper), 16);
  const WeightCarrier less(carried.cube.wrench_frame(), required.lower - 1e-3, {0.05, 9},
                           Vector3d::UnitZ());
  EXPECT_FALSE(less.HoldsAt(contacts, tilted.pose));
}

TEST(GravitySupportTest, PlanFilesKeepIt) {
  CarriedCube carried;
  carried.plan.hand->gravity_support = GravitySupport{0.2, 5};
  const std::string text = FormatPlan(carried.plan);
  EXPECT_NE(text.find("gravity_support"), std::string::npos);
  const Plan read = ParsePlan(text, "plan");
  ASSERT_TRUE(read.hand && read.hand->gravity_support);
  EXPECT_EQ(read.hand->gravity_support->disturbance, 0.2);
  EXPECT_EQ(read.hand->gravity_support->force, 5);
}

}  // namespace gravity_support_test
}  // namespace regrasp::plan
