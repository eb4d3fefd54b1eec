#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/plan/plan.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::plan {
namespace same_grasp_test {

constexpr double kTolerance = 1e-6;

/// Return a contact on the x axis, with its normal rotated from y towards x.
grasp::Contact At(double x, double turn = 0) {
  return {{x, 0, 0}, {std::sin(turn), std::cos(turn), 0}, FaceIndex(0)};
}

TEST(AreSameContact, WithinTheToleranceOfPointAndNormalWhateverTheFace) {
  grasp::Contact other = At(0);
  other.face = FaceIndex(7);
  EXPECT_TRUE(AreSameContact(At(0), other, kTolerance));
  EXPECT_TRUE(AreSameContact(At(0), At(0.9 * kTolerance), kTolerance));
  EXPECT_FALSE(AreSameContact(At(0), At(1.1 * kTolerance), kTolerance));
  EXPECT_TRUE(AreSameContact(At(0), At(0, 0.9 * kNormalTolerance), kTolerance));
  EXPECT_FALSE(AreSameContact(At(0), At(0, 1.1 * kNormalTolerance), kTolerance));
  EXPECT_FALSE(AreSameContact(At(0), At(0, 3.14159), kTolerance));
}

TEST(AreSameGrasp, InEveryOrderAndNotOfAnotherSize) {
  RandomGrasps random(3);
  int orders = 0;
  for (int count = 1; count <= 5; ++count) {
    const grasp::Grasp grasp = random.OnBall(count, 3);
    std::vector<int> order(count);
    for (int i = 0; i < count; ++i) order[i] = i;
    do {
      grasp::Grasp other;
      for (const int i : order) other.push_back(grasp[i]);
      EXPECT_TRUE(AreSameGrasp(grasp, other, kTolerance));
      ++orders;
    } while (std::ranges::next_permutation(order).found);
    grasp::Grasp fewer(grasp.begin(), grasp.end() - 1);
    EXPECT_FALSE(AreSameGrasp(grasp, fewer, kTolerance));
    grasp::Grasp off = grasp;
    off.back().p.x() += 2 * kTolerance;
    EXPECT_FALSE(AreSameGrasp(grasp, off, kTolerance));
    EXPECT_FALSE(AreSameGrasp(off, grasp, kTolerance));
  }
  EXPECT_EQ(orders, 1 + 2 + 6 + 24 + 120);
  EXPECT_TRUE(AreSameGrasp({}, {}, kTolerance));
}

TEST(AreSameGrasp, OneContactIsNotTwo) {
  EXPECT_FALSE(AreSameGrasp({At(0), At(0)}, {At(0), At(1)}, kTolerance));
  EXPECT_FALSE(AreSameGrasp({At(0), At(1)}, {At(0), At(0)}, kTolerance));
  EXPECT_TRUE(AreSameGrasp({At(0), At(0)}, {At(0), At(0)}, kTolerance));
}

TEST(AreSameGrasp, PairsContactsThatFitSeveralSoThatAllArePaired) {
  // The spacing is 90 % of the tolerance: each contact matches its neighbours, and matching the
  // first possible pair leaves other contacts unmatched.
  const auto at = [](double steps) { return At(steps * 0.9 * kTolerance); };
  const grasp::Grasp row = {at(0), at(1), at(2), at(3)};
  const grasp::Grasp shifted = {at(1), at(2), at(3), at(4)};
  for (grasp::Grasp order : {shifted, grasp::Grasp(shifted.rbegin(), shifted.rend()),
                             grasp::Grasp{at(2), at(1), at(4), at(3)}}) {
    EXPECT_TRUE(AreSameGrasp(row, order, kTolerance));
    EXPECT_TRUE(AreSameGrasp(order, row, kTolerance));
  }
  EXPECT_FALSE(AreSameGrasp(row, {at(1), at(2), at(3), at(5)}, kTolerance));
}

TEST(AreIdentical, OnlyTheSameFingersInTheSameOrderWithTheSameBits) {
  const FingerGrasp grasp = {{FingerIndex(2), At(0)}, {FingerIndex(1), At(1)}};
  EXPECT_TRUE(AreIdentical(grasp, grasp));
  EXPECT_TRUE(AreIdentical({}, {}));
  EXPECT_FALSE(AreIdentical(grasp, {grasp[0]}));
  EXPECT_FALSE(AreIdentical(grasp, {grasp[1], grasp[0]}));
  const auto changed = [&grasp](const auto& change) {
    FingerGrasp other = grasp;
    change(other[1]);
    return other;
  };
  for (const FingerGrasp& other :
       {changed([](FingerContact& held) { held.finger = FingerIndex(0); }),
        changed([](FingerContact& held) { held.contact.p.x() = std::nextafter(1, 2); }),
        changed([](FingerContact& held) { held.contact.n.x() += 1e-16; }),
        changed([](FingerContact& held) { held.contact.torsion = 0.1; })}) {
    EXPECT_FALSE(AreIdentical(grasp, other));
  }
}

}  // namespace same_grasp_test
}  // namespace regrasp::plan
