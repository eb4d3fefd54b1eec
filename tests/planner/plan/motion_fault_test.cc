#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/plan/check_step.h"
#include "planner/plan/projection.h"
#include "tests/fixtures/solids.h"

namespace regrasp::plan {
namespace motion_fault_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Return the contact that a file with these values defines.
grasp::Contact At(const object::Object& object, const Vector3d& p, const Vector3d& n) {
  const ProjectedContact projected = ProjectContact(object, {p, n.normalized()});
  EXPECT_EQ(projected.reason, Reason::kNone) << projected.detail;
  return projected.contact;
}

bool MayMove(const object::Object& object, const grasp::Contact& from, const grasp::Contact& to) {
  const bool there = !FindMotionFault(object, from, to).has_value();
  EXPECT_EQ(there, !FindMotionFault(object, to, from).has_value());
  return there;
}

/// Return a blade whose height grows from `thin` at x = 0 by `angle` up to x = 1; its lower side is
/// y = 0.
std::vector<Vector2d> Blade(double thin, double angle) {
  return {{0, 0}, {1, 0}, {1, thin + std::tan(angle)}, {0, thin}};
}

TEST(MotionFault, AThinWallIsNoEdgeToTurnAt) {
  // Turns of 179.4°, which an edge allows.
  const double angle = Radians(0.6);
  for (const double thin : {8e-7, 5e-7, 1.5e-7}) {
    const auto across = [&](const object::Object& blade, double x, double z) {
      const Vector3d upper_normal(std::sin(angle), -std::cos(angle), 0);
      const grasp::Contact lower = At(blade, {x, 0, z}, {0, 1, 0});
      const grasp::Contact upper = At(blade, {x, thin + x * std::tan(angle), z}, upper_normal);
      EXPECT_NE(lower.face, upper.face);
      EXPECT_LE((lower.p - upper.p).norm(), 1e-6 * blade.diameter());
      return MayMove(blade, lower, upper);
    };
    EXPECT_FALSE(across(object::Polygon::FromRings({Blade(thin, angle)}, "blade"), 1e-5, 0));
    EXPECT_FALSE(across(MakePrism(Blade(thin, angle)), 1e-5, 0.5));
    // The end of the blade is an edge between the two sides.
    EXPECT_FALSE(across(MakePrism(Blade(thin, angle)), 0, 0.5));
  }
}

TEST(MotionFault, AFingerTurnsAtTheRealEdgesOfAThinWall) {
  const double angle = Radians(0.6);
  const double thin = 5e-7;
  const Vector3d lower(0, 1, 0), end(1, 0, 0), upper(std::sin(angle), -std::cos(angle), 0);
  const object::Polyhedron blade = MakePrism(Blade(thin, angle));
  const object::Polygon flat = object::Polygon::FromRings({Blade(thin, angle)}, "blade");
  const double half = 0.5;
  for (const auto& [object, z] :
       std::vector<std::pair<const object::Object*, double>>{{&blade, half}, {&flat, 0.0}}) {
    EXPECT_TRUE(MayMove(*object, At(*object, {0, 0, z}, lower), At(*object, {0, 0, z}, end)));
    EXPECT_TRUE(MayMove(*object, At(*object, {0, thin, z}, upper), At(*object, {0, thin, z}, end)));
    // Coordinates of a file with rounded numbers.
    EXPECT_TRUE(MayMove(*object, At(*object, {4e-7, 0, z}, lower), At(*object, {0, 2e-7, z}, end)));
  }
}

TEST(MotionFault, ASharpEdgeIsToBeReachedBeforeItIsTurnedAt) {
  const double angle = Radians(0.6);
  const object::Polyhedron blade = MakePrism({{0, 0}, {1, 0}, {1, std::tan(angle)}});
  const auto turns = [&](double x) {
    const grasp::Contact lower = At(blade, {x, 0, 0.5}, {0, 1, 0});
    const grasp::Contact upper =
        At(blade, {x, x * std::tan(angle), 0.5}, {std::sin(angle), -std::cos(angle), 0});
    return MayMove(blade, lower, upper);
  };
  EXPECT_TRUE(turns(0));
  EXPECT_TRUE(turns(1e-6)) << "within the tolerance of points";
  EXPECT_FALSE(turns(1e-5));
}

TEST(MotionFault, NothingTurnsAtAnEdgeAsSharpAsNormalsAreKnown) {
  // Opposite normals have no unique shortest rotation. The tolerance is 0.1°.
  for (const auto& [degrees, turns] : {std::pair{0.09, false}, {0.11, true}}) {
    const double angle = Radians(degrees);
    const object::Polyhedron blade = MakePrism({{0, 0}, {1, 0}, {1, std::tan(angle)}});
    const grasp::Contact lower = At(blade, {0, 0, 0.5}, {0, 1, 0});
    const grasp::Contact upper = At(blade, {0, 0, 0.5}, {std::sin(angle), -std::cos(angle), 0});
    EXPECT_NE(lower.face, upper.face);
    EXPECT_EQ(MayMove(blade, lower, upper), turns) << degrees;
  }
}

TEST(MotionFault, FacesThatOnlyShareACornerMeetThere) {
  // A pyramid with four sides: opposite sides share its apex.
  object::PolygonSoup soup;
  soup.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
  soup.facets = {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const object::Polyhedron pyramid = object::Polyhedron::FromSoup(soup, "pyramid");
  const grasp::Contact left = At(pyramid, {0, 0, 1}, {1, 0, -1});
  const grasp::Contact right = At(pyramid, {0, 0, 1}, {-1, 0, -1});
  EXPECT_NE(left.face, right.face);
  EXPECT_TRUE(MayMove(pyramid, left, right));
}

/// Return a block of 3 × 2 × 1 with a slit of this width from y = 0 to y = 1 at x = 1, through
/// along z.
object::Polyhedron SlitBlock(double width) {
  return MakePrism(
      {{0, 0}, {1, 0}, {1, 1}, {1 + width, 1}, {1 + width, 0}, {3, 0}, {3, 2}, {0, 2}});
}

TEST(MotionFault, SlitsAreNotCrossedHoweverNarrow) {
  for (const double width : {1e-4, 1.1e-5, 9e-6, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 2e-11}) {
    const object::Polyhedron block = SlitBlock(width);
    const auto top = [&](double x, double y) { return At(block, {x, y, 1}, {0, 0, -1}); };
    EXPECT_FALSE(MayMove(block, top(0.5, 0.5), top(2.5, 0.5))) << width;
    EXPECT_FALSE(MayMove(block, top(1, 0.5), top(1 + width, 0.5))) << width;
    EXPECT_FALSE(MayMove(block, top(0.9, 0.3), top(2.5, 0.9))) << width;
    EXPECT_TRUE(MayMove(block, top(0.5, 1.5), top(2.5, 1.5))) << width;
    EXPECT_TRUE(MayMove(block, top(0.5, 1), top(2.5, 1))) << "past its end, " << width;
    EXPECT_TRUE(MayMove(block, top(1, 0), top(1, 1))) << "along its wall, " << width;
    EXPECT_TRUE(MayMove(block, top(1, 0.2), top(0.2, 0.3))) << "away from it, " << width;
    // The walls of the slit are reached from the edge on their own side.
    const auto wall = [&](double x, double side) { return At(block, {x, 0.5, 1}, {side, 0, 0}); };
    EXPECT_TRUE(MayMove(block, top(1, 0.5), wall(1, -1))) << width;
    EXPECT_TRUE(MayMove(block, top(1 + width, 0.5), wall(1 + width, 1))) << width;
    EXPECT_FALSE(MayMove(block, top(1, 0.5), wall(1 + width, 1))) << width;
    EXPECT_FALSE(MayMove(block, top(1 + width, 0.5), wall(1, -1))) << width;
  }
}

TEST(MotionFault, RoundedNumbersMayShaveACorner) {
  const object::Polyhedron block = MakeLBlock();
  const auto top = [&](double x, double y) { return At(block, {x, y, 1}, {0, 0, -1}); };
  // Through the concave corner (1, 1), or at a distance below the precision of points.
  EXPECT_TRUE(MayMove(block, top(1.5, 0.5), top(0.5, 1.5)));
  EXPECT_TRUE(MayMove(block, top(1.5, 0.5 + 1e-6), top(0.5, 1.5 + 1e-6)));
  EXPECT_FALSE(MayMove(block, top(1.5, 0.5 + 4e-5), top(0.5, 1.5 + 4e-5)));
}

}  // namespace motion_fault_test
}  // namespace regrasp::plan
