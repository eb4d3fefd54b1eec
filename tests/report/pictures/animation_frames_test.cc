#include "report/pictures/animation_frames.h"

#include <gtest/gtest.h>

namespace regrasp::report {
namespace animation_frames_test {

using Eigen::Vector3d;
using render::ViewerContactState;

constexpr double kDiameter = 0.1;

/// A finger that approaches its contact in the first second and then waits for another one.
struct Scene {
  plan::Plan plan;
  ReportStep hold;
  std::vector<ShownEntry> entries;
  std::vector<FingerIndex> fingers = {FingerIndex(0)};
  ReplayTimeline timeline;

  Scene() {
    entries = {{&hold, plan::Snapshot()}};
    for (const double time_s : {0.0, 1.0, 2.0}) {
      render::ViewerSample& sample = timeline.samples.emplace_back();
      sample.time_s = time_s;
      const bool touches = time_s > 0;
      sample.contacts = {{touches ? ViewerContactState::kHolding : ViewerContactState::kFree,
                          Vector3d(touches ? 0 : 0.05, 0, 0), Vector3d(-1, 0, 0),
                          Vector3d(touches ? -1 : 0, 0, 0)}};
    }
    timeline.ends = {2};
  }

  [[nodiscard]] AnimationFrames Make() const {
    return MakeAnimationFrames(plan, entries, timeline, fingers, nullptr, kDiameter);
  }
};

TEST(AnimationFramesTest, FramesWithoutMotionAreOneLongFrame) {
  Scene scene;
  // Without a change of state the contact moves continuously.
  scene.timeline.samples[0].contacts[0].state = ViewerContactState::kHolding;
  const AnimationFrames made = scene.Make();
  ASSERT_EQ(made.frames.size(), made.snapshots.size());
  int duration = 0;
  for (std::size_t i = 0; i < made.frames.size(); ++i) {
    EXPECT_EQ(made.frames[i].task.snapshot, &made.snapshots[i]);
    duration += made.frames[i].frames;
    if (i == 0) continue;
    EXPECT_LT(made.snapshots[i].fingers[0].contact_W.x(),
              made.snapshots[i - 1].fingers[0].contact_W.x());
  }
  EXPECT_EQ(duration, 2 * render::kFramesPerSecond - 1 + render::kLastPause);
  EXPECT_LE(made.frames.size(), 31u);
  EXPECT_GE(made.frames.size(), 29u);
  EXPECT_GT(made.frames.back().frames, render::kLastPause);
}

TEST(AnimationFramesTest, AFingerInTheAirIsFreeAndHasANormal) {
  const AnimationFrames made = Scene().Make();
  const plan::FingerState& first = made.snapshots.front().fingers[0];
  EXPECT_EQ(first.role, plan::FingerRole::kFree);
  EXPECT_NEAR(first.normal_W.norm(), 1, 1e-12);
  EXPECT_EQ(made.snapshots.back().fingers[0].role, plan::FingerRole::kHolding);
}

TEST(AnimationFramesTest, TheCaptionStatesTheSpeedOfASimulation) {
  Scene scene;
  EXPECT_EQ(scene.Make().frames[0].task.text.caption.find("speed"), std::string::npos);
  scene.timeline.simulated_time = true;
  EXPECT_NE(scene.Make().frames[0].task.text.caption.find("speed 1×"), std::string::npos);
  scene.timeline.samples.back().time_s = 200;
  scene.timeline.ends = {200};
  EXPECT_NE(scene.Make().frames[0].task.text.caption.find("speed 7.5×"), std::string::npos);
}

TEST(AnimationFramesTest, AFailureEndsWithItsFrameAndMarks) {
  Scene scene;
  scene.entries[0].marks = render::FaultMarks{.heading = "slipped", .fingers = {}};
  const AnimationFrames made = scene.Make();
  EXPECT_EQ(made.frames.back().task.fault, &*scene.entries[0].marks);
  EXPECT_EQ(made.frames.back().frames, render::kFailurePause);
  for (std::size_t i = 0; i + 1 < made.frames.size(); ++i) {
    EXPECT_EQ(made.frames[i].task.fault, nullptr);
  }
}

}  // namespace animation_frames_test
}  // namespace regrasp::report
