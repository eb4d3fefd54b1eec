#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/grasp/force_closure.h"
#include "planner/sets/contour/contour_planner.h"
#include "planner/sets/contour/set_geometry.h"
#include "planner/sets/polygon/set_cells.h"
#include "tests/fixtures/edge_grasp.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace plan_contour_test {

using testing::HasSubstr;
using testing::SizeIs;
using Status = planning::PlanResult::Status;

planning::PlanRequest RegionsAt(double degrees, std::uint64_t seed) {
  planning::PlanRequest request = RequestAt(degrees, seed);
  request.objective = planning::Objective::kRegions;
  return request;
}

const std::vector<NamedPolygon>& Objects() {
  static const std::vector<NamedPolygon> objects = {
      {"polygon20", ReadPlanarModel("polygon20.wkt")},
      {"polygon30", ReadPlanarModel("polygon30.wkt")},
      {"polygon40", ReadPlanarModel("polygon40.wkt")},
      {"polygon_hole", ReadPlanarModel("polygon_hole.wkt")},
      {"irregular 128", IrregularOutline(128, 0.9, 4)},
      {"disc", RegularPolygon(24)},
      {"annulus", Annulus(16, 1, 0.6)},
      {"fork", Fork()},
      {"irregular", IrregularOutline(60, 0.8, 3)}};
  return objects;
}

/// Check that the plan passes the checker, switches one finger at a time and has no two consecutive
/// sliding steps.
void ExpectGood(const object::Polygon& polygon, const planning::PlanResult& result) {
  ExpectGoodPlan(ContourPlanner(), polygon, result);
  ExpectOneFingerInEverySwitch(result.plan.value());
  ExpectNoAlignAfterAnAlign(*result.plan);
}

/// Return the contact regions in the plan's switches, in order.
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

/// Return the grasps before and after each switch.
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

/// Return the sets that a plan passes.
std::vector<sets::SetIndex> SetsOf(const object::Polygon& polygon, const plan::Plan& plan) {
  const ContourGraph graph(polygon, plan.friction_angle);
  const SetGeometry geometry(graph);
  std::vector<sets::SetIndex> sets;
  for (const auto& grasps : SwitchGrasps(plan)) {
    for (const grasp::Grasp& grasp : grasps) {
      sets.push_back(graph.set_of(geometry.Locate(grasp)->piece));
    }
  }
  return sets;
}

/// Move a contact by a length along the boundary.
grasp::Contact Moved(const Boundary& boundary, const grasp::Contact& contact, double by) {
  const RingIndex ring = boundary.ring_of(contact.face);
  double place = std::fmod(boundary.PlaceOf(contact) + by, boundary.perimeter(ring));
  if (place < 0) place += boundary.perimeter(ring);
  FaceIndex edge = boundary.first_edge(ring);
  while (edge + 1 < boundary.end_edge(ring) && place > boundary.end(edge)) ++edge;
  return boundary.ContactAt(edge, place);
}

class PlanOnContourAt : public testing::TestWithParam<double> {};

TEST_P(PlanOnContourAt, LeadsFromARandomGraspToAnother) {
  int switches = 0;
  int corners = 0;
  for (const auto& [name, polygon] : Objects()) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      for (const planning::PlanRequest& request :
           {RequestAt(GetParam(), seed), RegionsAt(GetParam(), seed)}) {
        SCOPED_TRACE(name + ", seed " + std::to_string(seed));
        const planning::PlanResult result =
            PlanWith(ContourPlanner(), polygon, Random(), Random(), request);
        ExpectGood(polygon, result);
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
      const planning::PlanResult margin =
          PlanWith(ContourPlanner(), polygon, Random(), Random(), RequestAt(GetParam(), seed));
      ASSERT_TRUE(margin.plan);
      const planning::PlanResult region =
          PlanWith(ContourPlanner(), polygon, Given(plan::ContactsOf(margin.plan->initial)),
                   Given(margin.plan->goal), RegionsAt(GetParam(), seed));
      ASSERT_TRUE(region.plan);
      // Skip different paths: one plan avoids a switch that does not meet its criteria.
      if (SetsOf(polygon, *margin.plan) != SetsOf(polygon, *region.plan)) continue;
      const std::vector<double> of_margin = RegionsOf(*margin.plan);
      const std::vector<double> of_region = RegionsOf(*region.plan);
      for (std::size_t i = 0; i < of_margin.size(); ++i) {
        EXPECT_GE(of_margin[i], 0) << name;
        EXPECT_GE(of_region[i], (1 - 1e-9) * of_margin[i]) << name << ", seed " << seed;
        ++compared;
        if (of_region[i] > 1.1 * of_margin[i]) ++larger;
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
        PlanWith(ContourPlanner(), polygon, Random(), Random(), RegionsAt(GetParam(), 5));
    ASSERT_TRUE(result.plan);
    const Boundary boundary(polygon);
    const std::vector<double> regions = RegionsOf(*result.plan);
    const auto grasps = SwitchGrasps(*result.plan);
    ASSERT_EQ(regions.size(), grasps.size());
    RandomStream random(7, RandomUse::kStart);
    const auto holds = [&](const grasp::Grasp& grasp, double x, double y) {
      return grasp::IsForceClosure(
          grasp::Grasp{Moved(boundary, grasp[0], x), Moved(boundary, grasp[1], y)},
          polygon.wrench_frame(), result.plan->friction_angle);
    };
    for (std::size_t i = 0; i < grasps.size(); ++i) {
      bool lost = false;
      for (const grasp::Grasp& grasp : grasps[i]) {
        // Corners and random places, a millionth inside the region.
        for (int k = 0; k < 200; ++k) {
          const double h = (1 - 1e-6) * regions[i];
          const double x = k < 4 ? (k % 2 == 0 ? h : -h) : h * (2 * random.Uniform() - 1);
          const double y = k < 4 ? (k < 2 ? h : -h) : h * (2 * random.Uniform() - 1);
          EXPECT_TRUE(holds(grasp, x, y)) << name << ", switch " << i;
          ++seen;
        }
        // Slightly outside the region, one of the two grasps loses force closure at some place.
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
      PlanWith(ContourPlanner(), disc, Given(start), Given(goal), RequestAt(15));
  ExpectGood(disc, result);
  ASSERT_THAT(result.plan->steps, SizeIs(1));
  const auto& align = std::get<plan::Align>(result.plan->steps[0]);
  // Each finger passes eight corners, or four if they reach the goal with exchanged fingers.
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
      for (sets::SetIndex a{0}; a < graph.vertex_count(); ++a) {
        for (sets::SetIndex b{0}; b < std::min(graph.vertex_count(), 6); ++b) {
          const auto start = geometry.Draw(a, random);
          const auto goal = geometry.Draw(b, random);
          if (!start || !goal) continue;
          const planning::PlanResult result =
              PlanWith(ContourPlanner(), polygon, Given(geometry.GraspOf(*start)),
                       Given(geometry.GraspOf(*goal)), RequestAt(degrees));
          if (components.of_vertex[a] == components.of_vertex[b]) {
            ++joined;
            ExpectGood(polygon, result);
          } else {
            ++apart;
            EXPECT_EQ(result.status, Status::kNoSequence) << name;
            EXPECT_THAT(result.message, HasSubstr("no sequence of switches and sliding steps"));
          }
        }
      }
    }
  }
  EXPECT_GT(joined, 100);
  EXPECT_GT(apart, 50);
}

}  // namespace plan_contour_test
}  // namespace regrasp::contour
