#include "planner/grasp/judge_grasps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"
#include "tests/fixtures/random_grasps.h"

namespace regrasp::grasp {
namespace {

constexpr int kContacts = 4;
constexpr double kHalfAngle = 0.4;

/// Points on the unit sphere with normals that point inwards, more or less.
class JudgeGraspsTest : public testing::Test {
 protected:
  JudgeGraspsTest() {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1000 * kContacts; ++i) {
      const Eigen::Vector3d p =
          Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
      const Eigen::Vector3d tilt(normal(random), normal(random), normal(random));
      const Eigen::Vector3d n = (-p + 0.3 * tilt).normalized();
      points_.insert(points_.end(), p.data(), p.data() + 3);
      normals_.insert(normals_.end(), n.data(), n.data() + 3);
    }
  }

  [[nodiscard]] GraspVerdicts Judge(const JudgeOptions& options) const {
    return JudgeGrasps({points_, normals_, kContacts}, options);
  }
  [[nodiscard]] Grasp GraspAt(std::size_t index) const {
    Grasp grasp;
    for (std::size_t c = index * kContacts; c < (index + 1) * kContacts; ++c) {
      grasp.push_back(
          {Eigen::Vector3d::Map(&points_[3 * c]), Eigen::Vector3d::Map(&normals_[3 * c])});
    }
    return grasp;
  }

  JudgeOptions options_{.half_angle = kHalfAngle, .frame = UnitFrame(3)};
  std::vector<double> points_, normals_;
};

TEST_F(JudgeGraspsTest, SaysOfEachWhatTheTestForOneSays) {
  options_.required_half_angle = options_.quality = true;
  const GraspVerdicts verdicts = Judge(options_);
  ASSERT_EQ(verdicts.force_closure.size(), 1000u);
  int yes = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const Grasp grasp = GraspAt(i);
    const ForceClosure alone = TestForceClosure(grasp, options_.frame, kHalfAngle);
    EXPECT_EQ(verdicts.force_closure[i].decision, alone.decision) << i;
    EXPECT_EQ(verdicts.force_closure[i].margin_lower, alone.margin_lower) << i;
    EXPECT_EQ(verdicts.quality[i], ComputeQuality(grasp, options_.frame, kHalfAngle).lower) << i;
    const auto required = ComputeRequiredHalfAngle(grasp, options_.frame);
    EXPECT_EQ(required.has_value(), !std::isnan(verdicts.required_half_angle[i])) << i;
    if (required) {
      EXPECT_EQ(verdicts.required_half_angle[i], required->upper) << i;
    }
    yes += alone.decision == Decision::kYes ? 1 : 0;
  }
  EXPECT_GT(yes, 100);  // both answers are there
  EXPECT_LT(yes, 900);
}

TEST_F(JudgeGraspsTest, DoesNotDependOnThreads) {
  options_.threads = 1;
  const GraspVerdicts one = Judge(options_);
  options_.threads = 5;
  const GraspVerdicts five = Judge(options_);
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(one.force_closure[i].decision, five.force_closure[i].decision) << i;
  }
}

TEST_F(JudgeGraspsTest, ComputesNothingThatIsNotAskedFor) {
  const GraspVerdicts verdicts = Judge(options_);
  EXPECT_TRUE(verdicts.required_half_angle.empty());
  EXPECT_TRUE(verdicts.quality.empty());
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
  points_.pop_back();
  EXPECT_THROW((void)Judge(options_), std::invalid_argument);
  points_.clear();
  EXPECT_THROW((void)Judge(options_), std::invalid_argument);
  EXPECT_THROW((void)JudgeGrasps({normals_, normals_, 0}, options_), std::invalid_argument);
}

TEST_F(JudgeGraspsTest, RefusesAnglesAndThreadsOutOfRange) {
  for (const double angle : {0.0, std::numbers::pi / 2, std::nan("")}) {
    options_.half_angle = angle;
    EXPECT_THROW((void)Judge(options_), std::invalid_argument) << angle;
  }
  options_.half_angle = kHalfAngle;
  options_.threads = -1;
  EXPECT_THROW((void)Judge(options_), std::invalid_argument);
}

}  // namespace
}  // namespace regrasp::grasp
