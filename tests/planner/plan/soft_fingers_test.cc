// Plans of soft fingers: effects of torsional friction on the check and on the file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "check_expectations.h"
#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "sample_plans.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace soft_fingers_test {

using testing::HasSubstr;

FingerGrasp Opposed(double y, double z) {
  return {{FingerIndex(0), {{-1, 0, 0}, {1, 0, 0}}}, {FingerIndex(1), {{1, y, z}, {-1, 0, 0}}}};
}

/// Return a plan on MakeCube(): two fingers hold, one of them slides, and two others take over.
Plan PairPlan(double torsion) {
  Plan plan = EmptyPlan(3, 4, 25);
  plan.torsion = torsion;
  plan.initial = Opposed(0, 0);
  const FingerGrasp across = {{FingerIndex(2), {{0, -1, 0.2}, {0, 1, 0}}},
                              {FingerIndex(3), {{0.1, 1, 0}, {0, -1, 0}}}};
  plan.steps = {Align{{Opposed(0, 0), Opposed(0.3, 0.2)}},
                Switch{across, {FingerIndex(0), FingerIndex(1)}}};
  plan.goal = ContactsOf(across);
  return plan;
}

TEST(SoftFingersCheck, TwoOfThemHoldSlideAndTakeOver) {
  const object::Polyhedron cube = MakeCube();
  const PlanCheck check = CheckPlan(cube, PairPlan(0.2));
  ExpectPasses(check, "soft");
  ASSERT_TRUE(check.steps[1].required);
  EXPECT_NEAR(check.steps[1].required->upper, std::atan(std::hypot(0.3, 0.2) / 2), 2e-4);
  for (const grasp::Contact& contact : ContactsOf(check.projected.initial)) {
    EXPECT_EQ(contact.torsion, 0.2);
  }
  ExpectFails(CheckPlan(cube, PairPlan(0)), 0, Reason::kNotForceClosure, "hard");
}

TEST(SoftFingersCheck, WhoeverChecksMaySayWhatTheContactsAre) {
  const object::Polyhedron cube = MakeCube();
  CheckOptions options;
  options.torsion = 0;
  ExpectFails(CheckPlan(cube, PairPlan(0.2), options), 0, Reason::kNotForceClosure, "as hard");
  options.torsion = 0.1;
  ExpectPasses(CheckPlan(cube, PairPlan(0), options), "as soft");
}

TEST(SoftFingersCheck, APlanOfHardPointsThatPassesDoesSoOfSoftFingersWithNoMoreFriction) {
  const object::Polyhedron cube = MakeCube();
  const PlanCheck hard = CheckPlan(cube, CubePlan());
  ExpectPasses(hard, "hard");
  CheckOptions options;
  for (const double torsion : {0.01, 0.5}) {
    options.torsion = torsion;
    const PlanCheck soft = CheckPlan(cube, CubePlan(), options);
    ExpectPasses(soft, "soft");
    for (std::size_t i = 0; i < soft.steps.size(); ++i) {
      EXPECT_LE(soft.steps[i].required->upper, hard.steps[i].required->upper + 2e-4);
    }
  }
}

TEST(SoftFingersCheck, BelowTheRequiredFrictionNothingPasses) {
  const object::Polyhedron cube = MakeCube();
  CheckOptions options;
  options.friction_angle = std::atan(0.99 * std::hypot(0.3, 0.2) / 2);
  ExpectFails(CheckPlan(cube, PairPlan(0.2), options), 1, Reason::kNotForceClosure, "at the end");
}

TEST(SoftFingersCheck, WhatTurnsOnAPairIsNotProvedAndTheDetailSaysWhy) {
  // Both fingers turn over an edge simultaneously, and only their torques resist a rotation.
  const object::Polyhedron prism = MakePrism({{0, 0}, {2, 0}, {2.2, 1}, {2, 2}, {0, 2}, {-0.2, 1}});
  Plan plan = EmptyPlan(3, 3, 40);
  plan.torsion = 0.3;
  const double c = 1 / std::hypot(1, 0.2), s = 0.2 / std::hypot(1, 0.2);
  const auto at = [&](double share, double side) {
    const double y = 1 + side * share;
    const double x = 0.2 * (1 - share);
    return FingerGrasp{{FingerIndex(0), {{2 + x, y, 0.5}, {-c, -side * s, 0}}},
                       {FingerIndex(1), {{-x, y, 0.5}, {c, -side * s, 0}}}};
  };
  plan.initial = at(0.3, -1);
  plan.steps = {Align{{at(0.3, -1), at(0, -1), at(0, 1), at(0.3, 1)}}};
  plan.goal = ContactsOf(at(0.3, 1));
  const PlanCheck check = CheckPlan(prism, plan);
  ExpectFails(check, 1, Reason::kNotProved, "over the edge");
  EXPECT_THAT(check.steps[1].detail, HasSubstr("a soft finger counts as a hard point"));
}

TEST(SoftFingersCheck, InThePlaneThereIsNoTorsion) {
  CheckOptions options;
  options.torsion = 0.1;
  EXPECT_THROW((void)CheckPlan(MakeSquare(), SquarePlan(), options), InputError);
}

TEST(SoftFingersFile, KeepsTheTorsionAndTheTorquesOfCertificates) {
  Plan plan = PairPlan(0.2);
  auto& align = std::get<Align>(plan.steps[0]);
  motion::GraspMotion motion;
  for (std::size_t i = 0; i < 2; ++i) {
    grasp::Contact from = align.waypoints[0][i].contact, to = align.waypoints[1][i].contact;
    from.torsion = to.torsion = plan.torsion;
    motion.emplace_back(from, to);
  }
  const auto proof = motion::FindMotionProof(motion, 3, plan.friction_angle);
  ASSERT_TRUE(proof);
  align.certificate = {*proof};
  const std::string text = FormatPlan(plan);
  EXPECT_THAT(text, HasSubstr("\"torsion\": 0.2"));
  const Plan read = ParsePlan(text, "plan.json");
  EXPECT_EQ(read.torsion, 0.2);
  EXPECT_EQ(FormatPlan(read), text);
  const auto& certificate = std::get<Align>(read.steps[0]).certificate;
  EXPECT_EQ(certificate->front().front().start_torques, proof->front().start_torques);
  EXPECT_EQ(certificate->front().front().end_torques, proof->front().end_torques);
  EXPECT_EQ(FormatPlan(PairPlan(0)).find("torsion"), std::string::npos);
}

TEST(SoftFingersFile, RefusesATorsionThatIsNone) {
  const auto complaint = [](const Plan& plan, const Json& torsion) -> std::string {
    Json json = ParseJson(FormatPlan(plan), "plan.json");
    json["torsion"] = torsion;
    try {
      static_cast<void>(ParsePlan(FormatJson(json), "plan.json"));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint(PairPlan(0.2), 0.3), "");
  EXPECT_THAT(complaint(PairPlan(0.2), 0), HasSubstr("/torsion: must be positive, found 0"));
  EXPECT_THAT(complaint(PairPlan(0.2), -1), HasSubstr("/torsion: must be positive, found -1"));
  EXPECT_THAT(complaint(PairPlan(0.2), "soft"), HasSubstr("/torsion"));
  EXPECT_THAT(complaint(SquarePlan(), 0.1),
              HasSubstr("/torsion: cannot be used with a planar object"));
}

}  // namespace soft_fingers_test
}  // namespace regrasp::plan
