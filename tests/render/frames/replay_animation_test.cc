#include "render/frames/replay_animation.h"

#include <gtest/gtest.h>

namespace regrasp::render {
namespace {

using Indices = std::vector<int>;

TEST(ReplayAnimationTest, InstantsAreSpreadEvenlyOverTheTimeOfAnEntry) {
  std::vector<double> times;
  for (int i = 0; i < 100; ++i) times.push_back(i);
  EXPECT_EQ(ChooseInstants(times, 9.5, 20, 5), (Indices{11, 13, 15, 17, 19}));
  // The end belongs to the entry, its beginning to the one before.
  EXPECT_EQ(ChooseInstants(times, 10, 12, 10), (Indices{12}));
  EXPECT_EQ(ChooseInstants(times, -1e9, 1e9, 2), (Indices{25, 75}));
}

TEST(ReplayAnimationTest, InstantsAreNotRepeated) {
  EXPECT_EQ(ChooseInstants({0, 1}, -1, 2, 50), (Indices{1}));
  EXPECT_EQ(ChooseInstants({1}, 0, 2, 3), (Indices{0}));
  EXPECT_TRUE(ChooseInstants({}, 0, 1, 3).empty());
  EXPECT_TRUE(ChooseInstants({1, 2}, 2, 5, 3).empty());
}

/// A finger of a body of 1 m that comes down by 5 cm in 50 samples, waits for 1000, presses, waits.
std::vector<plan::Snapshot> ComeDown() {
  std::vector<plan::Snapshot> samples;
  const auto add = [&](double z, double force) {
    plan::Snapshot sample;
    sample.time_s = 0.001 * static_cast<double>(samples.size());
    sample.fingers.emplace_back();
    sample.fingers.back().tip_W.z() = z;
    sample.fingers.back().force_W.z() = force;
    samples.push_back(sample);
  };
  add(7, 0);  // where it was before
  for (int i = 0; i <= 50; ++i) add(0.05 - 0.001 * i, 0);
  for (int i = 0; i < 1000; ++i) add(0, 0);
  for (int i = 1; i <= 80; ++i) add(0, i / 80.0);
  for (int i = 0; i < 1000; ++i) add(0, 1);
  return samples;
}

TEST(ReplayAnimationTest, PicturesAreSpreadOverWhatMoves) {
  const std::vector<plan::Snapshot> samples = ComeDown();
  const std::vector<double> progress = MeasureProgress(samples, 1, 1);
  ASSERT_EQ(progress.size(), samples.size());
  int coming = 0, pressing = 0;
  const std::vector<int> shown = ChooseInstants(progress, 0, progress.back(), 40);
  for (const int at : shown) {
    coming += samples[at].fingers[0].tip_W.z() > 0;
    const double force = samples[at].fingers[0].force_W.z();
    pressing += force > 0 && force < 1;
  }
  // 2.5 units of travel, 2 of force, and 2 of waiting.
  EXPECT_EQ(shown.size(), 40u);
  EXPECT_GE(coming, 13);
  EXPECT_GE(pressing, 11);
  for (std::size_t i = 1; i < progress.size(); ++i) ASSERT_GT(progress[i], progress[i - 1]);
}

TEST(ReplayAnimationTest, AFingerInTheAirIsDrawnAwayFromItsContact) {
  plan::Snapshot sample;
  sample.fingertip_radius_m = 0.04;
  plan::FingerState state;
  state.role = plan::FingerRole::kPlaced;
  state.normal_W = -Eigen::Vector3d::UnitZ();
  state.tip_W.z() = 0.09;
  sample.fingers = {state};
  const auto height = [&](GapView gaps) {
    return MakeFingerGlyphs(sample, PictureFrame(), FacetMesh(), {.gaps = gaps}).front().ball.z();
  };
  EXPECT_NEAR(height(GapView::kShown) - height(GapView::kNone), kGapScale * 0.05, 1e-12);
  sample.fingers[0].tip_W.z() = 0.04;
  EXPECT_EQ(height(GapView::kShown), height(GapView::kNone));
}

}  // namespace
}  // namespace regrasp::render
