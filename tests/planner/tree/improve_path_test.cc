#include "planner/tree/improve_path.h"

#include <gtest/gtest.h>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/tree/bidirectional_tree.h"
#include "planner/tree/subset_search.h"
#include "planner/tree/tree_planner.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace improve_path_test {

/// Expect a path of distinct force-closure grasps. Every step must be a switch of the hand or a
/// proved sliding step.
void ExpectIsPath(const GraspPath& path, const SearchSpace& space) {
  const criteria::ContactSet* before = &path.start;
  for (const PathStep& step : path.steps) {
    EXPECT_FALSE(*before == step.to);
    if (step.align) {
      EXPECT_FALSE(step.align->proof.empty());
    } else {
      EXPECT_LE(criteria::ContactSet::CountUnion(*before, step.to), space.fingers());
    }
    EXPECT_TRUE(grasp::IsForceClosure(space.GraspOf(step.to), space.object().wrench_frame(),
                                      space.friction_angle()));
    before = &step.to;
  }
}

struct Case {
  const char* model;
  double degrees;
  int contacts;
};

class ImprovePathCases : public testing::TestWithParam<Case> {
 protected:
  ImprovePathCases()
      : file_(ReadModel(GetParam().model)),
        source_(*file_.object),
        criteria_{Radians(GetParam().degrees), 0} {}

  /// Return a path between random grasps of the given quality.
  GraspPath Draw(double quality, std::uint64_t seed, SearchSpace& space) {
    RandomStream draws(seed, RandomUse::kStart);
    const criteria::GraspCriteria criteria{criteria_.friction_angle, quality};
    const criteria::ContactSet from =
        Take(DrawGrasp(*file_.object, GetParam().contacts, criteria, draws), space);
    const criteria::ContactSet to =
        Take(DrawGrasp(*file_.object, GetParam().contacts, criteria, draws), space);
    RandomStream random(seed, RandomUse::kCandidates);
    auto path = BidirectionalTree(from, to, source_, random, space).Join();
    if (!path) ADD_FAILURE() << "not joined";
    return path.value_or(GraspPath{from, {}});
  }

  object::ObjectFile file_;
  sampling::SurfaceSampler source_;
  criteria::GraspCriteria criteria_;
};
INSTANTIATE_TEST_SUITE_P(Bodies, ImprovePathCases,
                         testing::Values(Case{"cube.obj", 15, 4}, Case{"l_block.obj", 10, 4},
                                         Case{"duck500.obj", 20, 4}, Case{"polygon20.wkt", 15, 3}),
                         [](const auto& test) { return "case" + std::to_string(test.index); });

TEST_P(ImprovePathCases, LessTravelIsNeverMoreStepsAndIsWhatTravelOfSays) {
  int less = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SearchSpace space(*file_.object, criteria_);
    RandomStream random(seed, RandomUse::kCandidates);
    const GraspPath path = ShortcutPath(Draw(0, seed, space), source_, random, space);
    const GraspPath shorter = MinimiseTravel(path, source_, random, space);
    ExpectIsPath(shorter, space);
    EXPECT_TRUE(shorter.start == path.start);
    EXPECT_TRUE(shorter.end() == path.end());
    EXPECT_LE(shorter.steps.size(), path.steps.size());
    EXPECT_LE(TravelOf(shorter, space), TravelOf(path, space));
    less += TravelOf(shorter, space) < TravelOf(path, space) ? 1 : 0;
  }
  EXPECT_GT(less, 0);
}

TEST_P(ImprovePathCases, RepairedPathsHaveTheQualityThatTheyAreSaidToHave) {
  constexpr double kQuality = 0.01;
  // In the plane paths are found immediately, and few of them pass weak grasps.
  const int seeds = GetParam().contacts == 3 ? 24 : 6;
  int repaired = 0;
  int weak = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    SearchSpace space(*file_.object, {criteria_.friction_angle, kQuality});
    space.SetShare(0);
    RandomStream random(seed, RandomUse::kCandidates);
    GraspPath path = ShortcutPath(Draw(kQuality, seed, space), source_, random, space);
    const auto quality_of = [&](const criteria::ContactSet& set) {
      return grasp::ComputeQuality(space.GraspOf(set), file_.object->wrench_frame(),
                                   criteria_.friction_angle)
          .upper;
    };
    for (const PathStep& step : path.steps) weak += quality_of(step.to) < kQuality ? 1 : 0;
    space.SetShare(1);
    const double reached = RepairQuality(source_, random, space, path);
    EXPECT_EQ(space.share(), 1);
    EXPECT_LE(reached, 1);
    ExpectIsPath(path, space);
    for (const PathStep& step : path.steps) EXPECT_GE(quality_of(step.to), reached * kQuality);
    repaired += reached == 1 ? 1 : 0;
  }
  EXPECT_GT(weak, 0);
  EXPECT_GT(repaired, seeds / 2);
}

TEST(LeastTravel, IsTheLeastOfAllWaysOfSoManySwitches) {
  const object::ObjectFile file = ReadModel("duck500.obj");
  const criteria::GraspCriteria criteria{Radians(25), 0};
  RandomStream random(5, RandomUse::kStart);
  int checked = 0;
  for (int i = 0; i < 12; ++i) {
    SearchSpace space(*file.object, criteria);
    const criteria::ContactSet from = Take(DrawGrasp(*file.object, 4, criteria, random), space);
    const criteria::ContactSet to = Take(DrawGrasp(*file.object, 4, criteria, random), space);
    std::vector<int> contacts(space.count());
    for (int k = 0; k < space.count(); ++k) contacts[k] = k;
    // On small faces there are no sliding steps: test all paths of three switches, one by one.
    std::vector<criteria::ContactSet> grasps;
    for (unsigned mask = 0; mask < 1U << contacts.size(); ++mask) {
      const int size = std::popcount(mask);
      if (size < space.fewest_contacts() || size >= space.fingers()) continue;
      criteria::ContactSet set;
      for (const int contact : contacts) {
        if ((mask >> contact & 1) != 0) set.Insert(contact);
      }
      if (space.Admits(set)) grasps.push_back(set);
    }
    const auto joins = [&](const criteria::ContactSet& a, const criteria::ContactSet& b) {
      return criteria::ContactSet::CountUnion(a, b) <= space.fingers();
    };
    double least = std::numeric_limits<double>::infinity();
    for (const criteria::ContactSet& a : grasps) {
      if (!joins(from, a)) continue;
      for (const criteria::ContactSet& b : grasps) {
        if (!joins(a, b) || !joins(b, to)) continue;
        least = std::min(least, TravelOf({from, {{a, {}}, {b, {}}, {to, {}}}}, space));
      }
    }
    constexpr double kAnyway = 1e9;
    const auto found = SearchLeastTravel(from, to, contacts, 3, kAnyway, space);
    ASSERT_EQ(found.has_value(), least < kAnyway);
    if (!found) continue;
    ++checked;
    EXPECT_LE(TravelOf(*found, space), least + 1e-9);
    EXPECT_FALSE(
        SearchLeastTravel(from, to, contacts, 3, (1 - 1e-9) * TravelOf(*found, space), space));
  }
  EXPECT_GT(checked, 5);
}

}  // namespace improve_path_test
}  // namespace regrasp::tree
