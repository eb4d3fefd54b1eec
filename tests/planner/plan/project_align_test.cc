#include <gtest/gtest.h>

#include <string>

#include "planner/object/object.h"
#include "planner/plan/projection.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::plan {
namespace project_align_test {

using Eigen::Vector3d;

/// Return a sliding step in which one finger turns over an edge, at two points that should be
/// equal.
Align TurnOver(const object::Object& object, FaceIndex face, const object::FaceBorder& edge,
               const Vector3d& p, const Vector3d& q) {
  return {{{{FingerIndex(0), {p, object.inward_normal(face), {}}}},
           {{FingerIndex(0), {q, object.inward_normal(edge.beyond), {}}}}}};
}

TEST(ProjectAlign, AFingerThatTurnsOverAnEdgeKeepsItsPointExactly) {
  constexpr int kPoints = 16;
  const object::ObjectFile file = object::ReadObject(ProjectPath("models/stone.obj"));
  const object::Object& stone = *file.object;
  int rounded = 0;
  for (FaceIndex face{0}; face < stone.face_count(); ++face) {
    for (const object::FaceBorder& edge : stone.BordersOf(face)) {
      for (int i = 1; i < kPoints; ++i) {
        const Vector3d p = edge.a + static_cast<double>(i) / kPoints * (edge.b - edge.a);
        Align align = TurnOver(stone, face, edge, p, p);
        ProjectAlign(stone, align);
        const grasp::Contact& before = align.waypoints[0][0].contact;
        const grasp::Contact& after = align.waypoints[1][0].contact;
        EXPECT_EQ(before.face, face);
        EXPECT_EQ(after.face, edge.beyond);
        EXPECT_EQ(before.p, after.p);
        rounded += stone.ClosestPoint(face, p) != stone.ClosestPoint(edge.beyond, p) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(rounded, 0) << "the projections are not always the same";
}

TEST(ProjectAlign, PointsThatDifferByMoreThanRoundingStayWhereTheFileHasThem) {
  const object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
  const object::Object& cube = *file.object;
  const object::FaceBorder edge = cube.BordersOf(FaceIndex(0)).front();
  const Vector3d p = (edge.a + edge.b) / 2;
  const double off = 1e-8 * cube.diameter();
  Align align = TurnOver(cube, FaceIndex(0), edge, p, p + off * (edge.b - edge.a).normalized());
  ProjectAlign(cube, align);
  const double apart = (align.waypoints[0][0].contact.p - align.waypoints[1][0].contact.p).norm();
  EXPECT_NEAR(apart, off, off / 1000);
}

}  // namespace project_align_test
}  // namespace regrasp::plan
