#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "planner/base/error.h"
#include "planner/gait/gait_planner.h"
#include "planner/planning/planner.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/sets/set_parameters.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"

namespace regrasp::registry {
namespace choose_planner_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::StrEq;
using ::testing::ThrowsMessage;

const object::Object& Solid() {
  static const object::ObjectFile file = ReadModel("stone.obj");
  return *file.object;
}

const object::Object& Planar() {
  static const object::ObjectFile file = ReadModel("polygon15.wkt");
  return *file.object;
}

planning::PlanRequest On(const object::Object& object) {
  planning::PlanRequest request = RequestAt(20);
  request.object = &object;
  request.object_name = "file.obj";
  return request;
}

TEST(Registry, EveryPlannerIsFoundByItsNameAndHasOneOfItsOwn) {
  std::set<std::string> names;
  for (const planning::Planner* planner : AllPlanners()) {
    EXPECT_EQ(FindPlanner(planner->name()), planner);
    EXPECT_TRUE(planner->traits().in_plane || planner->traits().in_space) << planner->name();
    names.insert(planner->name());
  }
  EXPECT_EQ(names, (std::set<std::string>{"general", "contour", "gait", "polygon", "polyhedron",
                                          "roadmap"}));
  EXPECT_EQ(FindPlanner("auto"), nullptr);
  EXPECT_EQ(FindPlanner("genral"), nullptr);
}

TEST(Registry, PlannersTakeGraspsOfAsManyContactsAsTheyKnow) {
  const auto contacts = [](const char* planner, int dimension) {
    const auto limits = FindPlanner(planner)->ScopeIn(dimension).value().contacts;
    return std::pair(limits.least, limits.most);
  };
  EXPECT_EQ(contacts("general", 2), std::pair(2, 4));
  EXPECT_EQ(contacts("general", 3), std::pair(3, 5));
  EXPECT_EQ(contacts("polygon", 2), std::pair(2, 4));
  EXPECT_EQ(contacts("contour", 2), std::pair(2, 2));
  EXPECT_EQ(contacts("polyhedron", 3), std::pair(4, 4));
  EXPECT_EQ(contacts("roadmap", 3), std::pair(4, 4));
}

TEST(ChoosePlanner, TakesGeneralWhereNothingElseIsAskedFor) {
  EXPECT_EQ(ChoosePlanner(On(Solid())).name(), "general");
  EXPECT_EQ(ChoosePlanner(On(Planar())).name(), "general");
}

TEST(ChoosePlanner, TakesTheOneThatHasTheOption) {
  planning::PlanRequest regions = On(Planar());
  regions.objective = planning::Objective::kRegions;
  EXPECT_EQ(ChoosePlanner(regions).name(), "contour");
  for (const object::Object* object : {&Planar(), &Solid()}) {
    planning::PlanRequest uniform = On(*object);
    uniform.parameters = sets::SetParameters{planning::Spanning::kUniform};
    EXPECT_EQ(ChoosePlanner(uniform).name(), object == &Planar() ? "polygon" : "polyhedron");
  }
  planning::PlanRequest points = On(Solid());
  points.parameters = roadmap::RoadmapParameters{.contact_points = 30};
  EXPECT_EQ(ChoosePlanner(points).name(), "roadmap");
  planning::PlanRequest travel = On(Solid());
  travel.objective = planning::Objective::kTravel;
  EXPECT_EQ(ChoosePlanner(travel).name(), "general");
}

TEST(ChoosePlanner, TakesGaitForAHandAndSaysWhatNoPlannerJoinsWithIt) {
  planning::PlanRequest request = On(Solid());
  EXPECT_THAT(
      [&] { (void)PlannerFor("gait", request); },
      ThrowsMessage<InputError>(StrEq("planner gait requires a hand (--hand); help: use --planner "
                                      "general")));
  request.parameters.Edit<gait::GaitParameters>().task.emplace();
  EXPECT_EQ(ChoosePlanner(request).name(), "gait");
  EXPECT_THAT([&] { (void)PlannerFor("general", request); },
              ThrowsMessage<InputError>(
                  StrEq("--hand: not supported by planner general; help: use --planner gait")));
  request.objective = planning::Objective::kTravel;
  EXPECT_THAT([&] { (void)ChoosePlanner(request); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("--optimize travel (general)"), HasSubstr("--hand (gait)"))));
}

TEST(ChoosePlanner, TakesForAGraphTheFirstThatHasOneWithTheOption) {
  for (const object::Object* object : {&Planar(), &Solid()}) {
    planning::PlanRequest request = On(*object);
    request.for_graph = true;
    EXPECT_EQ(ChoosePlanner(request).name(), object == &Planar() ? "polygon" : "roadmap");
  }
  planning::PlanRequest request = On(Solid());
  request.for_graph = true;
  request.parameters = polyhedron::PolyhedronParameters{.focus_points = 5};
  EXPECT_EQ(ChoosePlanner(request).name(), "polyhedron");
  request.parameters = roadmap::RoadmapParameters{.queries = 5};
  EXPECT_EQ(ChoosePlanner(request).name(), "roadmap");
  EXPECT_THAT([&] { (void)PlannerFor("general", request); },
              ThrowsMessage<InputError>(
                  StrEq("planner general: graph not supported; help: use --planner roadmap")));
}

TEST(ChoosePlanner, SaysWhichOptionsNoPlannerJoins) {
  planning::PlanRequest request = On(Planar());
  request.objective = planning::Objective::kRegions;
  request.parameters = planning::SearchParameters{.explain = true};
  EXPECT_THAT([&] { (void)ChoosePlanner(request); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("--optimize regions (contour)"),
                                              HasSubstr("--explain (general)"))));
  request = On(Solid());
  request.objective = planning::Objective::kRegions;
  EXPECT_THAT([&] { (void)ChoosePlanner(request); },
              ThrowsMessage<InputError>(HasSubstr("for a solid: --optimize regions (no planner)")));
}

/// Requests with one parameter each, and the planners that have it.
std::vector<std::tuple<std::string, planning::PlannerParameters, std::set<std::string>>>
OneParameterEach() {
  using planning::SearchParameters;
  using roadmap::RoadmapParameters;
  return {
      {"--planner spanning=uniform",
       sets::SetParameters{planning::Spanning::kUniform},
       {"polygon", "polyhedron"}},
      {"--planner sampling", polyhedron::PolyhedronParameters{.focus_points = 1}, {"polyhedron"}},
      {"--planner points", RoadmapParameters{.contact_points = 0}, {"roadmap"}},
      {"--planner clusters", RoadmapParameters{.clusters = 0}, {"roadmap"}},
      {"--planner fallback=no", RoadmapParameters{.last_resort = false}, {"roadmap"}},
      {"--planner queries", RoadmapParameters{.queries = 1}, {"roadmap"}},
      {"--planner budget", SearchParameters{.budget = 0}, {"general", "gait"}},
      {"--explain", SearchParameters{.explain = true}, {"general", "gait"}},
      {"--hand", gait::GaitParameters{.task = planning::InHandTask()}, {"gait"}}};
}

TEST(PlannerFor, EveryParameterIsRefusedByOptionNameExceptByItsPlanners) {
  for (const auto& [option, parameters, planners] : OneParameterEach()) {
    for (const planning::Planner* planner : AllPlanners()) {
      planning::PlanRequest request = On(planner->traits().in_plane ? Planar() : Solid());
      request.parameters = parameters;
      if (planner->traits().needs_hand) {
        request.parameters.Edit<gait::GaitParameters>().task.emplace();
      }
      const std::string why = planning::WhyNotServed(*planner, request);
      if (planners.contains(planner->name())) {
        EXPECT_EQ(why, "") << option;
      } else {
        EXPECT_EQ(why, option + ": not supported by planner " + planner->name());
      }
    }
  }
}

TEST(PlannerFor, DefaultParametersAreNotRefused) {
  for (const object::Object* object : {&Planar(), &Solid()}) {
    planning::PlanRequest request = On(*object);
    static_cast<void>(request.parameters.Edit<sets::SetParameters>());
    static_cast<void>(request.parameters.Edit<roadmap::RoadmapParameters>());
    static_cast<void>(request.parameters.Edit<planning::SearchParameters>());
    static_cast<void>(request.parameters.Edit<gait::GaitParameters>());
    for (const planning::Planner* planner : AllPlanners()) {
      if (planner->traits().needs_hand || !planner->ScopeIn(object->dimension())) continue;
      EXPECT_EQ(planning::WhyNotServed(*planner, request), "");
    }
  }
}

TEST(PlannerFor, RefusesWhatThePlannerDoesNotServeAndNamesOneThatDoes) {
  planning::PlanRequest request = On(Planar());
  request.parameters = planning::SearchParameters{.budget = 5};
  EXPECT_EQ(PlannerFor("general", request).name(), "general");
  EXPECT_THAT(
      [&] { (void)PlannerFor("polygon", request); },
      ThrowsMessage<InputError>(AllOf(
          StartsWith("--planner budget: not supported by planner polygon"), HasSubstr("general"))));
  EXPECT_THAT([&] { (void)PlannerFor("roadmap", On(Planar())); },
              ThrowsMessage<InputError>(StartsWith(
                  "file.obj: planner roadmap supports solids only, found a planar object")));
  EXPECT_THAT([&] { (void)PlannerFor("genral", On(Planar())); },
              ThrowsMessage<InputError>(HasSubstr("expected one of auto, general, polygon")));
}

TEST(PlannerFor, RefusesAHandOfTooFewFingers) {
  planning::PlanRequest request = On(Solid());
  request.hand.fingers = 4;
  EXPECT_THAT([&] { (void)PlannerFor("polyhedron", request); },
              ThrowsMessage<InputError>(HasSubstr("requires a hand with 5 fingers")));
  request.hand.fingers = 5;
  EXPECT_EQ(PlannerFor("polyhedron", request).name(), "polyhedron");
}

TEST(Registry, EveryPlannerCountsTheGraphThatItSaysItHas) {
  int graphs = 0;
  for (const planning::Planner* planner : AllPlanners()) {
    const object::Object& object = planner->ScopeIn(2) ? Planar() : Solid();
    planning::PlanRequest request = On(object);
    request.for_graph = true;
    if (!planner->traits().has_graph) {
      EXPECT_THROW((void)planner->SummarizeGraph(request), std::logic_error) << planner->name();
      EXPECT_NE(planning::WhyNotServed(*planner, request), "") << planner->name();
      continue;
    }
    const planning::GraphSummary summary = planner->SummarizeGraph(request);
    EXPECT_EQ(summary.planner, planner->name());
    EXPECT_GT(summary.faces, 0) << planner->name();
    EXPECT_NE(summary.face_name, "") << planner->name();
    std::int64_t vertices = 0;
    for (const planning::TypeSummary& type : summary.types) vertices += type.vertices;
    EXPECT_GT(vertices, 0) << planner->name();
    EXPECT_EQ(vertices, summary.vertices) << planner->name();
    EXPECT_GT(summary.components, 0) << planner->name();
    EXPECT_FALSE(summary.edges.empty()) << planner->name();
    ++graphs;
  }
  EXPECT_EQ(graphs, 4);
}

/// Third-party planner whose name is already registered.
class OtherPlanner final : public planning::Planner {
 public:
  explicit OtherPlanner(const std::string& name) : Planner({.name = name, .what = "nothing"}) {}
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& /*request*/) const override {
    return {};
  }
};

TEST(RegisterPlanner, RefusesNamesThatAreTaken) {
  const std::size_t before = AllPlanners().size();
  for (const std::string name : {"auto", "general", "gait"}) {
    EXPECT_THROW(RegisterPlanner(std::make_unique<OtherPlanner>(name)), InputError) << name;
  }
  EXPECT_EQ(AllPlanners().size(), before);
}

TEST(RegisterPlanner, APlannerIsFoundByItsName) {
  EXPECT_EQ(FindPlanner("somebody's"), nullptr);
  RegisterPlanner(std::make_unique<OtherPlanner>("somebody's"));
  ASSERT_NE(FindPlanner("somebody's"), nullptr);
  EXPECT_EQ(AllPlanners().back()->name(), "somebody's");
  EXPECT_NE(PlannerNames().find(", somebody's"), std::string::npos);
  EXPECT_THROW(RegisterPlanner(std::make_unique<OtherPlanner>("somebody's")), InputError);
}

}  // namespace choose_planner_test
}  // namespace regrasp::registry
