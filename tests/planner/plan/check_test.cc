#include "planner/plan/check.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "check_expectations.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/read_object.h"
#include "sample_plans.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace check_test {

/// Change that makes a passing plan fail, with the failing entry and the reason.
struct Control {
  const char* name;
  std::function<void(Plan&)> change;
  int index;
  Reason reason;
};

void ExpectControlsFail(const object::Object& object, const Plan& plan,
                        const std::vector<Control>& controls) {
  ExpectPasses(CheckPlan(object, plan), "the plan that passes");
  int checked = 0;
  for (const Control& control : controls) {
    Plan changed = plan;
    control.change(changed);
    ExpectFails(CheckPlan(object, changed), control.index, control.reason, control.name);
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

Switch& SwitchOf(Plan& plan, int step) { return std::get<Switch>(plan.steps[step]); }
Align& AlignOf(Plan& plan, int step) { return std::get<Align>(plan.steps[step]); }

Eigen::Vector3d TurnedAboutZ(const Eigen::Vector3d& v, double degrees) {
  return Eigen::AngleAxisd(Radians(degrees), Eigen::Vector3d::UnitZ()) * v;
}

// Return the controls that are the same in space and in the plane. Both sample plans begin with a
// switch.
std::vector<Control> SharedControls() {
  return {
      {"an initial contact off the surface",
       [](Plan& plan) { plan.initial[0].contact.p *= 1 + 1e-4; }, 0, Reason::kOffSurface},
      {"an initial contact inside", [](Plan& plan) { plan.initial[0].contact.p *= 1 - 1e-4; }, 0,
       Reason::kOffSurface},
      {"a placed contact off the surface",
       [](Plan& plan) { SwitchOf(plan, 0).place[0].contact.p *= 1.001; }, 1, Reason::kOffSurface},
      {"a waypoint off the surface",
       [](Plan& plan) {
         std::get<Align>(plan.steps.back()).waypoints.back()[0].contact.p *= 1.001;
       },
       -1, Reason::kOffSurface},
      {"a normal that points outwards", [](Plan& plan) { plan.initial[0].contact.n *= -1; }, 0,
       Reason::kWrongNormal},
      {"a normal 0.2 degrees off",
       [](Plan& plan) { plan.initial[0].contact.n = TurnedAboutZ(plan.initial[0].contact.n, 0.2); },
       0, Reason::kWrongNormal},
      {"a normal too long", [](Plan& plan) { plan.initial[1].contact.n *= 1.001; }, 0,
       Reason::kWrongNormal},
      {"a placed contact with a wrong normal",
       [](Plan& plan) { SwitchOf(plan, 0).place[0].contact.n *= -1; }, 1, Reason::kWrongNormal},
      {"an initial grasp that names a finger twice",
       [](Plan& plan) { plan.initial[1].finger = plan.initial[0].finger; }, 0,
       Reason::kFingerNotFree},
      {"a placed finger that was already holding",
       [](Plan& plan) { SwitchOf(plan, 0).place[0].finger = FingerIndex(1); }, 1,
       Reason::kFingerNotFree},
      {"a switch that places a finger twice",
       [](Plan& plan) { SwitchOf(plan, 0).place.push_back(SwitchOf(plan, 0).place[0]); }, 1,
       Reason::kFingerNotFree},
      {"a released finger that is placed in the same step",
       [](Plan& plan) { SwitchOf(plan, 0).release[0] = SwitchOf(plan, 0).place[0].finger; }, 1,
       Reason::kFingerNotHolding},
      {"a switch that releases a finger twice",
       [](Plan& plan) { SwitchOf(plan, 0).release.push_back(SwitchOf(plan, 0).release[0]); }, 1,
       Reason::kFingerNotHolding},
      {"a released finger that no hand has",
       [](Plan& plan) { SwitchOf(plan, 0).release.push_back(FingerIndex(99)); }, 1,
       Reason::kFingerNotHolding},
      {"a hand with a finger too few", [](Plan& plan) { --plan.fingers; }, 1,
       Reason::kTooManyFingers},
      {"an initial grasp with a finger outside the hand",
       [](Plan& plan) { plan.initial[0].finger = FingerIndex(plan.fingers); }, 0,
       Reason::kTooManyFingers},
      {"a placed finger outside the hand",
       [](Plan& plan) { SwitchOf(plan, 0).place[0].finger = FingerIndex(plan.fingers); }, 1,
       Reason::kTooManyFingers},
      {"an initial grasp with two fingers at one point",
       [](Plan& plan) { plan.initial[1].contact = plan.initial[0].contact; }, 0,
       Reason::kCoincidentFingers},
      {"an align that begins where it should end",
       [](Plan& plan) {
         auto& waypoints = std::get<Align>(plan.steps.back()).waypoints;
         waypoints.front()[0].contact = waypoints.back()[0].contact;
       },
       -1, Reason::kDiscontinuous},
      {"an align that loses a finger on the way",
       [](Plan& plan) { std::get<Align>(plan.steps.back()).waypoints.back().pop_back(); }, -1,
       Reason::kDiscontinuous},
      {"an initial grasp without contacts", [](Plan& plan) { plan.initial.clear(); }, 0,
       Reason::kNotForceClosure},
      {"a goal with a contact too few", [](Plan& plan) { plan.goal.pop_back(); }, -1,
       Reason::kGoalNotReached},
      {"a goal off the last contacts", [](Plan& plan) { plan.goal[0].p = plan.goal[1].p; }, -1,
       Reason::kGoalNotReached},
      {"a goal with a normal turned", [](Plan& plan) { plan.goal[0].n *= -1; }, -1,
       Reason::kGoalNotReached},
      {"a plan that stops one step before its goal", [](Plan& plan) { plan.steps.pop_back(); }, -2,
       Reason::kGoalNotReached},
  };
}

/// Replace the indices −1 and −2 by those of the plan's last step and of the step before it.
std::vector<Control> ForPlan(std::vector<Control> controls, const Plan& plan) {
  for (Control& control : controls) {
    if (control.index < 0) control.index += static_cast<int>(plan.steps.size()) + 1;
  }
  return controls;
}

/// Return the sample plan's initial grasp and first switch.
Plan SwitchOnly() {
  Plan plan = CubePlan();
  plan.steps.resize(1);
  plan.goal = ContactsOf(GraspAfter(plan.initial, plan.steps[0]));
  plan.at_given_points = true;
  return plan;
}

/// Return the contact points of a plan.
std::vector<Eigen::Vector3d> PointsOf(Plan plan) {
  std::vector<Eigen::Vector3d> points;
  for (const FingerContact& finger : plan.initial) points.push_back(finger.contact.p);
  for (const FingerContact& finger : SwitchOf(plan, 0).place) points.push_back(finger.contact.p);
  return points;
}

TEST(CheckPlan, APlanAtGivenPointsHasItsContactsThere) {
  const object::Polyhedron cube = MakeCube();
  Plan plan = SwitchOnly();
  std::vector<Eigen::Vector3d> points = PointsOf(plan);
  ExpectPasses(CheckPlan(cube, plan, {.given_points = &points}), "at the points");
  points.front() += 0.9 * object::kAtGivenPoint * cube.diameter() * Eigen::Vector3d::UnitX();
  ExpectPasses(CheckPlan(cube, plan, {.given_points = &points}), "close to them");
  const double off = 2 * object::kAtGivenPoint * cube.diameter();
  points = PointsOf(plan);
  points.back() += off * Eigen::Vector3d::UnitX();
  const PlanCheck failed = CheckPlan(cube, plan, {.given_points = &points});
  ExpectFails(failed, 1, Reason::kOffPoint, "a placed contact elsewhere");
  EXPECT_NEAR(FarthestFromPoints(failed.projected, points), off, 1e-12);
  points.front() += off * Eigen::Vector3d::UnitY();
  ExpectFails(CheckPlan(cube, plan, {.given_points = &points}), 0, Reason::kOffPoint,
              "an initial contact elsewhere");
  ExpectPasses(CheckPlan(cube, plan), "where the points are not known");
  plan.at_given_points = false;
  ExpectPasses(CheckPlan(cube, plan, {.given_points = &points}), "a plan that promises nothing");
}

TEST(CheckPlan, APlanAtGivenPointsHasNoAligns) {
  const object::Polyhedron cube = MakeCube();
  Plan plan = CubePlan();
  plan.at_given_points = true;
  std::vector<Eigen::Vector3d> points;
  for (const Step& step : plan.steps) {
    const auto* align = std::get_if<Align>(&step);
    for (const FingerContact& finger : align ? align->waypoints.back() : FingerGrasp()) {
      points.push_back(finger.contact.p);
    }
    const auto* placing = std::get_if<Switch>(&step);
    for (const FingerContact& finger : placing ? placing->place : FingerGrasp()) {
      points.push_back(finger.contact.p);
    }
  }
  for (const FingerContact& finger : plan.initial) points.push_back(finger.contact.p);
  const PlanCheck check = CheckPlan(cube, plan, {.given_points = &points});
  const auto failed = std::ranges::find_if(
      check.steps, [](const StepCheck& step) { return step.reason != Reason::kNone; });
  ASSERT_NE(failed, check.steps.end());
  EXPECT_EQ(failed->kind, "align");
  EXPECT_EQ(failed->reason, Reason::kOffPoint);
}

TEST(CheckPlan, FailsEveryControlInSpaceForItsReason) {
  ExpectControlsFail(MakeCube(), CubePlan(), ForPlan(SharedControls(), CubePlan()));
}

TEST(CheckPlan, FailsEveryControlInThePlaneForItsReason) {
  ExpectControlsFail(MakeSquare(), SquarePlan(), ForPlan(SharedControls(), SquarePlan()));
}

TEST(CheckPlan, FailsControlsOfTheCubeForTheirReasons) {
  ExpectControlsFail(
      MakeCube(), CubePlan(),
      {
          {"a finger released that carries the grasp",
           [](Plan& plan) {
             SwitchOf(plan, 0).release = {FingerIndex(2), FingerIndex(0)};
           },
           1, Reason::kNotForceClosure},
          {"a finger placed where another holds",
           [](Plan& plan) { SwitchOf(plan, 0).place[0].contact = plan.initial[0].contact; }, 1,
           Reason::kCoincidentFingers},
          {"the first switch left out", [](Plan& plan) { plan.steps.erase(plan.steps.begin()); }, 1,
           Reason::kFingerNotFree},
          {"the second switch left out",
           [](Plan& plan) { plan.steps.erase(plan.steps.begin() + 1); }, 2, Reason::kDiscontinuous},
          {"an align with a finger that did not hold",
           [](Plan& plan) { AlignOf(plan, 2).waypoints[1][0].finger = FingerIndex(3); }, 3,
           Reason::kDiscontinuous},
          {"an align that a finger joins",
           [](Plan& plan) {
             for (FingerGrasp& waypoint : AlignOf(plan, 2).waypoints) {
               waypoint.push_back(plan.initial[3]);
             }
           },
           3, Reason::kDiscontinuous},
          {"an align that names a finger twice",
           [](Plan& plan) { AlignOf(plan, 2).waypoints[1][0].finger = FingerIndex(1); }, 3,
           Reason::kFingerNotFree},
          {"an align with a finger outside the hand",
           [](Plan& plan) { AlignOf(plan, 2).waypoints[1][0].finger = FingerIndex(8); }, 3,
           Reason::kTooManyFingers},
          {"an align without waypoints", [](Plan& plan) { AlignOf(plan, 2).waypoints.clear(); }, 3,
           Reason::kDiscontinuous},
          {"an align that goes to another face without a turn",
           [](Plan& plan) {
             AlignOf(plan, 2).waypoints[1][2].contact = {{0.2, 0.2, 1}, {0, 0, -1}};
           },
           3, Reason::kLeavesFace},
          {"an align that ends with two fingers at one point",
           [](Plan& plan) {
             FingerGrasp& last = AlignOf(plan, 2).waypoints.back();
             last[0].contact = {{1, 1, 0}, {-1, 0, 0}};
             last[2].contact = {{1, 1, 0}, {0, -1, 0}};
           },
           3, Reason::kCoincidentFingers},
          {"an align through a grasp that is not force closure",
           [](Plan& plan) {
             AlignOf(plan, 2).waypoints[1][0].contact.p = {1, 0.95, 0.95};
             AlignOf(plan, 2).waypoints[1][1].contact.p = {-1, -0.95, -0.95};
           },
           3, Reason::kNotForceClosure},
      });
}

TEST(CheckPlan, FailsControlsOfTheSquareForTheirReasons) {
  ExpectControlsFail(MakeSquare(), SquarePlan(),
                     {
                         {"a finger released that carries the grasp",
                          [](Plan& plan) {
                            SwitchOf(plan, 0).place.pop_back();
                            SwitchOf(plan, 0).release = {FingerIndex(0)};
                          },
                          1, Reason::kNotForceClosure},
                         {"a finger placed where another stays",
                          [](Plan& plan) {
                            SwitchOf(plan, 0).place[0].contact = plan.initial[0].contact;
                            SwitchOf(plan, 0).release = {FingerIndex(1)};
                          },
                          1, Reason::kCoincidentFingers},
                         {"an align that goes to another edge without a turn",
                          [](Plan& plan) {
                            AlignOf(plan, 1).waypoints[1][0].contact = {{0.5, 1, 0}, {0, -1, 0}};
                          },
                          2, Reason::kLeavesFace},
                         {"an align that ends where friction is too small",
                          [](Plan& plan) { AlignOf(plan, 1).waypoints[1][0].contact.p.y() = -0.9; },
                          2, Reason::kNotForceClosure},
                     });
}

TEST(CheckPlan, AcceptsContactsWithinTheTolerances) {
  for (const bool planar : {false, true}) {
    Plan plan = planar ? SquarePlan() : CubePlan();
    plan.initial[0].contact.p *= 1 + 1e-7;
    plan.initial[0].contact.n = TurnedAboutZ(plan.initial[0].contact.n, 0.05) * (1 + 5e-5);
    std::get<Align>(plan.steps.back()).waypoints.front()[0].contact.p *= 1 + 1e-7;
    if (planar) {
      ExpectPasses(CheckPlan(MakeSquare(), plan), "square");
    } else {
      ExpectPasses(CheckPlan(MakeCube(), plan), "cube");
    }
  }
}

TEST(CheckPlan, TolerancesAreThoseOfTheFormat) {
  const object::Polyhedron cube = MakeCube();
  const double point = 1e-6 * cube.diameter();
  // Change of the size of a tolerance, times a share.
  struct Case {
    const char* name;
    std::function<void(Plan&, double)> change;
    int index;
    Reason reason;
  };
  const std::vector<Case> cases = {
      {"a point above its face",
       [&](Plan& plan, double share) { plan.initial[0].contact.p.x() += share * point; }, 0,
       Reason::kOffSurface},
      {"a point below its face",
       [&](Plan& plan, double share) { plan.initial[0].contact.p.x() -= share * point; }, 0,
       Reason::kOffSurface},
      {"a normal's direction",
       [](Plan& plan, double share) {
         plan.initial[0].contact.n = TurnedAboutZ(plan.initial[0].contact.n, 0.1 * share);
       },
       0, Reason::kWrongNormal},
      {"a long normal",
       [](Plan& plan, double share) { plan.initial[0].contact.n *= 1 + 1e-4 * share; }, 0,
       Reason::kWrongNormal},
      {"a short normal",
       [](Plan& plan, double share) { plan.initial[0].contact.n *= 1 - 1e-4 * share; }, 0,
       Reason::kWrongNormal},
      {"where an align begins",
       [&](Plan& plan, double share) {
         AlignOf(plan, 2).waypoints[0][0].contact.p.y() += share * point;
       },
       3, Reason::kDiscontinuous},
      {"where it ends", [&](Plan& plan, double share) { plan.goal[0].p.y() += share * point; }, 3,
       Reason::kGoalNotReached},
  };
  for (const Case& one : cases) {
    Plan plan = CubePlan();
    one.change(plan, 0.95);
    ExpectPasses(CheckPlan(cube, plan), one.name);
    plan = CubePlan();
    one.change(plan, 1.05);
    ExpectFails(CheckPlan(cube, plan), one.index, one.reason, one.name);
  }
}

TEST(CheckPlan, ComparesStartAndGoalWithTheGivenGrasps) {
  const object::Polyhedron cube = MakeCube();
  const Plan plan = CubePlan();
  grasp::Grasp start = ContactsOf(plan.initial);
  std::swap(start[0], start[3]);
  grasp::Grasp goal = plan.goal;
  std::swap(goal[1], goal[2]);
  ExpectPasses(CheckPlan(cube, plan, {.start = &start, .goal = &goal}), "in another order");
  start[1].p.y() += 1e-3;
  ExpectFails(CheckPlan(cube, plan, {.start = &start}), 0, Reason::kStartDiffers, "start");
  goal[1].p += Eigen::Vector3d(1e-3, 1e-3, 1e-3);
  ExpectFails(CheckPlan(cube, plan, {.goal = &goal}), 3, Reason::kGoalNotReached, "goal");
  Plan promise = plan;
  promise.goal[0].p.y() += 1e-3;
  ExpectFails(CheckPlan(cube, promise, {.goal = &promise.goal}), 3, Reason::kGoalNotReached,
              "the given goal is the plan's, which it does not reach");
}

TEST(CheckPlan, AcceptsAnEmptyPlanThatIsAtItsGoal) {
  Plan plan = CubePlan();
  plan.steps.clear();
  ExpectFails(CheckPlan(MakeCube(), plan), 0, Reason::kGoalNotReached, "another goal");
  plan.goal = ContactsOf(plan.initial);
  ExpectPasses(CheckPlan(MakeCube(), plan), "at its goal");
}

TEST(CheckPlan, LetsFingersMeetOnlyWhileASwitchIsUnderWay) {
  // A spare finger takes over the contact of another finger: no static grasp has both.
  Plan plan = CubePlan();
  plan.steps = {Switch{{{FingerIndex(4), plan.initial[2].contact}}, {FingerIndex(2)}}};
  plan.goal = ContactsOf(plan.initial);
  ExpectPasses(CheckPlan(MakeCube(), plan), "taken over");
  SwitchOf(plan, 0).release.clear();
  ExpectFails(CheckPlan(MakeCube(), plan), 1, Reason::kCoincidentFingers, "both stay");
}

TEST(CheckPlan, LetsNoFingerIntoASealedCavity) {
  const auto inside = [](const grasp::Contact& contact) {
    return grasp::Contact{contact.p / 2, -contact.n};
  };
  ExpectControlsFail(MakeHollowCube(), CubePlan(),
                     {{"holds from inside",
                       [&](Plan& plan) {
                         for (FingerContact& held : plan.initial)
                           held.contact = inside(held.contact);
                       },
                       0, Reason::kUnreachable},
                      {"goes in from outside",
                       [&](Plan& plan) {
                         plan.steps[0] = Switch{
                             {{FingerIndex(4), inside(SwitchOf(plan, 0).place[0].contact)}}, {}};
                       },
                       1, Reason::kUnreachable}});
}

TEST(CheckPlan, ReportsTheFirstOfSeveralFaults) {
  Plan plan = CubePlan();
  plan.initial[1].contact.n *= -1;
  plan.initial[2].finger = FingerIndex(0);
  ExpectFails(CheckPlan(MakeCube(), plan), 0, Reason::kWrongNormal, "normal before finger");
  plan.initial[3].contact.p *= 1.1;
  ExpectFails(CheckPlan(MakeCube(), plan), 0, Reason::kOffSurface, "surface before normal");
}

TEST(CheckPlan, AFaultOfTheHandFailsAnyEntryThatHasNoOther) {
  const Plan plan = CubePlan();
  CheckOptions options;
  for (EntryIndex entry{0}; entry <= std::ssize(plan.steps); ++entry) {
    options.hand_faults = {{entry, Reason::kHandCollides, "two links touch"}};
    ExpectFails(CheckPlan(MakeCube(), plan, options), entry, Reason::kHandCollides,
                "entry " + std::to_string(entry));
  }
  Plan broken = plan;
  broken.initial[0].contact.p *= 1.1;
  options.hand_faults.front().entry = EntryIndex(0);
  ExpectFails(CheckPlan(MakeCube(), broken, options), 0, Reason::kOffSurface,
              "surface before hand");
}

TEST(CheckPlan, ACheckOfNothingDoesNotPass) { EXPECT_FALSE(PlanCheck().passed()); }

TEST(CheckPlan, RefusesAPlanOfAnotherDimension) {
  EXPECT_THROW(static_cast<void>(CheckPlan(MakeSquare(), CubePlan())), InputError);
}

TEST(CheckPlan, ProjectsContactsOntoTheirFaces) {
  Plan plan = CubePlan();
  plan.initial[0].contact.p.x() += 1e-7;
  plan.initial[1].contact.p.x() -= 1;
  const PlanCheck check = CheckPlan(MakeCube(), plan);
  EXPECT_EQ(check.projected.initial[0].contact.p.x(), 1);
  EXPECT_GE(check.projected.initial[0].contact.face, 0);
  EXPECT_EQ(check.projected.initial[1].contact.face, -1);
  EXPECT_EQ(check.projected.initial[1].contact.p, plan.initial[1].contact.p);
}

}  // namespace check_test
}  // namespace regrasp::plan
