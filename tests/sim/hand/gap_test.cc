#include "sim/hand/gap.h"

#include <gtest/gtest.h>

#include <vector>

#include "planner/base/random.h"
#include "planner/collision/convex_shape.h"

namespace regrasp::sim {
namespace gap_test {

using Eigen::Vector3d;

TEST(GapTest, KnownGaps) {
  const auto box = [](const Vector3d& centre) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 8; ++i) {
      points.push_back(
          centre + Vector3d((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
    }
    return points;
  };
  const ConvexBody at_origin = MakeConvexBody(box({0, 0, 0}), 0);
  for (const double gap : {0.01, 0.5, 3.0}) {
    for (const Vector3d& along : {Vector3d(1, 0, 0), Vector3d(0, 0.6, 0.8)}) {
      // Face to face, or edge to edge.
      const double size = along.x() == 1 ? 2 : 0;
      const ConvexBody other = size > 0 ? MakeConvexBody(box((size + gap) * along), 0)
                                        : MakeConvexBody({Vector3d(0, 1, 1) + gap * along}, 0);
      EXPECT_TRUE(HaveGap(at_origin, other, 0.99 * gap)) << gap;
      EXPECT_FALSE(HaveGap(at_origin, other, 1.01 * gap)) << gap;
    }
    const ConvexBody ball = MakeConvexBody({Vector3d(0, 0, 1 + 0.25 + gap)}, 0.25);
    EXPECT_TRUE(HaveGap(at_origin, ball, 0.999 * gap));
    EXPECT_FALSE(HaveGap(at_origin, ball, 1.001 * gap));
  }
  EXPECT_FALSE(HaveGap(at_origin, at_origin, 0));
  EXPECT_FALSE(HaveGap(at_origin, MakeConvexBody({Vector3d(0.1, 0.2, 0.3)}, 0), 0));
}

/// A law of distances, with bounding boxes that change with the orientation.
TEST(GapTest, RigidMotionsOfBothBodiesKeepTheGap) {
  RandomStream random(2, RandomUse::kGaits);
  const auto draw = [&random] {
    return Vector3d(random.Normal(), random.Normal(), random.Normal());
  };
  for (int i = 0; i < 50; ++i) {
    const auto hull = [&](const Vector3d& centre) {
      std::vector<Vector3d> points;
      for (int k = 0; k < 12; ++k)
        points.push_back(centre + draw().cwiseProduct(Vector3d(1, 1, 8)));
      return MakeConvexBody(std::move(points), 0.1);
    };
    const ConvexBody a = hull(Vector3d::Zero());
    const ConvexBody b = hull(9 * draw());
    Eigen::Isometry3d pose(Eigen::AngleAxisd(random.Normal(), draw().normalized()));
    pose.translation() = draw();
    const double gap = NearestOf(a, {&b, 1}).gap;
    if (gap < 0.01) continue;
    for (const double share : {0.98, 1.02}) {
      const bool is_clear = HaveGap(a, b, share * gap);
      EXPECT_EQ(is_clear, share < 1) << i;
      EXPECT_EQ(HaveGap(Moved(pose, a), Moved(pose, b), share * gap), is_clear) << i;
    }
  }
}

TEST(GapTest, TheNearestOfSomeAndThePlaceBetween) {
  const ConvexBody ball = MakeConvexBody({Vector3d(0, 0, 0)}, 0.5);
  const std::vector<ConvexBody> others = {
      MakeConvexBody({Vector3d(9, 0, 0)}, 1),
      MakeConvexBody({Vector3d(3, -2, 0), Vector3d(3, 2, 0)}, 1)};
  const Nearness nearest = NearestOf(ball, others);
  EXPECT_NEAR(nearest.gap, 1.5, 1e-2);
  EXPECT_NEAR((nearest.at - Vector3d(1.25, 0, 0)).norm(), 0, 0.1);
}

TEST(GapTest, AWayOutIsAsLongAsTheOverlap) {
  const auto box = [](double x) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 8; ++i) {
      points.emplace_back(x + ((i & 1) != 0 ? 1 : -1), (i & 2) != 0 ? 1 : -1,
                          (i & 4) != 0 ? 1 : -1);
    }
    return MakeConvexBody(points, 0);
  };
  const std::vector<Vector3d> ways = {Vector3d::UnitY(), -Vector3d::UnitX(), Vector3d::UnitX()};
  for (const double overlap : {0.01, 0.3, 0.9}) {
    const ConvexBody other = box(2 - overlap);
    EXPECT_NEAR(FreeingDistance(box(0), {&other, 1}, ways), overlap, 0.01 * overlap + 1e-6);
  }
  const ConvexBody apart = box(3);
  EXPECT_LE(FreeingDistance(box(0), {&apart, 1}, ways), 1e-6);
}

/// Compare with the other distance algorithm, close to its answer, where many small steps are
/// necessary.
TEST(GapTest, IsDecidedCloseToTheDistance) {
  RandomStream random(1, RandomUse::kGaits);
  const auto hull = [&random](const Vector3d& centre) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 32; ++i) {
      points.push_back(centre + Vector3d(random.Normal(), random.Normal(), 5 * random.Normal()));
    }
    return points;
  };
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<Vector3d> a = hull({0, 0, 0});
    const std::vector<Vector3d> b = hull({5 + 2 * random.Normal(), random.Normal(), 0});
    const double distance = collision::Distance({a, 0}, {b, 0}).lower;
    // Skip tiny distances: a clearance is larger than a thousandth of a link.
    if (distance < 0.05) continue;
    ++apart;
    EXPECT_TRUE(HaveGap(MakeConvexBody(a, 0), MakeConvexBody(b, 0), distance * (1 - 1e-3))) << i;
    EXPECT_FALSE(HaveGap(MakeConvexBody(a, 0), MakeConvexBody(b, 0), distance * (1 + 1e-3))) << i;
  }
  EXPECT_GT(apart, 50);
}

}  // namespace gap_test
}  // namespace regrasp::sim
