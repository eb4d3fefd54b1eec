#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/grasp/force_closure.h"
#include "planner/sets/polyhedron/face_part.h"
#include "planner/sets/polyhedron/polyhedron_model.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/sets/set_parameters.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace plan_polyhedron_test {

using testing::HasSubstr;
using Status = planning::PlanResult::Status;

planning::PlanRequest Spanned(double degrees, std::uint64_t seed, planning::Spanning spanning) {
  planning::PlanRequest request = RequestAt(degrees, seed);
  request.parameters.Edit<sets::SetParameters>().spanning = spanning;
  return request;
}

planning::PlanRequest RequestOn(const object::Polyhedron& body, double degrees) {
  planning::PlanRequest request = RequestAt(degrees);
  request.object = &body;
  return request;
}

/// Check that the plan passes the checker and switches one finger at a time.
void ExpectGood(const object::Polyhedron& body, const planning::PlanResult& result) {
  ExpectGoodPlan(PolyhedronPlanner(), body, result);
  ExpectOneFingerInEverySwitch(result.plan.value());
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
                                                       Random(), Spanned(degrees, seed, spanning));
          if (result.status == Status::kNoGrasp) {
            ++none;
            continue;
          }
          ExpectGood(body, result);
          for (const plan::Step& step : result.plan->steps) {
            (std::holds_alternative<plan::Switch>(step) ? switches : aligns) += 1;
          }
        }
      }
    }
  }
  EXPECT_GT(switches, 50);
  EXPECT_GT(aligns, 20);
  // Uniform spanning has no grasps at 25°. At little friction, some objects have no grasp that
  // meets the criteria.
  EXPECT_LT(none, 60);
}

TEST(PlanOnPolyhedron, SaysNoExactlyWhereTheCellsAreNotJoined) {
  int joined = 0;
  int apart = 0;
  for (const auto& [name, body] : SmallBodies()) {
    PolyhedronGraph graph(body, Radians(14), planning::Spanning::kUniform);
    PolyhedronModel model(body, graph, RequestOn(body, 14));
    const search::Components components = graph.components();
    RandomStream random(3, RandomUse::kGoal);
    for (int i = 0; i < 40 && graph.vertex_count() > 0; ++i) {
      const sets::SetIndex a(static_cast<int>(random.Index(graph.vertex_count())));
      const sets::SetIndex b(static_cast<int>(random.Index(graph.vertex_count())));
      const auto start = model.Draw(a, random);
      const auto goal = model.Draw(b, random);
      ASSERT_TRUE(start && goal);
      const planning::PlanResult result =
          PlanWith(PolyhedronPlanner(), body, Given(model.GraspOf(*start)),
                   Given(model.GraspOf(*goal)), Spanned(14, 0, planning::Spanning::kUniform));
      SCOPED_TRACE(name + ", cells " + std::to_string(a) + " and " + std::to_string(b));
      if (components.of_vertex[a] == components.of_vertex[b]) {
        ++joined;
        ExpectGood(body, result);
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
      PolyhedronModel model(body, graph, RequestOn(body, degrees));
      RandomStream random(5, RandomUse::kStart);
      for (int number = 0; number < graph.vertex_count(); number += 1 + graph.vertex_count() / 40) {
        const sets::SetIndex cell(number);
        const auto grasp = model.Draw(cell, random);
        ASSERT_TRUE(grasp);
        EXPECT_TRUE(
            grasp::IsForceClosure(model.GraspOf(*grasp), body.wrench_frame(), Radians(degrees)))
            << name << ", cell " << cell;
        const auto projected = model.Attach(model.GraspOf(*grasp));
        EXPECT_TRUE(std::ranges::any_of(projected, [&](const auto& a) { return a.set == cell; }))
            << name << ", cell " << cell;
        ++drawn;
      }
    }
  }
  EXPECT_GT(drawn, 200);
}

TEST(PlanOnPolyhedron, SaysWhichGraspIsNotConcurrent) {
  // Two pairs on opposite faces of a box are force closure, but no four normals span.
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
      PlanWith(PolyhedronPlanner(), box, Given(grasp), Given(other), RequestAt(25));
  EXPECT_EQ(result.status, Status::kNoGrasp);
  EXPECT_THAT(result.message,
              HasSubstr("given.json: force closure, but four contacts are nowhere concurrent"));
  EXPECT_EQ(PlanWith(PolyhedronPlanner(), box, Random(), Random(), RequestAt(25)).status,
            Status::kNoGrasp);
  EXPECT_FALSE(DescribeFocus(box, grasp, Radians(25)));
}

TEST(FocusView, SeesItsContactsInsideTheRegionsOfTheirFaces) {
  int seen = 0;
  for (const auto& [name, body] : SmallBodies()) {
    PolyhedronGraph graph(body, Radians(12), planning::Spanning::kAdaptive);
    PolyhedronModel model(body, graph, RequestOn(body, 12));
    RandomStream random(9, RandomUse::kStart);
    for (int number = 0; number < graph.vertex_count(); number += 1 + graph.vertex_count() / 10) {
      const sets::SetIndex cell(number);
      const auto drawn = model.Draw(cell, random);
      ASSERT_TRUE(drawn);
      const auto view = DescribeFocus(body, model.GraspOf(*drawn), Radians(12));
      ASSERT_TRUE(view) << name;
      const double tangent = graph.cells()[cell].tangent;
      for (const grasp::Contact& contact : model.GraspOf(*drawn)) {
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

}  // namespace plan_polyhedron_test
}  // namespace regrasp::polyhedron
