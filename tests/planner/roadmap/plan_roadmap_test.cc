#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "planner/base/number.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/check.h"
#include "planner/roadmap/cluster_search.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap_planner.h"
#include "planner/search/switching_graph.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/plan_with.h"
#include "tests/fixtures/solids.h"

namespace regrasp::roadmap {
namespace plan_roadmap_test {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Status = planning::PlanResult::Status;

constexpr double kHalf = 0.03;

/// Return a contact on the face of the cube whose outward normal is `axis` times `sign`.
grasp::Contact OnCube(const object::Polyhedron& cube, int axis, int sign, double u, double v) {
  grasp::Contact contact;
  contact.p[axis] = sign * kHalf;
  contact.p[(axis + 1) % 3] = u;
  contact.p[(axis + 2) % 3] = v;
  contact.face = cube.FacesNear(contact.p, object::kPointTolerance * cube.diameter()).front();
  contact.n = cube.inward_normal(contact.face);
  return contact;
}

/// Return two contacts on each of the two faces perpendicular to an axis.
grasp::Grasp AcrossAxis(const object::Polyhedron& cube, int axis, double offset = 0) {
  return {OnCube(cube, axis, -1, 0.012 + offset, 0.003), OnCube(cube, axis, -1, -0.012, -0.002),
          OnCube(cube, axis, 1, 0.012, 0.002), OnCube(cube, axis, 1, -0.012 + offset, -0.003)};
}

planning::PlanRequest Options(int contacts, std::uint64_t seed = 0, double degrees = 20) {
  planning::PlanRequest options = RequestAt(degrees, seed);
  options.parameters.Edit<RoadmapParameters>().contact_points = contacts;
  options.parameters.Edit<RoadmapParameters>().clusters = 0;
  return options;
}

double Margin(const object::Polyhedron& solid, const grasp::Grasp& grasp, double friction_angle) {
  return friction_angle -
         grasp::ComputeRequiredFrictionAngle(grasp, solid.wrench_frame()).value().upper;
}

std::vector<int> JoinedVertex(const Roadmap& roadmap, const grasp::Grasp& grasp) {
  std::vector<int> points;
  for (const grasp::Contact& contact : grasp) {
    const auto found = std::find_if(roadmap.points().begin(), roadmap.points().end(),
                                    [&](const grasp::Contact& c) { return c.p == contact.p; });
    points.push_back(static_cast<int>(found - roadmap.points().begin()));
  }
  return points;
}

/// Best sequence by brute force: breadth-first search by levels, then the largest smallest margin,
/// with all grasps evaluated.
struct BestSequence {
  int switches = -1;
  double margin = -std::numeric_limits<double>::infinity();
};

BestSequence FindByBruteForce(const object::Polyhedron& solid, const Roadmap& roadmap, int start,
                              int goal, double friction_angle, double min_quality) {
  const int count = roadmap.vertex_count();
  std::vector<double> best(count, -std::numeric_limits<double>::infinity());
  std::vector<bool> seen(count, false);
  std::vector<int> level = {start};
  best[start] = Margin(solid, roadmap.grasp(start), friction_angle);
  seen[start] = true;
  std::vector<int> neighbours;
  for (int switches = 0; !level.empty(); ++switches) {
    if (seen[goal]) return {switches, best[goal]};
    std::vector<int> next;
    for (const int v : level) {
      roadmap.GetNeighbours(v, neighbours);
      for (const int n : neighbours) {
        const bool is_next = std::find(next.begin(), next.end(), n) != next.end();
        if (seen[n] && !is_next) continue;
        const grasp::Grasp grasp = roadmap.grasp(n);
        if (!is_next) {
          if (n != goal &&
              !grasp::QualityAtLeast(grasp, solid.wrench_frame(), friction_angle, min_quality)) {
            continue;
          }
          seen[n] = true;
          next.push_back(n);
        }
        best[n] = std::max(best[n], std::min(best[v], Margin(solid, grasp, friction_angle)));
      }
    }
    if (seen[goal]) return {switches + 1, best[goal]};
    level = next;
  }
  return {};
}

TEST(PlanOnRoadmap, FindsTheBestOfAllSequences) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  int checked = 0;
  int detours = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    planning::PlanRequest options = Options(8, seed, 14);
    options.object = &cube;
    const grasp::Grasp start = AcrossAxis(cube, 0);
    const grasp::Grasp goal = AcrossAxis(cube, 1 + int(seed % 2), 0.001 * double(seed));
    std::vector<grasp::Contact> joined = start;
    joined.insert(joined.end(), goal.begin(), goal.end());
    const Roadmap roadmap = BuildRoadmap(options, SpreadContacts(options), joined);
    const BestSequence best =
        FindByBruteForce(cube, roadmap, roadmap.Find(JoinedVertex(roadmap, start)).value(),
                         roadmap.Find(JoinedVertex(roadmap, goal)).value(),
                         options.criteria.friction_angle, options.criteria.min_quality);
    if (best.switches < 0) continue;
    const planning::PlanResult result =
        PlanWith(RoadmapPlanner(), cube, Given(start), Given(goal), options);
    ASSERT_EQ(result.status, Status::kFound);
    EXPECT_THAT(result.plan->steps, SizeIs(best.switches)) << "seed " << seed;
    EXPECT_NEAR(result.margin, best.margin, 2 * kMarginTolerance) << "seed " << seed;
    ++checked;
    if (best.switches > 4) ++detours;
  }
  EXPECT_GE(checked, 4);
  RecordProperty("detours", detours);
}

TEST(PlanOnRoadmap, MarginIsTheSmallestOfThePlansGrasps) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  const planning::PlanResult result = PlanWith(RoadmapPlanner(), cube, Given(AcrossAxis(cube, 0)),
                                               Given(AcrossAxis(cube, 2)), Options(24));
  ASSERT_EQ(result.status, Status::kFound);
  double smallest = std::numeric_limits<double>::infinity();
  for (const grasp::Grasp& grasp : RestsOf(*result.plan)) {
    smallest = std::min(smallest, Margin(cube, grasp, Radians(20)));
    EXPECT_TRUE(grasp::QualityAtLeast(grasp, cube.wrench_frame(), Radians(20), 0.01));
  }
  EXPECT_NEAR(result.margin, smallest, kMarginTolerance);
  EXPECT_THAT(result.warnings, IsEmpty());
}

TEST(PlanOnRoadmap, PlansPassTheCheckerFromRandomGraspToRandomGrasp) {
  const object::Polyhedron box = MakeBox({0.08, 0.05, 0.06});
  int passed = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const planning::GraspChoice& choice : {Random(), RandomAny()}) {
      const planning::PlanResult result =
          PlanWith(RoadmapPlanner(), box, choice, choice, Options(30, seed));
      ASSERT_EQ(result.status, Status::kFound) << result.message;
      EXPECT_THAT(result.warnings, IsEmpty());
      EXPECT_FALSE(result.plan->steps.empty());
      const plan::PlanCheck check = plan::CheckPlan(box, *result.plan);
      EXPECT_TRUE(check.passed()) << "seed " << seed;
      passed += check.passed() ? 1 : 0;
    }
  }
  EXPECT_EQ(passed, 12);
}

TEST(PlanOnRoadmap, SaysWhatWasSearchedWhereThereIsNoSequence) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  // Two pairs whose torques cancel. They have almost no friction margin, and no contact can be
  // replaced, except by a contact on the same line of force.
  const auto pinwheel = [&](int axis) {
    constexpr double kArm = 0.02;
    const int other = (axis + 1) % 3;
    return Given({OnCube(cube, axis, 1, kArm, 0), OnCube(cube, axis, -1, -kArm, 0),
                  OnCube(cube, other, 1, 0, kArm), OnCube(cube, other, -1, 0, -kArm)});
  };
  planning::PlanRequest options = Options(4, 0, 2);
  const planning::PlanResult result =
      PlanWith(RoadmapPlanner(), cube, pinwheel(0), pinwheel(1), options);
  ASSERT_EQ(result.status, Status::kNoSequence);
  EXPECT_FALSE(result.plan.has_value());
  EXPECT_THAT(result.message, HasSubstr("12 contact points, 495 subsets of four"));
  EXPECT_THAT(result.message, HasSubstr(" force-closure grasps"));
  EXPECT_THAT(result.message, HasSubstr("the start's component has"));
  options = Options(30);
  EXPECT_EQ(PlanWith(RoadmapPlanner(), cube, pinwheel(0), pinwheel(1), options).status,
            Status::kFound);
}

TEST(PlanOnRoadmap, WarnsOfTheWeakestStepWhereNoSequenceIsGoodEnough) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  planning::PlanRequest options = Options(20);
  // More than the quality of any grasp of the cube at this friction.
  options.criteria.min_quality = 0.9;
  const planning::PlanResult result = PlanWith(RoadmapPlanner(), cube, Given(AcrossAxis(cube, 0)),
                                               Given(AcrossAxis(cube, 1)), options);
  ASSERT_EQ(result.status, Status::kFound);
  ASSERT_THAT(result.warnings, SizeIs(1));
  EXPECT_THAT(result.warnings[0], HasSubstr("below the required 0.9"));
  EXPECT_THAT(result.warnings[0], HasSubstr("step"));
}

TEST(PlanOnRoadmap, DrawsTheGoalFromTheStartsComponent) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const planning::PlanResult result =
        PlanWith(RoadmapPlanner(), cube, Random(), Random(), Options(9, seed, 12));
    if (result.status == Status::kNoGrasp) continue;
    EXPECT_EQ(result.status, Status::kFound) << "seed " << seed;
    ++found;
  }
  EXPECT_GT(found, 5);
}

/// Return the number of progress messages of the search.
int CountReports(double min_quality) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  planning::PlanRequest request = Options(40);
  request.criteria.min_quality = min_quality;
  int reports = 0;
  request.progress = [&](std::string_view text) {
    if (text.starts_with("searching a sequence")) ++reports;
  };
  const planning::PlanResult result = PlanWith(RoadmapPlanner(), cube, Given(AcrossAxis(cube, 0)),
                                               Given(AcrossAxis(cube, 1)), request);
  EXPECT_EQ(result.status, Status::kFound) << result.message;
  return reports;
}

TEST(PlanOnRoadmap, TellsOfTheSearchAfterManyTestsAndNotAfterNone) {
  EXPECT_EQ(CountReports(0), 1) << "no quality is tested: at the beginning alone";
  EXPECT_GT(CountReports(0.05), 1);
}

TEST(PlanOnRoadmap, RefusesOptionsOutOfRange) {
  const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  EXPECT_THROW((void)PlanWith(RoadmapPlanner(), cube, Random(), Random(), Options(3)),
               std::invalid_argument);
  EXPECT_THROW(
      (void)PlanWith(RoadmapPlanner(), cube, Random(), Random(), Options(kMaxRoadmapContacts + 1)),
      std::invalid_argument);
}

}  // namespace plan_roadmap_test
}  // namespace regrasp::roadmap
