#include "planner/tree/bidirectional_tree.h"

#include <gtest/gtest.h>

#include "planner/grasp/force_closure.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/plan/check.h"
#include "planner/tree/improve_path.h"
#include "planner/tree/subset_search.h"
#include "planner/tree/tree_planner.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace bidirectional_tree_test {

constexpr std::int64_t kEffort = 300'000;

plan::Plan PlanOf(const GraspPath& path, const grasp::Grasp& from, const grasp::Grasp& to,
                  const SearchSpace& space) {
  const planning::CandidateSequence candidate = MakeCandidate(path, from, space);
  plan::Plan plan;
  plan.dimension = space.dimension();
  plan.friction_angle = space.criteria().friction_angle;
  plan.fingers = space.fingers();
  plan.initial = candidate.initial;
  plan.steps = candidate.steps;
  plan.goal = to;
  return plan;
}

/// Check the proof of every sliding step in exact arithmetic. @returns number of sliding steps.
int CheckAligns(const GraspPath& path, const SearchSpace& space) {
  int aligns = 0;
  for (const PathStep& step : path.steps) {
    if (!step.align) continue;
    ++aligns;
    const std::vector<grasp::Grasp> waypoints = WaypointsOf(*step.align, space);
    for (std::size_t w = 0; w + 1 < waypoints.size(); ++w) {
      EXPECT_EQ(motion::CheckMotionProof(waypoints[w], waypoints[w + 1], space.dimension(),
                                         std::tan(space.friction_angle()), step.align->proof.at(w))
                    .kind,
                motion::ProofVerdict::Kind::kForceClosure);
    }
  }
  return aligns;
}

struct Case {
  const char* model;
  double degrees;
  int contacts;
};

class BidirectionalTreeCases : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, BidirectionalTreeCases,
                         testing::Values(Case{"cube.obj", 5, 4}, Case{"prism.obj", 10, 4},
                                         Case{"tetrahedron.obj", 10, 4}, Case{"stone.obj", 7, 4},
                                         Case{"l_block.obj", 10, 5}, Case{"cube.obj", 30, 3},
                                         Case{"polygon20.wkt", 6, 2}, Case{"triangle.wkt", 5, 3},
                                         Case{"polygon_hole.wkt", 12, 4}),
                         [](const auto& test) { return "case" + std::to_string(test.index); });

TEST_P(BidirectionalTreeCases, JoinGraspsByWaysThatTheCheckerPasses) {
  const object::ObjectFile file = ReadModel(GetParam().model);
  const object::Object& object = *file.object;
  const criteria::GraspCriteria criteria{Radians(GetParam().degrees), 0};
  const sampling::SurfaceSampler source(object);
  RandomStream draws(11, RandomUse::kStart);
  int joined = 0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const grasp::Grasp from = DrawGrasp(object, GetParam().contacts, criteria, draws);
    const grasp::Grasp to = DrawGrasp(object, GetParam().contacts, criteria, draws);
    SearchSpace space(object, criteria);
    space.SetLimits({.most_tests = kEffort});
    RandomStream random(i, RandomUse::kCandidates);
    BidirectionalTree trees(Take(from, space), Take(to, space), source, random, space);
    const auto path = trees.Join();
    ASSERT_TRUE(path) << i << ": " << trees.tree(0).size() << " and " << trees.tree(1).size();
    ++joined;
    CheckAligns(*path, space);
    EXPECT_TRUE(plan::CheckPlan(object, PlanOf(*path, from, to, space)).passed()) << i;

    const GraspPath shorter = ShortcutPath(*path, source, random, space);
    CheckAligns(shorter, space);
    EXPECT_LE(shorter.steps.size(), path->steps.size());
    const plan::PlanCheck checked = plan::CheckPlan(object, PlanOf(shorter, from, to, space));
    EXPECT_TRUE(checked.passed()) << i;

    const GraspPath wider = MaximiseMargin(shorter, 0, source, random, space);
    EXPECT_LE(wider.steps.size(), shorter.steps.size());
    EXPECT_LE(RequiredFrictionAngleOf(wider, space),
              RequiredFrictionAngleOf(shorter, space) + 1e-6);
    CheckAligns(wider, space);
    EXPECT_TRUE(plan::CheckPlan(object, PlanOf(wider, from, to, space)).passed()) << i;
  }
  EXPECT_EQ(joined, 6);
}

TEST(BidirectionalTree, WithTooLittleFrictionReachNothingElse) {
  // At 0.1 degrees a cube's faces allow almost no motion; the ends are accepted unchanged.
  const object::ObjectFile file = ReadModel("cube.obj");
  RandomStream draws(2, RandomUse::kStart);
  const grasp::Grasp from = DrawGrasp(*file.object, 4, {Radians(25), 0}, draws);
  const grasp::Grasp to = DrawGrasp(*file.object, 4, {Radians(25), 0}, draws);
  SearchSpace space(*file.object, {Radians(0.1), 0});
  space.SetLimits({.most_tests = 2000});
  RandomStream random(0, RandomUse::kCandidates);
  const sampling::SurfaceSampler source(*file.object);
  BidirectionalTree trees(Take(from, space), Take(to, space), source, random, space);
  EXPECT_FALSE(trees.Join());
  EXPECT_GE(space.tests(), 2000);
  EXPECT_GE(trees.tree(0).size(), 1);
}

TEST(BidirectionalTree, AGraspIsJoinedToItselfWithoutAStep) {
  const object::ObjectFile file = ReadModel("cube.obj");
  RandomStream draws(2, RandomUse::kStart);
  const grasp::Grasp grasp = DrawGrasp(*file.object, 4, {Radians(25), 0}, draws);
  SearchSpace space(*file.object, {Radians(25), 0});
  RandomStream random(0, RandomUse::kCandidates);
  const sampling::SurfaceSampler source(*file.object);
  const criteria::ContactSet set = Take(grasp, space);
  const auto path = BidirectionalTree(set, set, source, random, space).Join();
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->steps.empty());
}

}  // namespace bidirectional_tree_test

namespace transition_test {

constexpr std::int64_t kEffort = 20'000;

std::vector<FaceIndex> FacesOf(const grasp::Grasp& grasp) {
  std::vector<FaceIndex> faces;
  for (const grasp::Contact& contact : grasp) faces.push_back(contact.face);
  return faces;
}

SearchSpace SpaceFor(const object::Object& object, const criteria::GraspCriteria& criteria) {
  SearchSpace space(object, criteria);
  space.SetLimits({.most_tests = kEffort});
  return space;
}

TEST(FindTransition, MovesUntilAFingerCanBeSwitched) {
  const object::ObjectFile file = ReadModel("pyramid.obj");
  const object::Object& object = *file.object;
  const criteria::GraspCriteria criteria{Radians(5), 0};
  const sampling::SurfaceSampler source(object);
  RandomStream random(3, RandomUse::kCandidates);
  RandomStream draws(3, RandomUse::kStart);
  int found = 0, moved = 0;
  for (int i = 0; i < 40; ++i) {
    const grasp::Grasp before = DrawGrasp(object, 4, criteria, draws);
    const int leaving = static_cast<int>(random.Index(4));
    const FaceIndex face(random.Index(object.face_count()));
    const grasp::Contact placed = source.DrawOn(face, random);
    SearchSpace space = SpaceFor(object, criteria);
    const auto transition = FindTransition(before, leaving, placed, source, random, space);
    if (!transition) continue;
    ++found;
    ASSERT_FALSE(transition->path.empty());
    EXPECT_EQ(transition->path.front().front().p, before.front().p);
    for (const grasp::Grasp& grasp : transition->path) {
      EXPECT_EQ(FacesOf(grasp), FacesOf(before));
      EXPECT_TRUE(grasp::IsForceClosure(grasp, object.wrench_frame(), criteria.friction_angle));
    }
    const grasp::Grasp& last = transition->path.back();
    if (transition->path.size() > 1) ++moved;
    EXPECT_TRUE(
        grasp::IsForceClosure(transition->after, object.wrench_frame(), criteria.friction_angle));
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(transition->after[k].p == last[k].p, k != leaving) << "one finger is switched";
      EXPECT_TRUE(space.CanMeet(last[k], transition->after[leaving]));
    }
    EXPECT_EQ(transition->after[leaving].face, face);
  }
  EXPECT_GE(found, 8);
  EXPECT_GE(moved, 6) << "hardly any of these grasps allows the switch where it stands";
}

TEST(FindTransition, FindsNoneWhereTheLaterFacesHoldNothing) {
  // Two contacts on one face of a cube and one on a neighbouring face: at 10° no force opposes
  // them.
  const object::ObjectFile file = ReadModel("cube.obj");
  const object::Object& object = *file.object;
  const criteria::GraspCriteria criteria{Radians(10), 0};
  const sampling::SurfaceSampler source(object);
  RandomStream random(5, RandomUse::kCandidates);
  RandomStream draws(5, RandomUse::kStart);
  int tried = 0;
  for (int i = 0; i < 40; ++i) {
    const grasp::Grasp before = DrawGrasp(object, 3, criteria, draws);
    for (int leaving = 0; leaving < 3; ++leaving) {
      const grasp::Contact& left = before[(leaving + 1) % 3];
      if (left.face != before[(leaving + 2) % 3].face) continue;
      grasp::Contact placed = source.Draw(random);
      while (placed.n.dot(left.n) < -0.5) placed = source.Draw(random);
      SearchSpace space = SpaceFor(object, criteria);
      EXPECT_FALSE(FindTransition(before, leaving, placed, source, random, space));
      ++tried;
    }
  }
  EXPECT_GE(tried, 20);
}

TEST(FindTransition, IsTheSameForTheSameSeed) {
  const object::ObjectFile file = ReadModel("pyramid.obj");
  const object::Object& object = *file.object;
  const criteria::GraspCriteria criteria{Radians(8), 0};
  const sampling::SurfaceSampler source(object);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto find = [&] {
      RandomStream draws(seed, RandomUse::kStart);
      const grasp::Grasp before = DrawGrasp(object, 4, criteria, draws);
      RandomStream random(seed, RandomUse::kCandidates);
      SearchSpace space = SpaceFor(object, criteria);
      const grasp::Contact placed = source.Draw(random);
      return FindTransition(before, 1, placed, source, random, space);
    };
    const auto once = find(), again = find();
    ASSERT_EQ(once.has_value(), again.has_value());
    if (!once) continue;
    ++found;
    ASSERT_EQ(once->path.size(), again->path.size());
    for (int k = 0; k < 4; ++k) EXPECT_EQ(once->after[k].p, again->after[k].p);
  }
  EXPECT_GT(found, 0);
}

}  // namespace transition_test
}  // namespace regrasp::tree
