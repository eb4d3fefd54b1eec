#include "planner/grasp/subset_force_closure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace subset_force_closure_test {

using Subsets = std::vector<std::array<int, 4>>;

Subsets OneByOne(const Grasp& points, double friction_angle) {
  Subsets found;
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      for (int k = j + 1; k < count; ++k) {
        for (int l = k + 1; l < count; ++l) {
          const std::array grasp{points[i], points[j], points[k], points[l]};
          if (IsForceClosure(grasp, UnitFrame(3), friction_angle)) found.push_back({i, j, k, l});
        }
      }
    }
  }
  return found;
}

TEST(SubsetForceClosureTest, GivesWhatTheTestSaysOfEachSubset) {
  RandomGrasps random(31);
  for (const int count : {1, 3, 4, 5, 17, 40}) {
    for (const double degrees : {8.0, 15.0, 40.0}) {
      const Grasp ball = random.OnBall(count, 3);
      const Grasp box = random.OnBox(count, 3);
      EXPECT_EQ(ForceClosureSubsets(ball, UnitFrame(3), Radians(degrees)),
                OneByOne(ball, Radians(degrees)));
      EXPECT_EQ(ForceClosureSubsets(box, UnitFrame(3), Radians(degrees)),
                OneByOne(box, Radians(degrees)));
    }
  }
}

TEST(SubsetForceClosureTest, IndicesBeyondOneWordOfBitsAreRight) {
  RandomGrasps random(32);
  Grasp points = random.OnBall(67, 3);
  SubsetCounts counts;
  const Subsets found = ForceClosureSubsets(points, UnitFrame(3), Radians(12), &counts);
  int beyond = 0;
  for (const auto& [i, j, k, l] : found) {
    const std::array grasp{points[i], points[j], points[k], points[l]};
    EXPECT_TRUE(IsForceClosure(grasp, UnitFrame(3), Radians(12)));
    beyond += l >= 64;
  }
  EXPECT_GT(beyond, 100);
  EXPECT_EQ(counts.subsets, 766480);  // binomial coefficient of 67 over 4
  EXPECT_EQ(counts.subsets, counts.rejected_by_lines + counts.accepted_by_pairs +
                                counts.accepted_by_triples + counts.rejected_by_twists +
                                counts.by_simplex);
  EXPECT_GT(counts.rejected_by_twists, counts.by_simplex);
  EXPECT_EQ(found.size(), OneByOne(points, Radians(12)).size());
}

TEST(SubsetForceClosureTest, GridPointsWithCollinearAndCoincidentOnesAreRight) {
  RandomGrasps random(33);
  Grasp points = random.OnBox(30, 3);
  for (Contact& contact : points) contact.p = contact.p.array().round();
  const Subsets found = ForceClosureSubsets(points, UnitFrame(3), Radians(20));
  EXPECT_EQ(found, OneByOne(points, Radians(20)));
  EXPECT_GT(found.size(), 100U);
}

TEST(SubsetForceClosureTest, BadArgumentsThrow) {
  RandomGrasps random(34);
  EXPECT_THROW((void)ForceClosureSubsets({}, UnitFrame(3), 0.3), std::invalid_argument);
  EXPECT_THROW((void)ForceClosureSubsets(random.OnBall(5, 2), UnitFrame(2), 0.3),
               std::invalid_argument);
  EXPECT_THROW((void)ForceClosureSubsets(random.OnBall(5, 3), UnitFrame(3), -1),
               std::invalid_argument);
}

}  // namespace subset_force_closure_test

namespace separator_pool_test {

using Word = SeparatorPool::Word;
using Twist = SeparatorPool::Twist;

constexpr int kContacts = 70;
constexpr int kWordBits = 64;
constexpr int kPair[] = {3, 65};

UnitContacts ContactsOnBall() {
  RandomGrasps random(51);
  UnitContacts contacts =
      MakeUnitContacts(random.OnBall(kContacts, 3), {Eigen::Vector3d::Zero(), 1, 3});
  SetUnitForces(contacts, Radians(10));
  return contacts;
}

Twist RandomTwist(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  Twist twist;
  for (double& value : twist) value = normal(engine);
  return twist;
}

bool HeldOff(const UnitContact& contact, const Twist& twist) {
  return ConeSupport(contact, Velocity<6>(contact, twist.data())) < 0;
}

/// Return the contacts that no twist excludes together with the pair and the third contact, tested
/// one by one.
Word LeftOpenOneByOne(const UnitContacts& contacts, const std::vector<Twist>& twists, int third,
                      int word) {
  Word open = ~Word{0};
  for (const Twist& twist : twists) {
    if (!HeldOff(contacts[kPair[0]], twist) || !HeldOff(contacts[kPair[1]], twist) ||
        !HeldOff(contacts[third], twist)) {
      continue;
    }
    for (int c = word * kWordBits; c < std::min((word + 1) * kWordBits, kContacts); ++c) {
      if (HeldOff(contacts[c], twist)) open &= ~(Word{1} << (c % kWordBits));
    }
  }
  return open;
}

TEST(SeparatorPoolTest, LeavesOpenWhatNoTwistHoldsOff) {
  const UnitContacts contacts = ContactsOnBall();
  SeparatorPool pool(contacts);
  std::mt19937 engine(52);
  std::vector<Twist> twists;
  for (int i = 0; i < 40; ++i) {
    twists.push_back(RandomTwist(engine));
    // The result is the same before and after the pair is fixed.
    if (i == 20) pool.FixPair(kPair[0], kPair[1]);
    pool.Add(twists.back());
  }
  int settled = 0;
  for (int third = 0; third < kContacts; ++third) {
    for (const int word : {0, 1}) {
      const Word open = pool.LeftOpen(third, word, ~Word{0});
      EXPECT_EQ(open, LeftOpenOneByOne(contacts, twists, third, word));
      settled += open != ~Word{0} ? 1 : 0;
    }
  }
  EXPECT_GT(settled, 20);
}

TEST(SeparatorPoolTest, TheLastTwistAlone) {
  const UnitContacts contacts = ContactsOnBall();
  SeparatorPool pool(contacts);
  pool.FixPair(kPair[0], kPair[1]);
  std::mt19937 engine(53);
  int settled = 0;
  for (int i = 0; i < 200; ++i) {
    const Twist twist = RandomTwist(engine);
    pool.Add(twist);
    const Word open = pool.LeftOpenByLast(7, 0, ~Word{0});
    EXPECT_EQ(open, LeftOpenOneByOne(contacts, {twist}, 7, 0));
    settled += open != ~Word{0} ? 1 : 0;
  }
  EXPECT_GT(settled, 5);
}

TEST(SeparatorPoolTest, OldTwistsAreForgotten) {
  const UnitContacts contacts = ContactsOnBall();
  SeparatorPool pool(contacts);
  pool.FixPair(kPair[0], kPair[1]);
  std::mt19937 engine(54);
  Twist holding;
  do {
    holding = RandomTwist(engine);
  } while (LeftOpenOneByOne(contacts, {holding}, 7, 0) == ~Word{0});
  pool.Add(holding);
  EXPECT_NE(pool.LeftOpen(7, 0, ~Word{0}), ~Word{0});
  for (int i = 0; i < 2000; ++i) pool.Add({});
  EXPECT_EQ(pool.LeftOpen(7, 0, ~Word{0}), ~Word{0});
}

TEST(SeparatorPoolTest, AContactThatIsTouchedIsNotHeldOff) {
  UnitContacts contacts;
  contacts.push_back(
      {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), std::cos(0.2), std::sin(0.2)});
  SeparatorPool pool(contacts);
  pool.FixPair(0, 0);
  // Velocities outside the polar cone, on its boundary, and inside.
  for (const auto& [angle, held] :
       {std::pair{0.2 - 1e-6, false}, {0.2, false}, {0.2 + 1e-6, true}}) {
    const double polar = std::numbers::pi / 2 + angle;
    pool.Add({std::sin(polar), 0, std::cos(polar), 0, 0, 0});
    EXPECT_EQ(pool.LeftOpenByLast(0, 0, 1) == 0, held) << angle;
  }
}

}  // namespace separator_pool_test
}  // namespace regrasp::grasp
