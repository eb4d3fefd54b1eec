#include <gtest/gtest.h>

#include <cmath>

#include "planner/gait/change_paths.h"

namespace regrasp::gait {
namespace slide_path_test {

using Eigen::Vector3d;
using grasp::Contact;

bool IsSame(const Contact& a, const Contact& b) {
  return a.p == b.p && a.n == b.n && a.face == b.face;
}

/// On top of a cube, about its edge, and down its side: 1 and 3 units long.
const tree::SurfaceRoute kOverAnEdge = {{{0.1, 0, 1}, -Vector3d::UnitZ(), FaceIndex{0}},
                                        {{1.1, 0, 1}, -Vector3d::UnitZ(), FaceIndex{0}},
                                        {{1.1, 0, 1}, -Vector3d::UnitX(), FaceIndex{1}},
                                        {{1.1, 0, -2}, -Vector3d::UnitX(), FaceIndex{1}}};
const tree::SurfaceRoute kOnAFace = {{{-1, 0.3, 0}, Vector3d::UnitX(), FaceIndex{2}},
                                     {{-1, 0.7, 0}, Vector3d::UnitX(), FaceIndex{2}}};

TEST(GoTogetherTest, BeginsAndEndsBitForBitWithTheRoutes) {
  for (const auto& routes : {std::vector{&kOverAnEdge}, std::vector{&kOverAnEdge, &kOnAFace},
                             std::vector{&kOnAFace, &kOverAnEdge, &kOverAnEdge}}) {
    const auto along = GoTogether(routes);
    for (std::size_t i = 0; i < routes.size(); ++i) {
      EXPECT_TRUE(IsSame(along.front()[i], routes[i]->front()));
      EXPECT_TRUE(IsSame(along.back()[i], routes[i]->back()));
    }
  }
}

TEST(GoTogetherTest, EachGoesAtItsOwnEvenSpeedAndOthersWaitForATurn) {
  const auto along = GoTogether({&kOverAnEdge, &kOnAFace});
  ASSERT_EQ(along.size(), 4u);
  // A quarter of the first one's way is done at the edge.
  for (const int i : {1, 2}) EXPECT_LT((along[i][1].p - Vector3d(-1, 0.4, 0)).norm(), 1e-15);
  EXPECT_EQ(along[1][0].p, along[2][0].p);
  EXPECT_EQ(along[1][0].face, FaceIndex{0});
  EXPECT_EQ(along[2][0].face, FaceIndex{1});
  EXPECT_EQ(along[1][1].p, along[2][1].p);
}

/// Which two turns come first where both come at once is free; but they come one after the other.
TEST(GoTogetherTest, NoTwoTurnAtOnce) {
  const auto along = GoTogether({&kOverAnEdge, &kOverAnEdge});
  int turns = 0;
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    int turning = 0;
    for (int k = 0; k < 2; ++k) turning += along[i][k].face != along[i + 1][k].face;
    EXPECT_LE(turning, 1);
    if (turning == 0) continue;
    ++turns;
    for (int k = 0; k < 2; ++k) EXPECT_EQ(along[i][k].p, along[i + 1][k].p);
  }
  EXPECT_EQ(turns, 2);
}

TEST(GoTogetherTest, WhereOneStaysTheOtherGoesAllTheWay) {
  const tree::SurfaceRoute stays = {kOnAFace.front(), kOnAFace.front()};
  const auto along = GoTogether({&stays, &kOnAFace});
  ASSERT_EQ(along.size(), 2u);
  EXPECT_TRUE(IsSame(along[1][0], kOnAFace.front()));
  EXPECT_TRUE(IsSame(along[1][1], kOnAFace.back()));
}

}  // namespace slide_path_test
}  // namespace regrasp::gait
