#include "planner/grasp/judge_grasps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "planner/grasp/bound_quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace judge_grasps_test {

constexpr int kContacts = 4;
constexpr double kFrictionAngle = 0.4;
/// Number of grasps: several of the blocks that threads process.
constexpr int kGrasps = 1000;
/// Number of measured grasps, sufficient for both answers.
constexpr int kMeasured = 50;

class JudgeGraspsTest : public testing::Test {
 protected:
  JudgeGraspsTest() {
    RandomGrasps random(7);
    for (int i = 0; i < kGrasps; ++i) {
      for (const Contact& contact : random.OnBall(kContacts, 3)) {
        points_.insert(points_.end(), contact.p.data(), contact.p.data() + 3);
        normals_.insert(normals_.end(), contact.n.data(), contact.n.data() + 3);
      }
    }
  }

  [[nodiscard]] GraspVerdicts Judge(const JudgeOptions& options, int grasps = kGrasps) const {
    const std::size_t values = 3 * kContacts * static_cast<std::size_t>(grasps);
    return JudgeGrasps(
        {std::span(points_).first(values), std::span(normals_).first(values), kContacts}, options);
  }
  [[nodiscard]] Grasp GraspAt(std::size_t index) const {
    Grasp grasp;
    for (std::size_t c = index * kContacts; c < (index + 1) * kContacts; ++c) {
      grasp.push_back(
          {Eigen::Vector3d::Map(&points_[3 * c]), Eigen::Vector3d::Map(&normals_[3 * c])});
    }
    return grasp;
  }

  JudgeOptions options_{.friction_angle = kFrictionAngle, .frame = UnitFrame(3)};
  std::vector<double> points_, normals_;
};

TEST_F(JudgeGraspsTest, DecidesEachAsTheTestForOneDoes) {
  const GraspVerdicts verdicts = Judge(options_);
  ASSERT_EQ(verdicts.force_closure.size(), kGrasps);
  int yes = 0;
  for (std::size_t i = 0; i < kGrasps; ++i) {
    const ForceClosure alone = TestForceClosure(GraspAt(i), options_.frame, kFrictionAngle);
    EXPECT_EQ(verdicts.force_closure[i].decision, alone.decision) << i;
    EXPECT_EQ(verdicts.force_closure[i].margin_lower, alone.margin_lower) << i;
    EXPECT_EQ(verdicts.force_closure[i].margin_upper, alone.margin_upper) << i;
    yes += alone.decision == Decision::kYes ? 1 : 0;
  }
  EXPECT_GT(yes, kGrasps / 20);  // both answers occur
  EXPECT_LT(yes, kGrasps - kGrasps / 20);
}

TEST_F(JudgeGraspsTest, MeasuresEachAsForOne) {
  options_.required_friction_angle = options_.quality = true;
  const GraspVerdicts verdicts = Judge(options_, kMeasured);
  int held = 0;
  for (std::size_t i = 0; i < kMeasured; ++i) {
    const Grasp grasp = GraspAt(i);
    const QualityBounds quality = BoundQuality(grasp, options_.frame, kFrictionAngle);
    EXPECT_EQ(verdicts.quality[i], quality.lower) << i;
    EXPECT_EQ(verdicts.quality_upper[i], quality.upper) << i;
    EXPECT_LE(quality.upper - quality.lower, std::max(kQualityGap, 0.01 * quality.upper)) << i;
    const auto required = ComputeRequiredFrictionAngle(grasp, options_.frame);
    EXPECT_EQ(required.has_value(), !std::isnan(verdicts.required_friction_angle[i])) << i;
    if (required) {
      EXPECT_EQ(verdicts.required_friction_angle[i], required->upper) << i;
    }
    held += verdicts.quality[i] > 0 ? 1 : 0;
  }
  EXPECT_GT(held, 0);
  EXPECT_LT(held, kMeasured);
}

TEST_F(JudgeGraspsTest, DoesNotDependOnThreads) {
  options_.threads = 1;
  const GraspVerdicts one = Judge(options_);
  options_.threads = 5;
  const GraspVerdicts five = Judge(options_);
  for (std::size_t i = 0; i < kGrasps; ++i) {
    EXPECT_EQ(one.force_closure[i].decision, five.force_closure[i].decision) << i;
    EXPECT_EQ(one.force_closure[i].margin_lower, five.force_closure[i].margin_lower) << i;
  }
}

TEST_F(JudgeGraspsTest, ComputesNothingThatIsNotAskedFor) {
  const GraspVerdicts verdicts = Judge(options_);
  EXPECT_TRUE(verdicts.required_friction_angle.empty());
  EXPECT_TRUE(verdicts.quality.empty());
  EXPECT_TRUE(verdicts.quality_upper.empty());
}

TEST_F(JudgeGraspsTest, JudgesNone) {
  EXPECT_TRUE(JudgeGrasps({{}, {}, kContacts}, options_).force_closure.empty());
}

TEST_F(JudgeGraspsTest, NamesTheFirstThatIsNone) {
  normals_[3 * kContacts * 700] = std::numeric_limits<double>::quiet_NaN();
  normals_[3 * kContacts * 12 + 4] += 0.5;
  EXPECT_THAT([&] { (void)Judge(options_); },
              testing::ThrowsMessage<std::invalid_argument>(testing::StartsWith("grasp 12: ")));
}

TEST_F(JudgeGraspsTest, RefusesArraysThatDoNotFit) {
  const std::span<const double> all(points_);
  const auto refuses = [&](GraspArrays grasps) {
    EXPECT_THROW((void)JudgeGrasps(grasps, options_), std::invalid_argument);
  };
  refuses({all.first(all.size() - 1), all.first(all.size() - 1), kContacts});
  refuses({all.first(3 * kContacts), all, kContacts});
  refuses({{}, all, kContacts});
  refuses({all, all, 0});
}

TEST_F(JudgeGraspsTest, RefusesAnglesAndThreadsOutOfRange) {
  for (const double angle : {0.0, std::numbers::pi / 2, std::nan("")}) {
    options_.friction_angle = angle;
    EXPECT_THROW((void)Judge(options_), std::invalid_argument) << angle;
  }
  options_.friction_angle = kFrictionAngle;
  options_.threads = -1;
  EXPECT_THROW((void)Judge(options_), std::invalid_argument);
}

}  // namespace judge_grasps_test
}  // namespace regrasp::grasp
