#include "planner/sets/polyhedron/union_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace union_volume_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-12;
constexpr int kPoints = 300;
constexpr std::uint64_t kSeed = 3;

class PointSource {
 public:
  Vector3d Next(double size) {
    return {size * unit_(engine_), size * unit_(engine_), size * unit_(engine_)};
  }

 private:
  std::mt19937_64 engine_{kSeed};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

/// Return the part's contacts on a grid of triangles about its first corner, including corners.
std::vector<Vector3d> ContactsOf(const FacePart& part, int cells) {
  std::vector<Vector3d> contacts;
  const auto& o = part.outline();
  for (std::size_t k = 1; k + 1 < o.size(); ++k) {
    for (int i = 0; i <= cells; ++i) {
      for (int j = 0; i + j <= cells; ++j) {
        const Vector2d y = o[0] + (o[k] - o[0]) * i / cells + (o[k + 1] - o[0]) * j / cells;
        contacts.push_back(part.origin + y.x() * part.u + y.y() * part.v);
      }
    }
  }
  return contacts;
}

/// Compute the value of one contact at x: cos φ · (distance from the cone's axis) − sin φ ·
/// (height), negative inside its cone.
double OfContact(const Vector3d& x, const Vector3d& contact, const Vector3d& axis, double tangent) {
  const double height = axis.dot(x - contact);
  const double aside = (x - contact - height * axis).norm();
  return (aside - tangent * height) / std::sqrt(1 + tangent * tangent);
}

/// Call `check` for every half of the small objects' parts, with its cone's axis.
template <class Check>
int ForEachHalf(double tangent, const Check& check) {
  int halves = 0;
  for (const NamedBody& named : SmallBodies()) {
    SCOPED_TRACE(named.name);
    const FaceParts split = SplitFaces(named.body);
    for (const FacePart& part : split.parts) {
      for (const bool inner : {true, false}) {
        check(named.body, part, UnionVolume(part, inner, tangent),
              inner ? part.normal : Vector3d(-part.normal));
        ++halves;
      }
    }
  }
  return halves;
}

TEST(UnionVolume, IsTheLeastOverItsContacts) {
  constexpr int kCells = 60;
  PointSource source;
  for (const double tangent : {0.1, 0.7, 2.0}) {
    const int halves =
        ForEachHalf(tangent, [&](const object::Polyhedron& body, const FacePart& part,
                                 const UnionVolume& volume, const Vector3d& axis) {
          const std::vector<Vector3d> contacts = ContactsOf(part, kCells);
          // Every point of the part is closer to the grid than this.
          const double spacing = body.diameter() / kCells;
          for (int i = 0; i < 10; ++i) {
            const Vector3d x = body.mass_properties().centroid + source.Next(body.diameter());
            double least = std::numeric_limits<double>::infinity();
            for (const Vector3d& contact : contacts) {
              least = std::min(least, OfContact(x, contact, axis, tangent));
            }
            EXPECT_LE(volume.At(x), least + kRounding);
            EXPECT_GE(volume.At(x), least - spacing);
          }
        });
    EXPECT_GT(halves, 100);
  }
}

TEST(UnionVolume, CutsTouchTheFunctionAtTheirPointAndAreBelowItElsewhere) {
  PointSource source;
  int compared = 0;
  ForEachHalf(0.5, [&](const object::Polyhedron& body, const FacePart&, const UnionVolume& volume,
                       const Vector3d&) {
    const Vector3d centre = body.mass_properties().centroid;
    for (int i = 0; i < kPoints; ++i) {
      const Vector3d x = centre + source.Next(body.diameter());
      const Cut cut = volume.CutAt(x);
      EXPECT_EQ(cut.At(x), volume.At(x));
      EXPECT_LE(cut.gradient.norm(), 1 + kRounding);
      const Vector3d y = centre + source.Next(i % 2 == 0 ? body.diameter() : 0.1);
      EXPECT_LE(cut.At(y), volume.At(y) + kRounding * body.diameter());
      ++compared;
    }
  });
  EXPECT_GT(compared, 10000);
}

TEST(UnionVolume, IsConvexAlongRandomSegments) {
  PointSource source;
  ForEachHalf(0.36, [&](const object::Polyhedron& body, const FacePart&, const UnionVolume& volume,
                        const Vector3d&) {
    for (int i = 0; i < kPoints; ++i) {
      const Vector3d a = source.Next(body.diameter()), b = source.Next(body.diameter());
      EXPECT_LE(volume.At((a + b) / 2),
                (volume.At(a) + volume.At(b)) / 2 + kRounding * body.diameter());
    }
  });
}

TEST(UnionVolume, OfASquareIsKnownByHand) {
  // The top of a cube, seen from below, that is, from inside.
  const FaceParts split = SplitFaces(Box({2, 2, 2}));
  const auto top =
      std::ranges::find_if(split.parts, [](const FacePart& p) { return p.normal.z() < -0.5; });
  ASSERT_NE(top, split.parts.end());
  const double tangent = 0.75;  // cos φ 0.8, sin φ 0.6
  const UnionVolume inner(*top, true, tangent);
  const UnionVolume outer(*top, false, tangent);
  EXPECT_NEAR(inner.At({0, 0, -1}), -1.2, kRounding);
  EXPECT_NEAR(inner.At({0.3, -0.9, 0}), -0.6, kRounding);
  EXPECT_NEAR(inner.At({0, 0, 2}), 0.6, kRounding);
  EXPECT_NEAR(outer.At({0, 0, 2}), -0.6, kRounding);
  EXPECT_NEAR(outer.At({0, 0, -1}), 1.2, kRounding);
  EXPECT_NEAR(inner.At({3, 0, 0}), 0.8 * 2 - 0.6, kRounding);    // beyond a side
  EXPECT_NEAR(inner.At({4, 5, 0}), 0.8 * 5 - 0.6, kRounding);    // beyond a corner: 3, 4, 5
  EXPECT_NEAR(inner.At({-4, -5, 0}), 0.8 * 5 - 0.6, kRounding);  // and the opposite one
  EXPECT_NEAR(outer.At({-4, -5, 0}), 0.8 * 5 + 0.6, kRounding);
}

TEST(UnionVolume, OfASingleContactIsItsCone) {
  const FaceParts split = SplitFaces(Box({2, 2, 2}));
  PointSource source;
  for (const FacePart& part : split.parts) {
    const Vector3d contact = part.origin + 0.3 * part.u - 0.2 * part.v;
    const FacePart point = PointPart(part, contact);
    for (const bool inner : {true, false}) {
      const UnionVolume cone(point, inner, 0.4);
      const Vector3d axis = inner ? part.normal : Vector3d(-part.normal);
      for (int i = 0; i < kPoints; ++i) {
        const Vector3d x = source.Next(3);
        EXPECT_NEAR(cone.At(x), OfContact(x, contact, axis, 0.4), kRounding);
      }
      EXPECT_NEAR(cone.At(contact + axis), -0.4 / std::sqrt(1.16), kRounding);
    }
  }
}

}  // namespace union_volume_test
}  // namespace regrasp::polyhedron
