#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "planner/base/in_blocks.h"
#include "planner/planning/planner.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"

namespace regrasp::registry {
namespace progress_test {

/// Progress messages of a stage: "joining: 3 of 12" belongs to the stage "joining".
struct Stage {
  int reports = 0;
  long first = -1, last = -1, total = 0;
  bool ascends = true;
};

class Listener {
 public:
  [[nodiscard]] Tell tell() {
    return [this](std::string_view text) { Take(std::string(text)); };
  }
  [[nodiscard]] const std::map<std::string, Stage>& stages() const { return stages_; }

 private:
  void Take(const std::string& text) {
    const auto end = text.rfind(": ");
    const auto of = text.rfind(" of ");
    if (end == std::string::npos || of == std::string::npos || of < end) return;
    Stage& stage = stages_[text.substr(0, end)];
    const long done = std::stol(text.substr(end + 2));
    if (stage.reports++ == 0) stage.first = done;
    stage.ascends = stage.ascends && done >= stage.last;
    stage.last = done;
    stage.total = std::stol(text.substr(of + 4));
  }

  std::map<std::string, Stage> stages_;
};

/// Check that every stage counts from 0 to its total, in about a hundred messages whatever its
/// size.
void ExpectCounted(const Listener& listener, const std::vector<std::string>& names) {
  for (const std::string& name : names) EXPECT_TRUE(listener.stages().contains(name)) << name;
  for (const auto& [name, stage] : listener.stages()) {
    EXPECT_EQ(stage.first, 0) << name;
    EXPECT_TRUE(stage.ascends) << name;
    EXPECT_GE(stage.last, stage.total - stage.total / 50) << name;
    EXPECT_LE(stage.reports, 101) << name;
    EXPECT_GE(stage.reports, std::min(stage.total, 51L)) << name;
  }
}

Listener SummarizeWith(const std::string& planner, const std::string& model,
                       planning::PlanRequest request) {
  const object::ObjectFile file = ReadModel(model);
  Listener listener;
  request.object = file.object.get();
  request.criteria.friction_angle = 0.3;
  request.progress = listener.tell();
  EXPECT_GT(FindPlanner(planner)->SummarizeGraph(request).vertices, 0);
  return listener;
}

TEST(Progress, TheGraphOfASolidCountsItsQuadruplesCellsAndFocusPoints) {
  planning::PlanRequest request;
  request.for_graph = true;
  request.parameters = polyhedron::PolyhedronParameters{.focus_points = 500};
  ExpectCounted(SummarizeWith("polyhedron", "stone.obj", request),
                {"testing quadruples of faces", "joining focus cells on triples of faces",
                 "sampling focus points"});
}

TEST(Progress, TheGraphOfAPolygonCountsItsSetsAndPairs) {
  ExpectCounted(SummarizeWith("polygon", "polygon15.wkt", {}),
                {"testing triples of edges for concurrent grasps", "testing pairs of edges",
                 "testing triples of edges for parallel grasps",
                 "projecting sets of grasps on edges", "joining sets of grasps on pairs of edges",
                 "joining sets of 2-finger grasps", "joining sets of grasps on the same edges"});
}

TEST(Progress, TheGraphOfAContourCountsItsPairsGraspsAndSets) {
  ExpectCounted(SummarizeWith("contour", "gear128.wkt", {}),
                {"testing pairs of edges", "joining grasps across corners",
                 "projecting sets on the boundary", "joining sets along the boundary"});
}

TEST(Progress, ARoadmapCountsItsPairsOfContactPointsAndItsQueries) {
  planning::PlanRequest request;
  request.parameters = roadmap::RoadmapParameters{.contact_points = 40};
  ExpectCounted(SummarizeWith("roadmap", "stone.obj", request),
                {"testing the grasps of three on pairs of 40 contact points",
                 "testing the grasps of four on pairs of 40 contact points"});
  request.for_graph = true;
  request.parameters =
      roadmap::RoadmapParameters{.contact_points = 200, .clusters = 10, .queries = 20};
  ExpectCounted(SummarizeWith("roadmap", "stone.obj", request),
                {"testing the clearance of contact points", "comparing pairs of contact points",
                 "sorting contact points into clusters, runs",
                 "testing the grasps of four on pairs of 10 contact points", "random queries"});
}

TEST(Progress, ASearchThatFindsNothingCountsItsTestsUpToItsEffort) {
  const object::ObjectFile file = ReadModel("pyramid.obj");
  int none = 0;
  for (std::uint64_t seed = 0; seed < 40 && none == 0; ++seed) {
    Listener listener;
    planning::PlanRequest request = RequestAt(5, seed);
    request.criteria.min_quality = 0;
    request.parameters = planning::SearchParameters{.budget = 600};
    request.progress = listener.tell();
    const auto result =
        PlanWith(*FindPlanner("general"), *file.object, Random(), Random(), request);
    if (result.plan) continue;
    ++none;
    const Stage& stage = listener.stages().at("growing trees of grasps from start and goal, tests");
    EXPECT_EQ(stage.first, 0);
    EXPECT_EQ(stage.total, 600);
    EXPECT_GE(stage.last, 500);
  }
  EXPECT_EQ(none, 1);
}

}  // namespace progress_test
}  // namespace regrasp::registry
