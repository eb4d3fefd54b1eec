#include "planner/grasp/force_closure_core.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "planner/base/number.h"
#include "planner/grasp/cone_support.h"
#include "planner/grasp/required_friction_angle.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace friction_search_test {

/// Tolerance for the balance of unit forces with their torques, and for the separation by twists.
constexpr double kRounding = 1e-9;

UnitContacts Draw(RandomGrasps& random, int trial, int dimension) {
  const int count = 2 + trial % 4;
  Grasp grasp = trial % 8 < 4 ? random.OnBall(count, dimension) : random.OnBox(count, dimension);
  if (dimension == 3 && trial % 3 == 0) {
    for (Contact& contact : grasp) contact.torsion = std::pow(10, random.Uniform(-2, 0));
  }
  UnitContacts contacts = MakeUnitContacts(grasp, ContactFrame(grasp, dimension));
  SetUnitForces(contacts, random.Uniform(0.05, 1.2));
  return contacts;
}

void SetAngle(UnitContact& contact, double friction_angle) {
  contact.axial = std::cos(friction_angle);
  contact.tangential = std::sin(friction_angle);
}

/// Return an angle near the last one, as in a bisection, or any angle.
double NextAngle(RandomGrasps& random, double last) {
  const double step = std::pow(10, random.Uniform(-9, 0));
  return std::clamp(last + random.Uniform(-step, step), 1e-3, 1.5);
}

struct Agreement {
  int yes = 0, no = 0, too_close = 0;
};

/// Expect that each answer equals that of a separate decision, whatever the earlier queries.
/// Answers that are too close to call are exempt.
template <int kDim>
Agreement ExpectEachAsByItself(bool all) {
  RandomGrasps random(all ? 41 : 42);
  Agreement count;
  for (int trial = 0; trial < 400; ++trial) {
    const UnitContacts contacts = Draw(random, trial, kDim == 6 ? 3 : 2);
    const std::size_t finger = random.Index(static_cast<int>(contacts.size()));
    FrictionSearch<kDim> search =
        all ? FrictionSearch<kDim>(contacts) : FrictionSearch<kDim>(contacts, finger);
    double angle = random.Uniform(0.01, 1.5);
    for (int asked = 0; asked < 25; ++asked) {
      UnitContacts alone = contacts;
      for (std::size_t i = 0; i < alone.size(); ++i) {
        if (all || i == finger) SetAngle(alone[i], angle);
      }
      const Decision expected = DecideForceClosure<kDim>(alone).decision;
      const Decision found = search.Decide(angle);
      const bool close = expected == Decision::kTooClose || found == Decision::kTooClose;
      ++(close ? count.too_close : found == Decision::kYes ? count.yes : count.no);
      if (!close) {
        EXPECT_EQ(found, expected) << trial << " at " << angle;
      }
      EXPECT_EQ(search.DecideAlone(angle), expected);
      angle = NextAngle(random, angle);
    }
  }
  return count;
}

TEST(FrictionSearchTest, EachAnswerIsThatOfADecisionByItself) {
  for (const bool all : {true, false}) {
    for (const Agreement& count : {ExpectEachAsByItself<6>(all), ExpectEachAsByItself<3>(all)}) {
      EXPECT_GT(count.yes, 2000);
      EXPECT_GT(count.no, 2000);
      EXPECT_LT(count.too_close, 20);
    }
  }
}

/// Expect that the columns of a resumed simplex are a proof.
/// A proof consists of forces in the cones that balance, or of a twist on which all forces in the
/// cones do negative work.
template <int kDim>
void ExpectProof(const WrenchSimplex<kDim>& simplex, const UnitContacts& contacts,
                 typename WrenchSimplex<kDim>::Status status,
                 const typename WrenchSimplex<kDim>::Vector& twist) {
  using Simplex = WrenchSimplex<kDim>;
  if (status == Simplex::Status::kInfeasible) {
    EXPECT_LT(Simplex::Support(contacts, twist), 0);
    return;
  }
  std::array<double, kDim> sum{};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const int contact = static_cast<int>(i);
    const ContactWrench applied{simplex.ForceOf(contact), simplex.TorqueOf(contact)};
    const double pressing = contacts[i].n.dot(applied.force);
    const double tangential = (applied.force - pressing * contacts[i].n).norm();
    const double turning = contacts[i].torsion > 0 ? applied.torque / contacts[i].torsion : 0;
    EXPECT_LE(std::hypot(tangential, turning),
              contacts[i].tangential / contacts[i].axial * pressing + kRounding);
    std::array<double, kDim> wrench;
    WriteWrench<kDim>(contacts[i], applied, wrench.data());
    for (int r = 0; r < kDim; ++r) sum[r] += wrench[r];
  }
  for (const double value : sum) EXPECT_NEAR(value, 0, kRounding);
}

TEST(WrenchSimplexTest, WhatItFindsWhenResumedIsAProof) {
  using Simplex = WrenchSimplex<6>;
  RandomGrasps random(43);
  int feasible = 0, infeasible = 0, stalled = 0;
  for (int trial = 0; trial < 600; ++trial) {
    UnitContacts contacts = Draw(random, trial, 3);
    double angle = random.Uniform(0.3, 1.5);
    SetUnitForces(contacts, angle);
    Simplex simplex(contacts, {});
    if (simplex.FindWeights(/*stop_early=*/true) != Simplex::Status::kFeasible) continue;
    for (int asked = 0; asked < 20; ++asked) {
      angle = NextAngle(random, angle);
      SetUnitForces(contacts, angle);
      Simplex::Vector twist;
      const Simplex::Status status = simplex.Resume(twist);
      if (status == Simplex::Status::kStalled) {
        ++stalled;
        continue;
      }
      ++(status == Simplex::Status::kFeasible ? feasible : infeasible);
      ExpectProof<6>(simplex, contacts, status, twist);
    }
  }
  EXPECT_GT(feasible, 1000);
  EXPECT_GT(infeasible, 300);
  // Here rims rotate by up to a radian, also in grasps with opposite contacts.
  EXPECT_LT(stalled, (feasible + infeasible) / 5);
}

TEST(WrenchSimplexTest, IsNotResumedWithoutWeights) {
  // All normals point up: no force points down.
  const Grasp grasp{{{1, 0, 0}, {0, 0, 1}}, {{-1, 1, 0}, {0, 0, 1}}, {{0, -1, 0}, {0, 0, 1}}};
  UnitContacts contacts = MakeUnitContacts(grasp, ContactFrame(grasp, 3));
  SetUnitForces(contacts, Radians(20));
  WrenchSimplex<6> simplex(contacts, {});
  ASSERT_EQ(simplex.FindWeights(/*stop_early=*/true), WrenchSimplex<6>::Status::kInfeasible);
  SetUnitForces(contacts, Radians(30));
  WrenchSimplex<6>::Vector twist;
  EXPECT_EQ(simplex.Resume(twist), WrenchSimplex<6>::Status::kStalled);
}

}  // namespace friction_search_test
}  // namespace regrasp::grasp
