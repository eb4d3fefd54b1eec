#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/base/error.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/force_closure.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "planner/sets/contour/contour_planner.h"
#include "planner/sets/contour/set_geometry.h"
#include "planner/sets/polygon/set_cells.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = planning::GraspChoice::Kind;
using Status = planning::PlanResult::Status;

planning::PlanRequest Options(double degrees, std::uint64_t seed = 0,
                              planning::Objective aim = planning::Objective::kSteps) {
  planning::PlanRequest options;
  options.criteria.half_angle = Radians(degrees);
  options.seed = seed;
  options.objective = aim;
  return options;
}

object::Polygon Model(const std::string& name) {
  const object::ObjectFile file =
      object::ReadObject(std::string(REGRASP_SOURCE_DIR) + "/models/" + name);
  return dynamic_cast<const object::Polygon&>(*file.object);
}

const std::vector<NamedPolygon>& Objects() {
  static const std::vector<NamedPolygon> objects = {
      {"polygon20", Model("polygon20.wkt")},
      {"polygon30", Model("polygon30.wkt")},
      {"polygon40", Model("polygon40.wkt")},
      {"polygon_hole", Model("polygon_hole.wkt")},
      {"irregular 128", IrregularOutline(128, 0.9, 4)},
      {"disc", RegularPolygon(24)},
      {"annulus", Annulus(16, 1, 0.6)},
      {"fork", Fork()},
      {"irregular", IrregularOutline(60, 0.8, 3)}};
  return objects;
}

grasp::Grasp MakeGrasp(const object::Polygon& polygon,
                       const std::vector<std::pair<int, double>>& places) {
  grasp::Grasp grasp;
  for (const auto& [edge, u] : places)
    grasp.push_back(grasp::ContactAt(polygon, FaceIndex(edge), u));
  return grasp;
}

/// What the checker, which knows nothing of the planner, says of a plan.
void ExpectGoodPlan(const object::Polygon& polygon, const planning::PlanResult& result) {
  ASSERT_EQ(result.status, Status::kFound) << result.message;
  const plan::Plan& plan = *result.plan;
  const plan::PlanCheck check = plan::CheckPlan(polygon, plan);
  for (const plan::StepCheck& step : check.steps) {
    EXPECT_EQ(plan::ReasonName(step.reason), "") << "step " << step.index << ": " << step.detail;
  }
  EXPECT_TRUE(check.passed());
  EXPECT_EQ(plan.planner, "contour");
  EXPECT_EQ(plan.fingers, kContourFingers);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (const auto* step = std::get_if<plan::Switch>(&plan.steps[i])) {
      EXPECT_THAT(step->place, SizeIs(1));
      EXPECT_THAT(step->release, SizeIs(1));
    } else {
      // Two aligns in a row would be one.
      EXPECT_TRUE(i == 0 || std::holds_alternative<plan::Switch>(plan.steps[i - 1])) << i;
    }
  }
}

/// The regions that the plan's switches claim, in their order.
std::vector<double> RegionsOf(const plan::Plan& plan) {
  std::vector<double> regions;
  for (const plan::Step& step : plan.steps) {
    const auto* change = std::get_if<plan::Switch>(&step);
    if (change == nullptr) continue;
    for (const plan::FingerContact& placed : change->place)
      regions.push_back(placed.region.value_or(-1));
  }
  return regions;
}

/// The grasps before and after each switch.
std::vector<std::array<grasp::Grasp, 2>> SwitchGrasps(const plan::Plan& plan) {
  std::vector<std::array<grasp::Grasp, 2>> grasps;
  plan::FingerGrasp holding = plan.initial;
  for (const plan::Step& step : plan.steps) {
    const plan::FingerGrasp after = plan::GraspAfter(holding, step);
    if (std::holds_alternative<plan::Switch>(step)) {
      grasps.push_back({plan::ContactsOf(holding), plan::ContactsOf(after)});
    }
    holding = after;
  }
  return grasps;
}

/// The sets that a plan passes.
std::vector<int> SetsOf(const object::Polygon& polygon, const plan::Plan& plan) {
  const ContourGraph graph(polygon, plan.half_angle);
  const SetGeometry geometry(graph);
  std::vector<int> sets;
  for (const auto& grasps : SwitchGrasps(plan)) {
    for (const grasp::Grasp& grasp : grasps) {
      sets.push_back(graph.set_of(geometry.Locate(grasp)->piece));
    }
  }
  return sets;
}

/// The contact a length along the boundary farther.
grasp::Contact Moved(const Boundary& boundary, const grasp::Contact& contact, double by) {
  const int ring = boundary.ring_of(contact.face);
  double place = std::fmod(boundary.PlaceOf(contact) + by, boundary.perimeter(ring));
  if (place < 0) place += boundary.perimeter(ring);
  int edge = boundary.first_edge(ring);
  while (edge + 1 < boundary.first_edge(ring + 1) && place > boundary.end(edge)) ++edge;
  return boundary.ContactAt(edge, place);
}

class PlanOnContourAt : public testing::TestWithParam<double> {};

TEST_P(PlanOnContourAt, LeadsFromARandomGraspToAnother) {
  int switches = 0;
  int corners = 0;
  for (const auto& [name, polygon] : Objects()) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      for (const planning::Objective aim :
           {planning::Objective::kSteps, planning::Objective::kRegions}) {
        SCOPED_TRACE(name + ", seed " + std::to_string(seed));
        const planning::PlanResult result =
            PlanWith(ContourPlanner(), polygon, Random(), Random(), Options(GetParam(), seed, aim));
        ExpectGoodPlan(polygon, result);
        for (const plan::Step& step : result.plan->steps) {
          if (const auto* align = std::get_if<plan::Align>(&step)) {
            corners += static_cast<int>(align->waypoints.size()) / 2 - 1;
          } else {
            ++switches;
          }
        }
      }
    }
  }
  EXPECT_GT(switches, 50);
  EXPECT_GT(corners, 30);
}

TEST_P(PlanOnContourAt, OptimisedSwitchesHaveRegionsAtLeastAsLarge) {
  int compared = 0;
  int larger = 0;
  for (const auto& [name, polygon] : Objects()) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const planning::PlanResult room =
          PlanWith(ContourPlanner(), polygon, Random(), Random(),
                   Options(GetParam(), seed, planning::Objective::kSteps));
      ASSERT_TRUE(room.plan);
      const planning::PlanResult region = PlanWith(
          ContourPlanner(), polygon, Given(plan::ContactsOf(room.plan->initial)),
          Given(room.plan->goal), Options(GetParam(), seed, planning::Objective::kRegions));
      ASSERT_TRUE(region.plan);
      // Otherwise a switch was too weak for one of the two, and they went different ways.
      if (SetsOf(polygon, *room.plan) != SetsOf(polygon, *region.plan)) continue;
      const std::vector<double> of_room = RegionsOf(*room.plan);
      const std::vector<double> of_region = RegionsOf(*region.plan);
      for (std::size_t i = 0; i < of_room.size(); ++i) {
        EXPECT_GE(of_room[i], 0) << name;
        EXPECT_GE(of_region[i], (1 - 1e-9) * of_room[i]) << name << ", seed " << seed;
        ++compared;
        if (of_region[i] > 1.1 * of_room[i]) ++larger;
      }
    }
  }
  EXPECT_GT(compared, 30);
  EXPECT_GT(larger, compared / 3);
}

TEST_P(PlanOnContourAt, InsideTheirRegionsContactsStandAnywhere) {
  int seen = 0;
  int outside_lost = 0;
  for (const auto& [name, polygon] : Objects()) {
    const planning::PlanResult result =
        PlanWith(ContourPlanner(), polygon, Random(), Random(),
                 Options(GetParam(), 5, planning::Objective::kRegions));
    ASSERT_TRUE(result.plan);
    const Boundary boundary(polygon);
    const std::vector<double> regions = RegionsOf(*result.plan);
    const auto grasps = SwitchGrasps(*result.plan);
    ASSERT_EQ(regions.size(), grasps.size());
    RandomStream random(7, RandomUse::kStart);
    const auto holds = [&](const grasp::Grasp& grasp, double x, double y) {
      return grasp::IsForceClosure(
          grasp::Grasp{Moved(boundary, grasp[0], x), Moved(boundary, grasp[1], y)},
          polygon.wrench_frame(), result.plan->half_angle);
    };
    for (std::size_t i = 0; i < grasps.size(); ++i) {
      bool lost = false;
      for (const grasp::Grasp& grasp : grasps[i]) {
        // Corners and random places, a millionth inside.
        for (int k = 0; k < 200; ++k) {
          const double h = (1 - 1e-6) * regions[i];
          const double x = k < 4 ? (k % 2 == 0 ? h : -h) : h * (2 * random.Uniform() - 1);
          const double y = k < 4 ? (k < 2 ? h : -h) : h * (2 * random.Uniform() - 1);
          EXPECT_TRUE(holds(grasp, x, y)) << name << ", switch " << i;
          ++seen;
        }
        // A little outside along its border force closure is lost somewhere, for one of the two.
        for (int k = 0; k < 800; ++k) {
          const double h = 1.02 * regions[i];
          const double t = h * (2 * random.Uniform() - 1);
          const double side = k % 2 == 0 ? h : -h;
          lost = lost || !(k % 4 < 2 ? holds(grasp, t, side) : holds(grasp, side, t));
        }
        for (const double x : {-1.02, 1.02}) {
          for (const double y : {-1.02, 1.02}) {
            lost = lost || !holds(grasp, x * regions[i], y * regions[i]);
          }
        }
      }
      if (lost) ++outside_lost;
    }
  }
  EXPECT_GT(seen, 2000);
  EXPECT_GT(outside_lost, 5);
}

INSTANTIATE_TEST_SUITE_P(Degrees, PlanOnContourAt, testing::Values(10.0, 15.0, 25.0));

TEST(PlanOnContour, GoesAroundADiscByOneAlign) {
  const object::Polygon disc = RegularPolygon(24);
  const grasp::Grasp start = MakeGrasp(disc, {{0, 0.5}, {12, 0.5}});
  const grasp::Grasp goal = MakeGrasp(disc, {{8, 0.5}, {20, 0.5}});
  const planning::PlanResult result =
      PlanWith(ContourPlanner(), disc, Given(start), Given(goal), Options(15));
  ExpectGoodPlan(disc, result);
  ASSERT_THAT(result.plan->steps, SizeIs(1));
  const auto& align = std::get<plan::Align>(result.plan->steps[0]);
  // Each finger passes eight corners, or four if they meet the goal the other way round.
  EXPECT_GE(align.waypoints.size(), 2U + 2 * 2 * 4);
  EXPECT_LE(align.waypoints.size(), 2U + 2 * 2 * 8);
}

TEST(PlanOnContour, SaysNoExactlyWhereTheSetsAreNotJoined) {
  int joined = 0;
  int apart = 0;
  for (const auto& [name, polygon] : TwelveEdgePolygons()) {
    for (const double degrees : {10.0, 20.0}) {
      const ContourGraph graph(polygon, Radians(degrees));
      SetGeometry geometry(graph);
      const search::Components components = graph.components();
      RandomStream random(3, RandomUse::kGoal);
      for (int a = 0; a < graph.vertex_count(); ++a) {
        for (int b = 0; b < std::min(graph.vertex_count(), 6); ++b) {
          const auto start = geometry.Draw(a, random);
          const auto goal = geometry.Draw(b, random);
          if (!start || !goal) continue;
          const planning::PlanResult result =
              PlanWith(ContourPlanner(), polygon, Given(geometry.GraspOf(*start)),
                       Given(geometry.GraspOf(*goal)), Options(degrees));
          if (components.of_vertex[a] == components.of_vertex[b]) {
            ++joined;
            ExpectGoodPlan(polygon, result);
          } else {
            ++apart;
            EXPECT_EQ(result.status, Status::kNoSequence) << name;
            EXPECT_THAT(result.message, HasSubstr("no sequence of switches and aligns leads"));
          }
        }
      }
    }
  }
  EXPECT_GT(joined, 100);
  EXPECT_GT(apart, 50);
}

TEST(PlanOnContour, HasNothingToDoWhereTheGoalIsTheStart) {
  const object::Polygon square = Square(1);
  const grasp::Grasp start = MakeGrasp(square, {{0, 0.5}, {2, 0.5}});
  const grasp::Grasp same = {start[1], start[0]};
  const planning::PlanResult result =
      PlanWith(ContourPlanner(), square, Given(start), Given(same), Options(10));
  ASSERT_EQ(result.status, Status::kFound);
  EXPECT_THAT(result.plan->steps, IsEmpty());
}

TEST(PlanOnContour, IsTheSameBitForBit) {
  const object::Polygon polygon = Model("polygon40.wkt");
  const auto text = [&](std::uint64_t seed) {
    return plan::FormatPlan(
        *PlanWith(ContourPlanner(), polygon, Random(), Random(), Options(20, seed)).plan);
  };
  EXPECT_EQ(text(4), text(4));
  EXPECT_NE(text(4), text(5));
}

TEST(PlanOnContour, RefusesGraspsThatDoNotServe) {
  const object::Polygon square = Square(1);
  const grasp::Grasp good = MakeGrasp(square, {{0, 0.5}, {2, 0.5}});
  const grasp::Grasp three = MakeGrasp(square, {{0, 0.5}, {2, 0.5}, {1, 0.5}});
  const grasp::Grasp leaning = MakeGrasp(square, {{0, 0.1}, {2, 0.1}});
  EXPECT_THROW((void)PlanWith(ContourPlanner(), square, Given(three), Given(good), Options(10)),
               InputError);
  EXPECT_THROW((void)PlanWith(ContourPlanner(), square, Given(leaning), Given(good), Options(10)),
               InputError);
  EXPECT_THROW((void)PlanWith(ContourPlanner(), square, Given(good), Given(good), Options(0)),
               std::invalid_argument);
  planning::PlanRequest options = Options(10);
  options.criteria.min_quality = -1;
  EXPECT_THROW((void)PlanWith(ContourPlanner(), square, Given(good), Given(good), options),
               std::invalid_argument);
}

TEST(PlanOnContour, RandomGraspsAreAsGoodAsAsked) {
  const object::Polygon polygon = Model("polygon30.wkt");
  for (const planning::GraspChoice& choice : {Random(), RandomAny()}) {
    planning::PlanRequest options = Options(20, 9);
    options.criteria.min_quality = 0.05;
    const planning::PlanResult result =
        PlanWith(ContourPlanner(), polygon, choice, choice, options);
    ASSERT_TRUE(result.plan) << result.message;
    const criteria::GraspEvaluator evaluator(
        polygon, {options.criteria.half_angle, options.criteria.min_quality});
    EXPECT_TRUE(evaluator.IsGood(plan::ContactsOf(result.plan->initial)));
    EXPECT_TRUE(evaluator.IsGood(result.plan->goal));
    options.criteria.min_quality = 10;
    EXPECT_EQ(PlanWith(ContourPlanner(), polygon, choice, choice, options).status,
              Status::kNoGrasp);
  }
}

}  // namespace
}  // namespace regrasp::contour
