#include "planner/object/face_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace regrasp::object {
namespace box_tree_test {

using Box = BoxTree::Box;

std::vector<Box> RandomBoxes(int count, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> place(0, 1), size(0, 0.1);
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d low(place(engine), place(engine), place(engine));
    boxes.emplace_back(low, low + Eigen::Vector3d(size(engine), size(engine), size(engine)));
  }
  return boxes;
}

std::multiset<int> Near(const BoxTree& tree, const Box& box) {
  std::multiset<int> near;
  tree.VisitNear(box, [&](int i) { near.insert(i); });
  return near;
}

TEST(BoxTree, VisitsEverythingThatMeetsABoxOnceAndLittleElse) {
  for (const int count : {1, 6, 7, 1000}) {
    const std::vector<Box> boxes = RandomBoxes(count, 1);
    const BoxTree tree(count, [&](int i) { return boxes[i]; });
    std::size_t met = 0, visited = 0;
    for (const Box& query : RandomBoxes(50, 2)) {
      const std::multiset<int> near = Near(tree, query);
      visited += near.size();
      for (int i = 0; i < count; ++i) {
        EXPECT_LE(near.count(i), 1u);
        if (!boxes[i].intersects(query)) continue;
        ++met;
        EXPECT_EQ(near.count(i), 1u) << i;
      }
    }
    EXPECT_TRUE(met > 0 || count < 1000);
    EXPECT_TRUE(visited < 10 * met || count < 1000) << visited << " of 50,000";
  }
}

TEST(BoxTree, BordersThatTouchMeet) {
  const Box unit(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  const BoxTree tree(1, [&](int) { return unit; });
  EXPECT_EQ(Near(tree, Box(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(2, 2, 2))).size(), 1u);
  EXPECT_TRUE(Near(tree, Box(Eigen::Vector3d(1.001, 1, 1), Eigen::Vector3d(2, 2, 2))).empty());
}

TEST(BoxTree, ManyThatLieInOnePlaceAreFound) {
  const Box unit(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  const BoxTree tree(100, [&](int) { return unit; });
  EXPECT_EQ(Near(tree, unit).size(), 100u);
}

TEST(BoxTree, AnEmptyOneHasNothing) {
  EXPECT_TRUE(Near(BoxTree(0, [](int) { return Box(); }),
                   Box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()))
                  .empty());
}

}  // namespace box_tree_test
}  // namespace regrasp::object
