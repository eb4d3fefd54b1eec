#include "report/pictures/replay_timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace regrasp::report {
namespace replay_timeline_test {

using Eigen::Vector3d;
using render::ViewerContactState;

constexpr double kDiameter = 0.1;

plan::FingerState Press(int finger, const Vector3d& contact, const Vector3d& inward,
                        double newtons) {
  plan::FingerState state;
  state.finger = FingerIndex(finger);
  state.role = plan::FingerRole::kHolding;
  state.contact_W = contact;
  state.normal_W = inward;
  state.force_W = newtons * inward;
  return state;
}

/// The initial grasp of fingers 0 and 1, and a switch that places finger 2 and releases finger 0.
struct Scene {
  ReportStep hold, change;
  std::vector<ShownEntry> entries;
  std::vector<FingerIndex> fingers;
  ReplayTimeline timeline;

  Scene() {
    change.check.index = plan::EntryIndex(1);
    plan::Snapshot first;
    first.fingers = {Press(0, {-0.03, 0, 0}, {1, 0, 0}, 4), Press(1, {0.03, 0, 0}, {-1, 0, 0}, 4)};
    plan::Snapshot second;
    second.fingers = {Press(1, {0.03, 0, 0}, {-1, 0, 0}, 6),
                      Press(2, {-0.03, 0, 0.01}, {1, 0, 0}, 6)};
    second.X_WO.translation() = Vector3d(1e-4, 0, 0);
    entries = {{&hold, first}, {&change, second}};
    fingers = FingersOf(entries);
    timeline = MakePointTimeline(entries, fingers, Vector3d::Zero(), kDiameter);
  }

  /// Return the last sample of an entry.
  [[nodiscard]] const render::ViewerSample& EndOf(int entry) const {
    const double end = timeline.ends[entry];
    return *std::ranges::find_if(timeline.samples,
                                 [end](const auto& sample) { return sample.time_s >= end - 1e-9; });
  }
};

TEST(ReplayTimelineTest, EachEntryEndsAtItsStaticGrasp) {
  const Scene scene;
  ASSERT_EQ(scene.fingers, (std::vector{FingerIndex(0), FingerIndex(1), FingerIndex(2)}));
  ASSERT_EQ(scene.timeline.ends.size(), 2);
  const auto& first = scene.EndOf(0);
  EXPECT_EQ(first.contacts[0].state, ViewerContactState::kHolding);
  EXPECT_TRUE(first.contacts[0].point.isApprox(Vector3d(-0.03, 0, 0), 1e-12));
  EXPECT_TRUE(first.contacts[1].force.isApprox(Vector3d(-4, 0, 0), 1e-12));
  EXPECT_EQ(first.contacts[2].state, ViewerContactState::kHidden);
  const auto& second = scene.EndOf(1);
  EXPECT_EQ(second.contacts[0].state, ViewerContactState::kFree);
  EXPECT_EQ(second.contacts[2].state, ViewerContactState::kHolding);
  EXPECT_TRUE(second.contacts[2].force.isApprox(Vector3d(6, 0, 0), 1e-12));
  EXPECT_NEAR(second.X_WO.translation().x(), 1e-4, 1e-12);
  EXPECT_FALSE(scene.timeline.simulated_time);
}

TEST(ReplayTimelineTest, TimesAscendAndJumpsAreSmall) {
  const Scene scene;
  const auto& samples = scene.timeline.samples;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_GT(samples[i].time_s, samples[i - 1].time_s);
    for (std::size_t f = 0; f < scene.fingers.size(); ++f) {
      if (samples[i - 1].contacts[f].state == ViewerContactState::kHidden) continue;
      const double jump = (samples[i].contacts[f].point - samples[i - 1].contacts[f].point).norm();
      EXPECT_LT(jump, 0.12 * kDiameter) << i << " " << f;
    }
  }
}

TEST(ReplayTimelineTest, FingersApproachAndLeaveAlongTheNormal) {
  const Scene scene;
  int approaching = 0, leaving = 0;
  for (const auto& sample : scene.timeline.samples) {
    if (sample.contacts[2].state == ViewerContactState::kFree) {
      EXPECT_LT(sample.contacts[2].point.x(), -0.03 + 1e-9);  // outside the object
      if (sample.contacts[2].point.x() > -0.05) {
        EXPECT_NEAR(sample.contacts[2].point.z(), 0.01, 1e-9);
        ++approaching;
      }
    }
    if (sample.contacts[0].state == ViewerContactState::kFree &&
        sample.time_s > scene.timeline.ends[0]) {
      EXPECT_NEAR(sample.contacts[0].point.y(), 0, 1e-12);
      EXPECT_EQ(sample.contacts[0].force, Vector3d::Zero());
      ++leaving;
    }
  }
  EXPECT_GT(approaching, 3);
  EXPECT_GT(leaving, 3);
}

TEST(ReplayTimelineTest, AFingerGoesAroundTheObject) {
  Scene scene;
  plan::Snapshot third;  // finger 0 returns on the opposite side
  third.fingers = {Press(0, {0.03, 0, 0.01}, {-1, 0, 0}, 6), Press(1, {0.03, 0, 0}, {-1, 0, 0}, 6),
                   Press(2, {-0.03, 0, 0.01}, {1, 0, 0}, 6)};
  scene.entries.push_back({&scene.change, third});
  const ReplayTimeline timeline =
      MakePointTimeline(scene.entries, scene.fingers, Vector3d::Zero(), kDiameter);
  int seen = 0;
  for (const auto& sample : timeline.samples) {
    if (sample.time_s < timeline.ends[1] || sample.contacts[0].state != ViewerContactState::kFree) {
      continue;
    }
    EXPECT_GE(sample.contacts[0].point.norm(), 0.03);
    ++seen;
  }
  EXPECT_GT(seen, 10);
}

TEST(ReplayTimelineTest, AMaliciousNumberOfFingersIsLimited) {
  ReportStep step;
  plan::Snapshot snapshot;
  for (int f = 0; f < 100; ++f) {
    snapshot.fingers.push_back(Press(1000 * f, {0, 0, 0}, {1, 0, 0}, 1));
  }
  EXPECT_EQ(FingersOf({{&step, snapshot}}).size(), plan::kMostDrawnFingers);
}

}  // namespace replay_timeline_test
}  // namespace regrasp::report
