#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "planner/grasp/quality.h"
#include "planner/sets/polygon/graph_cells.h"
#include "planner/sets/polygon/polygon_planner.h"
#include "planner/sets/set_parameters.h"
#include "tests/fixtures/edge_grasp.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace plan_polygon_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Status = planning::PlanResult::Status;

/// Draw a random grasp of every type that the polygon has.
std::map<GraspType, grasp::Grasp> DrawEveryType(const object::Polygon& polygon, double degrees,
                                                std::uint64_t seed) {
  const PolygonGraph graph = MakeGraph(polygon, degrees, planning::Spanning::kAdaptive);
  GraphCells cells(polygon, graph);
  RandomStream random(seed, RandomUse::kStart);
  std::map<GraspType, std::vector<sets::SetIndex>> vertices;
  for (sets::SetIndex v{0}; v < graph.vertex_count(); ++v)
    vertices[graph.sets()[v].type].push_back(v);
  std::map<GraspType, grasp::Grasp> grasps;
  for (const auto& [type, all] : vertices) {
    // Sets that are too thin for doubles return no grasp.
    std::optional<PolygonPlace> place;
    while (!place) place = cells.Draw(all[random.Index(all.size())], random);
    grasps[type] = cells.GraspOf(*place);
  }
  return grasps;
}

/// Return whether two vertices that contain these grasps, or a part of them, are in one component.
bool AreJoined(const object::Polygon& polygon, double degrees, const grasp::Grasp& a,
               const grasp::Grasp& b) {
  const PolygonGraph graph = MakeGraph(polygon, degrees, planning::Spanning::kAdaptive);
  GraphCells cells(polygon, graph);
  const search::Components components = graph.components();
  for (const auto& of_a : cells.FindAttachments(a)) {
    for (const auto& of_b : cells.FindAttachments(b)) {
      if (components.of_vertex[of_a.place.set] == components.of_vertex[of_b.place.set]) return true;
    }
  }
  return false;
}

/// Check that the plan passes the checker and has no two consecutive sliding steps.
void ExpectGood(const object::Polygon& polygon, const planning::PlanResult& result,
                const grasp::Grasp& start, const grasp::Grasp& goal) {
  ExpectGoodPlan(PolygonPlanner(), polygon, result, start, goal);
  ExpectNoAlignAfterAnAlign(result.plan.value());
}

class PlanOnPolygonAt : public testing::TestWithParam<double> {};

TEST_P(PlanOnPolygonAt, LeadsFromEveryTypeToEveryType) {
  const double degrees = GetParam();
  int plans = 0;
  int apart = 0;
  std::vector<NamedPolygon> polygons = SmallPolygons();
  polygons.push_back({"square", Square(1)});
  polygons.push_back({"hexagon", RegularPolygon(6)});
  polygons.push_back({"polygon15", ReadPlanarModel("polygon15.wkt")});
  polygons.push_back({"polygon_hole", ReadPlanarModel("polygon_hole.wkt")});
  for (const auto& [name, polygon] : polygons) {
    for (const auto& [start_type, start] : DrawEveryType(polygon, degrees, 1)) {
      for (const auto& [goal_type, goal] : DrawEveryType(polygon, degrees, 2)) {
        SCOPED_TRACE(name + ", type " + std::to_string(static_cast<int>(start_type)) + " to " +
                     std::to_string(static_cast<int>(goal_type)));
        const planning::PlanResult result =
            PlanWith(PolygonPlanner(), polygon, Given(start), Given(goal), RequestAt(degrees));
        if (AreJoined(polygon, degrees, start, goal)) {
          ExpectGood(polygon, result, start, goal);
          ++plans;
        } else {
          EXPECT_EQ(result.status, Status::kNoSequence);
          EXPECT_FALSE(result.plan.has_value());
          ++apart;
        }
      }
    }
  }
  EXPECT_GT(plans, 15);
  RecordProperty("apart", apart);
}

INSTANTIATE_TEST_SUITE_P(FrictionAngles, PlanOnPolygonAt, testing::Values(10.0, 20.0, 40.0, 50.0),
                         [](const auto& info) {
                           return std::to_string(static_cast<int>(info.param)) + "degrees";
                         });

TEST(PlanOnPolygon, LeadsBetweenRandomGraspsOfTheModels) {
  int plans = 0;
  for (const char* name : {"square.wkt", "triangle.wkt", "polygon20.wkt", "polygon40.wkt"}) {
    const object::Polygon polygon = ReadPlanarModel(name);
    for (const double degrees : {15.0, 35.0}) {
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        SCOPED_TRACE(std::string(name) + ", seed " + std::to_string(seed));
        const planning::PlanResult result =
            PlanWith(PolygonPlanner(), polygon, Random(), Random(), RequestAt(degrees, seed));
        ASSERT_EQ(result.status, Status::kFound) << result.message;
        const grasp::Grasp start = plan::ContactsOf(result.plan->initial);
        ExpectGood(polygon, result, start, result.plan->goal);
        for (const grasp::Grasp* grasp : {&start, &result.plan->goal}) {
          EXPECT_TRUE(
              grasp::QualityAtLeast(*grasp, polygon.wrench_frame(), Radians(degrees), 0.01));
        }
        ++plans;
      }
    }
  }
  EXPECT_EQ(plans, 24);
}

TEST(PlanOnPolygon, RandomAnyDrawsTwoOrThreeContactsConnectedOrNot) {
  const object::Polygon polygon = ReadPlanarModel("polygon15.wkt");
  std::map<std::size_t, int> contacts;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const planning::PlanResult result =
        PlanWith(PolygonPlanner(), polygon, RandomAny(), RandomAny(), RequestAt(25, seed));
    if (result.status != Status::kFound) continue;
    const grasp::Grasp start = plan::ContactsOf(result.plan->initial);
    ExpectGood(polygon, result, start, result.plan->goal);
    ++contacts[start.size()];
  }
  EXPECT_GT(contacts[2], 0);
  EXPECT_GT(contacts[3], 0);
  EXPECT_THAT(contacts, SizeIs(2));
}

TEST(PlanOnPolygon, RandomAnyDrawsThreeContactsWhereNoTwoHold) {
  // At 20° the triangle has no 2-finger grasp.
  const object::Polygon triangle = ReadPlanarModel("triangle.wkt");
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const planning::PlanResult result =
        PlanWith(PolygonPlanner(), triangle, RandomAny(), RandomAny(), RequestAt(20, seed));
    ASSERT_EQ(result.status, Status::kFound) << result.message;
    EXPECT_THAT(result.plan->initial, SizeIs(3));
    EXPECT_THAT(result.plan->goal, SizeIs(3));
  }
}

TEST(PlanOnPolygon, OneAlignLeadsFromGraspToGraspOfASet) {
  const object::Polygon square = Square(1);
  const grasp::Grasp start = MakeGrasp(square, {{0, 0.3}, {2, 0.7}});
  const grasp::Grasp goal = MakeGrasp(square, {{2, 0.35}, {0, 0.65}});
  const planning::PlanResult result =
      PlanWith(PolygonPlanner(), square, Given(start), Given(goal), RequestAt(20));
  ExpectGood(square, result, start, goal);
  ASSERT_THAT(result.plan->steps, SizeIs(1));
  EXPECT_TRUE(std::holds_alternative<plan::Align>(result.plan->steps.front()));
}

TEST(PlanOnPolygon, TwoFingersAcrossTheSquareTurnByOneSwitch) {
  const object::Polygon square = Square(1);
  const grasp::Grasp start = MakeGrasp(square, {{0, 0.5}, {2, 0.5}});
  const grasp::Grasp goal = MakeGrasp(square, {{1, 0.5}, {3, 0.5}});
  const planning::PlanResult result =
      PlanWith(PolygonPlanner(), square, Given(start), Given(goal), RequestAt(20));
  ExpectGood(square, result, start, goal);
  ASSERT_THAT(result.plan->steps, SizeIs(1));
  const auto& step = std::get<plan::Switch>(result.plan->steps.front());
  EXPECT_THAT(step.place, SizeIs(2));
  EXPECT_THAT(step.release, SizeIs(2));
}

TEST(PlanOnPolygon, StartAndGoalMayHoldWithMoreContactsThanASetHas) {
  // No set on three edges of the square contains these grasps, but a set contains two of their
  // contacts.
  const object::Polygon square = Square(1);
  const grasp::Grasp start = MakeGrasp(square, {{0, 0.5}, {0, 0.25}, {2, 0.5}, {1, 0.75}});
  const grasp::Grasp goal = MakeGrasp(square, {{1, 0.5}, {3, 0.5}, {3, 0.25}});
  const planning::PlanResult result =
      PlanWith(PolygonPlanner(), square, Given(start), Given(goal), RequestAt(10));
  ExpectGood(square, result, start, goal);
  const auto& first = std::get<plan::Switch>(result.plan->steps.front());
  EXPECT_THAT(first.place, IsEmpty());
  EXPECT_FALSE(first.release.empty());
  const auto& last = std::get<plan::Switch>(result.plan->steps.back());
  EXPECT_FALSE(last.place.empty());
  EXPECT_THAT(last.release, IsEmpty());
}

TEST(PlanOnPolygon, RestsInGraspsOfTheQualityAskedForOrWarns) {
  const object::Polygon polygon = ReadPlanarModel("polygon20.wkt");
  int good = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const planning::PlanResult result =
        PlanWith(PolygonPlanner(), polygon, Random(), Random(), RequestAt(20, seed));
    ASSERT_EQ(result.status, Status::kFound);
    const std::vector<grasp::Grasp> rests = RestsOf(*result.plan);
    const bool all = std::all_of(rests.begin(), rests.end(), [&](const grasp::Grasp& grasp) {
      return grasp::QualityAtLeast(grasp, polygon.wrench_frame(), Radians(20), 0.01);
    });
    EXPECT_EQ(all, result.warnings.empty()) << "seed " << seed;
    good += all ? 1 : 0;
  }
  EXPECT_GE(good, 7);
}

TEST(PlanOnPolygon, WarnsOfTheWeakestStepWhereNoSequenceIsGoodEnough) {
  const object::Polygon square = Square(1);
  planning::PlanRequest options = RequestAt(20);
  options.criteria.min_quality = 0.9;  // higher than for any grasp at this friction
  const planning::PlanResult result =
      PlanWith(PolygonPlanner(), square, Given(MakeGrasp(square, {{0, 0.5}, {2, 0.5}})),
               Given(MakeGrasp(square, {{1, 0.5}, {3, 0.5}})), options);
  ASSERT_EQ(result.status, Status::kFound);
  ASSERT_THAT(result.warnings, SizeIs(1));
  EXPECT_THAT(result.warnings[0], AllOf(HasSubstr("below the required 0.9"), HasSubstr("step")));
}

TEST(PlanOnPolygon, SaysTheSizesOfTheComponentsWhereThereIsNoSequence) {
  constexpr double kDegrees = 3;
  const object::Polygon polygon = ReadPlanarModel("polygon15.wkt");
  const PolygonGraph graph = MakeGraph(polygon, kDegrees, planning::Spanning::kAdaptive);
  const search::Components components = graph.components();
  ASSERT_GT(components.count(), 1);
  GraphCells cells(polygon, graph);
  RandomStream random(1, RandomUse::kStart);
  int apart = 0;
  for (sets::SetIndex v{0}; v < graph.vertex_count(); ++v) {
    if (components.of_vertex[v] == components.of_vertex[0]) continue;
    const grasp::Grasp start = cells.GraspOf(*cells.Draw(v, random));
    const grasp::Grasp goal = cells.GraspOf(*cells.Draw(sets::SetIndex(0), random));
    if (AreJoined(polygon, kDegrees, start, goal)) continue;
    const planning::PlanResult result =
        PlanWith(PolygonPlanner(), polygon, Given(start), Given(goal), RequestAt(kDegrees));
    EXPECT_EQ(result.status, Status::kNoSequence);
    EXPECT_FALSE(result.plan.has_value());
    EXPECT_THAT(result.message, HasSubstr("no sequence of switches and sliding steps"));
    for (const sets::SetIndex vertex : {v, sets::SetIndex(0)}) {
      const int size = components.sizes[components.of_vertex[vertex]];
      EXPECT_THAT(result.message, HasSubstr(std::to_string(size)));
    }
    ++apart;
  }
  EXPECT_GT(apart, 0);
}

/// Make two pairs across the square whose torques cancel. The grasp needs very little friction, but
/// each pair alone is inclined by atan 0.2 = 11.3°.
grasp::Grasp MakePinwheel(const object::Polygon& square) {
  return MakeGrasp(square, {{0, 0.6}, {2, 0.6}, {1, 0.4}, {3, 0.4}});
}

TEST(PlanOnPolygon, SaysOfAGraspInNoSetThatItIsInNone) {
  const object::Polygon square = Square(1);
  const grasp::Grasp pinwheel = MakePinwheel(square);
  const grasp::Grasp pair = MakeGrasp(square, {{0, 0.5}, {2, 0.5}});
  const auto message = [&](const grasp::Grasp& from, const grasp::Grasp& to) {
    const planning::PlanResult result = PlanWith(PolygonPlanner(), square, Given(from, "from.json"),
                                                 Given(to, "to.json"), RequestAt(5));
    EXPECT_EQ(result.status, Status::kNoGrasp);
    EXPECT_FALSE(result.plan.has_value());
    return result.message;
  };
  EXPECT_THAT(message(pinwheel, pair), AllOf(HasSubstr("from.json"), HasSubstr("in none of")));
  EXPECT_THAT(message(pair, pinwheel), AllOf(HasSubstr("to.json"), HasSubstr("in none of")));
  // With enough friction for a pair alone, it can switch. If it is both start and goal, no step is
  // required.
  ExpectGood(square,
             PlanWith(PolygonPlanner(), square, Given(pinwheel), Given(pair), RequestAt(15)),
             pinwheel, pair);
  const planning::PlanResult same =
      PlanWith(PolygonPlanner(), square, Given(pinwheel), Given(pinwheel), RequestAt(5));
  ExpectGood(square, same, pinwheel, pinwheel);
  EXPECT_THAT(same.plan->steps, IsEmpty());
}

TEST(PlanOnPolygon, AGraspInNoSetComesToOneByASwitchOfItsOwn) {
  // The normals of a regular triangle span the plane up to 30°. With more friction, uniform
  // spanning has 2-finger grasps only. Two contacts of these rotated grasps are not among them.
  const object::Polygon triangle = RegularPolygon(3);
  const grasp::Grasp start = MakeGrasp(triangle, {{0, 0.4}, {1, 0.4}, {2, 0.4}});
  const grasp::Grasp goal = MakeGrasp(triangle, {{0, 0.6}, {1, 0.6}, {2, 0.6}});
  planning::PlanRequest options = RequestAt(35);
  const planning::PlanResult adaptive =
      PlanWith(PolygonPlanner(), triangle, Given(start), Given(goal), options);
  ExpectGood(triangle, adaptive, start, goal);
  ASSERT_THAT(adaptive.plan->steps, SizeIs(1));
  EXPECT_TRUE(std::holds_alternative<plan::Align>(adaptive.plan->steps.front()));
  options.parameters.Edit<sets::SetParameters>().spanning = planning::Spanning::kUniform;
  const planning::PlanResult uniform =
      PlanWith(PolygonPlanner(), triangle, Given(start), Given(goal), options);
  ExpectGood(triangle, uniform, start, goal);
  EXPECT_FALSE(std::get<plan::Switch>(uniform.plan->steps.front()).place.empty());
  EXPECT_FALSE(std::get<plan::Switch>(uniform.plan->steps.back()).place.empty());
}

TEST(PlanOnPolygon, FingersAtCornersLeaveFirstAndComeLast) {
  const object::Polygon square = Square(1);
  const grasp::Grasp start = MakeGrasp(square, {{0, 0.0}, {2, 1.0}});
  const grasp::Grasp goal = MakeGrasp(square, {{0, 1.0}, {2, 0.0}});
  const planning::PlanResult result =
      PlanWith(PolygonPlanner(), square, Given(start), Given(goal), RequestAt(20));
  ExpectGood(square, result, start, goal);
}

TEST(PlanOnPolygon, UniformSpanningNeverJoinsConcurrentAndParallelSets) {
  int joined_under_adaptive = 0;
  int plans = 0;
  for (const auto& [name, polygon] : SmallPolygons()) {
    const auto joined = [&](planning::Spanning spanning) {
      return MakeGraph(polygon, 20, spanning)
          .edge_count(GraspType::kConcurrent, GraspType::kParallel);
    };
    EXPECT_EQ(joined(planning::Spanning::kUniform), 0) << name;
    joined_under_adaptive += joined(planning::Spanning::kAdaptive) > 0 ? 1 : 0;
    planning::PlanRequest options = RequestAt(20, 1);
    options.parameters.Edit<sets::SetParameters>().spanning = planning::Spanning::kUniform;
    const planning::PlanResult result =
        PlanWith(PolygonPlanner(), polygon, Random(), Random(), options);
    if (result.status != Status::kFound) continue;
    ExpectGood(polygon, result, plan::ContactsOf(result.plan->initial), result.plan->goal);
    ++plans;
  }
  EXPECT_GT(joined_under_adaptive, 0);
  EXPECT_GT(plans, 3);
}

}  // namespace plan_polygon_test
}  // namespace regrasp::polygon
