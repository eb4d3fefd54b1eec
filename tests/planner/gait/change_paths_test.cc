#include "planner/gait/change_paths.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regrasp::gait {
namespace change_paths_test {

using Eigen::Vector3d;
using grasp::Contact;

bool IsSame(const Contact& a, const Contact& b) {
  return a.p == b.p && a.n == b.n && a.face == b.face;
}

/// Across the top of a cube, about its edge, and down its side: lengths 1 and 3.
const tree::SurfaceRoute kOverAnEdge = {{{0.1, 0, 1}, -Vector3d::UnitZ(), FaceIndex{0}},
                                        {{1.1, 0, 1}, -Vector3d::UnitZ(), FaceIndex{0}},
                                        {{1.1, 0, 1}, -Vector3d::UnitX(), FaceIndex{1}},
                                        {{1.1, 0, -2}, -Vector3d::UnitX(), FaceIndex{1}}};
const tree::SurfaceRoute kOnAFace = {{{-1, 0.3, 0}, Vector3d::UnitX(), FaceIndex{2}},
                                     {{-1, 0.7, 0}, Vector3d::UnitX(), FaceIndex{2}}};

TEST(SynchronizeRoutesTest, TheEndsEqualThoseOfTheRoutesBitForBit) {
  for (const auto& routes : {std::vector{&kOverAnEdge}, std::vector{&kOverAnEdge, &kOnAFace},
                             std::vector{&kOnAFace, &kOverAnEdge, &kOverAnEdge}}) {
    const auto waypoints = SynchronizeRoutes(routes);
    for (std::size_t i = 0; i < routes.size(); ++i) {
      EXPECT_TRUE(IsSame(waypoints.front()[i], routes[i]->front()));
      EXPECT_TRUE(IsSame(waypoints.back()[i], routes[i]->back()));
    }
  }
}

TEST(SynchronizeRoutesTest, SpeedsAreConstantAndOthersStayDuringARotation) {
  const auto waypoints = SynchronizeRoutes({&kOverAnEdge, &kOnAFace});
  ASSERT_EQ(waypoints.size(), 4u);
  // The first contact reaches the edge after a quarter of its route.
  for (const int i : {1, 2}) EXPECT_LT((waypoints[i][1].p - Vector3d(-1, 0.4, 0)).norm(), 1e-15);
  EXPECT_EQ(waypoints[1][0].p, waypoints[2][0].p);
  EXPECT_EQ(waypoints[1][0].face, FaceIndex{0});
  EXPECT_EQ(waypoints[2][0].face, FaceIndex{1});
  EXPECT_EQ(waypoints[1][1].p, waypoints[2][1].p);
}

/// If two contacts reach an edge simultaneously, they rotate one after the other in any order.
TEST(SynchronizeRoutesTest, ContactsRotateOneAfterTheOther) {
  const auto waypoints = SynchronizeRoutes({&kOverAnEdge, &kOverAnEdge});
  int rotations = 0;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    int rotating = 0;
    for (int k = 0; k < 2; ++k) rotating += waypoints[i][k].face != waypoints[i + 1][k].face;
    EXPECT_LE(rotating, 1);
    if (rotating == 0) continue;
    ++rotations;
    for (int k = 0; k < 2; ++k) EXPECT_EQ(waypoints[i][k].p, waypoints[i + 1][k].p);
  }
  EXPECT_EQ(rotations, 2);
}

TEST(SynchronizeRoutesTest, AStationaryContactDoesNotStopTheOther) {
  const tree::SurfaceRoute stays = {kOnAFace.front(), kOnAFace.front()};
  const auto waypoints = SynchronizeRoutes({&stays, &kOnAFace});
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_TRUE(IsSame(waypoints[1][0], kOnAFace.front()));
  EXPECT_TRUE(IsSame(waypoints[1][1], kOnAFace.back()));
}

}  // namespace change_paths_test
}  // namespace regrasp::gait
