#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/number.h"
#include "planner/plan/check.h"
#include "sample_plans.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace check_align_test {

/// Return a plan whose only step slides from the first to the last waypoint.
Plan AlignPlan(Plan plan, std::vector<FingerGrasp> waypoints) {
  plan.initial = waypoints.front();
  plan.goal = ContactsOf(waypoints.back());
  plan.steps = {Align{std::move(waypoints)}};
  return plan;
}

Reason ReasonOf(const object::Object& object, const Plan& plan) {
  const PlanCheck check = CheckPlan(object, plan);
  EXPECT_EQ(check.steps[0].reason, Reason::kNone) << check.steps[0].detail;
  return check.steps[1].reason;
}

/// Return a plan in which finger 1 slides from `from` to `to`, while the two other fingers hold the
/// object along z at `hold`.
Plan SlideOnTop(const Eigen::Vector2d& hold, const Eigen::Vector3d& from,
                const Eigen::Vector3d& to) {
  const auto grasp = [&](const Eigen::Vector3d& at) {
    return FingerGrasp{{FingerIndex(0), {{hold.x(), hold.y(), 0}, {0, 0, 1}}},
                       {FingerIndex(1), {at, {0, 0, -1}}},
                       {FingerIndex(2), {{hold.x(), hold.y(), 1}, {0, 0, -1}}}};
  };
  return AlignPlan(EmptyPlan(3, 5, 30), {grasp(from), grasp(to)});
}

TEST(CheckAlign, KeepsFingersInsideAFaceThatIsNotConvex) {
  const object::Polyhedron block = MakeLBlock();
  const Eigen::Vector2d hold(0.5, 0.4);
  const Eigen::Vector3d arm(0.5, 2.5, 1);
  EXPECT_EQ(ReasonOf(block, SlideOnTop(hold, arm, {0.6, 0.5, 1})), Reason::kNone);
  EXPECT_EQ(ReasonOf(block, SlideOnTop(hold, arm, {1, 1, 1})), Reason::kNone);
  EXPECT_EQ(ReasonOf(block, SlideOnTop(hold, arm, {2.5, 0.5, 1})), Reason::kLeavesFace);
  EXPECT_EQ(ReasonOf(block, SlideOnTop(hold, arm, {1.02, 0.99, 1})), Reason::kLeavesFace);
}

TEST(CheckAlign, DoesNotBeginBeyondASlit) {
  // Narrower than the precision of points.
  const double width = 1e-6;
  const object::Polyhedron block =
      MakePrism({{0, 0}, {1, 0}, {1, 1}, {1 + width, 1}, {1 + width, 0}, {3, 0}, {3, 2}, {0, 2}});
  Plan plan = SlideOnTop({1.5, 1.5}, {1 + width, 0.5, 1}, {2, 0.5, 1});
  plan.friction_angle = Radians(60);
  EXPECT_EQ(ReasonOf(block, plan), Reason::kNone);
  plan.initial[1].contact.p.x() = 1;
  EXPECT_EQ(ReasonOf(block, plan), Reason::kDiscontinuous);
  plan.initial[1].contact.p = {1 + width, 0.5 + 1e-6, 1};
  EXPECT_EQ(ReasonOf(block, plan), Reason::kNone);
}

TEST(CheckAlign, KeepsFingersFromCrossingAHoleOfAFace) {
  const object::Polyhedron ring = MakeRing();
  const Eigen::Vector2d hold(-2, 0.5);
  const Eigen::Vector3d left(-2, 0, 1);
  EXPECT_EQ(ReasonOf(ring, SlideOnTop(hold, left, {0, 2, 1})), Reason::kNone);
  EXPECT_EQ(ReasonOf(ring, SlideOnTop(hold, left, {2, 0, 1})), Reason::kLeavesFace);
  // Next to the hole's corner at (−1, 1), on either side of it.
  EXPECT_EQ(ReasonOf(ring, SlideOnTop(hold, left, {0, 2.001, 1})), Reason::kNone);
  EXPECT_EQ(ReasonOf(ring, SlideOnTop(hold, left, {0, 1.999, 1})), Reason::kLeavesFace);
}

TEST(CheckAlign, LetsAFingerTurnWhereTwoFacesMeet) {
  const auto grasp = [](const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    return FingerGrasp{{FingerIndex(0), {{1, 0, 0}, {-1, 0, 0}}},
                       {FingerIndex(1), {{-1, 0, 0}, {1, 0, 0}}},
                       {FingerIndex(2), {p, n}}};
  };
  const object::Polyhedron cube = MakeCube();
  const FingerGrasp back = grasp({0, 1, 0.8}, {0, -1, 0});
  const FingerGrasp edge_back = grasp({0, 1, 1}, {0, -1, 0});
  const FingerGrasp edge_top = grasp({0, 1, 1}, {0, 0, -1});
  const FingerGrasp top = grasp({0, 0.8, 1}, {0, 0, -1});
  // At 50° the finger can always exert a force towards the line through the other two.
  const Plan plan = EmptyPlan(3, 5, 50);
  EXPECT_EQ(ReasonOf(cube, AlignPlan(plan, {back, edge_back, edge_top, top})), Reason::kNone);
  EXPECT_EQ(ReasonOf(cube, AlignPlan(plan, {back, edge_back, top})), Reason::kLeavesFace);
  EXPECT_EQ(ReasonOf(cube, AlignPlan(plan, {back, edge_top, top})), Reason::kLeavesFace);
  EXPECT_EQ(ReasonOf(cube, AlignPlan(plan, {back, top})), Reason::kLeavesFace);
}

TEST(CheckAlign, JudgesForceClosureWhileANormalTurns) {
  // Finger 1 turns at the corner (1, 1) of a square from the right edge to the upper one. Finger 0
  // is in the opposite corner. With normals on the diagonal no friction is required; at the ends of
  // the turn 45° are.
  const object::Polygon square = MakeSquare();
  const auto grasp = [](const Eigen::Vector3d& n0, const Eigen::Vector3d& n1) {
    return FingerGrasp{{FingerIndex(0), {{-1, -1, 0}, n0}}, {FingerIndex(1), {{1, 1, 0}, n1}}};
  };
  const FingerGrasp from = grasp({1, 0, 0}, {-1, 0, 0});
  const FingerGrasp to = grasp({0, 1, 0}, {0, -1, 0});
  const PlanCheck check = CheckPlan(square, AlignPlan(EmptyPlan(2, 4, 46), {from, to}));
  EXPECT_TRUE(check.passed());
  ASSERT_TRUE(check.steps[1].required);
  EXPECT_NEAR(Degrees(check.steps[1].required->lower), 45, 0.01);
  EXPECT_NEAR(Degrees(check.steps[1].required->upper), 45, 0.02);
  EXPECT_EQ(CheckPlan(square, AlignPlan(EmptyPlan(2, 4, 44.9), {from, to})).steps[0].reason,
            Reason::kNotForceClosure);
}

TEST(CheckAlign, KeepsCollinearEdgesOfAPolygonApart) {
  const auto grasp = [](double x) {
    return FingerGrasp{{FingerIndex(0), {{x, -1, 0}, {0, 1, 0}}},
                       {FingerIndex(1), {{0, 1, 0}, {0, -1, 0}}}};
  };
  const Plan plan = EmptyPlan(2, 4, 30);
  const auto slide = AlignPlan(plan, {grasp(-0.3), grasp(0.3)});
  const auto stop = AlignPlan(plan, {grasp(-0.3), grasp(0), grasp(0.3)});
  EXPECT_EQ(ReasonOf(MakeSquare(), slide), Reason::kNone);
  EXPECT_EQ(ReasonOf(MakeSquare(1, true), slide), Reason::kLeavesFace);
  EXPECT_EQ(ReasonOf(MakeSquare(1, true), stop), Reason::kLeavesFace);
}

TEST(CheckAlign, GoesOverFromAnEdgeToACollinearOneAtTheirVertex) {
  const auto grasp = [](double x) {
    return FingerGrasp{{FingerIndex(0), {{x, -1, 0}, {0, 1, 0}}},
                       {FingerIndex(1), {{0, 1, 0}, {0, -1, 0}}}};
  };
  const object::Polygon square = MakeSquare(1, true);
  const Plan plan = EmptyPlan(2, 4, 30);
  for (const double sign : {1.0, -1.0}) {
    const auto over = AlignPlan(plan, {grasp(-0.3 * sign), grasp(0), grasp(0), grasp(0.3 * sign)});
    EXPECT_EQ(ReasonOf(square, over), Reason::kNone);
    const Align projected = std::get<Align>(ProjectPlan(square, over).steps.front());
    const auto face = [&](int waypoint) { return projected.waypoints[waypoint][0].contact.face; };
    EXPECT_EQ(face(0), face(1));
    EXPECT_NE(face(1), face(2));
    EXPECT_EQ(face(2), face(3));
    // The finger cannot pass two vertices in one segment.
    EXPECT_EQ(ReasonOf(square, AlignPlan(plan, {grasp(-0.3 * sign), grasp(0.3 * sign)})),
              Reason::kLeavesFace);
  }
}

/// Return two fingers of the square, below and above.
FingerGrasp Pair(double below, double above) {
  return {{FingerIndex(0), {{below, -1, 0}, {0, 1, 0}}},
          {FingerIndex(1), {{above, 1, 0}, {0, -1, 0}}}};
}

TEST(CheckAlign, FindsForceClosureLostOnlyOnTheWay) {
  const object::Polygon square = MakeSquare();
  const Plan plan = EmptyPlan(2, 4, 20);
  // Finger 1 moves only after finger 0 has arrived: they are opposite before and after, but not in
  // between.
  const PlanCheck late =
      CheckPlan(square, AlignPlan(plan, {Pair(-0.9, -0.9), Pair(0.9, -0.9), Pair(0.9, 0.9)}));
  EXPECT_EQ(late.steps[1].reason, Reason::kNotForceClosure);
  EXPECT_FALSE(late.steps[1].force_closure);
  ASSERT_TRUE(late.steps[1].required);
  EXPECT_NEAR(late.steps[1].required->upper, std::atan(0.9), 2e-4);
  const PlanCheck together = CheckPlan(square, AlignPlan(plan, {Pair(-0.9, -0.9), Pair(0.9, 0.9)}));
  EXPECT_TRUE(together.passed());
  ASSERT_TRUE(together.steps[1].required);
  EXPECT_LT(together.steps[1].required->upper, 2e-4);
}

TEST(CheckAlign, RefusesAMotionAtItsCriticalFriction) {
  const object::Polygon square = MakeSquare();
  Plan plan = AlignPlan(EmptyPlan(2, 4, 20), {Pair(-0.8, -0.3), Pair(-0.3, 0.2)});
  plan.friction_angle = std::atan(0.25);
  EXPECT_FALSE(CheckPlan(square, plan).passed());
  plan.friction_angle += 1e-8;
  EXPECT_TRUE(CheckPlan(square, plan).passed());
}

/// Return a plan in which three fingers hold a cube and the third passes the position of the first.
/// At that instant, which is between the waypoints, all fingers are collinear and no friction is
/// sufficient.
Plan CollinearForAnInstant(double from, double to) {
  const auto grasp = [](double y) {
    return FingerGrasp{{FingerIndex(0), {{1, 0, 0}, {-1, 0, 0}}},
                       {FingerIndex(1), {{-1, 0, 0}, {1, 0, 0}}},
                       {FingerIndex(2), {{1, y, 0}, {-1, 0, 0}}}};
  };
  return AlignPlan(EmptyPlan(3, 5, 30), {grasp(from), grasp(to)});
}

TEST(CheckAlign, DoesNotPassWhatItCannotProve) {
  const object::Polyhedron cube = MakeCube();
  const PlanCheck check = CheckPlan(cube, CollinearForAnInstant(-0.3, 0.4));
  const StepCheck& step = check.steps[1];
  EXPECT_FALSE(check.passed());
  EXPECT_EQ(step.reason, Reason::kNotProved);
  EXPECT_FALSE(step.force_closure);
  EXPECT_FALSE(step.required);
  EXPECT_GT(step.undecided, 0);
  EXPECT_THAT(step.detail, testing::HasSubstr("0.4286 of the path from waypoint 0 to waypoint 1"));
  // If bisection hits this instant, force closure is lost.
  EXPECT_EQ(CheckPlan(cube, CollinearForAnInstant(-0.4, 0.4)).steps[1].reason,
            Reason::kNotForceClosure);
  EXPECT_TRUE(CheckPlan(cube, CollinearForAnInstant(0.1, 0.8)).passed());
}

TEST(CheckAlign, PassesWhatItCannotProveWhereThatIsAllowed) {
  const object::Polyhedron cube = MakeCube();
  const CheckOptions allowed = {.allow_undecided = true};
  const PlanCheck check = CheckPlan(cube, CollinearForAnInstant(-0.3, 0.4), allowed);
  EXPECT_TRUE(check.passed());
  EXPECT_TRUE(check.steps[1].force_closure);
  EXPECT_GT(check.steps[1].undecided, 0);
  EXPECT_EQ(CheckPlan(cube, CollinearForAnInstant(-0.4, 0.4), allowed).steps[1].reason,
            Reason::kNotForceClosure);
  // The same result if a waypoint is at this instant.
  Plan plan = CollinearForAnInstant(-0.3, 0.4);
  auto& waypoints = std::get<Align>(plan.steps[0]).waypoints;
  waypoints.insert(waypoints.begin() + 1, waypoints.front());
  waypoints[1][2].contact.p.y() = 0;
  EXPECT_EQ(CheckPlan(cube, plan, allowed).steps[1].reason, Reason::kNotForceClosure);
  // Undecided instants of all segments are counted.
  Plan both = CollinearForAnInstant(-0.3, 0.4);
  auto& ways = std::get<Align>(both.steps[0]).waypoints;
  ways.push_back(ways.front());
  both.goal = ContactsOf(ways.front());
  EXPECT_GT(CheckPlan(cube, both, allowed).steps[1].undecided, check.steps[1].undecided);
}

/// Finger 0 turns at a corner while the other fingers slide up a wall, both uniformly. The angle
/// between its normal and the line to finger 1 is kTurn + atan(kTurn t) − kTurn t, which is near
/// its maximum for a long time. The other fingers, slightly above finger 1, do not help.
struct TurnAndSlide {
  static constexpr double kTurn = 0.3;
  object::Polygon body = object::Polygon::FromRings(
      {{{0, 0}, {0, -1}, {1, -1}, {1, 1}, {std::tan(kTurn), 1}}}, "body");
  Plan plan;

  TurnAndSlide(int fingers, double above) {
    const auto grasp = [&](const Eigen::Vector3d& n, double y) {
      FingerGrasp held = {{FingerIndex(0), {{0, 0, 0}, n}}};
      for (FingerIndex f{1}; f < fingers; ++f) {
        held.push_back({f, {{1, y + 1e-3 * (f - 1), 0}, {-1, 0, 0}}});
      }
      return held;
    };
    plan = AlignPlan(EmptyPlan(2, fingers, 20),
                     {grasp({std::cos(kTurn), -std::sin(kTurn), 0}, 0), grasp({1, 0, 0}, kTurn)});
    plan.friction_angle = kTurn + above;
  }
};

TEST(CheckAlign, SaysWhereTheSearchForProofsEnded) {
  const TurnAndSlide close(2, 1e-9);
  for (const bool allow_undecided : {false, true}) {
    const StepCheck step =
        CheckPlan(close.body, close.plan, {.allow_undecided = allow_undecided}).steps[1];
    EXPECT_EQ(step.reason, Reason::kNotProved);
    EXPECT_FALSE(step.force_closure);
    EXPECT_THAT(step.detail, testing::HasSubstr("the search for proofs ended at"));
    EXPECT_EQ(step.fault.grasp.size(), 2u) << "the grasp there, for a picture";
    EXPECT_EQ(step.fault.waypoint, 0);
  }
  EXPECT_TRUE(CheckPlan(close.body, TurnAndSlide(2, 1e-4).plan).passed());
}

TEST(CheckAlign, EndsWhereTheWorkThatAPlanMayTakeIsDone) {
  // The motion and its reverse: with 60 fingers the reverse exceeds the remaining budget.
  const auto check = [](int fingers) {
    TurnAndSlide sample(fingers, 1e-4);
    auto& waypoints = std::get<Align>(sample.plan.steps[0]).waypoints;
    waypoints.push_back(waypoints.front());
    sample.plan.goal = ContactsOf(waypoints.front());
    return CheckPlan(sample.body, sample.plan).steps[1];
  };
  EXPECT_EQ(check(2).reason, Reason::kNone);
  const StepCheck step = check(60);
  EXPECT_EQ(step.reason, Reason::kNotProved);
  EXPECT_EQ(step.undecided, 0);
  EXPECT_THAT(step.detail, testing::HasSubstr("the search for proofs ended at"));
  EXPECT_THAT(step.detail, testing::HasSubstr("from waypoint 1 to waypoint 2"));
}

TEST(CheckAlign, JudgesTheWayAtTheFrictionOfTheOptions) {
  // The fingers are opposite before and after. In between they are far apart, and require 42°.
  const Plan plan =
      AlignPlan(EmptyPlan(2, 4, 60), {Pair(-0.9, -0.9), Pair(0.9, -0.9), Pair(0.9, 0.9)});
  const object::Polygon square = MakeSquare();
  EXPECT_TRUE(CheckPlan(square, plan).passed());
  const StepCheck less = CheckPlan(square, plan, {.friction_angle = Radians(40)}).steps[1];
  EXPECT_EQ(less.reason, Reason::kNotForceClosure);
  Plan weak = plan;
  weak.friction_angle = Radians(20);
  EXPECT_FALSE(CheckPlan(square, weak).passed());
  EXPECT_TRUE(CheckPlan(square, weak, {.friction_angle = Radians(43)}).passed());
}

TEST(CheckAlign, PassesOnlyWithARequiredHalfAngleWithinTheFriction) {
  const object::Polygon square = MakeSquare();
  // Slightly above the required friction, the bounds of single grasps are wider than the margin.
  int passed = 0;
  for (const double above : {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-5, 1e-3}) {
    Plan plan = AlignPlan(EmptyPlan(2, 4, 20), {Pair(-0.8, -0.3), Pair(-0.3, 0.2)});
    plan.friction_angle = std::atan(0.25) + above;
    const PlanCheck check = CheckPlan(square, plan);
    if (!check.passed()) continue;
    ++passed;
    for (const StepCheck& step : check.steps) {
      ASSERT_TRUE(step.required);
      EXPECT_LE(step.required->lower, step.required->upper);
      EXPECT_LE(step.required->upper, plan.friction_angle);
    }
  }
  EXPECT_GE(passed, 4);
}

}  // namespace check_align_test
}  // namespace regrasp::plan
