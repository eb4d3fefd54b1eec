#include "planner/sets/polygon/slack_program.h"

#include <gtest/gtest.h>

#include <random>

namespace regrasp::polygon {
namespace slack_program_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Tolerance of slacks of order 1: a few hundred roundings.
constexpr double kTolerance = 1e-13;

/// Return the inequalities low < x < high and low < y < high.
Inequalities Box(double low, double high) {
  Inequalities box;
  box.rows = MatrixXd(4, 2);
  box.rows << 1, 0, -1, 0, 0, 1, 0, -1;
  box.offsets = VectorXd(4);
  box.offsets << -low, high, -low, high;
  return box;
}

TEST(SlackProgram, TheMiddleOfABoxIsFarthestFromItsSides) {
  const SlackSolution solution = MaximizeSlack(Box(0.25, 0.75));
  EXPECT_NEAR(solution.slack, 0.25, kTolerance);
  EXPECT_NEAR((solution.z - Vector2d(0.5, 0.5)).norm(), 0, kTolerance);
}

TEST(SlackProgram, TheIncentreOfATriangleIsFarthestFromItsSides) {
  // x > 0, y > 0 and 3x + 4y < 12: a 3-4-5 triangle with an inscribed circle of radius 1.
  Inequalities triangle;
  triangle.rows = MatrixXd(3, 2);
  triangle.rows << 1, 0, 0, 1, -0.6, -0.8;
  triangle.offsets = VectorXd(3);
  triangle.offsets << 0, 0, 2.4;
  const SlackSolution solution = MaximizeSlack(triangle);
  EXPECT_NEAR(solution.slack, 1, kTolerance);
  EXPECT_NEAR((solution.z - Vector2d(1, 1)).norm(), 0, kTolerance);
}

TEST(SlackProgram, ASetWithoutInteriorHasNoSlackAndAnEmptyOneLess) {
  EXPECT_NEAR(MaximizeSlack(Box(0.5, 0.5)).slack, 0, kTolerance);
  EXPECT_NEAR(MaximizeSlack(Box(0.5, 0.25)).slack, -0.125, kTolerance);
}

TEST(SlackProgram, MoreSlackThanEnoughCountsForNothing) {
  const SlackSolution solution = MaximizeSlack(Box(-100, 100), 3);
  EXPECT_GE(solution.slack, 3 - kTolerance);
  // x > 0 alone is unbounded.
  Inequalities half_line;
  half_line.rows = MatrixXd::Ones(1, 1);
  half_line.offsets = VectorXd::Zero(1);
  EXPECT_GE(MaximizeSlack(half_line).slack, 1 - kTolerance);
}

TEST(SlackProgram, WithoutVariablesTheSlackIsTheSmallestOffset) {
  Inequalities fixed;
  fixed.rows = MatrixXd(3, 0);
  fixed.offsets = VectorXd(3);
  fixed.offsets << 0.5, 0.125, 0.25;
  EXPECT_EQ(MaximizeSlack(fixed).slack, 0.125);
}

TEST(SlackProgram, NoRandomPointHasMoreSlack) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(engine); };
  int nearly_best = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const int rows = 8 + trial % 10;
    const int variables = 1 + trial % 7;
    Inequalities set = {MatrixXd::NullaryExpr(rows, variables, draw),
                        VectorXd::NullaryExpr(rows, draw)};
    const SlackSolution best = MaximizeSlack(set);
    EXPECT_EQ(best.slack, set.SlackAt(best.z));
    if (best.slack >= 1 - kTolerance) continue;  // limited by `enough`
    for (int i = 0; i < 200; ++i) {
      const VectorXd z = best.z + 1e-3 * VectorXd::NullaryExpr(variables, draw);
      EXPECT_LE(set.SlackAt(z), best.slack + kTolerance);
      nearly_best += set.SlackAt(z) > best.slack - 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(nearly_best, 1000);
}

}  // namespace slack_program_test
}  // namespace regrasp::polygon
