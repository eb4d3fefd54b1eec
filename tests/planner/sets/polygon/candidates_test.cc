#include "planner/sets/polygon/candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "planner/base/number.h"

namespace regrasp::polygon {
namespace candidates_test {

constexpr double kPi = std::numbers::pi;
/// Distance of an angle from a limit below which only exact predicates can decide.
constexpr double kTooClose = 1e-9;

/// Make a polygon with `n` irregular edges around the origin.
object::Polygon Irregular(int n, unsigned seed) {
  std::vector<Eigen::Vector2d> ring;
  for (int k = 0; k < n; ++k) {
    seed = seed * 1664525U + 1013904223U;
    const double radius = 1 + static_cast<double>(seed >> 8) / (1U << 24);
    const double angle = 2 * kPi * k / n;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return object::Polygon::FromRings({ring}, "irregular");
}

double NormalAngle(const object::Polygon& polygon, int edge) {
  const Eigen::Vector3d n = polygon.inward_normal(FaceIndex(edge));
  return std::atan2(n.y(), n.x());
}

/// Return the angle between two directions, in [0, π].
double Between(double a, double b) { return std::abs(std::remainder(a - b, 2 * kPi)); }

/// Return (π − largest gap) / 2 of three directions; not positive if they do not span.
double SpanningLimit(std::array<double, 3> angles) {
  for (double& a : angles) a = std::remainder(a, 2 * kPi);
  std::sort(angles.begin(), angles.end());
  const double gap =
      std::max({angles[1] - angles[0], angles[2] - angles[1], angles[0] + 2 * kPi - angles[2]});
  return (kPi - gap) / 2;
}

class CandidatesTest : public testing::TestWithParam<double> {
 protected:
  [[nodiscard]] double friction_angle() const { return Radians(GetParam()); }
};

TEST_P(CandidatesTest, ConcurrentOnesAreTheTriplesWhoseNormalsSpan) {
  int found = 0;
  int refused = 0;
  for (const planning::Spanning spanning :
       {planning::Spanning::kUniform, planning::Spanning::kAdaptive}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const object::Polygon polygon = Irregular(17, seed);
      const IntervalScope scope;
      const EdgeTable edges(polygon, std::tan(friction_angle()));
      const auto candidates = FindConcurrentCandidates(edges, spanning);
      EXPECT_TRUE(std::is_sorted(candidates.begin(), candidates.end(),
                                 [](const auto& a, const auto& b) { return a.edges < b.edges; }));
      std::size_t next = 0;
      for (int i = 0; i < 17; ++i) {
        for (int j = i + 1; j < 17; ++j) {
          for (int k = j + 1; k < 17; ++k) {
            const EdgeTriple triple = {FaceIndex(i), FaceIndex(j), FaceIndex(k)};
            const double limit = SpanningLimit(
                {NormalAngle(polygon, i), NormalAngle(polygon, j), NormalAngle(polygon, k)});
            const double needed = spanning == planning::Spanning::kUniform ? friction_angle() : 0;
            const bool listed = next < candidates.size() && candidates[next].edges == triple;
            if (std::abs(limit - needed) > kTooClose) {
              EXPECT_EQ(listed, limit > needed) << i << ' ' << j << ' ' << k;
            }
            ++(listed ? found : refused);
            if (!listed) continue;
            const double tangent = std::tan(std::min(limit, friction_angle()));
            EXPECT_NEAR(candidates[next].tangent, tangent, 1e-12 * (1 + tangent));
            EXPECT_LE(candidates[next].tangent, edges.tangent());
            ++next;
          }
        }
      }
      EXPECT_EQ(next, candidates.size());
    }
  }
  EXPECT_GT(refused, 0);
  if (GetParam() < 30) {
    EXPECT_GT(found, 100);
  }
}

TEST_P(CandidatesTest, TwoFingerOnesAreThePairsOfNearlyOppositeNormals) {
  int found = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const object::Polygon polygon = Irregular(23, seed);
    const IntervalScope scope;
    const auto candidates = FindTwoFingerCandidates(EdgeTable(polygon, std::tan(friction_angle())));
    const std::set<TwoFingerCandidate> listed(candidates.begin(), candidates.end());
    EXPECT_EQ(listed.size(), candidates.size());
    for (int i = 0; i < 23; ++i) {
      for (int j = i + 1; j < 23; ++j) {
        const double apart = Between(NormalAngle(polygon, i) + kPi, NormalAngle(polygon, j));
        if (std::abs(apart - 2 * friction_angle()) < kTooClose) continue;
        const TwoFingerCandidate pair = {FaceIndex(i), FaceIndex(j)};
        EXPECT_EQ(listed.contains(pair), apart < 2 * friction_angle()) << i << ' ' << j;
        found += listed.contains(pair) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(found, 10);
}

/// Return whether some direction is in the interiors of all three cones, by sampling; nullopt if it
/// is uncertain.
std::optional<bool> HaveCommonDirection(const std::array<double, 3>& axes, double friction_angle) {
  double best = -kPi;
  constexpr int kDirections = 7200;
  for (int k = 0; k < kDirections; ++k) {
    const double w = 2 * kPi * k / kDirections;
    double slack = kPi;
    for (const double axis : axes) slack = std::min(slack, friction_angle - Between(axis, w));
    best = std::max(best, slack);
  }
  if (std::abs(best) < kPi / kDirections) return std::nullopt;
  return best > 0;
}

TEST_P(CandidatesTest, ParallelOnesHaveACommonCone) {
  int found = 0;
  int refused = 0;
  const int n = 11;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const object::Polygon polygon = Irregular(n, seed);
    const IntervalScope scope;
    const auto candidates = FindParallelCandidates(EdgeTable(polygon, std::tan(friction_angle())));
    std::set<EdgeTriple> triples;
    std::set<std::pair<EdgeTriple, int>> listed;
    for (const ParallelCandidate& c : candidates) {
      EXPECT_TRUE(triples.insert(c.edges).second);
      for (const int centre : c.centres) EXPECT_TRUE(listed.insert({c.edges, centre}).second);
    }
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        for (int k = j + 1; k < n; ++k) {
          const EdgeTriple triple = {FaceIndex(i), FaceIndex(j), FaceIndex(k)};
          for (int centre = 0; centre < 3; ++centre) {
            std::array<double, 3> axes;
            for (int m = 0; m < 3; ++m) {
              axes[m] = NormalAngle(polygon, triple[m]) + (m == centre ? kPi : 0);
            }
            const auto meet = HaveCommonDirection(axes, friction_angle());
            if (!meet) continue;
            EXPECT_EQ(listed.contains({triple, centre}), *meet)
                << i << ' ' << j << ' ' << k << " centre " << centre;
            ++(*meet ? found : refused);
          }
        }
      }
    }
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(FrictionAngles, CandidatesTest, testing::Values(10, 20, 35, 50, 65, 80));

}  // namespace candidates_test
}  // namespace regrasp::polygon
