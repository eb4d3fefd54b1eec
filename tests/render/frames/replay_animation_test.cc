#include "render/frames/replay_animation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace replay_animation_test {

int FramesOf(const AnimationSchedule& schedule) {
  int frames = 0;
  for (const AnimationInstant& instant : schedule.instants) frames += instant.frames;
  return frames;
}

/// Return the ends of `count` entries of `seconds` each.
std::vector<double> Ends(int count, double seconds) {
  std::vector<double> ends;
  for (int i = 1; i <= count; ++i) ends.push_back(i * seconds);
  return ends;
}

TEST(ReplayAnimationTest, AShortReplayHasItsOwnSpeedAndAPauseAfterEachEntry) {
  const AnimationSchedule schedule = ScheduleAnimation(std::vector<double>{0, 0.5, 1.5}, false);
  EXPECT_EQ(schedule.speed, 1);
  std::vector<int> pauses;
  double last_s = -1;
  for (const AnimationInstant& instant : schedule.instants) {
    EXPECT_GT(instant.time_s, last_s);
    last_s = instant.time_s;
    if (instant.frames > 1) pauses.push_back(instant.frames);
  }
  EXPECT_EQ(pauses, (std::vector<int>{kFirstPause, kPause, kLastPause}));
  EXPECT_EQ(FramesOf(schedule), kFirstPause + kPause + kLastPause + 14 + 29);
  EXPECT_EQ(schedule.instants.back().time_s, 1.5);
  EXPECT_EQ(schedule.instants.back().entry, 2);
}

TEST(ReplayAnimationTest, EighteenStepsLastAtMostThirtySeconds) {
  for (const double seconds : {0.1, 1.0, 1.7, 5.0, 40.0}) {
    const AnimationSchedule schedule = ScheduleAnimation(Ends(19, seconds), false);
    EXPECT_LE(FramesOf(schedule), 30 * kFramesPerSecond) << seconds;
    EXPECT_EQ(std::fmod(schedule.speed, kSpeedStep), 0) << seconds;
    // The next slower speed would be too long.
    if (schedule.speed == 1) continue;
    const double motion = 19 * seconds * kFramesPerSecond / (schedule.speed - kSpeedStep);
    EXPECT_GT(motion + kFirstPause + 17 * kPause + kLastPause, 30 * kFramesPerSecond) << seconds;
  }
}

TEST(ReplayAnimationTest, LongPlansAreProportionallyLongerUpToALimit) {
  const auto seconds = [](int entries) {
    return FramesOf(ScheduleAnimation(Ends(entries, 5), false)) /
           static_cast<double>(kFramesPerSecond);
  };
  EXPECT_GT(seconds(30), kLongest_s);
  EXPECT_LE(seconds(30), kLongest_s * 30 / kUsualEntries);
  for (const int entries : {100, 1000}) EXPECT_LE(seconds(entries), kLongestOfAll_s) << entries;
}

TEST(ReplayAnimationTest, AFailureHasALongPause) {
  const AnimationSchedule schedule = ScheduleAnimation(Ends(2, 1), true);
  EXPECT_EQ(schedule.instants.back().frames, kFailurePause);
  EXPECT_EQ(ScheduleAnimation(Ends(1, 0), true).instants.size(), 1u);
}

TEST(ReplayAnimationTest, EveryFormatIsWrittenAndTheBytesDoNotDependOnTheWorkers) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameOptions options = {96, 72, 1};
  options.animated = true;
  const FrameRenderer renderer(cube, 1, 0.3, snapshots, options);
  std::vector<AnimationFrame> frames;
  for (int i = 0; i < 6; ++i) {
    frames.push_back({{&snapshots[i % 3], {std::to_string(i)}}, 1 + i % 2});
  }
  const std::vector<AnimationFormat> formats = {AnimationFormat::kGif, AnimationFormat::kMp4,
                                                AnimationFormat::kWebp};
  std::vector<int> done;
  const std::vector<std::string> files =
      RenderAnimation(renderer, frames, formats, 1, [&](int count) { done.push_back(count); });
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].substr(0, 3), "GIF");
  EXPECT_EQ(files[1].substr(4, 4), "ftyp");
  EXPECT_EQ(files[2].substr(0, 4), "RIFF");
  const std::vector<std::string> again = RenderAnimation(renderer, frames, formats, 3);
  frames.pop_back();
  const std::vector<std::string> shorter = RenderAnimation(renderer, frames, formats, 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(again[i] == files[i]) << i;
    EXPECT_FALSE(shorter[i] == files[i]) << i;
  }
}

/// Return a snapshot with a finger that has a normal.
plan::Snapshot WithFinger(plan::FingerRole role) {
  plan::Snapshot snapshot;
  plan::FingerState& state = snapshot.fingers.emplace_back();
  state.role = role;
  state.normal_W = -Eigen::Vector3d::UnitZ();
  state.contact_W.z() = 0.2;
  return snapshot;
}

TEST(ReplayAnimationTest, AFreeFingerIsDrawnInTheAirOnlyInAnAnimation) {
  const auto glyphs = [](const plan::Snapshot& snapshot, bool free_fingers) {
    return MakeFingerGlyphs(snapshot, NormalizedFrame(), RayTree(), {.free_fingers = free_fingers});
  };
  plan::Snapshot snapshot = WithFinger(plan::FingerRole::kFree);
  EXPECT_TRUE(glyphs(snapshot, false).empty());
  const std::vector<FingerGlyph> shown = glyphs(snapshot, true);
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_NEAR(shown[0].contact.z(), 0.2, 1e-12);
  EXPECT_EQ(shown[0].end, shown[0].stem_end) << "no arrow";
  // It has neither a cone nor a force.
  std::vector<Shape> free, holding;
  AddFingerShapes(shown[0], 1, {0, 1}, free);
  AddFingerShapes(glyphs(WithFinger(plan::FingerRole::kHolding), true).front(), 1, {0, 1}, holding);
  EXPECT_EQ(free.size(), 2u);
  EXPECT_EQ(holding.size(), 3u);
  snapshot.fingers[0].normal_W.setZero();
  EXPECT_TRUE(glyphs(snapshot, true).empty()) << "its place is not known";
}

}  // namespace replay_animation_test
}  // namespace regrasp::render
