#include "planner/tree/face_align.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/plan/check_step.h"
#include "planner/tree/bidirectional_tree.h"
#include "planner/tree/surface_route.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace face_align_test {

using Eigen::Vector3d;

motion::GraspMotion MotionOf(const grasp::Grasp& from, const grasp::Grasp& to) {
  motion::GraspMotion motion;
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  return motion;
}

int TurnsOf(const std::vector<grasp::Grasp>& waypoints) {
  int turns = 0;
  for (std::size_t w = 1; w < waypoints.size(); ++w) {
    for (std::size_t i = 0; i < waypoints[w].size(); ++i) {
      turns += waypoints[w][i].face != waypoints[w - 1][i].face ? 1 : 0;
    }
  }
  return turns;
}

/// Expect a sliding step that a plan may contain and that is force closure at every sampled
/// instant. Its proof must be valid in exact arithmetic.
void ExpectSound(const FaceAlign& align, const SearchSpace& space) {
  constexpr int kInstants = 64;
  const std::vector<grasp::Grasp> waypoints = WaypointsOf(align, space);
  ASSERT_EQ(align.proof.size() + 1, waypoints.size());
  for (std::size_t w = 0; w + 1 < waypoints.size(); ++w) {
    const grasp::Grasp& from = waypoints[w];
    const grasp::Grasp& to = waypoints[w + 1];
    int turns = 0;
    int moves = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      EXPECT_EQ(plan::FindMotionFault(space.object(), from[i], to[i]), std::nullopt);
      turns += from[i].face != to[i].face ? 1 : 0;
      moves += from[i].p != to[i].p ? 1 : 0;
    }
    EXPECT_TRUE(turns == 0 || (turns == 1 && moves == 0)) << "the others stand still";
    const motion::GraspMotion motion = MotionOf(from, to);
    for (int k = 0; k <= kInstants; ++k) {
      EXPECT_TRUE(grasp::IsForceClosure(motion::GraspAt(motion, static_cast<double>(k) / kInstants),
                                        space.object().wrench_frame(), space.friction_angle()));
    }
    const auto verdict = motion::CheckMotionProof(from, to, space.dimension(),
                                                  std::tan(space.friction_angle()), align.proof[w]);
    EXPECT_TRUE(verdict.proves()) << verdict.why;
  }
}

void ExpectSameContacts(const grasp::Grasp& a, const grasp::Grasp& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].p, b[i].p);
    EXPECT_EQ(a[i].n, b[i].n);
    EXPECT_EQ(a[i].face, b[i].face);
  }
}

struct Case {
  const char* model;
  double degrees;
  int contacts;
};

class FaceAlignCases : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, FaceAlignCases,
                         testing::Values(Case{"cube.obj", 25, 4}, Case{"cube.obj", 15, 5},
                                         Case{"stone.obj", 15, 4}, Case{"ellipsoid500.obj", 20, 4},
                                         Case{"polygon20.wkt", 20, 3}, Case{"square.wkt", 25, 4},
                                         Case{"polygon_hole.wkt", 15, 4}),
                         [](const auto& test) { return "case" + std::to_string(test.index); });

TEST_P(FaceAlignCases, AlignsAcrossEdgesAreProvedAndLegalBothWays) {
  const object::ObjectFile file = ReadModel(GetParam().model);
  const criteria::GraspCriteria criteria{Radians(GetParam().degrees), 0};
  const sampling::SurfaceSampler source(*file.object);
  RandomStream random(11, RandomUse::kStart);
  int across = 0;
  for (int i = 0; i < 400 && across < 20; ++i) {
    SearchSpace space(*file.object, criteria);
    const grasp::Grasp grasp = DrawGrasp(*file.object, GetParam().contacts, criteria, random);
    grasp::Grasp other = grasp;
    for (int k = 0; k <= i % 3; ++k) {
      other[k] = source.DrawAround(grasp[k], file.object->diameter() / 4, random);
    }
    if (!space.IsAdmitted(other)) continue;
    const criteria::ContactSet from = Take(grasp, space);
    const criteria::ContactSet to = Take(other, space);
    const auto align = AlignBetween(from, to, space);
    if (!align || align->between.empty()) continue;
    ++across;
    ExpectSound(*align, space);
    const std::vector<grasp::Grasp> waypoints = WaypointsOf(*align, space);
    EXPECT_GE(TravelOf(*align, space), DistanceBetween(from, to, space) - 1e-12);
    const FaceAlign back = Reversed(*align);
    ExpectSound(back, space);
    std::vector<grasp::Grasp> reversed = WaypointsOf(back, space);
    ASSERT_EQ(reversed.size(), waypoints.size());
    for (std::size_t w = 0; w < waypoints.size(); ++w) {
      ExpectSameContacts(reversed[reversed.size() - 1 - w], waypoints[w]);
    }
  }
  EXPECT_GE(across, 10);
}

/// Return true if a grasp is force closure with all fingers of the hand, and not without any one of
/// them.
bool NeedsAll(const criteria::ContactSet& set, SearchSpace& space) {
  return set.size() == space.fingers() && space.Admits(set) &&
         std::none_of(set.begin(), set.end(),
                      [&](int contact) { return space.Admits(set.Without(contact)); });
}

class NeedingAll : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, NeedingAll,
                         testing::Values(Case{"stone.obj", 10, 5}, Case{"body14.obj", 10, 5},
                                         Case{"polygon20.wkt", 5, 4}),
                         [](const auto& test) { return "case" + std::to_string(test.index); });

TEST_P(NeedingAll, OnlyAnAlignAcrossAnEdgeJoinsGraspsThatNeedAllFingers) {
  // No finger of either grasp can be lifted, and the grasps are on different faces. Hence neither a
  // switch nor a sliding step on one tuple of faces connects them to other grasps.
  const object::ObjectFile file = ReadModel(GetParam().model);
  const criteria::GraspCriteria criteria{Radians(GetParam().degrees), 0};
  const sampling::SurfaceSampler source(*file.object);
  RandomStream random(5, RandomUse::kStart);
  int joined = 0;
  for (int i = 0; i < 4000 && joined < 3; ++i) {
    SearchSpace space(*file.object, criteria);
    const grasp::Grasp grasp = DrawGrasp(*file.object, GetParam().contacts, criteria, random);
    const criteria::ContactSet from = space.Add(grasp);
    if (!NeedsAll(from, space)) continue;
    for (int k = 0; k < 40; ++k) {
      grasp::Grasp other = grasp;
      grasp::Contact& moved = other[k % GetParam().contacts];
      moved = source.DrawAround(moved, file.object->diameter() / 8, random);
      const criteria::ContactSet to = space.Add(other);
      if (TupleOf(to, space) == TupleOf(from, space) || !NeedsAll(to, space)) continue;
      const auto align = AlignBetween(from, to, space);
      if (!align) continue;
      ++joined;
      ExpectSound(*align, space);
      EXPECT_GT(TurnsOf(WaypointsOf(*align, space)), 0);
      break;
    }
  }
  EXPECT_EQ(joined, 3);
}

TEST(FaceAlignTest, PairsContactsAcrossAsFewEdgesAsCanBeAndNoneThatAreFarApart) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const object::Object& cube = *file.object;
  SearchSpace space(cube, {Radians(25), 0});
  const sampling::SurfaceSampler source(cube);
  RandomStream random(1, RandomUse::kStart);
  const auto draw = [&](FaceIndex face) { return space.Add(source.DrawOn(face, random)); };
  const FaceIndex first(0);
  FaceIndex opposite{1};
  while (cube.AreNeighbours(first, opposite)) ++opposite;
  const FaceIndex side(opposite == 1 ? 2 : 1);
  const FaceIndex third = [&] {
    FaceIndex face{0};
    while (face == 0 || face == opposite || face == side || !cube.AreNeighbours(face, side)) ++face;
    return face;
  }();
  const int a = draw(first), b = draw(side), c = draw(opposite);
  const criteria::ContactSet from = criteria::ContactSet().With(a).With(b).With(c);
  // The contact of face 0 moves to `third`, the other contacts stay on their faces.
  const int d = draw(side), e = draw(opposite), f = draw(third);
  const auto pairs = PairContacts(from, criteria::ContactSet().With(d).With(e).With(f), space);
  ASSERT_TRUE(pairs);
  EXPECT_THAT(*pairs,
              testing::UnorderedElementsAre(std::pair(a, f), std::pair(b, d), std::pair(c, e)));
  // Common contacts stay in place.
  const auto same = PairContacts(from, criteria::ContactSet().With(a).With(d).With(e), space);
  ASSERT_TRUE(same);
  EXPECT_THAT(*same,
              testing::UnorderedElementsAre(std::pair(a, a), std::pair(b, d), std::pair(c, e)));
  // Two of three contacts would have to move to face 0 from the opposite side of the cube.
  const criteria::ContactSet far =
      criteria::ContactSet().With(draw(opposite)).With(draw(opposite)).With(c);
  const criteria::ContactSet near =
      criteria::ContactSet().With(draw(first)).With(draw(first)).With(a);
  EXPECT_FALSE(PairContacts(far, near, space));
  EXPECT_FALSE(AlignBetween(far, near, space));
  EXPECT_FALSE(PairContacts(from, criteria::ContactSet().With(a).With(b), space))
      << "one finger fewer";
}

/// Return the friction angle that the rotation in a sliding step requires at a share of it,
/// radians.
double RequiredWhileTurning(const std::vector<grasp::Grasp>& waypoints, double t,
                            const object::WrenchFrame& frame) {
  for (std::size_t w = 1; w < waypoints.size(); ++w) {
    if (TurnsOf({waypoints[w - 1], waypoints[w]}) == 0) continue;
    const auto required = grasp::ComputeRequiredFrictionAngle(
        motion::GraspAt(MotionOf(waypoints[w - 1], waypoints[w]), t), frame);
    return required ? required->upper : std::numeric_limits<double>::infinity();
  }
  return 0;
}

TEST(FaceAlignTest, FrictionThatHoldsOnBothSidesOfAnEdgeMayBeTooSmallBetween) {
  // Halfway through the turn, the grasp may require a larger friction angle than at both ends.
  const object::ObjectFile file = ReadModel("cube.obj");
  const object::Object& cube = *file.object;
  const sampling::SurfaceSampler source(cube);
  RandomStream random(2, RandomUse::kStart);
  const criteria::GraspCriteria criteria{Radians(25), 0};
  int lost = 0;
  for (int i = 0; i < 3000 && lost < 2; ++i) {
    const grasp::Grasp grasp = DrawGrasp(cube, 4, criteria, random);
    grasp::Grasp other = grasp;
    other[0] = source.DrawAround(grasp[0], cube.diameter() / 4, random);
    SearchSpace space(cube, criteria);
    if (other[0].face == grasp[0].face || !space.IsAdmitted(other)) continue;
    const auto align = AlignBetween(Take(grasp, space), Take(other, space), space);
    if (!align || TurnsOf(WaypointsOf(*align, space)) != 1) continue;
    const std::vector<grasp::Grasp> waypoints = WaypointsOf(*align, space);
    const auto required = [&](double t) {
      return RequiredWhileTurning(waypoints, t, cube.wrench_frame());
    };
    const double ends = std::max(required(0), required(1));
    if (required(0.5) < ends + Radians(0.5)) continue;
    const criteria::GraspCriteria less{(ends + required(0.5)) / 2, 0};
    SearchSpace smooth(cube, less);
    if (!smooth.IsAdmitted(grasp) || !smooth.IsAdmitted(other)) continue;
    ++lost;
    EXPECT_FALSE(AlignBetween(Take(grasp, smooth), Take(other, smooth), smooth));
  }
  EXPECT_EQ(lost, 2);
}

TEST(FaceAlignTest, ThickFingersDoNotTurnWhereTheyWouldMeet) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const object::Object& cube = *file.object;
  const criteria::GraspCriteria criteria{Radians(30), 0};
  const hand::Hand thick{.fingertip_radius = cube.diameter() / 10};
  const sampling::SurfaceSampler source(cube);
  RandomStream random(3, RandomUse::kStart);
  int kept = 0;
  int blocked = 0;
  for (int i = 0; i < 3000 && (kept == 0 || blocked == 0); ++i) {
    const grasp::Grasp grasp = DrawGrasp(cube, 4, criteria, random, thick);
    grasp::Grasp other = grasp;
    other[0] = source.DrawAround(grasp[0], cube.diameter() / 3, random);
    SearchSpace thick_space(cube, criteria, thick);
    if (other[0].face == grasp[0].face || !thick_space.IsAdmitted(other)) continue;
    SearchSpace space(cube, criteria);
    if (!AlignBetween(Take(grasp, space), Take(other, space), space)) continue;
    const auto align =
        AlignBetween(Take(grasp, thick_space), Take(other, thick_space), thick_space);
    ++(align ? kept : blocked);
    if (align) ExpectSound(*align, thick_space);
  }
  EXPECT_GT(kept, 0);
  EXPECT_GT(blocked, 0);
}

}  // namespace face_align_test
}  // namespace regrasp::tree
