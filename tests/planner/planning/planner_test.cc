#include "planner/planning/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/solids.h"

namespace regrasp::planning {
namespace planner_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Idle final : public Planner {
 public:
  explicit Idle(PlannerTraits traits) : Planner(std::move(traits)) {}
  [[nodiscard]] PlanResult Plan(const PlanRequest&) const override { return {}; }
};

/// Parameters of two planners outside this project; one option is common.
struct OrderParameters {
  int most_orders = 24;
  bool explain = false;
  [[nodiscard]] std::vector<std::string> Options() const {
    std::vector<std::string> options;
    if (most_orders != 24) options.emplace_back("--orders");
    if (explain) options.emplace_back(kExplainOption);
    return options;
  }
};
struct ColourParameters {
  std::string colour;
  bool explain = false;
  [[nodiscard]] std::vector<std::string> Options() const {
    std::vector<std::string> options;
    if (explain) options.emplace_back(kExplainOption);
    if (!colour.empty()) options.emplace_back("--colour");
    return options;
  }
};

/// Requests with one option each.
std::vector<std::pair<std::string, PlanRequest>> OneOptionEach() {
  static const std::vector<Eigen::Vector3d> kPoints;
  std::vector<std::pair<std::string, PlanRequest>> requests;
  requests.push_back({"--optimize margin", {.objective = Objective::kMargin}});
  requests.push_back({"--optimize travel", {.objective = Objective::kTravel}});
  requests.push_back({"--optimize regions", {.objective = Objective::kRegions}});
  requests.push_back({"--planner points=given", {.given_points = &kPoints}});
  requests.push_back({"--torsion", {.hand = {.torsion = 0.1}}});
  requests.push_back({"--orders", {.parameters = OrderParameters{.most_orders = 6}}});
  requests.push_back({"--explain", {.parameters = OrderParameters{.explain = true}}});
  requests.push_back({"--colour", {.parameters = ColourParameters{.colour = "red"}}});
  return requests;
}

TEST(PlannerParameters, HaveTheDefaultsUntilTheyAreEdited) {
  PlannerParameters parameters;
  EXPECT_EQ(parameters.Get<OrderParameters>().most_orders, 24);
  parameters.Edit<OrderParameters>().most_orders = 6;
  EXPECT_EQ(parameters.Get<OrderParameters>().most_orders, 6);
  EXPECT_EQ(parameters.Edit<OrderParameters>().most_orders, 6);
  EXPECT_EQ(parameters.Get<ColourParameters>().colour, "");
}

TEST(PlannerParameters, ACopyIsIndependent) {
  PlannerParameters parameters = OrderParameters{.most_orders = 6};
  PlannerParameters copy = parameters;
  copy.Edit<OrderParameters>().most_orders = 2;
  copy.Edit<ColourParameters>().colour = "red";
  EXPECT_EQ(parameters.Get<OrderParameters>().most_orders, 6);
  EXPECT_EQ(parameters.Get<ColourParameters>().colour, "");
  EXPECT_EQ(copy.Get<OrderParameters>().most_orders, 2);
}

TEST(PlannerParameters, ListTheOptionsThatDifferFromTheDefaultsOnceInTheOrderOfTheEdits) {
  PlannerParameters parameters;
  static_cast<void>(parameters.Edit<ColourParameters>());
  parameters.Edit<OrderParameters>() = {.most_orders = 6, .explain = true};
  EXPECT_THAT(parameters.OptionNames(), ElementsAre("--orders", "--explain"));
  parameters.Edit<ColourParameters>() = {.colour = "red", .explain = true};
  EXPECT_THAT(parameters.OptionNames(), ElementsAre("--explain", "--colour", "--orders"));
}

TEST(OptionsOf, AreTheRequestedOptionsAndNoOthers) {
  EXPECT_THAT(OptionsOf(PlanRequest()), IsEmpty());
  for (const auto& [option, request] : OneOptionEach()) {
    EXPECT_THAT(OptionsOf(request), ElementsAre(option));
  }
  const PlanRequest several = {.objective = Objective::kMargin,
                               .parameters = OrderParameters{.most_orders = 6, .explain = true}};
  EXPECT_THAT(OptionsOf(several), ElementsAre("--optimize margin", "--orders", "--explain"));
}

TEST(WhyNotServed, NamesAnOptionThatThePlannerDoesNotHave) {
  const object::Polyhedron cube = MakeCube();
  const PlannerScope scope = {5, {4, 4}, {4, 4}};
  for (auto& [option, request] : OneOptionEach()) {
    request.object = &cube;
    EXPECT_EQ(WhyNotServed(Idle({.name = "idle", .in_space = scope, .options = {option}}), request),
              "");
    EXPECT_EQ(WhyNotServed(Idle({.name = "idle", .in_space = scope}), request),
              option + ": not supported by planner idle");
  }
}

TEST(WhyNotServed, NamesTheDimensionAndTheFingersThatAreMissing) {
  const object::Polyhedron cube = MakeCube();
  const object::Polygon square = Square(1);
  const Idle planar({.name = "idle", .in_plane = PlannerScope{4, {2, 2}, {2, 2}}});
  PlanRequest request;
  request.object = &cube;
  EXPECT_EQ(WhyNotServed(planar, request),
            "planner idle supports planar objects only, found a solid");
  request.object_name = "cube.obj";
  EXPECT_THAT(WhyNotServed(planar, request),
              testing::StartsWith("cube.obj: planner idle supports planar objects only"));
  request.object = &square;
  for (const int fingers : {0, 4, 5}) {
    request.hand.fingers = fingers;
    EXPECT_EQ(WhyNotServed(planar, request), "") << fingers;
  }
  request.hand.fingers = 3;
  EXPECT_THAT(WhyNotServed(planar, request), HasSubstr("requires a hand with 4 fingers, found 3"));
}

}  // namespace planner_test
}  // namespace regrasp::planning
