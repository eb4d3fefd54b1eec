#include "render/picture/caption.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace regrasp::render {
namespace caption_test {

/// Return the caption of a plan whose only step slides fingers 1 and 2.
/// @param waypoints  positions of the two fingers at each waypoint, centimetres.
std::string CaptionOf(const std::vector<std::array<double, 2>>& waypoints) {
  plan::Align align;
  for (const auto& places : waypoints) {
    plan::FingerGrasp& grasp = align.waypoints.emplace_back();
    for (const int i : {0, 1}) {
      plan::FingerContact& contact = grasp.emplace_back();
      contact.finger = FingerIndex(i + 1);
      contact.contact.p = Eigen::Vector3d(0.01 * places[i], i, 0);
    }
  }
  plan::Plan plan;
  plan.initial = align.waypoints.front();
  plan.steps = {align};
  return FrameCaption(plan, plan::EntryIndex(1));
}

TEST(CaptionTest, StatesTheDistancesAndTheOrderOfSlidingFingers) {
  EXPECT_EQ(CaptionOf({{0, 0}, {1, 0}}), "step 1/1 · align: move 1 by 1 cm along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {1, 2}}),
            "step 1/1 · align: move 1 by 1 cm, 2 by 2 cm together along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {1, 0}, {1, 2}}),
            "step 1/1 · align: move 1 by 1 cm, then 2 by 2 cm along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {0, 2}, {1, 2}}),
            "step 1/1 · align: move 2 by 2 cm, then 1 by 1 cm along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {0, 0}}), "step 1/1 · align");
}

/// Return the caption of an in-hand motion with a translation (metres) and a rotation about z
/// (radians).
std::string CaptionOfMove(double shift, double turn) {
  plan::Move move;
  move.path.resize(2);
  move.path[0].pose = Eigen::Isometry3d::Identity();
  move.path[1].pose =
      Eigen::Translation3d(shift, 0, 0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  plan::Plan plan;
  plan.steps = {move};
  return FrameCaption(plan, plan::EntryIndex(1));
}

TEST(CaptionTest, StatesTheRotationOrTheTranslationOfTheObject) {
  EXPECT_EQ(CaptionOfMove(0.005, 0.5), "step 1/1 · move: rotate the object by 28.65°");
  EXPECT_EQ(CaptionOfMove(0.005, 0), "step 1/1 · move: translate the object by 5 mm");
  EXPECT_EQ(CaptionOfMove(0.005, 1e-9), "step 1/1 · move: translate the object by 5 mm");
  EXPECT_EQ(CaptionOfMove(1e-9, 1e-9), "step 1/1 · move: free fingers");
}

}  // namespace caption_test
}  // namespace regrasp::render
