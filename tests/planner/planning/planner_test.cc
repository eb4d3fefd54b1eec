#include "planner/planning/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "planner/base/number.h"
#include "planner/planning/in_hand_task.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/solids.h"

namespace regrasp::planning {
namespace planner_test {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class Idle final : public Planner {
 public:
  explicit Idle(PlannerTraits traits) : Planner(std::move(traits)) {}
  [[nodiscard]] PlanResult Plan(const PlanRequest&) const override { return {}; }
};

/// Return requests that require one option each.
std::vector<std::pair<PlanOption, PlanRequest>> OneOptionEach() {
  std::vector<std::pair<PlanOption, PlanRequest>> requests;
  const auto add = [&](PlanOption option, const auto& ask) {
    requests.emplace_back(option, PlanRequest());
    ask(requests.back().second);
  };
  add(PlanOption::kMargin, [](PlanRequest& r) { r.objective = Objective::kMargin; });
  add(PlanOption::kTravel, [](PlanRequest& r) { r.objective = Objective::kTravel; });
  add(PlanOption::kRegions, [](PlanRequest& r) { r.objective = Objective::kRegions; });
  add(PlanOption::kUniformSpanning, [](PlanRequest& r) { r.spanning = Spanning::kUniform; });
  add(PlanOption::kContactPoints, [](PlanRequest& r) { r.contact_points = 0; });
  static const std::vector<Eigen::Vector3d> kPoints;
  add(PlanOption::kGivenPoints, [](PlanRequest& r) { r.given_points = &kPoints; });
  add(PlanOption::kClusters, [](PlanRequest& r) { r.clusters = 0; });
  add(PlanOption::kNoLastResort, [](PlanRequest& r) { r.last_resort = false; });
  add(PlanOption::kEffort, [](PlanRequest& r) { r.effort = 0; });
  add(PlanOption::kExplain, [](PlanRequest& r) { r.explain = true; });
  add(PlanOption::kSoftFingers, [](PlanRequest& r) { r.hand.torsion = 0.1; });
  add(PlanOption::kHand, [](PlanRequest& r) { r.in_hand = std::make_shared<InHandTask>(); });
  return requests;
}

TEST(OptionsOf, AreTheOnesThatAreAskedForAndNoOthers) {
  EXPECT_THAT(OptionsOf(PlanRequest()), IsEmpty());
  for (const auto& [option, request] : OneOptionEach()) {
    EXPECT_THAT(OptionsOf(request), UnorderedElementsAre(option)) << OptionName(option);
  }
  PlanRequest several;
  several.objective = Objective::kMargin;
  several.effort = 5;
  several.explain = true;
  EXPECT_THAT(OptionsOf(several),
              UnorderedElementsAre(PlanOption::kMargin, PlanOption::kEffort, PlanOption::kExplain));
}

TEST(OptionName, IsAnOptionOfTheProgramAndEachHasItsOwn) {
  std::set<std::string> names;
  for (const auto& [option, request] : OneOptionEach()) {
    EXPECT_TRUE(OptionName(option).starts_with("--")) << OptionName(option);
    names.insert(OptionName(option));
  }
  EXPECT_EQ(names.size(), OneOptionEach().size());
}

TEST(WhyNotServed, AsksForOneOptionAndHasItOrNot) {
  const object::Polyhedron cube = MakeCube();
  const PlannerScope scope = {5, {4, 4}, {4, 4}};
  for (auto& [option, request] : OneOptionEach()) {
    request.object = &cube;
    EXPECT_EQ(WhyNotServed(Idle({.name = "idle", .in_space = scope, .options = {option}}), request),
              "");
    EXPECT_EQ(WhyNotServed(Idle({.name = "idle", .in_space = scope}), request),
              OptionName(option) + ": not supported by planner idle");
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
  EXPECT_THAT(WhyNotServed(planar, request), testing::StartsWith("cube.obj: a solid"));
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
