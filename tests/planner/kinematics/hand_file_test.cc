#include "planner/kinematics/hand_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <optional>

#include "planner/base/random.h"
#include "planner/kinematics/finger_kinematics.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::kinematics {
namespace hand_file_test {

const std::string kHands = ProjectPath("models/hands/");

JointConfiguration RandomConfiguration(const Finger& finger, RandomStream& random) {
  JointConfiguration configuration(finger.drives);
  for (int i = 0; i < finger.drives; ++i) {
    configuration[i] = finger.lower[i] + (finger.upper[i] - finger.lower[i]) * random.Uniform();
  }
  return configuration;
}

/// MuJoCo's kinematics are the independent reference.
TEST(HandFileTest, TipsAreWhereTheEngineHasThem) {
  for (const char* name : {"ring4", "ring5"}) {
    const HandModel hand = ReadHand(kHands + name + ".json");
    std::array<char, 1000> error{};
    const std::string xml = kHands + name + ".xml";
    mjModel* model = mj_loadXML(xml.c_str(), nullptr, error.data(), 1000);
    ASSERT_NE(model, nullptr) << error.data();
    mjData* data = mj_makeData(model);
    RandomStream random(1, RandomUse::kCandidates);
    for (int i = 0; i < 50; ++i) {
      for (const Finger& finger : hand.fingers) {
        const JointConfiguration configuration = RandomConfiguration(finger, random);
        const std::vector<double> angles = JointAngles(finger, configuration);
        for (std::size_t j = 0; j < angles.size(); ++j) {
          const int id = mj_name2id(model, mjOBJ_JOINT, finger.joints[j].name.c_str());
          ASSERT_GE(id, 0);
          data->qpos[model->jnt_qposadr[id]] = angles[j];
        }
        mj_kinematics(model, data);
        const int tip = mj_name2id(model, mjOBJ_GEOM, (finger.name + "_tip").c_str());
        ASSERT_GE(tip, 0);
        const Eigen::Map<const Eigen::Vector3d> expected(data->geom_xpos + 3 * tip);
        EXPECT_LT((TipAt(finger, configuration).centre - expected).norm(), 1e-12);
      }
    }
    mj_deleteData(data);
    mj_deleteModel(model);
  }
}

TEST(HandFileTest, TheJacobianIsTheDerivative) {
  const HandModel hand = ReadHand(kHands + "ring5.json");
  RandomStream random(2, RandomUse::kCandidates);
  for (const Finger& finger : hand.fingers) {
    const JointConfiguration configuration = RandomConfiguration(finger, random);
    const TipState state = TipAt(finger, configuration);
    for (int i = 0; i < finger.drives; ++i) {
      JointConfiguration more = configuration;
      JointConfiguration less = configuration;
      more[i] += 1e-6;
      less[i] -= 1e-6;
      const Eigen::Vector3d expected =
          (TipAt(finger, more).centre - TipAt(finger, less).centre) / 2e-6;
      EXPECT_LT((state.jacobian.col(i) - expected).norm(), 1e-8);
    }
  }
}

TEST(InverseKinematicsTest, FindsNearlyEveryPlaceThatATipCanBeIn) {
  const HandModel hand = ReadHand(kHands + "ring5.json");
  RandomStream random(3, RandomUse::kCandidates);
  int found = 0;
  constexpr int kTries = 500;
  const Finger& finger = hand.fingers[1];
  const InverseKinematics inverse(finger);
  for (int i = 0; i < kTries; ++i) {
    const TipState state = TipAt(finger, RandomConfiguration(finger, random));
    const TipTarget target{state.centre, state.axis};
    const std::optional<JointConfiguration> configuration = inverse.Solve(target);
    if (!configuration) continue;
    ++found;
    EXPECT_LT((TipAt(finger, *configuration).centre - target.centre).norm(), 1e-9);
    EXPECT_GE((*configuration - finger.lower).minCoeff(), 0.019);
    EXPECT_GE((finger.upper - *configuration).minCoeff(), 0.019);
    EXPECT_GE(TipAt(finger, *configuration).axis.dot(target.towards),
              std::cos(ConfigurationLimits().approach));
  }
  EXPECT_GT(found, kTries * 9 / 10);
  EXPECT_FALSE(inverse.Solve({{1, 1, 1}, {0, 0, 1}}));
  EXPECT_FALSE(inverse.Solve({{1e300, 0, 0}, {0, 0, 1}}));
}

TEST(InverseKinematicsTest, FollowsATargetWithoutJumps) {
  const HandModel hand = ReadHand(kHands + "ring5.json");
  const InverseKinematics inverse(hand.fingers[0]);
  std::optional<JointConfiguration> last;
  for (int i = 0; i <= 100; ++i) {
    const TipTarget target{{0.035, -0.02 + 0.0004 * i, 0.06}, {-1, 0, 0}};
    const std::optional<JointConfiguration> configuration = inverse.Solve(target);
    ASSERT_TRUE(configuration) << i;
    if (last) {
      EXPECT_LT((*configuration - *last).cwiseAbs().maxCoeff(), 0.05) << i;
    }
    last = configuration;
  }
}

/// A configuration with its fingertip at the target stays unchanged. A nearby one changes little.
/// With joint centering the result would be another configuration.
TEST(InverseKinematicsTest, NearAPostureItStaysNearWhereverTheMiddleIs) {
  const HandModel hand = ReadHand(kHands + "ring5.json");
  RandomStream random(5, RandomUse::kCandidates);
  const Finger& finger = hand.fingers[1];
  const InverseKinematics inverse(finger);
  int drawn_away = 0;
  for (int i = 0; i < 200; ++i) {
    // The configuration has a margin to its limits.
    const JointConfiguration configuration =
        inverse.middle() + 0.8 * (RandomConfiguration(finger, random) - inverse.middle());
    const TipState state = TipAt(finger, configuration);
    const TipTarget target{state.centre, state.axis};
    const auto same = inverse.SolveNear(target, configuration);
    ASSERT_TRUE(same);
    EXPECT_LT((*same - configuration).norm(), 1e-9);
    const auto near = inverse.SolveNear(
        target, configuration + JointConfiguration::Constant(configuration.size(), 0.01));
    ASSERT_TRUE(near);
    EXPECT_LT((TipAt(finger, *near).centre - target.centre).norm(), kTipTolerance);
    EXPECT_LT((*near - configuration).norm(), 0.1);
    const auto middle = inverse.SolveFrom(target, configuration);
    drawn_away += middle && (*middle - configuration).norm() > 0.1;
  }
  EXPECT_GT(drawn_away, 50);
}

/// No point of a link moves farther than the bound.
TEST(FingerKinematicsTest, MotionIsBounded) {
  const HandModel hand = ReadHand(kHands + "ring4.json");
  RandomStream random(4, RandomUse::kCandidates);
  const Finger& finger = hand.fingers[0];
  double tightest = 0;
  for (int i = 0; i < 300; ++i) {
    const JointConfiguration from = RandomConfiguration(finger, random);
    const JointConfiguration to = from + 0.1 * (RandomConfiguration(finger, random) - from);
    for (const LinkShape& link : finger.shapes) {
      const double bound = MotionBound(finger, from, to, link.after, LinkReach(finger, link));
      const auto before = FramesOf(finger, from);
      for (int k = 1; k <= 4; ++k) {
        const auto after = FramesOf(finger, from + 0.25 * k * (to - from));
        for (const Eigen::Vector3d& point : link.enclosing.points) {
          const double moved =
              (after[link.after - 1] * point - before[link.after - 1] * point).norm();
          ASSERT_LE(moved, bound + 1e-15);
          tightest = std::max(tightest, moved / bound);
        }
      }
    }
  }
  EXPECT_GT(tightest, 0.5);
}

}  // namespace hand_file_test
}  // namespace regrasp::kinematics
