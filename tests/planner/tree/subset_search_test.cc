#include "planner/tree/subset_search.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <queue>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_friction_angle.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace subset_search_test {

constexpr int kAnySteps = std::numeric_limits<int>::max();

std::vector<criteria::ContactSet> AllSets(const std::vector<int>& contacts, int least, int most) {
  std::vector<criteria::ContactSet> sets;
  for (unsigned mask = 0; mask < 1u << contacts.size(); ++mask) {
    criteria::ContactSet set;
    if (std::popcount(mask) < least || std::popcount(mask) > most) continue;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if ((mask >> i & 1) != 0) set.Insert(contacts[i]);
    }
    sets.push_back(set);
  }
  return sets;
}

/// Return the fewest switches between two grasps, over all subsets, based only on the definition of
/// a switch.
int FewestSwitches(const criteria::ContactSet& from, const criteria::ContactSet& to,
                   const std::vector<int>& contacts, const SearchSpace& space) {
  std::vector<criteria::ContactSet> grasps = {from, to};
  for (const criteria::ContactSet& set :
       AllSets(contacts, space.fewest_contacts(), space.fingers())) {
    if (set == from || set == to) continue;
    if (grasp::IsForceClosure(space.GraspOf(set), space.object().wrench_frame(),
                              space.friction_angle())) {
      grasps.push_back(set);
    }
  }
  std::vector<int> steps(grasps.size(), -1);
  std::queue<int> queue;
  steps[0] = 0;
  queue.push(0);
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop();
    for (std::size_t next = 0; next < grasps.size(); ++next) {
      if (steps[next] >= 0) continue;
      if (criteria::ContactSet::CountUnion(grasps[at], grasps[next]) > space.fingers()) continue;
      steps[next] = steps[at] + 1;
      queue.push(static_cast<int>(next));
    }
  }
  return steps[1];
}

std::vector<int> Numbers(const SearchSpace& space) {
  std::vector<int> contacts(space.count());
  for (int i = 0; i < space.count(); ++i) contacts[i] = i;
  return contacts;
}

struct Case {
  const char* model;
  double degrees;
  int from_contacts;
  int to_contacts;
};

class SubsetSearchCases : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, SubsetSearchCases,
                         testing::Values(Case{"cube.obj", 25, 4, 4}, Case{"cube.obj", 30, 3, 5},
                                         Case{"l_block.obj", 12, 4, 4},
                                         Case{"star500.obj", 20, 4, 3},
                                         Case{"polygon20.wkt", 15, 2, 3},
                                         Case{"triangle.wkt", 25, 3, 3},
                                         Case{"polygon_hole.wkt", 10, 4, 2}),
                         [](const auto& test) { return "case" + std::to_string(test.index); });

TEST_P(SubsetSearchCases, FindsTheFewestSwitchesOfAllSubsets) {
  const object::ObjectFile file = ReadModel(GetParam().model);
  const criteria::GraspCriteria criteria{Radians(GetParam().degrees), 0};
  RandomStream random(7, RandomUse::kStart);
  int joined = 0;
  int apart = 0;
  for (int i = 0; i < 12; ++i) {
    SearchSpace space(*file.object, criteria);
    const auto from =
        Take(DrawGrasp(*file.object, GetParam().from_contacts, criteria, random), space);
    const auto to = Take(DrawGrasp(*file.object, GetParam().to_contacts, criteria, random), space);
    const int expected = FewestSwitches(from, to, Numbers(space), space);
    const auto path = SearchOwnSubsets(from, to, space);
    ASSERT_EQ(path.has_value(), expected >= 0);
    if (!path) {
      ++apart;
      continue;
    }
    ++joined;
    EXPECT_EQ(static_cast<int>(path->steps.size()), expected);
    EXPECT_TRUE(path->start == from);
    EXPECT_TRUE(path->end() == to);
    const criteria::ContactSet* before = &path->start;
    for (const PathStep& step : path->steps) {
      EXPECT_LE(criteria::ContactSet::CountUnion(*before, step.to), space.fingers());
      EXPECT_TRUE(grasp::IsForceClosure(space.GraspOf(step.to), file.object->wrench_frame(),
                                        criteria.friction_angle));
      before = &step.to;
    }
  }
  EXPECT_GT(joined + apart, 0);
  EXPECT_GT(joined, 0);
}

/// Return the least friction angle at which `steps` switches connect two grasps, based only on its
/// definition.
double LeastFrictionAngle(const criteria::ContactSet& from, const criteria::ContactSet& to,
                          const std::vector<int>& contacts, int steps, const SearchSpace& space) {
  std::vector<std::pair<criteria::ContactSet, double>> grasps = {{from, 0}, {to, 0}};
  for (const criteria::ContactSet& set :
       AllSets(contacts, space.fewest_contacts(), space.fingers() - 1)) {
    if (set == from || set == to) continue;
    const auto required =
        grasp::ComputeRequiredFrictionAngle(space.GraspOf(set), space.object().wrench_frame());
    if (required) grasps.emplace_back(set, required->upper);
  }
  std::vector<double> least(grasps.size(), std::numeric_limits<double>::infinity());
  least[0] = 0;
  for (int step = 0; step < steps; ++step) {
    const std::vector<double> before = least;
    for (std::size_t a = 0; a < grasps.size(); ++a) {
      for (std::size_t b = 0; b < grasps.size(); ++b) {
        if (criteria::ContactSet::CountUnion(grasps[a].first, grasps[b].first) > space.fingers())
          continue;
        least[b] = std::min(least[b], std::max(before[a], grasps[b].second));
      }
    }
  }
  return least[1];
}

TEST_P(SubsetSearchCases, TheWidestWayNeedsTheLeastHalfAngleOfAllSubsets) {
  const object::ObjectFile file = ReadModel(GetParam().model);
  const criteria::GraspCriteria criteria{Radians(GetParam().degrees), 0};
  constexpr double kAccuracy = 1.1e-3;
  RandomStream random(11, RandomUse::kStart);
  int wider = 0;
  for (int i = 0; i < 8; ++i) {
    SearchSpace space(*file.object, criteria);
    const auto from =
        Take(DrawGrasp(*file.object, GetParam().from_contacts, criteria, random), space);
    const auto to = Take(DrawGrasp(*file.object, GetParam().to_contacts, criteria, random), space);
    const std::vector<int> contacts = Numbers(space);
    for (const int steps : {2, 3, 4}) {
      const double expected = LeastFrictionAngle(from, to, contacts, steps, space);
      const auto path = SearchWidest(from, to, contacts, UseAligns::kNo, steps, 0, space);
      EXPECT_EQ(space.friction_angle(), criteria.friction_angle);
      if (expected > criteria.friction_angle) {
        EXPECT_FALSE(path);
      }
      if (expected > criteria.friction_angle - kAccuracy) continue;
      ASSERT_TRUE(path);
      ++wider;
      EXPECT_LE(static_cast<int>(path->steps.size()), steps);
      for (const PathStep& step : path->steps) {
        if (step.to == to) continue;
        EXPECT_TRUE(grasp::IsForceClosure(space.GraspOf(step.to), file.object->wrench_frame(),
                                          expected + kAccuracy));
      }
      // If the bound excludes a path, none is searched.
      EXPECT_FALSE(
          SearchWidest(from, to, contacts, UseAligns::kNo, steps, criteria.friction_angle, space));
    }
  }
  EXPECT_GT(wider, 0);
}

TEST(SubsetSearch, MoreContactsAndAlignsNeverNeedMoreSteps) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const criteria::GraspCriteria criteria{Radians(20), 0};
  RandomStream random(3, RandomUse::kStart);
  const sampling::SurfaceSampler source(*file.object);
  int aligns = 0;
  for (int i = 0; i < 20; ++i) {
    SearchSpace space(*file.object, criteria);
    const auto from = Take(DrawGrasp(*file.object, 4, criteria, random), space);
    const auto to = Take(DrawGrasp(*file.object, 4, criteria, random), space);
    const auto own = SearchOwnSubsets(from, to, space);
    for (int k = 0; k < 4; ++k) (void)space.Add(source.Draw(random));
    const std::vector<int> contacts = Numbers(space);
    const auto more = SearchSubsets(from, to, contacts, UseAligns::kNo, kAnySteps, space);
    const auto aligned = SearchSubsets(from, to, contacts, UseAligns::kYes, kAnySteps, space);
    if (!own) continue;
    ASSERT_TRUE(more && aligned);
    EXPECT_LE(more->steps.size(), own->steps.size());
    EXPECT_LE(aligned->steps.size(), more->steps.size());
    for (const PathStep& step : aligned->steps) aligns += step.align ? 1 : 0;
    EXPECT_FALSE(SearchSubsets(from, to, contacts, UseAligns::kNo,
                               static_cast<int>(more->steps.size()) - 1, space));
  }
  EXPECT_GT(aligns, 0);
}

TEST(SubsetSearch, ContactsAtOnePointAreNotHeldAtOnce) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const criteria::GraspCriteria criteria{Radians(25), 0};
  RandomStream random(5, RandomUse::kStart);
  const grasp::Grasp grasp = DrawGrasp(*file.object, 4, criteria, random);
  grasp::Grasp shifted = grasp;
  // The same grasp except for a different contact within the reader's tolerance of it.
  shifted[0].p += 1e-7 * file.object->diameter() * shifted[0].n.unitOrthogonal();
  SearchSpace space(*file.object, criteria);
  const criteria::ContactSet from = Take(grasp, space);
  const criteria::ContactSet to = Take(shifted, space);
  EXPECT_EQ(space.count(), 5);
  EXPECT_FALSE(space.CanMeet(0, 4));
  const auto path = SearchOwnSubsets(from, to, space);
  if (path) {
    const criteria::ContactSet* before = &path->start;
    for (const PathStep& step : path->steps) {
      EXPECT_FALSE((before->Has(0) || step.to.Has(0)) && (before->Has(4) || step.to.Has(4)));
      before = &step.to;
    }
  }
}

}  // namespace subset_search_test
}  // namespace regrasp::tree
