#include "planner/collision/shape_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/object/object.h"
#include "tests/fixtures/project_path.h"
#include "tests/fixtures/solids.h"

namespace regrasp::collision {
namespace shape_contact_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kHalf = 0.025;
constexpr double kSkin = 2e-4;

/// Return a cube of edge length 50 mm, centred at the origin.
const BallContact& Cube() {
  static const BallContact cube(MakeCube(), kHalf);
  return cube;
}

std::vector<int> Among(const ConvexShape& shape) {
  const BoundingSphere ball = BoundingSphereOf(shape);
  return Cube().Around(ball.centre, ball.radius + 0.01);
}

std::vector<SurfaceContact> Contacts(const ConvexShape& shape) {
  return FindContacts(Cube(), TreeShape(shape), Among(shape));
}

ConvexShape BoxShape(const Vector3d& half, const Isometry3d& pose) {
  ConvexShape box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                        (corner & 4) != 0 ? 1 : -1);
    box.points.push_back(pose * half.cwiseProduct(sign));
  }
  box.radius = kSkin;
  return box;
}

Vector3d Draw(RandomStream& random) {
  Vector3d drawn;
  for (double& x : drawn) x = random.Normal();
  return drawn;
}

Isometry3d At(const Vector3d& place) { return Isometry3d(Eigen::Translation3d(place)); }

TEST(ShapeContactTest, APointWithARadiusTouchesAsABall) {
  int touching = 0;
  for (const Vector3d& centre : {Vector3d(0, 0, 0.034), Vector3d(0.02, 0.031, 0.01),
                                 Vector3d(0.03, 0.03, 0.03), Vector3d(0, 0, 0.036)}) {
    const ConvexShape ball = {{centre}, 0.01};
    const std::vector<NearPoint> expected = Cube().Find(centre, 0.01);
    const std::vector<SurfaceContact> found = Contacts(ball);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].point, expected[i].point);
      EXPECT_EQ(found[i].outward, expected[i].outward);
      EXPECT_EQ(found[i].gap, expected[i].distance - 0.01);
      ++touching;
    }
  }
  EXPECT_EQ(touching, 3);
}

TEST(ShapeContactTest, ACapsuleOnAFaceTouchesWithBothEndsAndAcrossAnEdgeWithItsMiddle) {
  const std::vector<SurfaceContact> flat =
      Contacts({{{-0.01, 0, 0.0329}, {0.01, 0, 0.0329}}, 0.008});
  ASSERT_EQ(flat.size(), 2U);
  for (const SurfaceContact& contact : flat) {
    EXPECT_NEAR(contact.gap, -1e-4, 1e-12);
    EXPECT_NEAR((contact.outward - Vector3d::UnitZ()).norm(), 0, 1e-12);
    EXPECT_NEAR(std::abs(contact.point.x()), 0.01, 1e-12);
  }
  // At 45° to both faces, 7 mm above the edge.
  const double aside = 0.007 / std::numbers::sqrt2;
  const Vector3d middle(0, kHalf + aside, kHalf + aside);
  const Vector3d way(0, 0.02, -0.02);
  const std::vector<SurfaceContact> across = Contacts({{middle - way, middle + way}, 0.008});
  ASSERT_EQ(across.size(), 1U);
  EXPECT_NEAR(across[0].gap, -1e-3, 1e-9);
  EXPECT_NEAR((across[0].point - Vector3d(0, kHalf, kHalf)).norm(), 0, 1e-6);
  EXPECT_NEAR((across[0].outward - Vector3d(0, 1, 1).normalized()).norm(), 0, 1e-6);
}

TEST(ShapeContactTest, ABoxOnAFaceTouchesWithItsFourCornersHoweverDeepItIs) {
  const Vector3d half(0.004, 0.003, 0.005);
  for (const double depth : {1e-4, 1e-3, 2.5e-3}) {
    const double z = kHalf + half.z() + kSkin - depth;
    const std::vector<SurfaceContact> found = Contacts(BoxShape(half, At({0.001, 0.002, z})));
    ASSERT_EQ(found.size(), 4U) << depth;
    Vector3d sum = Vector3d::Zero();
    for (const SurfaceContact& contact : found) {
      EXPECT_NEAR(contact.gap, -depth, 1e-12);
      EXPECT_NEAR((contact.outward - Vector3d::UnitZ()).norm(), 0, 1e-12);
      sum += contact.point;
    }
    EXPECT_NEAR((sum / 4 - Vector3d(0.001, 0.002, kHalf)).norm(), 0, 1e-12);
  }
  EXPECT_TRUE(Contacts(BoxShape(half, At({0, 0, kHalf + half.z() + 2 * kSkin}))).empty());
}

TEST(ShapeContactTest, AnEdgeOfTheSolidUnderASideIsFoundAndPushedOut) {
  const Vector3d half(0.01, 0.01, 0.002);
  const Vector3d outward = Vector3d(0, 1, 1).normalized();
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(-std::numbers::pi / 4, Vector3d::UnitX()).toRotationMatrix();
  for (const double above : {0.5 * kSkin, -1e-3}) {
    pose.translation() = Vector3d(0, kHalf, kHalf) + (half.z() + above) * outward;
    const std::vector<SurfaceContact> found = Contacts(BoxShape(half, pose));
    ASSERT_FALSE(found.empty()) << above;
    EXPECT_NEAR(found[0].gap, above - kSkin, 1e-6) << above;
    EXPECT_GT(found[0].outward.dot(outward), 0.99) << above;
  }
}

TEST(ShapeContactTest, OfManyContactsTheDeepestOfEachPlaceAreKept) {
  // Spherical cap with many points.
  ConvexShape cap;
  cap.radius = kSkin;
  constexpr double kRadius = 0.02;
  for (int i = -20; i <= 20; ++i) {
    for (int k = -20; k <= 20; ++k) {
      const double x = 2e-4 * i;
      const double y = 2e-4 * k;
      cap.points.emplace_back(x, y, kRadius - std::sqrt(kRadius * kRadius - x * x - y * y));
    }
  }
  for (Vector3d& point : cap.points) point.z() += kHalf - 1e-4;
  const std::vector<SurfaceContact> found = Contacts(cap);
  ASSERT_FALSE(found.empty());
  EXPECT_LE(found.size(), static_cast<std::size_t>(kMostContacts));
  EXPECT_NEAR(found[0].gap, -1e-4 - kSkin, 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(found, {}, &SurfaceContact::gap));
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE((found[i].point - found[k].point).norm(), kApart);
    }
  }
}

/// Independent calculation: bounds of the distances to the triangles.
TEST(ShapeContactTest, TheNearestPlaceIsAsFarAsTheNearestTriangle) {
  RandomStream random(1, RandomUse::kTrialContacts);
  int checked = 0;
  for (int i = 0; i < 200; ++i) {
    Isometry3d pose = At(0.045 * Draw(random).normalized());
    pose.linear() =
        Eigen::AngleAxisd(random.Normal(), Draw(random).normalized()).toRotationMatrix();
    const ConvexShape shape = BoxShape({0.003, 0.005, 0.009}, pose);
    const auto found =
        FindNearest(Cube(), TreeShape(shape), 0.05, Cube().Around(Vector3d::Zero(), 1));
    double expected = 1;
    for (int triangle = 0; triangle < 12; ++triangle) {
      const auto& corners = Cube().corners(triangle);
      expected = std::min(expected, Distance(shape, {{corners.begin(), corners.end()}, 0}).upper);
    }
    ASSERT_TRUE(found);
    if (expected == 0) continue;
    EXPECT_NEAR(found->gap, expected, 1e-9) << i;
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

}  // namespace shape_contact_test

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
