#include "planner/sets/polyhedron/min_max.h"

#include <CGAL/MP_Float.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace min_max_test {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 5;
constexpr double kReach = 100;
/// Tolerance of minima: a hundredth of their value, and rounding.
constexpr double kGap = 0.0101;
constexpr double kRounding = 1e-9;

class Draw {
 public:
  double Between(double least, double most) { return least + (most - least) * unit_(engine_); }
  Vector3d Point(double size) {
    return {Between(-size, size), Between(-size, size), Between(-size, size)};
  }
  Vector3d Direction() {
    const Vector3d drawn(normal_(engine_), normal_(engine_), normal_(engine_));
    return drawn.normalized();
  }

 private:
  std::mt19937_64 engine_{kSeed};
  std::uniform_real_distribution<double> unit_{0, 1};
  std::normal_distribution<double> normal_;
};

struct Ball {
  Vector3d centre;
  double radius;
};

/// Return the cut of the ball with the largest |x − c| − r at x.
MinMax::LargestCut LargestOf(const std::vector<Ball>& balls) {
  return [&balls](const Vector3d& x) {
    Cut largest;
    double value = -std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls) {
      const Vector3d away = x - ball.centre;
      const double at = away.norm() - ball.radius;
      if (at <= value) continue;
      value = at;
      largest.gradient = away.isZero(0) ? Vector3d::Zero() : away.normalized();
      largest.offset = -largest.gradient.dot(ball.centre) - ball.radius;
    }
    return largest;
  };
}

MinMax::LargestCut LargestOf(const std::vector<Cut>& planes) {
  return [&planes](const Vector3d& x) {
    return *std::ranges::max_element(planes, {}, [&](const Cut& cut) { return cut.At(x); });
  };
}

/// Compute the minimum of the largest |x − c| − r with CGAL: the smallest ball that encloses balls
/// of radius kCommon − r.
double LeastByEnclosingBall(const std::vector<Ball>& balls) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<Kernel, double>;
  constexpr double kCommon = 10;
  std::vector<Traits::Sphere> spheres;
  for (const auto& [c, r] : balls) {
    spheres.emplace_back(Kernel::Point_3(c.x(), c.y(), c.z()), kCommon - r);
  }
  CGAL::Min_sphere_of_spheres_d<Traits> enclosing(spheres.begin(), spheres.end());
  return enclosing.radius() - kCommon;
}

/// Compute the smallest t with n · x + offset ≤ t for all planes with CGAL's exact linear programs;
/// nullopt if there is none.
std::optional<double> LeastByProgram(const std::vector<Cut>& planes) {
  CGAL::Quadratic_program<double> program(CGAL::SMALLER, false, 0, false, 0);
  for (int row = 0; row < static_cast<int>(planes.size()); ++row) {
    for (int axis = 0; axis < 3; ++axis) program.set_a(axis, row, planes[row].gradient[axis]);
    program.set_a(3, row, -1);
    program.set_b(row, -planes[row].offset);
  }
  program.set_c(3, 1);
  const auto solution = CGAL::solve_linear_program(program, CGAL::MP_Float());
  if (!solution.is_optimal()) return std::nullopt;
  return CGAL::to_double(solution.objective_value());
}

void ExpectLeast(const MinMaxResult& result, double least) {
  EXPECT_NEAR(result.value, least, kGap * std::abs(least) + kRounding);
  EXPECT_EQ(result.overlap, least < 0 ? Overlap::kSome : Overlap::kNone);
}

TEST(MinMax, OfRandomBallsIsThatOfTheEnclosingBall) {
  Draw draw;
  int some = 0, none = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<Ball> balls;
    for (int k = 0; k < 2 + i % 7; ++k) {
      balls.push_back({draw.Point(1), draw.Between(0.3, 1.5)});
    }
    const double least = LeastByEnclosingBall(balls);
    MinMax min_max(Vector3d::Zero(), kReach);
    const MinMaxResult sign = min_max.Solve(LargestOf(balls), MinMax::Until::kSign);
    EXPECT_EQ(sign.overlap, least < 0 ? Overlap::kSome : Overlap::kNone);
    if (least < 0) {
      ++some;
      ExpectLeast(min_max.Solve(LargestOf(balls), MinMax::Until::kMinimum), least);
      for (const auto& [c, r] : balls) EXPECT_LT((sign.point - c).norm(), r);
    } else {
      ++none;
    }
  }
  EXPECT_GT(some, 50);
  EXPECT_GT(none, 50);
}

TEST(MinMax, OfRandomHalfSpacesIsThatOfExactPrograms) {
  Draw draw;
  int some = 0, none = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Cut> planes;
    for (int k = 0; k < 12; ++k) planes.push_back({draw.Direction(), draw.Between(-1, 0.5)});
    const auto program = LeastByProgram(planes);
    // Normals that nearly do not span, or do not.
    if (!program || *program < -kReach / 10) continue;
    const double least = *program;
    MinMax min_max(Vector3d::Zero(), kReach);
    const MinMaxResult result = min_max.Solve(LargestOf(planes), MinMax::Until::kMinimum);
    EXPECT_EQ(result.overlap, least < 0 ? Overlap::kSome : Overlap::kNone);
    if (least < 0) ExpectLeast(result, least);
    ++(least < 0 ? some : none);
  }
  EXPECT_GT(some, 50);
  EXPECT_GT(none, 20);
}

TEST(MinMax, OfTwoBallsAndOfFourIsKnownByHand) {
  for (const double gap : {-0.5, -1e-6, 1e-6, 0.5}) {
    const std::vector<Ball> two = {{{-1, 0, 0}, 1 - gap}, {{1, 0, 0}, 1}};
    MinMax min_max(Vector3d(0.3, -0.2, 0.1), kReach);
    const MinMaxResult result = min_max.Solve(LargestOf(two), MinMax::Until::kMinimum);
    EXPECT_EQ(result.overlap, gap < 0 ? Overlap::kSome : Overlap::kNone);
    if (gap > 0) continue;
    EXPECT_NEAR(result.value, gap / 2, kGap * -gap);
  }
  const std::vector<Ball> four = {
      {{1, 1, 1}, 2}, {{1, -1, -1}, 2}, {{-1, 1, -1}, 2}, {{-1, -1, 1}, 2}};
  MinMax min_max(Vector3d::Zero(), kReach);
  ExpectLeast(min_max.Solve(LargestOf(four), MinMax::Until::kMinimum), std::sqrt(3.0) - 2);
}

TEST(MinMax, OfSetsThatTouchIsUnclearAndOneThatIsFarIsNotFoundBeyondTheReach) {
  const std::vector<Cut> touching = {{Vector3d::UnitX(), 0}, {-Vector3d::UnitX(), 0}};
  MinMax min_max(Vector3d::Zero(), kReach);
  EXPECT_EQ(min_max.Solve(LargestOf(touching), MinMax::Until::kMinimum).overlap, Overlap::kUnclear);
  const std::vector<Ball> far = {{{10 * kReach, 0, 0}, 1}};
  min_max.Restart();
  EXPECT_NE(min_max.Solve(LargestOf(far), MinMax::Until::kSign).overlap, Overlap::kSome);
}

/// Return the largest value of some volumes at x.
double LargestAt(const std::vector<UnionVolume>& volumes, const Vector3d& x) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const UnionVolume& volume : volumes) largest = std::max(largest, volume.At(x));
  return largest;
}

/// Descend on the largest of some volumes in random directions. The convex function has only one
/// minimum.
double WalkDown(const std::vector<UnionVolume>& volumes, Vector3d x, double step, Draw& draw) {
  double value = LargestAt(volumes, x);
  for (int i = 0; i < 3000 && step > kRounding; ++i) {
    const Vector3d next = x + step * draw.Direction();
    const double at = LargestAt(volumes, next);
    if (at < value) {
      value = at;
      x = next;
      step *= 1.5;
    } else {
      step *= 0.93;
    }
  }
  return value;
}

TEST(MinMax, OfUnionVolumesIsNotBeatenByWalksDown) {
  Draw draw;
  std::mt19937_64 engine(kSeed);
  int some = 0, none = 0;
  for (const NamedBody& named : SmallBodies()) {
    SCOPED_TRACE(named.name);
    const FaceParts split = SplitFaces(named.body);
    const double size = named.body.diameter();
    MinMax min_max(named.body.mass_properties().centroid, kReach * size);
    for (int i = 0; i < 40; ++i) {
      std::vector<UnionVolume> volumes;
      for (int k = 0; k < 4 + i % 2; ++k) {
        const FacePart& part = split.parts[engine() % split.parts.size()];
        volumes.emplace_back(part, engine() % 4 != 0, 0.3);
      }
      min_max.Restart();
      const MinMaxResult sign = min_max.Solve(volumes, MinMax::Until::kSign);
      const MinMax::Basis basis = min_max.basis();
      const MinMaxResult result = min_max.Solve(volumes, MinMax::Until::kMinimum);
      if (sign.overlap == Overlap::kUnclear) continue;
      EXPECT_EQ(result.overlap, sign.overlap);
      const double walked = WalkDown(volumes, result.point, 0.1 * size, draw);
      if (sign.overlap == Overlap::kNone) {
        EXPECT_GT(walked, 0);
        ++none;
        continue;
      }
      EXPECT_LT(LargestAt(volumes, sign.point), 0);
      EXPECT_NEAR(result.value, LargestAt(volumes, result.point), kRounding);
      EXPECT_GE(walked, result.value - kGap * std::abs(result.value) - kRounding);
      // The basis that decided the sign yields the same minimum.
      min_max.Resume(basis);
      const MinMaxResult again = min_max.Solve(volumes, MinMax::Until::kMinimum);
      EXPECT_EQ(again.overlap, Overlap::kSome);
      EXPECT_NEAR(again.value, result.value, 2 * kGap * std::abs(result.value) + kRounding);
      ++some;
    }
  }
  EXPECT_GT(some, 20);
  EXPECT_GT(none, 50);
}

}  // namespace min_max_test

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
