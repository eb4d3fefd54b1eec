#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/sampling/contact_points.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/sets/polyhedron/normal_quadruples.h"
#include "planner/tree/tree_planner.h"
#include "tests/fixtures/plan_with.h"
#include "tests/fixtures/soups.h"

namespace regrasp::tree {
namespace sealed_cavity_test {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Return [−1, 1]³ with the cavity [−0.9, 0.9]³, which has nearly half of the surface. The file
/// begins with the cavity or with the outer surface.
object::Polyhedron MakeHollowCube(bool cavity_first) {
  object::PolygonSoup cavity = soups::BoxSoup(Vector3d::Constant(-0.9), Vector3d::Constant(0.9));
  soups::Turn(cavity);
  const object::PolygonSoup outside = soups::BoxSoup(Vector3d::Constant(-1), Vector3d::Constant(1));
  return object::Polyhedron::FromSoup(
      cavity_first ? soups::Join(cavity, outside) : soups::Join(outside, cavity), "hollow");
}

/// Counts contacts and expects none in the cavity.
class OutsideOnly {
 public:
  explicit OutsideOnly(const object::Object& object) : object_(object) {}
  void See(const grasp::Contact& contact) {
    EXPECT_FALSE(object_.IsEnclosed(contact.face));
    EXPECT_NEAR(contact.p.lpNorm<Eigen::Infinity>(), 1, 1e-9);
    ++seen_;
  }
  [[nodiscard]] int seen() const { return seen_; }

 private:
  const object::Object& object_;
  int seen_ = 0;
};

class SealedCavity : public ::testing::TestWithParam<bool> {
 protected:
  const object::Polyhedron hollow_ = MakeHollowCube(GetParam());
  OutsideOnly outside_{hollow_};
  RandomStream random_{1, RandomUse::kStart};
};

INSTANTIATE_TEST_SUITE_P(CavityFirst, SealedCavity, ::testing::Bool());

TEST_P(SealedCavity, ThePlannerGeneralDrawsNothingFromIt) {
  const sampling::SurfaceSampler source(hollow_);
  grasp::Contact contact = source.Draw(random_);
  for (int i = 0; i < 300; ++i) {
    outside_.See(contact = source.Draw(random_));
    // The radius exceeds the wall thickness of 0.1.
    outside_.See(source.DrawAround(contact, 0.2, random_));
    outside_.See(source.DrawOn(contact.face, random_));
  }
  EXPECT_EQ(outside_.seen(), 900);
}

TEST_P(SealedCavity, RoadmapsHaveNoContactPointsThere) {
  const sampling::SurfaceSampler sampler(hollow_);
  for (int i = 0; i < 300; ++i) outside_.See(sampler.DrawAnywhere(random_));
  EXPECT_NEAR(sampler.measure(), 24, 1e-12);
  for (const grasp::Contact& contact : sampling::SpreadContactPoints(hollow_, 50, 1))
    outside_.See(contact);
  EXPECT_EQ(outside_.seen(), 350);
}

TEST(SealedCavityOfAMesh, HasNoContactPoints) {
  object::PolygonSoup cavity = soups::SphereSoup(12);
  object::PolygonSoup outside = cavity;
  for (Vector3d& p : outside.vertices) p *= 1.2;
  soups::Turn(cavity);
  const object::Polyhedron hollow =
      object::Polyhedron::FromSoup(soups::Join(cavity, outside), "hollow");
  int enclosed = 0;
  for (FaceIndex face{0}; face < hollow.face_count(); ++face) enclosed += hollow.IsEnclosed(face);
  EXPECT_EQ(2 * enclosed, hollow.face_count());
  const std::vector<grasp::Contact> points =
      sampling::MeshContacts(hollow, static_cast<int>(hollow.triangles().size()), 1);
  EXPECT_EQ(2 * points.size(), hollow.triangles().size());
  for (const grasp::Contact& contact : points) EXPECT_FALSE(hollow.IsEnclosed(contact.face));
}

TEST(SealedCavityOfATetrahedron, HasNoFocusCells) {
  object::PolygonSoup outside = soups::CornerTetrahedronSoup();
  object::PolygonSoup cavity = outside;
  soups::Turn(cavity);
  for (Vector3d& p : outside.vertices) p = 9 * p - Vector3d::Ones();
  for (const bool cavity_first : {false, true}) {
    const object::Polyhedron hollow = object::Polyhedron::FromSoup(
        cavity_first ? soups::Join(cavity, outside) : soups::Join(outside, cavity), "hollow");
    const auto candidates = polyhedron::FindQuadrupleCandidates(hollow, std::tan(Radians(10)),
                                                                planning::Spanning::kAdaptive);
    ASSERT_EQ(candidates.size(), 1u);
    const int first = cavity_first ? 4 : 0;
    for (int k = 0; k < 4; ++k) EXPECT_EQ(candidates.front().faces[k], FaceIndex(first + k));
  }
}

TEST_P(SealedCavity, AGraspThereIsBadInputForPointsToo) {
  planning::GraspChoice choice;
  choice.name = "grasp.json";
  for (const double x : {-0.9, 0.9}) {
    for (FaceIndex face{0}; face < hollow_.face_count(); ++face) {
      if (hollow_.IsEnclosed(face) && hollow_.inward_normal(face).x() * x > 0) {
        for (const double y : {-0.05, 0.05}) {
          choice.grasp.push_back({{x, y, 0}, hollow_.inward_normal(face), face});
        }
      }
    }
  }
  ASSERT_EQ(choice.grasp.size(), 4u);
  EXPECT_THAT([&] { (void)PlanWith(TreePlanner(), hollow_, choice, choice, RequestAt(20)); },
              ThrowsMessage<InputError>(HasSubstr("finger 0: its contact is in a sealed cavity")));
}

}  // namespace sealed_cavity_test
}  // namespace regrasp::tree
