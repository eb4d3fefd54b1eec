#include "planner/sets/polyhedron/normal_quadruples.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace normal_quadruples_test {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 12;
/// Distance of tan φ* from tan θ, or of normals from a half-space, below which only rounding
/// decides.
constexpr double kTooClose = 1e-9;

std::vector<Vector3d> RandomNormals(int count, const Vector3d& stretch, std::mt19937_64& engine) {
  std::normal_distribution<double> number;
  std::vector<Vector3d> normals;
  for (int i = 0; i < count; ++i) {
    const Vector3d drawn(number(engine), number(engine), number(engine));
    normals.push_back(drawn.cwiseProduct(stretch).normalized());
  }
  return normals;
}

/// Compute tan φ* by its definition; negative if the normals do not span.
///
/// The normals positively span iff Σ λ_k n_k = 0 with all λ > 0. φ* is the angle at which a plane
/// through the origin first has all four cones on one side. It is the minimum over planes of the
/// largest elevation of a normal above the plane. At the minimum, three normals have equal
/// elevation.
double LimitByDefinition(const std::array<Vector3d, 4>& n) {
  // λ by Cramer's rule: the volumes of the three remaining normals with alternating signs.
  Eigen::Vector4d lambda(n[1].cross(n[2]).dot(n[3]), -n[0].cross(n[2]).dot(n[3]),
                         n[0].cross(n[1]).dot(n[3]), -n[0].cross(n[1]).dot(n[2]));
  if (lambda.sum() < 0) lambda = -lambda;
  if (lambda.minCoeff() < kTooClose) return -1;
  double least_sine = std::numeric_limits<double>::infinity();
  for (int out = 0; out < 4; ++out) {
    Eigen::Matrix3d three;
    for (int k = 0, row = 0; k < 4; ++k) {
      if (k != out) three.row(row++) = n[k].transpose();
    }
    // d · n = 1 for the three normals: along the unit vector of d, each has the height 1 / |d|.
    least_sine = std::min(least_sine, 1 / (three.inverse() * Vector3d::Ones()).norm());
  }
  return least_sine / std::sqrt(1 - least_sine * least_sine);
}

struct Limited {
  FaceQuadruple faces;
  double limit;  ///< tan φ* of the normals
};

/// Find every subset of four normals that spans by the definition.
std::vector<Limited> FindPlainly(const std::vector<Vector3d>& n) {
  std::vector<Limited> spanning;
  const int count = static_cast<int>(n.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      for (int c = b + 1; c < count; ++c) {
        for (int d = c + 1; d < count; ++d) {
          const double limit = LimitByDefinition({n[a], n[b], n[c], n[d]});
          const FaceQuadruple faces = {FaceIndex(a), FaceIndex(b), FaceIndex(c), FaceIndex(d)};
          if (limit > 0) spanning.push_back({faces, limit});
        }
      }
    }
  }
  return spanning;
}

/// Compare the candidates with the definition. @returns number of candidates.
std::size_t ExpectPlainCandidates(const std::vector<Vector3d>& normals) {
  std::size_t count = 0;
  const std::vector<Limited> plain = FindPlainly(normals);
  for (const double degrees : {1, 10, 18, 40}) {
    for (const planning::Spanning spanning : kBothSpannings) {
      SCOPED_TRACE(testing::Message() << normals.size() << " normals, " << degrees << " degrees");
      const double tangent = std::tan(Radians(degrees));
      const double least = spanning == planning::Spanning::kUniform ? tangent : 0;
      std::vector<Limited> expected;
      for (const Limited& limited : plain) {
        EXPECT_GT(std::abs(limited.limit - least), kTooClose);
        if (limited.limit > least) expected.push_back(limited);
      }
      const auto found = FindQuadrupleCandidates(normals, tangent, spanning);
      EXPECT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
        EXPECT_EQ(found[i].faces, expected[i].faces);
        EXPECT_NEAR(found[i].tangent, std::min(tangent, expected[i].limit), kTooClose);
        EXPECT_LE(found[i].tangent, tangent);
      }
      count += found.size();
    }
  }
  return count;
}

TEST(NormalQuadruples, AreThoseOfThePlainDefinition) {
  std::mt19937_64 engine(kSeed);
  std::size_t found_in_all = 0;
  for (const Vector3d& stretch : {Vector3d(1, 1, 1), Vector3d(1, 1, 0.2), Vector3d(3, 0.5, 1)}) {
    for (const int count : {4, 9, 30}) {
      found_in_all += ExpectPlainCandidates(RandomNormals(count, stretch, engine));
    }
  }
  // The bits need more than one word.
  found_in_all += ExpectPlainCandidates(RandomNormals(66, Vector3d::Ones(), engine));
  EXPECT_GT(found_in_all, 100000U);
}

/// Return whether directions positively span, by Σ λ d = 0.
bool Spans(const std::array<Vector3d, 4>& d) { return LimitByDefinition(d) > 0; }

TEST(NormalQuadruples, AnyDirectionsInsideTheConesSpanAndSomeJustBeyondDoNot) {
  std::mt19937_64 engine(kSeed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto normals = RandomNormals(25, Vector3d::Ones(), engine);
  const auto found = FindQuadrupleCandidates(normals, 10, planning::Spanning::kAdaptive);
  ASSERT_GT(found.size(), 500U);
  int beyond = 0;
  for (std::size_t i = 0; i < found.size(); i += 5) {
    const double limit = std::atan(found[i].tangent);
    const auto tilted = [&](double share) {
      std::array<Vector3d, 4> d;
      for (int k = 0; k < 4; ++k) {
        const Vector3d& n = normals[found[i].faces[k]];
        const Vector3d u = n.unitOrthogonal();
        const double around = 2 * M_PI * unit(engine);
        const Vector3d aside = std::cos(around) * u + std::sin(around) * n.cross(u);
        d[k] = std::cos(share * limit) * n + std::sin(share * limit) * aside;
      }
      return d;
    };
    for (int draw = 0; draw < 20; ++draw) ASSERT_TRUE(Spans(tilted(0.999 * unit(engine))));
    // Tilt all four normals by slightly more than the limit towards a plane above which three of
    // them have equal elevation.
    for (int out = 0; out < 4; ++out) {
      Eigen::Matrix3d three;
      for (int k = 0, row = 0; k < 4; ++k) {
        if (k != out) three.row(row++) = normals[found[i].faces[k]].transpose();
      }
      const Vector3d up = (three.inverse() * Vector3d::Ones()).normalized();
      std::array<Vector3d, 4> d;
      for (int k = 0; k < 4; ++k) {
        const Vector3d& n = normals[found[i].faces[k]];
        const Vector3d down = (-up + up.dot(n) * n).normalized();
        d[k] = std::cos(1.001 * limit) * n + (k == out ? -1 : 1) * std::sin(1.001 * limit) * down;
      }
      if (!Spans(d)) {
        ++beyond;
        break;
      }
    }
  }
  EXPECT_EQ(beyond, static_cast<int>((found.size() + 4) / 5));
}

std::size_t CountOf(const object::Polyhedron& body, double degrees, planning::Spanning spanning) {
  std::vector<Vector3d> normals;
  for (FaceIndex f{0}; f < body.face_count(); ++f) normals.push_back(body.inward_normal(f));
  return FindQuadrupleCandidates(normals, std::tan(Radians(degrees)), spanning).size();
}

TEST(NormalQuadruples, OfARegularTetrahedronSpanBelowTheArcSineOfAThird) {
  const double limit = Degrees(std::asin(1.0 / 3));
  const object::Polyhedron body = RegularTetrahedron();
  EXPECT_EQ(CountOf(body, limit - 1e-6, planning::Spanning::kUniform), 1U);
  EXPECT_EQ(CountOf(body, limit + 1e-6, planning::Spanning::kUniform), 0U);
  EXPECT_EQ(CountOf(body, limit + 1e-6, planning::Spanning::kAdaptive), 1U);
  EXPECT_EQ(CountOf(body, 80, planning::Spanning::kAdaptive), 1U);
}

TEST(NormalQuadruples, OfBoxesDoNotSpanAndOfAnOctahedronTwoTetrahedraDo) {
  for (const planning::Spanning spanning : kBothSpannings) {
    EXPECT_EQ(CountOf(Box({1, 2, 3}), 5, spanning), 0U);
    // Normals (±1, ±1, ±1). Four of them that span contain no two opposite normals that are
    // coplanar with the remaining pair. The only such sets are the two sets of alternate corners of
    // the cube.
    EXPECT_EQ(CountOf(RegularOctahedron(), 5, spanning), 2U);
  }
}

}  // namespace normal_quadruples_test
}  // namespace regrasp::polyhedron
