#include "planner/tree/transition.h"

#include <gtest/gtest.h>

#include "planner/grasp/force_closure.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
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
