#include "render/frames/replay_animation.h"

#include <gtest/gtest.h>

#include "tests/render/frames/scenes.h"

namespace regrasp::render {
namespace replay_animation_test {

using Indices = std::vector<int>;

TEST(ReplayAnimationTest, InstantsAreSpreadEvenlyOverTheTimeOfAnEntry) {
  std::vector<double> times;
  for (int i = 0; i < 100; ++i) times.push_back(i);
  EXPECT_EQ(ChooseInstants(times, 9.5, 20, 5), (Indices{11, 13, 15, 17, 19}));
  // The end belongs to the entry, its start to the previous one.
  EXPECT_EQ(ChooseInstants(times, 10, 12, 10), (Indices{12}));
  EXPECT_EQ(ChooseInstants(times, -1e9, 1e9, 2), (Indices{25, 75}));
}

TEST(ReplayAnimationTest, InstantsAreNotRepeated) {
  EXPECT_EQ(ChooseInstants({0, 1}, -1, 2, 50), (Indices{1}));
  EXPECT_EQ(ChooseInstants({1}, 0, 2, 3), (Indices{0}));
  EXPECT_TRUE(ChooseInstants({}, 0, 1, 3).empty());
  EXPECT_TRUE(ChooseInstants({1, 2}, 2, 5, 3).empty());
}

/// Return samples of a finger on an object of 1 m: 50 samples in which it descends by 5 cm, 1000 of
/// waiting, an increasing force, and waiting.
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
  add(7, 0);  // its former position
  for (int i = 0; i <= 50; ++i) add(0.05 - 0.001 * i, 0);
  for (int i = 0; i < 1000; ++i) add(0, 0);
  for (int i = 1; i <= 80; ++i) add(0, i / 80.0);
  for (int i = 0; i < 1000; ++i) add(0, 1);
  return samples;
}

TEST(ReplayAnimationTest, FramesAreDistributedOverMotion) {
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
  // 2.5 units of travel, 2 of force and 2 of waiting.
  EXPECT_EQ(shown.size(), 40u);
  EXPECT_GE(coming, 13);
  EXPECT_GE(pressing, 11);
  for (std::size_t i = 1; i < progress.size(); ++i) ASSERT_GT(progress[i], progress[i - 1]);
}

/// Return pauses after the initial grasp and after a step with these samples.
std::vector<AnimationPause> MakePauses(const std::vector<plan::Snapshot>& samples) {
  return {{samples[1080], "coming", "hold"}, {samples.back(), "pressing", "step"}};
}

TEST(ReplayAnimationTest, EveryEntryHasMotionAndThenAPause) {
  const std::vector<plan::Snapshot> samples = ComeDown();
  const std::vector<AnimationPause> pauses = MakePauses(samples);
  const std::vector<AnimationFrame> frames = CutAnimation(samples, pauses, 1);
  std::vector<std::string> captions;
  std::vector<int> durations;
  double time = -1;
  for (const AnimationFrame& frame : frames) {
    EXPECT_GE(frame.task.snapshot->time_s, time);
    time = frame.task.snapshot->time_s;
    EXPECT_EQ(frame.task.fault, nullptr);
    if (captions.empty() || captions.back() != frame.task.caption) {
      captions.push_back(frame.task.caption);
    }
    if (frame.duration_ms > kFrameTime_ms) durations.push_back(frame.duration_ms);
  }
  EXPECT_EQ(captions, (std::vector<std::string>{"coming", "hold", "pressing", "step"}));
  EXPECT_EQ(durations, (std::vector<int>{kFirstPause_ms, kLastPause_ms}));
  EXPECT_EQ(frames.back().task.snapshot, &pauses[1].snapshot);
}

TEST(ReplayAnimationTest, AFailedStepHasALongPauseAndOnlyItHasMarks) {
  const std::vector<plan::Snapshot> samples = ComeDown();
  std::vector<AnimationPause> pauses = MakePauses(samples);
  pauses.back().marks = FaultMarks{.heading = "slipped", .fingers = {}};
  const std::vector<AnimationFrame> frames = CutAnimation(samples, pauses, 1);
  EXPECT_EQ(frames.back().task.fault, &*pauses.back().marks);
  EXPECT_EQ(frames.back().duration_ms, kFailurePause_ms);
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    EXPECT_EQ(frames[i].task.fault, nullptr);
  }
}

TEST(ReplayAnimationTest, AnEntryWithoutReplayHasOnlyAPause) {
  const std::vector<plan::Snapshot> samples = ComeDown();
  std::vector<AnimationPause> pauses = MakePauses(samples);
  const std::size_t count = CutAnimation(samples, pauses, 1).size();
  pauses.push_back({plan::Snapshot(), "planned", "planned", FaultMarks()});
  EXPECT_EQ(CutAnimation(samples, pauses, 1).size(), count + 1);
  EXPECT_EQ(CutAnimation({}, {pauses.back()}, 1).size(), 1u);
}

TEST(ReplayAnimationTest, GivenMotionsPrecedeTheirPauses) {
  std::vector<AnimationPause> pauses(3);
  for (int i = 0; i < 3; ++i) {
    pauses[i].moving_caption = "to " + std::to_string(i);
    pauses[i].caption = std::to_string(i);
  }
  const std::vector<std::vector<plan::Snapshot>> motions = {
      {}, std::vector<plan::Snapshot>(5), std::vector<plan::Snapshot>(2)};
  std::string captions;
  for (const AnimationFrame& frame : JoinAnimation(motions, pauses)) {
    captions += frame.task.caption + (frame.duration_ms > kFrameTime_ms ? "! " : " ");
  }
  EXPECT_EQ(captions, "0! to 1 to 1 to 1 to 1 to 1 1! to 2 to 2 2! ");
  // If there are too many frames, some are omitted evenly.
  const std::vector<std::vector<plan::Snapshot>> many(3, std::vector<plan::Snapshot>(4000));
  const std::size_t count = JoinAnimation(many, pauses).size();
  EXPECT_LE(count, std::size_t{kMaxFrames + 3});
  EXPECT_GT(count, std::size_t{kMaxFrames / 2});
}

TEST(ReplayAnimationTest, EveryFormatIsWrittenAndTheBytesDoNotDependOnTheWorkers) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameOptions options = {96, 72, 1};
  options.gaps = GapView::kShown;
  const FrameRenderer renderer(cube, 1, 0.3, snapshots, options);
  std::vector<AnimationFrame> frames;
  for (int i = 0; i < 6; ++i) {
    frames.push_back({{&snapshots[i % 3], std::to_string(i)}, (1 + i % 2) * kTick_ms});
  }
  const std::vector<AnimationFormat> formats = {AnimationFormat::kGif, AnimationFormat::kMp4,
                                                AnimationFormat::kWebp};
  std::vector<int> done;
  const std::vector<std::string> files =
      RenderAnimation(renderer, frames, formats, 1, [&](int count) { done.push_back(count); });
  EXPECT_EQ(done, (Indices{1, 2, 3, 4, 5, 6}));
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

/// Return a finger with a fingertip sphere of 0.04 on an object of 1, at distance `gap` from the
/// surface.
FingerGlyph GlyphInTheAir(double gap, plan::FingerRole role, GapView gaps) {
  plan::Snapshot sample;
  sample.fingertip_radius_m = 0.04;
  plan::FingerState state;
  state.role = role;
  state.normal_W = -Eigen::Vector3d::UnitZ();
  state.tip_W.z() = 0.04 + gap;
  sample.fingers = {state};
  return MakeFingerGlyphs(sample, NormalizedFrame(), RayTree(), {.gaps = gaps}).front();
}

TEST(ReplayAnimationTest, AFingerInTheAirIsDrawnAwayFromItsContact) {
  const auto height = [](double gap, GapView gaps) {
    return GlyphInTheAir(gap, plan::FingerRole::kPlaced, gaps).fingertip.z();
  };
  EXPECT_NEAR(height(0.02, GapView::kShown) - height(0.02, GapView::kNone), kGapScale * 0.02,
              1e-12);
  EXPECT_EQ(height(0, GapView::kShown), height(0, GapView::kNone));
}

TEST(ReplayAnimationTest, AFingerInTheAirIsNoFartherOutThanItsArrowOtherwise) {
  for (const plan::FingerRole role : {plan::FingerRole::kPlaced, plan::FingerRole::kReleased}) {
    const double arrow = GlyphInTheAir(0.01, role, GapView::kNone).end.z();
    EXPECT_NEAR(GlyphInTheAir(0, role, GapView::kShown).end.z(), arrow, 1e-12);
    for (const double gap : {0.01, 0.03, 0.1, 10.0}) {
      const FingerGlyph glyph = GlyphInTheAir(gap, role, GapView::kShown);
      EXPECT_EQ(glyph.end, glyph.stem_end) << "no arrow";
      EXPECT_LE(glyph.end.z(), arrow + 1e-12) << gap;
    }
  }
}

}  // namespace replay_animation_test
}  // namespace regrasp::render
