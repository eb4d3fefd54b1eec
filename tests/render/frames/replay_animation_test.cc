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

/// The hold and a step of those samples.
std::vector<AnimationRest> MakeRests(const std::vector<plan::Snapshot>& samples) {
  return {{samples[1080], "coming", "hold"}, {samples.back(), "pressing", "step"}};
}

TEST(ReplayAnimationTest, EveryEntryMovesAndThenRests) {
  const std::vector<plan::Snapshot> samples = ComeDown();
  const std::vector<AnimationRest> rests = MakeRests(samples);
  const std::vector<AnimationPicture> pictures = CutAnimation(samples, rests, 1);
  std::vector<std::string> captions;
  std::vector<int> durations;
  double time = -1;
  for (const AnimationPicture& picture : pictures) {
    EXPECT_GE(picture.frame.snapshot->time_s, time);
    time = picture.frame.snapshot->time_s;
    EXPECT_EQ(picture.frame.fault, nullptr);
    if (captions.empty() || captions.back() != picture.frame.caption) {
      captions.push_back(picture.frame.caption);
    }
    if (picture.duration_ms > kPictureTime_ms) durations.push_back(picture.duration_ms);
  }
  EXPECT_EQ(captions, (std::vector<std::string>{"coming", "hold", "pressing", "step"}));
  EXPECT_EQ(durations, (std::vector<int>{kFirstRestTime_ms, kLastRestTime_ms}));
  EXPECT_EQ(pictures.back().frame.snapshot, &rests[1].snapshot);
}

TEST(ReplayAnimationTest, AFailedStepRestsLongWithItsMarksAndNothingElseHasThem) {
  const std::vector<plan::Snapshot> samples = ComeDown();
  std::vector<AnimationRest> rests = MakeRests(samples);
  rests.back().marks = FaultMarks{.heading = "slipped", .fingers = {}};
  const std::vector<AnimationPicture> pictures = CutAnimation(samples, rests, 1);
  EXPECT_EQ(pictures.back().frame.fault, &*rests.back().marks);
  EXPECT_EQ(pictures.back().duration_ms, kFailedRestTime_ms);
  for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
    EXPECT_EQ(pictures[i].frame.fault, nullptr);
  }
}

TEST(ReplayAnimationTest, AnEntryThatWasNotReplayedOnlyRests) {
  const std::vector<plan::Snapshot> samples = ComeDown();
  std::vector<AnimationRest> rests = MakeRests(samples);
  const std::size_t count = CutAnimation(samples, rests, 1).size();
  rests.push_back({plan::Snapshot(), "planned", "planned", FaultMarks()});
  EXPECT_EQ(CutAnimation(samples, rests, 1).size(), count + 1);
  EXPECT_EQ(CutAnimation({}, {rests.back()}, 1).size(), 1u);
}

TEST(ReplayAnimationTest, MotionsThatAreGivenStandBeforeTheirRests) {
  std::vector<AnimationRest> rests(3);
  for (int i = 0; i < 3; ++i) {
    rests[i].moving_caption = "to " + std::to_string(i);
    rests[i].caption = std::to_string(i);
  }
  const std::vector<std::vector<plan::Snapshot>> motions = {
      {}, std::vector<plan::Snapshot>(5), std::vector<plan::Snapshot>(2)};
  std::string captions;
  for (const AnimationPicture& picture : JoinAnimation(motions, rests)) {
    captions += picture.frame.caption + (picture.duration_ms > kPictureTime_ms ? "! " : " ");
  }
  EXPECT_EQ(captions, "0! to 1 to 1 to 1 to 1 to 1 1! to 2 to 2 2! ");
  // Of many pictures some are left out, evenly.
  const std::vector<std::vector<plan::Snapshot>> many(3, std::vector<plan::Snapshot>(4000));
  const std::size_t count = JoinAnimation(many, rests).size();
  EXPECT_LE(count, std::size_t{kMostPicturesInAll + 3});
  EXPECT_GT(count, std::size_t{kMostPicturesInAll / 2});
}

TEST(ReplayAnimationTest, EveryFormatIsWrittenAndTheBytesDoNotDependOnTheWorkers) {
  const object::Polyhedron cube = MakeCube(0.03);
  const std::vector<plan::Snapshot> snapshots = MakeCubeSequence();
  FrameOptions options = {96, 72, 1};
  options.gaps = GapView::kShown;
  const FrameRenderer renderer(cube, 1, 0.3, snapshots, options);
  std::vector<AnimationPicture> pictures;
  for (int i = 0; i < 6; ++i) {
    pictures.push_back({{&snapshots[i % 3], std::to_string(i)}, (1 + i % 2) * kTick_ms});
  }
  const std::vector<MovingFormat> formats = {MovingFormat::kGif, MovingFormat::kMp4,
                                             MovingFormat::kWebp};
  std::vector<int> done;
  const std::vector<std::string> files =
      RenderAnimation(renderer, pictures, formats, 1, [&](int count) { done.push_back(count); });
  EXPECT_EQ(done, (Indices{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].substr(0, 3), "GIF");
  EXPECT_EQ(files[1].substr(4, 4), "ftyp");
  EXPECT_EQ(files[2].substr(0, 4), "RIFF");
  const std::vector<std::string> again = RenderAnimation(renderer, pictures, formats, 3);
  pictures.pop_back();
  const std::vector<std::string> shorter = RenderAnimation(renderer, pictures, formats, 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(again[i] == files[i]) << i;
    EXPECT_FALSE(shorter[i] == files[i]) << i;
  }
}

/// A finger whose tip, a ball of 0.04 on a body of 1, is `gap` off the surface.
FingerGlyph GlyphInTheAir(double gap, plan::FingerRole role, GapView gaps) {
  plan::Snapshot sample;
  sample.fingertip_radius_m = 0.04;
  plan::FingerState state;
  state.role = role;
  state.normal_W = -Eigen::Vector3d::UnitZ();
  state.tip_W.z() = 0.04 + gap;
  sample.fingers = {state};
  return MakeFingerGlyphs(sample, PictureFrame(), RayTree(), {.gaps = gaps}).front();
}

TEST(ReplayAnimationTest, AFingerInTheAirIsDrawnAwayFromItsContact) {
  const auto height = [](double gap, GapView gaps) {
    return GlyphInTheAir(gap, plan::FingerRole::kPlaced, gaps).ball.z();
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
