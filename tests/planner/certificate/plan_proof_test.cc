#include "planner/certificate/plan_proof.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::certificate {
namespace plan_proof_test {

using Eigen::Vector3d;
using Kind = motion::ProofVerdict::Kind;

constexpr double kFrictionAngle = Radians(20);
const double kMu = std::tan(kFrictionAngle);

grasp::Contact At(const Vector3d& p, const Vector3d& n) { return {p, n, {}}; }

/// Return a plan on a cube of side 2: a hold by two crossed pairs, a finger switch, and a sliding
/// step.
plan::Plan MakeCubePlan() {
  plan::Plan plan;
  plan.friction_angle = kFrictionAngle;
  plan.fingers = 5;
  plan.initial = {{FingerIndex(0), At({1, 0.1, 0}, -Vector3d::UnitX())},
                  {FingerIndex(1), At({-1, 0, 0.1}, Vector3d::UnitX())},
                  {FingerIndex(2), At({0, 1, -0.1}, -Vector3d::UnitY())},
                  {FingerIndex(3), At({0.1, -1, 0}, Vector3d::UnitY())}};
  plan.steps.push_back(
      plan::Switch{{{FingerIndex(4), At({1, -0.1, 0.1}, -Vector3d::UnitX())}}, {FingerIndex(0)}});
  const plan::FingerGrasp before = plan::GraspAfter(plan.initial, plan.steps[0]);
  plan::FingerGrasp after = before;
  after[0].contact.p.y() += 0.1;
  after[2].contact.p.z() -= 0.1;
  plan.steps.push_back(plan::Align{{before, after}});
  plan.goal = plan::ContactsOf(after);
  return plan;
}

EntryProof WrittenAndRead(const EntryProof& proof) {
  const Json json = ParseJson(FormatJson(EntryProofJson(proof, 3)), "proof");
  return ReadEntryProof(plan::JsonReader(json, "proof"), 3);
}

TEST(PlanProofTest, EveryEntryIsProvedBeforeAndAfterItIsWritten) {
  const plan::Plan plan = MakeCubePlan();
  std::vector<EntryProof> proofs = FindPlanProofs(plan, kFrictionAngle, 3);
  ASSERT_EQ(proofs.size(), 3U);
  ASSERT_EQ(proofs[2].motions.size(), 1U);
  for (int round = 0; round < 2; ++round) {
    const auto verdicts = CheckPlanProofs(plan, kMu, proofs);
    ASSERT_EQ(verdicts.size(), 3U);
    for (const EntryVerdict& verdict : verdicts) EXPECT_TRUE(verdict.proved()) << verdict.index;
    EXPECT_EQ(verdicts[2].kind, "align");
    for (EntryProof& proof : proofs) proof = WrittenAndRead(proof);
  }
}

/// Return a sliding step of four contacts on four sides of a cube of side 2 `half`.
/// The contacts are in one inclined plane. They move from opposite positions to `apart` half sides
/// off them.
plan::Plan AlignInOnePlane(double half, double lean, double apart) {
  const auto grasp = [&](double off) {
    plan::FingerGrasp held;
    for (FingerIndex f{0}; f < 4; ++f) {
      Vector3d p = Vector3d::Zero();
      p[f % 2] = f < 2 ? half : -half;
      p[1 - f % 2] = (f < 2 ? 1 : -1) * off * half;
      p.z() = lean * p.x() - 0.7 * lean * p.y();
      const Vector3d n = -p[f % 2] / half * Vector3d::Unit(f % 2);
      held.push_back({f, {p, n}});
    }
    return held;
  };
  plan::Plan plan;
  plan.friction_angle = Radians(45);
  plan.fingers = 5;
  plan.initial = grasp(0.1 * apart);
  plan.steps = {plan::Align{{plan.initial, grasp(apart)}}};
  plan.goal = plan::ContactsOf(grasp(apart));
  return plan;
}

TEST(PlanProofTest, EveryAlignThatTheCheckPassesIsProvedInWriting) {
  const object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
  const double half = file.object->diameter() / std::sqrt(12.0);
  // Contacts in one plane, including grasps close to the limit of friction.
  int checked = 0;
  for (const double lean : {0.0, 0.1, 0.3, 0.5}) {
    for (const double apart : {0.1, 0.3}) {
      for (const double above : {1e-6, 1e-3, 0.1}) {
        plan::Plan plan = AlignInOnePlane(half, lean, apart);
        const auto needed = plan::CheckPlan(*file.object, plan).steps[1].required;
        ASSERT_TRUE(needed);
        plan.friction_angle = needed->upper + above;
        const plan::PlanCheck check = plan::CheckPlan(*file.object, plan);
        ASSERT_TRUE(check.passed()) << check.steps[1].detail;
        std::vector<EntryProof> proofs = FindPlanProofs(check.projected, plan.friction_angle, 2);
        for (EntryProof& proof : proofs) proof = WrittenAndRead(proof);
        for (const EntryVerdict& verdict :
             CheckPlanProofs(check.projected, std::tan(plan.friction_angle), proofs)) {
          SCOPED_TRACE(testing::Message() << lean << " " << apart << " " << above);
          EXPECT_TRUE(verdict.rest.proves()) << verdict.index << verdict.rest.why;
          for (const motion::ProofVerdict& motion : verdict.motions)
            EXPECT_TRUE(motion.proves()) << motion.why;
        }
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 24);
}

TEST(PlanProofTest, ThePlansOwnProofsAreTakenWhereTheyHold) {
  plan::Plan plan = MakeCubePlan();
  auto& align = std::get<plan::Align>(plan.steps[1]);
  align.certificate = FindPlanProofs(plan, kFrictionAngle, 3)[2].motions;
  for (Vector3d& force : (*align.certificate)[0][0].start) force *= 0.5;
  for (Vector3d& force : (*align.certificate)[0][0].end) force *= 0.5;
  const motion::MotionSegment given = (*align.certificate)[0][0];
  EXPECT_EQ(FindPlanProofs(plan, kFrictionAngle, 3)[2].motions[0][0].start, given.start);
  for (Vector3d& force : (*align.certificate)[0][0].start) force *= -1;
  const auto proofs = FindPlanProofs(plan, kFrictionAngle, 3);
  EXPECT_NE(proofs[2].motions[0][0].start, (*align.certificate)[0][0].start);
  EXPECT_TRUE(CheckPlanProofs(plan, kMu, proofs)[2].proved());
}

TEST(PlanProofTest, ProofsOfAnotherPlanProveNothing) {
  const plan::Plan plan = MakeCubePlan();
  const auto proofs = FindPlanProofs(plan, kFrictionAngle, 3);
  plan::Plan other = plan;
  other.initial[0].contact.p.y() += 0.7;
  EXPECT_FALSE(CheckPlanProofs(other, kMu, proofs)[0].proved());
  EXPECT_FALSE(CheckPlanProofs(plan, kMu / 10, proofs)[1].proved());
}

TEST(PlanProofTest, AWayWithoutAProofIsNotProved) {
  const plan::Plan plan = MakeCubePlan();
  auto proofs = FindPlanProofs(plan, kFrictionAngle, 3);
  proofs[2].motions.clear();
  const auto verdicts = CheckPlanProofs(plan, kMu, proofs);
  EXPECT_EQ(verdicts[2].rest.kind, Kind::kForceClosure);
  EXPECT_FALSE(verdicts[2].proved());
}

TEST(PlanProofTest, AGraspThatLosesTheObjectIsRefuted) {
  plan::Plan plan = MakeCubePlan();
  plan.steps[0] = plan::Switch{{}, {FingerIndex(0), FingerIndex(1)}};
  plan.steps.pop_back();
  const auto proofs = FindPlanProofs(plan, kFrictionAngle, 2);
  for (const auto& proof : {proofs[1], WrittenAndRead(proofs[1])}) {
    const std::vector<EntryProof> both = {proofs[0], proof};
    EXPECT_EQ(CheckPlanProofs(plan, kMu, both)[1].rest.kind, Kind::kNotForceClosure);
  }
  plan.steps[0] = plan::Switch{{}, {FingerIndex(2)}};
  plan.initial[1].contact.p.y() = 0.9;
  const auto three = FindPlanProofs(plan, kFrictionAngle, 2);
  EXPECT_EQ(CheckPlanProofs(plan, kMu, three)[1].rest.kind, Kind::kNotForceClosure);
  EXPECT_EQ(
      CheckPlanProofs(plan, kMu, std::vector<EntryProof>{three[0], WrittenAndRead(three[1])})[1]
          .rest.kind,
      Kind::kNotForceClosure);
}

TEST(PlanProofTest, BrokenProofsAreBadInput) {
  for (const char* text :
       {R"({})", R"({"rest": {}})", R"({"rest": {"forces": [[1, 2]]}})",
        R"({"rest": {"line": [1]}})", R"({"rest": {"line": [-1, 2]}})",
        R"({"rest": null, "ways": [[{"from": 0}]]})", R"({"rest": {"twist": {"v": [0, 0, 0]}}})"}) {
    const Json json = ParseJson(text, "proof");
    EXPECT_THROW((void)ReadEntryProof(plan::JsonReader(json, "proof"), 3), InputError) << text;
  }
  const plan::Plan plan = MakeCubePlan();
  EXPECT_THROW((void)CheckPlanProofs(plan, kMu, std::vector<EntryProof>(4)), std::invalid_argument);
}

}  // namespace plan_proof_test
}  // namespace regrasp::certificate
