#include "planner/collision/ball_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"
#include "planner/object/object.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::collision {
namespace ball_contact_test {

using Eigen::Vector3d;

object::Polyhedron Read(const std::string& name) {
  const object::ObjectFile file = object::ReadObject(ProjectPath("models/" + name));
  return dynamic_cast<const object::Polyhedron&>(*file.object);
}

TEST(BallContactTest, OverAFaceAnEdgeAndACornerOfACubeThereIsOnePoint) {
  const BallContact cube(Read("cube.obj"), 1);  // edge length 6 cm, centred at the origin
  const auto expect_one = [&](const Vector3d& centre, const Vector3d& nearest) {
    const auto found = cube.Find(centre, 0.02);
    ASSERT_EQ(found.size(), 1U) << centre.transpose();
    EXPECT_LT((found[0].point - nearest).norm(), 1e-12);
    EXPECT_NEAR(found[0].distance, (centre - nearest).norm(), 1e-12);
    EXPECT_LT((found[0].outward - (centre - nearest).normalized()).norm(), 1e-9);
  };
  expect_one({0.04, 0.011, -0.002}, {0.03, 0.011, -0.002});
  expect_one({0.04, 0, 0}, {0.03, 0, 0});  // on the diagonal between two triangles
  expect_one({0.035, 0.036, 0.01}, {0.03, 0.03, 0.01});
  expect_one({0.035, 0.036, 0.037}, {0.03, 0.03, 0.03});
  EXPECT_TRUE(cube.Find({0.06, 0, 0}, 0.02).empty());
}

TEST(BallContactTest, InAGrooveThereAreTwo) {
  const object::Polyhedron block = Read("l_block.obj");
  const BallContact surface(block, 1);
  // A sphere between two opposite faces has a point on each of them.
  RandomStream random(3, RandomUse::kGaits);
  const double size = block.diameter();
  int twice = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d at =
        block.mass_properties().centroid +
        size * Vector3d(random.Uniform() - 0.5, random.Uniform() - 0.5, random.Uniform() - 0.5);
    const auto found = surface.Find(at, 0.1 * size);
    if (found.size() < 2) continue;
    ++twice;
    EXPECT_LE(found[0].distance, found[1].distance);
    EXPECT_LT(found[0].outward.dot(found[1].outward), 0.999);
  }
  EXPECT_GT(twice, 0);
}

TEST(BallContactTest, TheNearestPointIsTheNearestOfManySamples) {
  const object::Polyhedron duck = Read("duck500.obj");
  const BallContact surface(duck, 1);
  RandomStream random(5, RandomUse::kGaits);
  int checked = 0;
  for (int i = 0; i < 50; ++i) {
    const auto& [a, b, c] = duck.triangles()[random.Index(duck.triangles().size())];
    const auto& v = duck.vertices();
    const Vector3d normal = (v[b] - v[a]).cross(v[c] - v[a]).normalized();
    const double away = 0.03 * duck.diameter();
    const Vector3d centre = (v[a] + v[b] + v[c]) / 3 + away * normal;
    const auto found = surface.Find(centre, 2 * away);
    ASSERT_FALSE(found.empty());
    EXPECT_LE(found.front().distance, away * (1 + 1e-9));
    for (const Vector3d& vertex : v) {
      EXPECT_GE((vertex - centre).norm(), found.front().distance - 1e-12);
    }
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

TEST(BallContactTest, AmongTheTrianglesAroundItIsTheSameToTheBit) {
  const object::Polyhedron duck = Read("duck500.obj");
  const BallContact surface(duck, 1);
  RandomStream random(6, RandomUse::kGaits);
  const double step = 0.02 * duck.diameter();
  int several = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d& at = duck.vertices()[random.Index(duck.vertices().size())];
    const Vector3d middle = at + step * Vector3d(random.Uniform(), random.Uniform(), 1);
    const std::vector<int> around = surface.Around(middle, 4 * step);
    const Vector3d centre = middle + 0.5 * step * Vector3d(1, -1, random.Uniform());
    const auto expected = surface.Find(centre, 3 * step);
    const auto found = surface.Find(centre, 3 * step, around);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(found[k].point, expected[k].point);
      EXPECT_EQ(found[k].outward, expected[k].outward);
    }
    several += found.size() > 1 ? 1 : 0;
    EXPECT_LT(around.size(), duck.triangles().size());
  }
  EXPECT_GT(several, 0);
}

}  // namespace ball_contact_test
}  // namespace regrasp::collision
