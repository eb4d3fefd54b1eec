#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/error.h"
#include "planner/grasp/force_closure.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "planner/sets/polyhedron/focus_geometry.h"
#include "planner/sets/polyhedron/focus_view.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = planning::GraspChoice::Kind;
using Status = planning::PlanResult::Status;

planning::PlanRequest Options(double degrees, std::uint64_t seed,
                              planning::Spanning spanning = planning::Spanning::kAdaptive) {
  planning::PlanRequest options;
  options.criteria.half_angle = Radians(degrees);
  options.seed = seed;
  options.spanning = spanning;
  return options;
}

/// What the checker, which knows nothing of the planner, says of a plan.
void ExpectGoodPlan(const object::Polyhedron& body, const planning::PlanResult& result) {
  ASSERT_EQ(result.status, Status::kFound) << result.message;
  const plan::Plan& plan = *result.plan;
  const plan::PlanCheck check = plan::CheckPlan(body, plan);
  for (const plan::StepCheck& step : check.steps) {
    EXPECT_EQ(plan::ReasonName(step.reason), "") << "step " << step.index << ": " << step.detail;
  }
  EXPECT_TRUE(check.passed());
  EXPECT_EQ(plan.planner, "polyhedron");
  EXPECT_EQ(plan.fingers, kPolyhedronFingers);
  for (const plan::Step& step : plan.steps) {
    if (const auto* change = std::get_if<plan::Switch>(&step)) {
      EXPECT_THAT(change->place, SizeIs(1));
      EXPECT_THAT(change->release, SizeIs(1));
    }
  }
}

TEST(PlanOnPolyhedron, LeadsFromARandomGraspToAnother) {
  int switches = 0;
  int aligns = 0;
  int none = 0;
  for (const auto& [name, body] : SmallBodies()) {
    for (const planning::Spanning spanning : kBothSpannings) {
      for (const double degrees : {10.0, 25.0}) {
        for (const std::uint64_t seed : {1, 2, 3}) {
          SCOPED_TRACE(name + ", " + Name(spanning) + ", seed " + std::to_string(seed));
          const planning::PlanResult result = PlanWith(PolyhedronPlanner(), body, Random(),
                                                       Random(), Options(degrees, seed, spanning));
          if (result.status == Status::kNoGrasp) {
            ++none;
            continue;
          }
          ExpectGoodPlan(body, result);
          for (const plan::Step& step : result.plan->steps) {
            (std::holds_alternative<plan::Switch>(step) ? switches : aligns) += 1;
          }
        }
      }
    }
  }
  EXPECT_GT(switches, 50);
  EXPECT_GT(aligns, 20);
  // Uniform spanning at 25° has no grasps at all; with little friction some bodies have none so
  // good.
  EXPECT_LT(none, 60);
}

TEST(PlanOnPolyhedron, SaysNoExactlyWhereTheCellsAreNotJoined) {
  int joined = 0;
  int apart = 0;
  for (const auto& [name, body] : SmallBodies()) {
    PolyhedronGraph graph(body, Radians(14), planning::Spanning::kUniform);
    FocusGeometry geometry(body, graph);
    const search::Components components = graph.components();
    RandomStream random(3, RandomUse::kGoal);
    for (int i = 0; i < 40 && graph.vertex_count() > 0; ++i) {
      const int a = static_cast<int>(random.Index(graph.vertex_count()));
      const int b = static_cast<int>(random.Index(graph.vertex_count()));
      const auto start = geometry.Draw(a, random);
      const auto goal = geometry.Draw(b, random);
      ASSERT_TRUE(start && goal);
      const planning::PlanResult result =
          PlanWith(PolyhedronPlanner(), body, Given(geometry.GraspOf(*start)),
                   Given(geometry.GraspOf(*goal)), Options(14, 0, planning::Spanning::kUniform));
      SCOPED_TRACE(name + ", cells " + std::to_string(a) + " and " + std::to_string(b));
      if (components.of_vertex[a] == components.of_vertex[b]) {
        ++joined;
        ExpectGoodPlan(body, result);
      } else {
        ++apart;
        EXPECT_EQ(result.status, Status::kNoSequence);
        EXPECT_THAT(result.message, HasSubstr("focus cells the start's component has"));
      }
    }
  }
  EXPECT_GT(joined, 20);
  EXPECT_GT(apart, 5);
}

TEST(PlanOnPolyhedron, EveryRandomGraspIsForceClosureAndLocatedInItsCell) {
  int drawn = 0;
  for (const auto& [name, body] : SmallBodies()) {
    for (const double degrees : {8.0, 30.0}) {
      PolyhedronGraph graph(body, Radians(degrees), planning::Spanning::kAdaptive);
      FocusGeometry geometry(body, graph);
      RandomStream random(5, RandomUse::kStart);
      for (int cell = 0; cell < graph.vertex_count(); cell += 1 + graph.vertex_count() / 40) {
        const auto grasp = geometry.Draw(cell, random);
        ASSERT_TRUE(grasp);
        EXPECT_TRUE(
            grasp::IsForceClosure(geometry.GraspOf(*grasp), body.wrench_frame(), Radians(degrees)))
            << name << ", cell " << cell;
        const auto located = geometry.Locate(geometry.GraspOf(*grasp));
        EXPECT_TRUE(
            std::ranges::any_of(located, [&](const FocusGrasp& at) { return at.cell == cell; }))
            << name << ", cell " << cell;
        ++drawn;
      }
    }
  }
  EXPECT_GT(drawn, 200);
}

TEST(PlanOnPolyhedron, HasNothingToDoWhereTheGoalIsTheStart) {
  const object::Polyhedron& body = SmallBodies().front().body;
  const planning::PlanResult some =
      PlanWith(PolyhedronPlanner(), body, Random(), Random(), Options(15, 1));
  ASSERT_TRUE(some.plan) << some.message;
  grasp::Grasp start = plan::ContactsOf(some.plan->initial);
  grasp::Grasp same = start;
  std::ranges::reverse(same);
  const planning::PlanResult result =
      PlanWith(PolyhedronPlanner(), body, Given(start), Given(same), Options(15, 1));
  ASSERT_EQ(result.status, Status::kFound);
  EXPECT_THAT(result.plan->steps, IsEmpty());
}

TEST(PlanOnPolyhedron, IsTheSameBitForBit) {
  const object::Polyhedron& body = SmallBodies().back().body;
  const auto text = [&](std::uint64_t seed) {
    const planning::PlanResult result =
        PlanWith(PolyhedronPlanner(), body, Random(), Random(), Options(12, seed));
    return result.plan ? plan::FormatPlan(*result.plan) : result.message;
  };
  EXPECT_EQ(text(4), text(4));
  EXPECT_NE(text(4), text(5));
}

TEST(PlanOnPolyhedron, SaysWhichGraspIsNotConcurrent) {
  // Two pairs on opposite faces of a box: force closure, but no four normals span.
  const object::Polyhedron box = Box({2, 2, 2});
  const auto contact = [&](const Eigen::Vector3d& p) {
    const FaceIndex face = box.FacesNear(p, 1e-9).front();
    return grasp::Contact{p, box.inward_normal(face), face};
  };
  const grasp::Grasp grasp = {contact({-1, 0.1, 0}), contact({1, -0.1, 0}), contact({0, -1, 0.1}),
                              contact({0, 1, -0.1})};
  const grasp::Grasp other = {contact({-1, 0.2, 0}), contact({1, -0.2, 0}), contact({0, -1, 0.2}),
                              contact({0, 1, -0.2})};
  const planning::PlanResult result =
      PlanWith(PolyhedronPlanner(), box, Given(grasp), Given(other), Options(25, 0));
  EXPECT_EQ(result.status, Status::kNoGrasp);
  EXPECT_THAT(
      result.message,
      HasSubstr(
          "given.json: force closure, but four contacts on this body are nowhere concurrent"));
  EXPECT_EQ(PlanWith(PolyhedronPlanner(), box, Random(), Random(), Options(25, 0)).status,
            Status::kNoGrasp);
  EXPECT_FALSE(DescribeFocus(box, grasp, Radians(25)));
}

TEST(PlanOnPolyhedron, RefusesGraspsThatDoNotServe) {
  const object::Polyhedron& body = SmallBodies().front().body;
  const planning::PlanResult some =
      PlanWith(PolyhedronPlanner(), body, Random(), Random(), Options(15, 1));
  ASSERT_TRUE(some.plan) << some.message;
  const grasp::Grasp good = plan::ContactsOf(some.plan->initial);
  const grasp::Grasp three(good.begin(), good.begin() + 3);
  EXPECT_THROW((void)PlanWith(PolyhedronPlanner(), body, Given(three), Given(good), Options(15, 1)),
               InputError);
  EXPECT_THROW((void)PlanWith(PolyhedronPlanner(), body, Given(good), Given(three), Options(15, 1)),
               InputError);
  EXPECT_THROW((void)PlanWith(PolyhedronPlanner(), body, Random(), Random(), Options(0, 1)),
               std::invalid_argument);
  planning::PlanRequest options = Options(15, 1);
  options.criteria.min_quality = -1;
  EXPECT_THROW((void)PlanWith(PolyhedronPlanner(), body, Random(), Random(), options),
               std::invalid_argument);
  options.criteria.min_quality = 10;
  EXPECT_EQ(PlanWith(PolyhedronPlanner(), body, RandomAny(), Random(), options).status,
            Status::kNoGrasp);
}

TEST(FocusView, SeesItsContactsInsideTheRegionsOfTheirFaces) {
  int seen = 0;
  for (const auto& [name, body] : SmallBodies()) {
    PolyhedronGraph graph(body, Radians(12), planning::Spanning::kAdaptive);
    FocusGeometry geometry(body, graph);
    RandomStream random(9, RandomUse::kStart);
    for (int cell = 0; cell < graph.vertex_count(); cell += 1 + graph.vertex_count() / 10) {
      const auto drawn = geometry.Draw(cell, random);
      ASSERT_TRUE(drawn);
      const auto view = DescribeFocus(body, geometry.GraspOf(*drawn), Radians(12));
      ASSERT_TRUE(view) << name;
      const double tangent = graph.cells()[cell].tangent;
      for (const grasp::Contact& contact : geometry.GraspOf(*drawn)) {
        const Eigen::Vector3d line = view->focus - contact.p;
        const double height = std::abs(contact.n.dot(line));
        EXPECT_LE((line - contact.n.dot(line) * contact.n).norm(), tangent * height * (1 + 1e-9));
      }
      EXPECT_GE(view->regions.size(), 4U);
      for (const auto& region : view->regions) {
        for (const Eigen::Vector3d& p : region) {
          EXPECT_FALSE(body.FacesNear(p, 1e-9 * body.diameter()).empty());
        }
      }
      ++seen;
    }
  }
  EXPECT_GT(seen, 20);
}

}  // namespace
}  // namespace regrasp::polyhedron
