#include "planner/motion/moving_forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "planner/base/number.h"
#include "tests/planner/motion/random_boxes.h"

namespace regrasp::motion {
namespace moving_forces_test {

using Eigen::Vector3d;

constexpr double kFrictionAngle = Radians(20);

/// Tolerance of the balance for forces up to 1 with moment arms up to a few radii.
constexpr double kRounding = 1e-11;

MovingContacts MovingContactsOf(const grasp::Grasp& from, const grasp::Grasp& to) {
  Vector3d centre = Vector3d::Zero();
  for (const grasp::Contact& contact : from) centre += contact.p / static_cast<double>(from.size());
  MovingContacts contacts;
  for (std::size_t i = 0; i < from.size(); ++i) {
    contacts.push_back({from[i].p - centre, to[i].p - centre, to[i].p - from[i].p, from[i].n,
                        std::cos(kFrictionAngle), std::sin(kFrictionAngle)});
  }
  return contacts;
}

/// Evaluate f(t) by the de Casteljau scheme.
template <int kDegree>
Vector3d ForceAt(ForceCoefficients<kDegree> coefficients, double t) {
  for (int level = kDegree; level > 0; --level) {
    for (int k = 0; k < level; ++k) {
      coefficients[k] = (1 - t) * coefficients[k] + t * coefficients[k + 1];
    }
  }
  return coefficients[0];
}

template <int kDegree>
void ExpectBalancedInside(const MovingContacts& contacts, const MovingForces<kDegree>& forces) {
  ASSERT_EQ(forces.size(), contacts.size());
  for (const double t : {0.0, 0.17, 0.5, 0.83, 1.0}) {
    Vector3d force = Vector3d::Zero();
    Vector3d torque = Vector3d::Zero();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Vector3d f = ForceAt<kDegree>(forces[i], t);
      force += f;
      torque += ((1 - t) * contacts[i].start + t * contacts[i].end).cross(f);
      EXPECT_GT(f.dot(contacts[i].n), f.norm() * std::cos(kFrictionAngle)) << t;
    }
    EXPECT_LT(force.norm(), kRounding) << t;
    EXPECT_LT(torque.norm(), kRounding) << t;
  }
}

/// @returns number of motions proved by degree 1, and by degree 2.
template <int kSpace>
std::array<int, 2> Prove(int contacts) {
  RandomBoxes random(kSpace);
  std::array<int, 2> proved = {0, 0};
  for (int i = 0; i < 500; ++i) {
    const grasp::Grasp from = random.Draw(contacts);
    const MovingContacts moving = MovingContactsOf(from, random.Moved(from, 0.4));
    MovingForces<1> first;
    MovingForces<2> second;
    const bool by_first = FindMovingForces<kSpace, 1>(moving, first);
    const bool by_second = FindMovingForces<kSpace, 2>(moving, second);
    EXPECT_TRUE(by_second || !by_first) << "forces of degree 1 are of degree 2 as well";
    if (by_first) ExpectBalancedInside<1>(moving, first);
    if (by_second) ExpectBalancedInside<2>(moving, second);
    proved[0] += by_first ? 1 : 0;
    proved[1] += by_second ? 1 : 0;
  }
  return proved;
}

TEST(MovingForcesTest, BalanceAtEveryInstantInsideTheCones) {
  const auto [first, second] = Prove<3>(4);
  EXPECT_GT(first, 30);
  EXPECT_GT(second, first) << "degree 2 reaches farther";
  for (const int proved : {second, Prove<3>(5)[0], Prove<2>(3)[0]}) {
    EXPECT_GT(proved, 30);
    EXPECT_LT(proved, 400) << "most random grasps are not force closure";
  }
}

TEST(MovingForcesTest, AreNotFoundWhereAnInstantIsNotForceClosure) {
  // Both pairs become misaligned, one after the other.
  const grasp::Grasp from = CrossedGrasp();
  grasp::Grasp to = from;
  to[0].p.y() += 0.85;
  to[2].p.z() -= 0.85;
  MovingForces<1> forces;
  EXPECT_TRUE((FindMovingForces<3, 1>(MovingContactsOf(from, from), forces)));
  EXPECT_FALSE((FindMovingForces<3, 1>(MovingContactsOf(from, to), forces)));
}

}  // namespace moving_forces_test
}  // namespace regrasp::motion
