#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "planner/grasp/grasp_forces.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace sliding_forces_test {

constexpr double kTotal = 7.5;
constexpr double kMu = 0.6;
constexpr double kRounding = 1e-9;
const SlidingFriction kFriction{kMu, std::atan(kMu)};

/// Return a random direction perpendicular to a contact's normal.
Eigen::Vector3d Across(const Contact& contact, RandomGrasps& random, int dimension) {
  if (dimension == 2) return {-contact.n.y(), contact.n.x(), 0};
  const Eigen::Vector3d drawn = random.Direction(3);
  return (drawn - drawn.dot(contact.n) * contact.n).normalized();
}

TEST(SlidingForcesTest, OthersBalanceWhatSlidesOnTheEdgeOfItsCone) {
  RandomGrasps random(5);
  int balanced = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const int dimension = 2 + trial % 2;
    const Grasp grasp = random.OnBall(dimension + 1 + trial % 3, dimension);
    const object::WrenchFrame frame = UnitFrame(dimension);
    const SlidingContact sliding{trial % 2, Across(grasp[trial % 2], random, dimension)};
    const Wrench load{0.1 * random.Direction(dimension), Eigen::Vector3d::Zero()};
    const double normal = 0.05 * kTotal;
    const GraspForces result =
        ComputeSlidingForces(grasp, {{sliding}}, frame, kFriction, load, kTotal, normal);
    ASSERT_EQ(result.forces.size(), grasp.size());
    const Eigen::Vector3d& pushed = result.forces[sliding.contact];
    EXPECT_NEAR(pushed.dot(grasp[sliding.contact].n), normal, kRounding);
    EXPECT_NEAR(pushed.dot(sliding.direction), kMu * normal, kRounding);
    if (!result.balanced) continue;
    ++balanced;
    EXPECT_GE(result.margin, 0);
    Eigen::Vector3d force = load.force;
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
    double total = 0;
    for (std::size_t i = 0; i < grasp.size(); ++i) {
      force += result.forces[i];
      torque += (grasp[i].p - frame.origin).cross(result.forces[i]) / frame.radius;
      total += result.forces[i].dot(grasp[i].n);
    }
    EXPECT_LT(force.norm() + torque.norm(), kRounding * 100);
    EXPECT_NEAR(total, kTotal, kRounding * 100);
  }
  EXPECT_GT(balanced, 50);
}

TEST(SlidingForcesTest, WhereNothingSlidesTheyAreThoseOfTheGrasp) {
  RandomGrasps random(6);
  const Grasp grasp = random.OnBall(5, 3);
  const Wrench load{{0, 0, -1}, Eigen::Vector3d::Zero()};
  const GraspForces expected =
      ComputeGraspForces(grasp, UnitFrame(3), kFriction.friction_angle, load, kTotal);
  const GraspForces result =
      ComputeSlidingForces(grasp, {}, UnitFrame(3), kFriction, load, kTotal, 0.1);
  EXPECT_EQ(result.margin, expected.margin);
  EXPECT_EQ(result.forces, expected.forces);
}

TEST(SlidingForcesTest, WhereAllSlideNothingBalances) {
  const Grasp grasp = {{{1, 0, 0}, {-1, 0, 0}, {}}, {{-1, 0, 0}, {1, 0, 0}, {}}};
  const std::vector<SlidingContact> sliding = {{0, Eigen::Vector3d::UnitY()},
                                               {1, Eigen::Vector3d::UnitY()}};
  const GraspForces result =
      ComputeSlidingForces(grasp, sliding, UnitFrame(3), kFriction, {}, kTotal, 1);
  EXPECT_FALSE(result.balanced);
  EXPECT_NEAR(result.margin, -2 * kMu / kTotal, kRounding);
}

TEST(SlidingForcesTest, TheFirstGoodNormalForceIsTakenOrElseTheBest) {
  const SlidingNormal first =
      ChooseSlidingNormal(0.1, 10, [](double normal) { return normal > 0.2 ? 0.06 : 0.01; });
  EXPECT_NEAR(first.normal, 0.225, 1e-12);
  const SlidingNormal best =
      ChooseSlidingNormal(0.1, 10, [](double normal) { return 0.04 - std::abs(normal - 0.15); });
  EXPECT_NEAR(best.normal, 0.15, 1e-12);
  EXPECT_NEAR(best.margin, 0.04, 1e-12);
}

}  // namespace sliding_forces_test
}  // namespace regrasp::grasp
