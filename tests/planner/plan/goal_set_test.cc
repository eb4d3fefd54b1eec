#include "planner/plan/goal_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "planner/base/error.h"
#include "planner/plan/goal_set_io.h"

namespace regrasp::plan {
namespace goal_set_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kDraws = 300;

class Draws {
 public:
  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution(lower, upper)(generator_);
  }
  Vector3d Vector(double size) {
    return size * Vector3d(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1));
  }
  Vector3d Direction() { return Vector(1).normalized(); }
  Isometry3d Pose() {
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(Uniform(0, std::numbers::pi), Direction()).toRotationMatrix();
    pose.translation() = Vector(0.1);
    return pose;
  }
  GoalSet Goal(double scale = 1) {
    if (Uniform(0, 1) < 0.5) return GoalSet(FacingGoal{Direction(), Direction(), scale * 0.7});
    return GoalSet(PoseGoal{Pose(), {scale * 0.05, scale * 1.2}, Vector(0.02)});
  }

 private:
  std::mt19937 generator_{7};
};

/// Law: a set with larger tolerances contains the set with smaller ones, and is not farther away.
TEST(GoalSetTest, ALargerToleranceGivesASuperset) {
  Draws draws;
  int contained = 0;
  for (int i = 0; i < kDraws; ++i) {
    const GoalSet set = draws.Goal();
    const GoalSet smaller = set.Shrunk(0.02, 0.3);
    const Isometry3d pose = draws.Pose();
    EXPECT_TRUE(!smaller.Contains(pose) || set.Contains(pose));
    EXPECT_LE(set.Distance(pose).angle, smaller.Distance(pose).angle);
    EXPECT_LE(set.Distance(pose).length, smaller.Distance(pose).length);
    contained += smaller.Contains(pose);
  }
  EXPECT_GT(contained, 0);
}

/// Law: facing is invariant under rotation about the axis and under translation.
TEST(GoalSetTest, FacingDoesNotDependOnTheRotationAboutTheAxis) {
  Draws draws;
  for (int i = 0; i < kDraws; ++i) {
    const FacingGoal goal{draws.Direction(), draws.Direction(), 0.5};
    const Isometry3d pose = draws.Pose();
    const Isometry3d turned = Eigen::Translation3d(draws.Vector(1)) * pose *
                              Eigen::AngleAxisd(draws.Uniform(-4, 4), goal.axis);
    EXPECT_NEAR(GoalSet(goal).Distance(turned).angle, GoalSet(goal).Distance(pose).angle, 1e-12);
    EXPECT_EQ(GoalSet(goal).Distance(turned).length, 0);
  }
}

/// Law: the distance is zero if and only if the set contains the pose.
TEST(GoalSetTest, DistanceIsZeroInTheSetOnly) {
  Draws draws;
  for (int i = 0; i < kDraws; ++i) {
    const GoalSet set = draws.Goal();
    const Isometry3d pose = draws.Pose();
    EXPECT_EQ(set.Contains(pose), set.Distance(pose).IsZero());
  }
}

/// The nearest pose is in the set and rotates by the angle of the distance.
TEST(GoalSetTest, NearestIsInTheSetAtTheDistance) {
  Draws draws;
  for (int i = 0; i < kDraws; ++i) {
    const GoalSet set = draws.Goal();
    const Isometry3d pose = draws.Pose();
    const Vector3d pivot = draws.Vector(0.03);
    const Isometry3d nearest = set.Nearest(pose, pivot);
    EXPECT_LT(set.Distance(nearest).angle, 1e-9);
    EXPECT_LT(set.Distance(nearest).length, 1e-12);
    const Eigen::AngleAxisd between(pose.linear().transpose() * nearest.linear());
    EXPECT_NEAR(between.angle(), set.Distance(pose).angle, 1e-7);
    if (set.facing() != nullptr) {
      EXPECT_LT((pose * pivot - nearest * pivot).norm(), 1e-12);
    }
  }
}

/// Without tolerance the nearest pose is the goal pose, to the bit.
TEST(GoalSetTest, AnExactGoalHasOnePose) {
  Draws draws;
  const Isometry3d goal = draws.Pose();
  const GoalSet exact = GoalSet(goal).Shrunk(1, 1);
  EXPECT_EQ(exact.Nearest(draws.Pose(), draws.Vector(1)).matrix(), goal.matrix());
  EXPECT_TRUE(GoalSet(goal).HasDefaultTolerance());
  EXPECT_FALSE(exact.HasDefaultTolerance());
}

/// An axis that points in the opposite direction rotates by half a turn about any axis.
TEST(GoalSetTest, AnOppositeDirectionIsReachable) {
  const GoalSet set(FacingGoal{Vector3d::UnitX(), -Vector3d::UnitX(), 0});
  const Isometry3d nearest = set.Nearest(Isometry3d::Identity());
  EXPECT_LT((nearest.linear() * Vector3d::UnitX() + Vector3d::UnitX()).norm(), 1e-12);
}

/// Goals up and down follow the upward direction; other goals do not.
TEST(GoalSetTest, GoalsUpAndDownFollowTheDirectionOfGravity) {
  const auto read = [](const std::string& direction) {
    const Json json = Json::parse(R"({"facing": {"axis": "x", "tolerance_deg": 5, "direction": )" +
                                  direction + "}}");
    return ReadGoalSet(JsonReader(json, "goals"), Vector3d::UnitZ());
  };
  const Vector3d up = Vector3d(1, 2, -2) / 3;
  EXPECT_EQ(read(R"("up")").facing()->direction, Vector3d::UnitZ());
  EXPECT_EQ(read(R"("up")").WithUp(up).facing()->direction, up);
  EXPECT_EQ(read(R"("down")").WithUp(up).facing()->direction, -up);
  EXPECT_EQ(read(R"("z")").WithUp(up).facing()->direction, Vector3d::UnitZ());
  EXPECT_EQ(read("[0, 0, 1]").WithUp(up).facing()->direction, Vector3d::UnitZ());
  EXPECT_EQ(read(R"("up")").WithUp(up).facing()->tolerance, Radians(5));
  Draws draws;
  const GoalSet pose(draws.Pose());
  EXPECT_EQ(pose.WithUp(up).pose()->pose.matrix(), pose.pose()->pose.matrix());
}

TEST(GoalSetTest, JsonIsReadBack) {
  Draws draws;
  for (int i = 0; i < kDraws; ++i) {
    const GoalSet set = draws.Goal();
    const Json json = GoalSetJson(set);
    const GoalSet read = ReadGoalSet(JsonReader(json, "goals"), std::nullopt);
    const Isometry3d pose = draws.Pose();
    EXPECT_NEAR(read.Distance(pose).angle, set.Distance(pose).angle, 1e-10);
    EXPECT_NEAR(read.Distance(pose).length, set.Distance(pose).length, 1e-12);
    EXPECT_EQ(read.facing() != nullptr, set.facing() != nullptr);
  }
}

std::string ErrorOf(const std::string& text) {
  try {
    const Json json = ParseJson(text, "goals");
    static_cast<void>(ReadGoalSet(JsonReader(json, "goals"), Vector3d(Vector3d::UnitZ())));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GoalSetTest, BadGoalsAreReported) {
  const auto facing = [](const std::string& axis, const std::string& direction,
                         const std::string& tolerance, const std::string& more = "") {
    return R"({"facing": {"axis": )" + axis + R"(, "direction": )" + direction +
           R"(, "tolerance_deg": )" + tolerance + more + "}}";
  };
  EXPECT_EQ(ErrorOf(facing(R"("+y")", R"("up")", "30")), "");
  EXPECT_EQ(ErrorOf(facing("[0, 2, 0]", R"("-z")", "30")), "");
  EXPECT_THAT(ErrorOf(facing("[0, 0, 0]", R"("up")", "30")), testing::HasSubstr("zero vector"));
  EXPECT_THAT(ErrorOf(facing(R"("up")", R"("up")", "30")),
              testing::HasSubstr("/facing/axis: expected 3 numbers"));
  EXPECT_EQ(ErrorOf(facing("null", R"("up")", "30")),
            "goals: /facing/axis: expected 3 numbers, or x, y or z with an optional sign, "
            "found null");
  EXPECT_EQ(ErrorOf(facing(R"("+y")", "7", "30")),
            "goals: /facing/direction: expected 3 numbers, or x, y or z with an optional sign, "
            "up or down, found 7");
  EXPECT_THAT(ErrorOf(facing(R"("+y")", R"("left")", "30")), testing::HasSubstr("up or down"));
  EXPECT_THAT(ErrorOf(facing(R"("+y")", R"("up")", "-1")), testing::HasSubstr("must be between"));
  EXPECT_THAT(ErrorOf(facing(R"("+y")", R"("up")", "NaN")), testing::HasSubstr("goals"));
  EXPECT_THAT(ErrorOf(facing(R"("+y")", R"("up")", "1e999")), testing::HasSubstr("goals"));
  EXPECT_THAT(ErrorOf(facing(R"("+y")", R"("up")", "30", R"(, "yaw": 1)")),
              testing::HasSubstr("unknown member \"yaw\""));
  EXPECT_THAT(ErrorOf("{}"), testing::HasSubstr("either \"facing\" or \"pose\""));
}

std::string ErrorOfMarks(const std::string& text) {
  try {
    const Json json = ParseJson(text, "plan");
    static_cast<void>(ReadGoalMarks(JsonReader(json, "plan", "/goals")));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GoalMarksTest, AListWithoutGoalsIsRefused) {
  EXPECT_EQ(ErrorOfMarks("[]"), "plan: /goals: must not be empty");
}

TEST(GoalMarksTest, OnlyVectorsAreDirections) {
  const auto facing = [](const std::string& axis, const std::string& direction) {
    return R"([{"step": 0, "facing": {"axis": )" + axis + R"(, "direction": )" + direction +
           R"(, "tolerance_deg": 30}}])";
  };
  EXPECT_EQ(ErrorOfMarks(facing("[1, 0, 0]", "[0, 0, 2]")), "");
  EXPECT_EQ(ErrorOfMarks(facing(R"("x")", "[0, 0, 1]")),
            "plan: /goals/0/facing/axis: expected 3 numbers, found \"x\"");
  EXPECT_EQ(ErrorOfMarks(facing("[1, 0, 0]", R"("+z")")),
            "plan: /goals/0/facing/direction: expected 3 numbers, found \"+z\"");
  EXPECT_EQ(ErrorOfMarks(facing("null", "[0, 0, 1]")),
            "plan: /goals/0/facing/axis: expected 3 numbers, found null");
}

TEST(GoalMarksTest, NamesAreUnique) {
  const auto goals = [](const std::string& first, const std::string& second) {
    const std::string pose = R"("pose": {"position": [0, 0, 0], "quaternion": [1, 0, 0, 0]}})";
    return "[{" + first + R"("step": 0, )" + pose + ", {" + second + R"("step": 1, )" + pose + "]";
  };
  EXPECT_EQ(ErrorOfMarks(goals("", "")), "");
  EXPECT_EQ(ErrorOfMarks(goals(R"("name": "a", )", R"("name": "b", )")), "");
  EXPECT_EQ(ErrorOfMarks(goals(R"("name": "a", )", R"("name": "a", )")),
            "plan: /goals/1/name: must be unique, found \"a\" again");
}

}  // namespace goal_set_test
}  // namespace regrasp::plan
