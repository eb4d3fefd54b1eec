#include "bench/patch_judge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/random.h"
#include "planner/grasp/angle_between.h"
#include "planner/object/patch_normal.h"
#include "tests/fixtures/soups.h"

namespace regrasp {
namespace patch_judge_test {

using Eigen::Vector3d;
using object::Polyhedron;

/// What pieces at the rim of a patch may make of it.
constexpr double kDegrees = 1;

/// The angle between the two mean normals, degrees.
double Difference(const Polyhedron& solid, const grasp::Contact& contact, double radius) {
  return Degrees(grasp::AngleBetween(PatchJudge(solid, radius).MeanNormal(contact),
                                     object::PatchNormal(solid, contact.face, contact.p, radius)));
}

TEST(PatchJudge, AgreesWithWhatPlannersGoByOnANoisyBody) {
  object::PolygonSoup soup = soups::SphereSoup(20);
  RandomStream random(1, RandomUse::kTrialContacts);
  for (Vector3d& v : soup.vertices) v *= 1 + 0.02 * random.Normal();
  const Polyhedron body = Polyhedron::FromSoup(soup, "soup");
  double most_turned = 0;
  for (FaceIndex f{0}; f < body.face_count(); f = FaceIndex(f + 37)) {
    const grasp::Contact contact{body.CentroidOf(f), body.inward_normal(f), f};
    EXPECT_LT(Difference(body, contact, 0.3), kDegrees) << f;
    const Vector3d mean = PatchJudge(body, 0.3).MeanNormal(contact);
    most_turned = std::max(most_turned, grasp::AngleBetween(mean, contact.n));
  }
  EXPECT_GT(Degrees(most_turned), 5);
}

TEST(PatchJudge, AgreesBesideAnEdgeAndOnAThinWall) {
  const Polyhedron cube = Polyhedron::FromSoup(soups::UnitCubeSoup(), "soup");
  const Polyhedron plate = Polyhedron::FromSoup(soups::BoxSoup({0, 0, 0}, {1, 1, 0.01}), "soup");
  for (const Polyhedron* body : {&cube, &plate}) {
    for (FaceIndex f{0}; f < body->face_count(); ++f) {
      const Vector3d at = 0.8 * body->BordersOf(f).front().a + 0.2 * body->CentroidOf(f);
      EXPECT_LT(Difference(*body, {at, body->inward_normal(f), f}, 0.2), kDegrees) << f;
    }
  }
}

}  // namespace patch_judge_test
}  // namespace regrasp
