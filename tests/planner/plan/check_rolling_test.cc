#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"
#include "planner/plan/check.h"
#include "planner/plan/projection.h"
#include "sample_plans.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace check_rolling_test {

using Eigen::Vector3d;

/// Return a plan on MakeCube() whose only step is an in-hand motion. Fingers 0 to 3 hold the
/// middles of ±x and ±z, and finger 4 rolls on +y through the given contacts.
Plan RollOnTop(const std::vector<grasp::Contact>& contacts) {
  Plan plan = EmptyPlan(3, 5, 30);
  Move move;
  for (const grasp::Contact& contact : contacts) {
    move.contacts.push_back({{FingerIndex(0), {{-1, 0, 0}, {1, 0, 0}}},
                             {FingerIndex(1), {{1, 0, 0}, {-1, 0, 0}}},
                             {FingerIndex(2), {{0, 0, -1}, {0, 0, 1}}},
                             {FingerIndex(3), {{0, 0, 1}, {0, 0, -1}}},
                             {FingerIndex(4), contact}});
    move.path.emplace_back();
  }
  plan.initial = move.contacts.front();
  plan.goal = ContactsOf(move.contacts.back());
  plan.steps = {move};
  return plan;
}

const grasp::Contact kStart = {{0, 1, 0}, {0, -1, 0}};

/// Contact on the edge between +y and +z whose normal is rotated from that of +y.
grasp::Contact OnEdge(double degrees) {
  const double a = Radians(degrees);
  return {{0, 1, 1}, {0, -std::cos(a), -std::sin(a)}};
}

StepCheck CheckOf(const Plan& plan) { return CheckPlan(MakeCube(), plan).steps.at(1); }

Reason ReasonOf(const Plan& plan) {
  EXPECT_EQ(CheckPlan(MakeCube(), plan).steps.at(0).reason, Reason::kNone);
  return CheckOf(plan).reason;
}

TEST(CheckRolling, ContactsMoveOnFacesAndOverEdges) {
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, {{0, 1, 0.8}, {0, -1, 0}}})), Reason::kNone);
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, OnEdge(0), OnEdge(45)})), Reason::kNone);
  const grasp::Contact beyond = {{0, 0.8, 1}, {0, 0, -1}};
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, OnEdge(0), OnEdge(45), OnEdge(90), beyond})),
            Reason::kNone);
}

TEST(CheckRolling, ContactsLeaveNeitherTheSurfaceNorItsNormals) {
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, {{0, 1.02, 0.2}, {0, -1, 0}}})), Reason::kOffSurface);
  const Vector3d tilted(0, -std::cos(0.1), -std::sin(0.1));
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, {{0, 1, 0.2}, tilted}})), Reason::kWrongNormal);
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, OnEdge(-20)})), Reason::kWrongNormal);
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, OnEdge(110)})), Reason::kWrongNormal);
  EXPECT_EQ(ReasonOf(RollOnTop({kStart, {{0, 1, 0.2}, {0, -2, 0}}})), Reason::kWrongNormal);
}

TEST(CheckRolling, TheFirstContactsAreThoseBeforeTheStep) {
  Plan plan = RollOnTop({kStart, {{0, 1, 0.8}, {0, -1, 0}}});
  plan.initial[4].contact.p.z() = 0.1;
  EXPECT_EQ(ReasonOf(plan), Reason::kDiscontinuous);
  plan = RollOnTop({kStart, kStart});
  std::get<Move>(plan.steps[0]).contacts[1].pop_back();
  EXPECT_EQ(CheckOf(plan).reason, Reason::kDiscontinuous);
}

/// Both ends are force closure, and a grasp between them is not.
TEST(CheckRolling, EveryGraspOnTheWayIsForceClosure) {
  // The line between two opposite contacts must be in both friction cones of 20°.
  const auto hold = [](double x) {
    return FingerGrasp{{FingerIndex(0), {{0, -1, 0}, {0, 1, 0}}},
                       {FingerIndex(1), {{x, 1, 0}, {0, -1, 0}}},
                       {FingerIndex(2), {{0, 0, -1}, {0, 0, 1}}}};
  };
  Plan plan = EmptyPlan(3, 3, 20);
  plan.initial = hold(0);
  plan.goal = ContactsOf(hold(0));
  const auto roll = [&](double x) {
    Move move{{{}, {}, {}}, {hold(0), hold(x), hold(0)}};
    plan.steps = {move};
    return CheckPlan(MakeCube(), plan).steps.at(1);
  };
  const StepCheck near = roll(0.2);
  const StepCheck far = roll(0.95);
  EXPECT_EQ(near.reason, Reason::kNone) << near.detail;
  EXPECT_EQ(far.reason, Reason::kNotForceClosure) << far.detail;
  // The required friction is that of the worst grasp, not that of the ends.
  EXPECT_GT(near.required->lower, CheckPlan(MakeCube(), plan).steps.at(0).required->upper);
}

/// Normals that differ by rounding, or by their length only, do not turn.
TEST(CheckRolling, RoundingOfNormalsIsNoRotation) {
  const double down = std::nextafter(-1.0, 0.0);
  const std::vector<grasp::Contact> contacts = {
      kStart, {{0, 1, 0.1}, {1e-17, down, -1e-17}}, {{0, 1, 0.2}, {0, -1, 1e-16}}};
  const Plan projected = ProjectPlan(MakeCube(), RollOnTop(contacts));
  for (const FingerGrasp& grasp : std::get<Move>(projected.steps[0]).contacts) {
    EXPECT_EQ(grasp[4].contact.n, kStart.n);
    EXPECT_TRUE(grasp[4].contact.face.valid());
  }
  EXPECT_EQ(ReasonOf(RollOnTop(contacts)), Reason::kNone);
  // A rotation of a microradian remains.
  const Plan turned = ProjectPlan(MakeCube(), RollOnTop({OnEdge(0), OnEdge(Degrees(1e-6))}));
  EXPECT_NE(std::get<Move>(turned.steps[0]).contacts[1][4].contact.n, OnEdge(0).n);
}

TEST(CheckRolling, GraspAfterTheStepHasTheRolledContacts) {
  const Plan plan = RollOnTop({kStart, OnEdge(0), OnEdge(45)});
  const FingerGrasp after = GraspAfter(plan.initial, plan.steps[0]);
  EXPECT_EQ(FindFinger(after, FingerIndex(4))->contact.n, OnEdge(45).n);
  EXPECT_EQ(GraspAfter(plan.initial, Move{})[4].contact.p, kStart.p) << "without rolling";
}

TEST(CheckRolling, PicturesHaveTheTrackOfTheContact) {
  Plan plan = RollOnTop({kStart, OnEdge(0)});
  plan.scale = 1;
  const Snapshot snapshot = MakePlannedSnapshot(plan, 1, {}, 0);
  ASSERT_EQ(snapshot.fingers.size(), 5u);
  EXPECT_EQ(snapshot.fingers[4].role, FingerRole::kMoved);
  EXPECT_EQ(snapshot.fingers[4].path_W.front(), kStart.p);
  EXPECT_EQ(snapshot.fingers[4].path_W.back(), OnEdge(0).p);
  EXPECT_EQ(snapshot.fingers[0].role, FingerRole::kHolding);
}

}  // namespace check_rolling_test
}  // namespace regrasp::plan
