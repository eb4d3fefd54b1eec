#include "planner/sets/polyhedron/face_part.h"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace face_part_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Bound on rounding of the face's plane, for sines and areas divided by the object's size.
constexpr double kRounding = 1e-9;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double AreaOf(const std::vector<Vector2d>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += Cross(outline[i], outline[(i + 1) % outline.size()]);
  }
  return twice / 2;
}

Vector3d InSpace(const FacePart& part, const Vector2d& y) {
  return part.origin + y.x() * part.u + y.y() * part.v;
}

bool IsInside(const FacePart& part, const Vector2d& y, double by) {
  const auto& o = part.outline();
  for (std::size_t i = 0; i < o.size(); ++i) {
    const Vector2d side = o[(i + 1) % o.size()] - o[i];
    if (Cross(side, y - o[i]) < by * side.norm()) return false;
  }
  return true;
}

void ExpectConvexAndCounterClockwise(const FacePart& part) {
  const auto& o = part.outline();
  ASSERT_GE(o.size(), 3U);
  ASSERT_EQ(o.size(), part.corners.size());
  for (std::size_t i = 0; i < o.size(); ++i) {
    const Vector2d ab = o[(i + 1) % o.size()] - o[i];
    const Vector2d bc = o[(i + 2) % o.size()] - o[(i + 1) % o.size()];
    EXPECT_GT(ab.norm(), 0);
    EXPECT_GE(Cross(ab, bc), -kRounding * ab.norm() * bc.norm());
  }
  EXPECT_GT(AreaOf(o), 0);
}

/// Return whether all of the second part is beyond or on a side of the first one.
bool HasSideBetween(const FacePart& a, const FacePart& b) {
  const auto& o = a.outline();
  for (std::size_t i = 0; i < o.size(); ++i) {
    const Vector2d side = (o[(i + 1) % o.size()] - o[i]).normalized();
    const bool beyond = std::ranges::all_of(
        b.outline(), [&](const Vector2d& y) { return Cross(side, y - o[i]) <= kRounding; });
    if (beyond) return true;
  }
  return false;
}

/// Return whether two convex polygons have no common interior: a side of one separates them.
bool AreDisjoint(const FacePart& a, const FacePart& b) {
  return HasSideBetween(a, b) || HasSideBetween(b, a);
}

/// Check properties that all objects have. @returns number of parts.
int CheckParts(const object::Polyhedron& body, const FaceParts& split) {
  EXPECT_EQ(std::ssize(split.first), body.face_count() + 1);
  EXPECT_EQ(split.first.back(), static_cast<int>(split.parts.size()));
  const double small = kRounding * body.diameter() * body.diameter();
  for (FaceIndex face{0}; face < body.face_count(); ++face) {
    double area = 0;
    for (int p = split.first[face]; p < split.first[face + 1]; ++p) {
      const FacePart& part = split.parts[p];
      EXPECT_EQ(part.face, face);
      EXPECT_EQ(part.normal, body.inward_normal(face));
      EXPECT_NEAR(part.u.cross(part.v).dot(part.normal), -1, kRounding);
      ExpectConvexAndCounterClockwise(part);
      for (std::size_t i = 0; i < part.corners.size(); ++i) {
        const Vector3d corner = body.vertices()[part.corners[i]];
        EXPECT_LT((InSpace(part, part.outline()[i]) - corner).norm(), kRounding * body.diameter());
      }
      area += AreaOf(part.outline());
      for (int q = split.first[face]; q < p; ++q) {
        EXPECT_TRUE(AreDisjoint(part, split.parts[q]));
      }
    }
    EXPECT_NEAR(area, body.face_measure(FaceIndex(face)), small);
  }
  return static_cast<int>(split.parts.size());
}

/// Check hulls: a hull contains its parts, touches them at all of its corners, and equals a single
/// part.
/// @returns number of faces with several parts.
int CheckHulls(const object::Polyhedron& body, const FaceParts& split) {
  EXPECT_EQ(std::ssize(split.hulls), body.face_count());
  const double small = kRounding * body.diameter();
  int several = 0;
  for (FaceIndex face{0}; face < body.face_count(); ++face) {
    const FacePart& hull = split.hulls[face];
    const int first = split.first[face];
    const int end = split.first[face + 1];
    EXPECT_EQ(hull.face, face);
    EXPECT_GT(AreaOf(hull.outline()), 0);
    std::vector<Vector2d> corners;
    for (int p = first; p < end; ++p) {
      for (const Vector2d& corner : split.parts[p].outline()) {
        EXPECT_TRUE(IsInside(hull, corner, -small));
        corners.push_back(corner);
      }
      for (const int corner : split.parts[p].corners) {
        EXPECT_EQ(std::ranges::count(hull.corners, corner), 1);
      }
    }
    for (const Vector2d& corner : hull.outline()) {
      EXPECT_GT(std::ranges::count(corners, corner), 0);
    }
    if (end - first == 1) {
      EXPECT_EQ(hull.outline(), split.parts[first].outline());
    } else {
      EXPECT_GT(AreaOf(hull.outline()), body.face_measure(FaceIndex(face)) + small);
      ++several;
    }
  }
  return several;
}

/// Check that joints are on the borders of both parts and connect all parts of a face.
int CheckJoints(const FaceParts& split) {
  for (const PartJoint& joint : split.joints) {
    EXPECT_EQ(joint.segment.outline().size(), 2U);
    EXPECT_NE(joint.parts[0], joint.parts[1]);
    const std::vector<Vector2d> ends = joint.segment.outline();
    const Vector2d middle = (ends[0] + ends[1]) / 2;
    const Vector2d along = ends[1] - ends[0];
    const Vector2d across = Vector2d(-along.y(), along.x()) * 1e-3;
    int inside = 0;
    for (const int p : joint.parts) {
      const FacePart& part = split.parts[p];
      EXPECT_EQ(part.face, joint.segment.face);
      EXPECT_TRUE(IsInside(part, middle, -kRounding));
      if (IsInside(part, middle + across, 0) != IsInside(part, middle - across, 0)) ++inside;
    }
    EXPECT_EQ(inside, 2);
  }
  return static_cast<int>(split.joints.size());
}

TEST(SplitFaces, PartsOfSmallBodiesAreConvexDisjointAndCoverTheirFaces) {
  int parts = 0;
  for (const NamedBody& named : SmallBodies()) {
    SCOPED_TRACE(named.name);
    const FaceParts split = SplitFaces(named.body);
    parts += CheckParts(named.body, split);
    CheckJoints(split);
  }
  EXPECT_GT(parts, 60);
}

TEST(SplitFaces, ConvexFacesAreOnePart) {
  for (const object::Polyhedron& body :
       {Box({1, 2, 3}), RegularOctahedron(), RegularTetrahedron()}) {
    const FaceParts split = SplitFaces(body);
    EXPECT_EQ(CheckParts(body, split), body.face_count());
    EXPECT_TRUE(split.joints.empty());
    EXPECT_EQ(CheckHulls(body, split), 0);
  }
}

TEST(SplitFaces, AnLIsTwoPartsWithOneJoint) {
  const object::Polyhedron body = Frustum(LOutline(), 1, 0.5);
  ASSERT_EQ(body.face_count(), 8);
  const FaceParts split = SplitFaces(body);
  EXPECT_EQ(CheckParts(body, split), 10);
  EXPECT_EQ(CheckJoints(split), 2);
  EXPECT_EQ(CheckHulls(body, split), 2);
}

TEST(SplitFaces, AFrameIsPartsInACircle) {
  const object::Polyhedron body = Frustum(FrameOutline(), 1, 0.5);
  ASSERT_EQ(body.face_count(), 10);
  const FaceParts split = SplitFaces(body);
  const int parts = CheckParts(body, split) - 8;  // parts of the two frames
  // The minimum is four per frame; joining triangles can need up to twice as many.
  EXPECT_GE(parts, 8);
  EXPECT_LE(parts, 16);
  EXPECT_EQ(CheckJoints(split), parts);
  EXPECT_EQ(CheckHulls(body, split), 2);
}

TEST(SplitFaces, AStarOfManyCornersIsCutAtItsConcaveOnes) {
  Ring star;
  constexpr int kTips = 9;
  for (int i = 0; i < 2 * kTips; ++i) {
    const double angle = M_PI * i / kTips;
    const double r = i % 2 == 0 ? 2 : 1;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  const object::Polyhedron body = Frustum({star}, 1, 0.5);
  const FaceParts split = SplitFaces(body);
  const int parts = CheckParts(body, split) - 2 * kTips;
  // At least one part more per two concave corners, and at most four times as many.
  EXPECT_GE(parts, 2 * (kTips / 2 + 1));
  EXPECT_LE(parts, 8 * (kTips / 2 + 1));
  EXPECT_GT(CheckJoints(split), 0);
  EXPECT_EQ(CheckHulls(body, split), 2);
}

TEST(SplitFaces, TheChecksSeeAPartThatIsNotConvexAndOnesThatOverlap) {
  const object::Polyhedron body = Frustum(LOutline(), 1, 0.5);
  const FaceParts split = SplitFaces(body);
  const auto several = std::ranges::find_if(
      split.joints, [](const PartJoint& joint) { return joint.parts[0] != joint.parts[1]; });
  ASSERT_NE(several, split.joints.end());
  const FacePart& part = split.parts[several->parts[0]];
  EXPECT_FALSE(AreDisjoint(part, part));
  EXPECT_FALSE(IsInside(part, part.outline()[0], 0.01));
  EXPECT_GT(body.face_measure(FaceIndex(part.face)), AreaOf(part.outline()) + 0.1);
}

}  // namespace face_part_test
}  // namespace regrasp::polyhedron
