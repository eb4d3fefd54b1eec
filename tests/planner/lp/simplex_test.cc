#include "planner/lp/simplex.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "tests/planner/lp/glpk_program.h"

namespace regrasp::lp {
namespace simplex_test {

/// Accumulated rounding error of programs with entries of about 1.
constexpr double kRounding = 1e-9;

/// No program in this file takes a tenth of these pivots.
constexpr Limits kLimits = {.pivots = 500, .refactor_after = 24};

/// Rounding error of reduced costs.
constexpr double kImprovement = 1e-11;

template <int kRows>
struct ListedColumn {
  Eigen::Matrix<double, kRows, 1> entries = Eigen::Matrix<double, kRows, 1>::Zero();
  double weight_cost = 0;
  int index = -1;

  template <class Visit>
  void ForEachEntry(const Visit& visit) const {
    for (int r = 0; r < kRows; ++r) {
      if (entries[r] != 0) visit(r, entries[r]);
    }
  }
  [[nodiscard]] double cost() const { return weight_cost; }
};

template <int kRows>
ListedColumn<kRows> ColumnOf(const ListedProgram& program, int index) {
  return {program.columns.col(index), program.costs[index], index};
}

/// Dantzig's rule over a list: the largest reduced cost.
template <int kRows>
auto PriceOf(const ListedProgram& program, bool with_costs) {
  using Column = ListedColumn<kRows>;
  return [&program, with_costs](const Eigen::Matrix<double, kRows, 1>& dual, Column& column) {
    const Eigen::VectorXd costs = with_costs ? program.costs : 0 * program.costs;
    const Eigen::VectorXd reduced = program.columns.transpose() * dual - costs;
    int best = 0;
    if (!(reduced.maxCoeff(&best) > kImprovement)) return false;
    column = ColumnOf<kRows>(program, best);
    return true;
  };
}

enum class Outcome { kSolved, kInfeasible, kUnbounded, kStalled };

struct Solution {
  Outcome outcome;
  double least = 0;
  Eigen::VectorXd weights;  ///< by column
  Eigen::VectorXd dual;
};

template <int kRows, class Program>
Eigen::VectorXd WeightsOf(const Program& simplex, Eigen::Index columns) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(columns);
  for (int r = 0; r < kRows; ++r) {
    if (const auto* column = simplex.column(r)) weights[column->index] += simplex.weights()[r];
  }
  return weights;
}

/// Solve a program in two phases.
template <int kRows>
Solution Solve(const ListedProgram& program) {
  Simplex<kRows, ListedColumn<kRows>> simplex;
  simplex.StartFeasibility(program.right);
  if (simplex.Run(PriceOf<kRows>(program, false), kLimits) != End::kNoColumn) {
    return {Outcome::kStalled, 0, {}, {}};
  }
  if (simplex.unbalanced() > kRounding) return {Outcome::kInfeasible, 0, {}, simplex.dual()};
  simplex.StartOptimality();
  const End end = simplex.Run(PriceOf<kRows>(program, true), kLimits);
  if (end == End::kUnbounded) return {Outcome::kUnbounded, 0, {}, {}};
  if (end == End::kPivotLimit) return {Outcome::kStalled, 0, {}, {}};
  simplex.Refactor();
  return {Outcome::kSolved, simplex.objective(), WeightsOf<kRows>(simplex, program.columns.cols()),
          simplex.dual()};
}

/// Check that weights and dual solution prove each other's objective.
void ExpectOptimal(const ListedProgram& program, const Solution& solution) {
  const double rounding = kRounding * (1 + solution.weights.lpNorm<1>());
  EXPECT_GE(solution.weights.minCoeff(), -rounding);
  EXPECT_LT((program.columns * solution.weights - program.right).norm(), rounding);
  EXPECT_LT((program.columns.transpose() * solution.dual - program.costs).maxCoeff(), kRounding);
  EXPECT_NEAR(program.costs.dot(solution.weights), solution.least, rounding);
  EXPECT_NEAR(program.right.dot(solution.dual), solution.least, rounding);
}

/// Return a random program with entries from −1 to 1 and costs from `least_cost` on.
ListedProgram RandomProgram(int rows, int columns, double least_cost, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_real_distribution<double> cost(least_cost, 1);
  ListedProgram program;
  program.columns = Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(engine); });
  program.costs = Eigen::VectorXd::NullaryExpr(columns, [&] { return cost(engine); });
  program.right = Eigen::VectorXd::NullaryExpr(rows, [&] { return uniform(engine); });
  return program;
}

struct Counts {
  int solved = 0;
  int infeasible = 0;
  int unbounded = 0;
};

template <int kRows>
Counts CompareWithGlpk(int columns, double least_cost, int programs) {
  std::mt19937_64 engine(17);
  Counts counts;
  for (int i = 0; i < programs; ++i) {
    const ListedProgram program = RandomProgram(kRows, columns, least_cost, engine);
    const Solution solution = Solve<kRows>(program);
    const GlpkAnswer answer = SolveByGlpk(program);
    SCOPED_TRACE(testing::Message() << kRows << " rows, program " << i);
    EXPECT_NE(solution.outcome, Outcome::kStalled);
    EXPECT_EQ(solution.outcome != Outcome::kInfeasible, answer.feasible);
    EXPECT_EQ(solution.outcome == Outcome::kSolved, answer.least.has_value());
    counts.solved += solution.outcome == Outcome::kSolved ? 1 : 0;
    counts.infeasible += solution.outcome == Outcome::kInfeasible ? 1 : 0;
    counts.unbounded += solution.outcome == Outcome::kUnbounded ? 1 : 0;
    if (solution.outcome != Outcome::kSolved || !answer.least) continue;
    const double size = 1 + solution.weights.lpNorm<1>();
    EXPECT_NEAR(solution.least, *answer.least, kRounding * size);
    ExpectOptimal(program, solution);
  }
  return counts;
}

TEST(SimplexTest, OfRandomProgramsIsThatOfGlpk) {
  for (const Counts& counts :
       {CompareWithGlpk<3>(6, -0.5, 300), CompareWithGlpk<4>(8, -0.5, 300),
        CompareWithGlpk<7>(14, -0.5, 200), CompareWithGlpk<15>(30, -0.5, 100)}) {
    EXPECT_GT(counts.solved, 10);
    EXPECT_GT(counts.infeasible, 10);
    EXPECT_GT(counts.unbounded, 5);
  }
}

TEST(SimplexTest, FindsTheOptimumThatAProgramIsBuiltFor) {
  // A basis with positive weights, a dual solution, and other columns with higher costs than it
  // implies.
  constexpr int kRows = 6;
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0.1, 1);
  for (int i = 0; i < 100; ++i) {
    ListedProgram program = RandomProgram(kRows, 3 * kRows, 0, engine);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(3 * kRows);
    for (int c = 0; c < kRows; ++c) weights[2 * c] = uniform(engine);
    const Eigen::VectorXd dual =
        Eigen::VectorXd::NullaryExpr(kRows, [&] { return uniform(engine); });
    program.right = program.columns * weights;
    program.costs = program.columns.transpose() * dual;
    for (int c = 0; c < program.costs.size(); ++c) {
      if (weights[c] == 0) program.costs[c] += uniform(engine);
    }
    const Solution solution = Solve<kRows>(program);
    ASSERT_EQ(solution.outcome, Outcome::kSolved) << i;
    ExpectOptimal(program, solution);
    EXPECT_NEAR(solution.least, program.right.dot(dual), kRounding) << i;
  }
}

TEST(SimplexTest, SeparatesWhatIsInfeasible) {
  // All columns have a first entry ≥ 0.1, and that of the right-hand side is −1.
  constexpr int kRows = 5;
  std::mt19937_64 engine(3);
  for (int i = 0; i < 50; ++i) {
    ListedProgram program = RandomProgram(kRows, 12, 0, engine);
    program.columns.row(0) = program.columns.row(0).cwiseAbs().array() + 0.1;
    program.right[0] = -1;
    const Solution solution = Solve<kRows>(program);
    ASSERT_EQ(solution.outcome, Outcome::kInfeasible) << i;
    EXPECT_GT(program.right.dot(solution.dual), kRounding);
    EXPECT_LT((program.columns.transpose() * solution.dual).maxCoeff(), kRounding);
  }
}

TEST(SimplexTest, SaysThatAColumnGrowsWithoutEnd) {
  // λ_0 = 1 + λ_1, and increasing λ_1 reduces the cost.
  ListedProgram program;
  program.columns = Eigen::MatrixXd{{1, -1, 0}, {0, 0, 1}, {0, 0, 0.5}};
  program.costs = Eigen::Vector3d(0, -1, 0);
  program.right = Eigen::Vector3d(1, 2, 1);
  EXPECT_EQ(Solve<3>(program).outcome, Outcome::kUnbounded);
  program.costs[0] = 2;
  const Solution bounded = Solve<3>(program);
  ASSERT_EQ(bounded.outcome, Outcome::kSolved);
  EXPECT_NEAR(bounded.least, 2, kRounding);
}

TEST(SimplexTest, EndsOnDegenerateProgramsThatMakeDantzigsRuleCycle) {
  // Beale 1955, as in Chvátal 1983, page 31: the minimum is −1, and all earlier bases have the
  // objective 0.
  ListedProgram program;
  program.columns = Eigen::MatrixXd{{0.5, -5.5, -2.5, 9, 1, 0, 0},  //
                                    {0.5, -1.5, -0.5, 1, 0, 1, 0},
                                    {1, 0, 0, 0, 0, 0, 1}};
  program.costs = Eigen::VectorXd{{-10, 57, 9, 24, 0, 0, 0}};
  program.right = Eigen::Vector3d(0, 0, 1);
  const Solution solution = Solve<3>(program);
  ASSERT_EQ(solution.outcome, Outcome::kSolved);
  EXPECT_NEAR(solution.least, -1, kRounding);
  ExpectOptimal(program, solution);
}

TEST(SimplexTest, OfAssignmentsIsThatOfGlpk) {
  // All vertices of an assignment program are degenerate, and one of its equations is redundant.
  constexpr int kSide = 5;
  constexpr int kRows = 2 * kSide;
  std::mt19937_64 engine(11);
  for (int i = 0; i < 50; ++i) {
    ListedProgram program = RandomProgram(kRows, kSide * kSide, 0, engine);
    program.columns.setZero();
    for (int c = 0; c < kSide * kSide; ++c) {
      program.columns(c / kSide, c) = 1;
      program.columns(kSide + c % kSide, c) = 1;
    }
    program.right.setOnes();
    const Solution solution = Solve<kRows>(program);
    ASSERT_EQ(solution.outcome, Outcome::kSolved) << i;
    ExpectOptimal(program, solution);
    EXPECT_NEAR(solution.least, SolveByGlpk(program).least.value(), kRounding) << i;
  }
}

TEST(SimplexTest, StopsAtTheLimitOnPivots) {
  std::mt19937_64 engine(1);
  ListedProgram program = RandomProgram(4, 12, 0, engine);
  program.right = program.columns.rowwise().sum();
  Simplex<4, ListedColumn<4>> simplex;
  simplex.StartFeasibility(program.right);
  EXPECT_EQ(simplex.Run(PriceOf<4>(program, false), {.pivots = 2}), End::kPivotLimit);
  EXPECT_GT(simplex.unbalanced(), kRounding);
  EXPECT_EQ(simplex.Run(PriceOf<4>(program, false), kLimits), End::kNoColumn) << "it goes on";
  EXPECT_LT(simplex.unbalanced(), kRounding);
}

TEST(SimplexTest, KeepsBalanceAndTheObjectiveFallsAtEveryPivot) {
  constexpr int kRows = 7;
  std::mt19937_64 engine(23);
  ListedProgram program = RandomProgram(kRows, 40, 0.1, engine);
  program.right = program.columns * Eigen::VectorXd::Constant(40, 0.5);
  Simplex<kRows, ListedColumn<kRows>> simplex;
  simplex.StartFeasibility(program.right);
  simplex.Run(PriceOf<kRows>(program, false), kLimits);
  simplex.StartOptimality();
  int pivots = 0;
  double before = simplex.objective();
  const auto price = PriceOf<kRows>(program, true);
  simplex.Run(
      [&](const auto& dual, ListedColumn<kRows>& column) {
        const Eigen::VectorXd weights = WeightsOf<kRows>(simplex, 40);
        EXPECT_LT((program.columns * weights - program.right).norm(), kRounding);
        EXPECT_GE(weights.minCoeff(), -kRounding);
        EXPECT_LE(simplex.objective(), before + kRounding);
        EXPECT_NEAR(simplex.objective(), program.costs.dot(weights), kRounding);
        before = simplex.objective();
        ++pivots;
        return price(dual, column);
      },
      kLimits);
  EXPECT_GT(pivots, 3);
}

TEST(SimplexTest, ARefactoredBasisIsTheSame) {
  std::mt19937_64 engine(29);
  ListedProgram program = RandomProgram(6, 20, 0.1, engine);
  program.right = program.columns.rowwise().sum();
  Simplex<6, ListedColumn<6>> simplex;
  simplex.StartFeasibility(program.right);
  for (const int pivots : {2, 500}) {  // with and without artificial columns
    simplex.Run(PriceOf<6>(program, false), {.pivots = pivots});
    const Eigen::MatrixXd inverse = simplex.inverse();
    const Eigen::VectorXd weights = simplex.weights();
    const Eigen::VectorXd dual = simplex.dual();
    const double objective = simplex.objective();
    simplex.Refactor();
    EXPECT_LT((simplex.inverse() - inverse).norm(), kRounding);
    EXPECT_LT((simplex.weights() - weights).norm(), kRounding);
    EXPECT_LT((simplex.dual() - dual).norm(), kRounding);
    EXPECT_NEAR(simplex.objective(), objective, kRounding);
  }
}

TEST(SimplexTest, RowsThatAreLeftOutCountForNothing) {
  std::mt19937_64 engine(31);
  for (int i = 0; i < 50; ++i) {
    const ListedProgram inner = RandomProgram(3, 9, 0.1, engine);
    // The same program with an additional row that cannot be satisfied.
    ListedProgram program = inner;
    program.columns.resize(4, 9);
    program.columns << inner.columns.topRows(2), Eigen::MatrixXd::Ones(1, 9),
        inner.columns.bottomRows(1);
    program.right.resize(4);
    program.right << inner.right.head(2), -1, inner.right.tail(1);
    EXPECT_EQ(Solve<4>(program).outcome, Outcome::kInfeasible);

    Simplex<4, ListedColumn<4>> simplex;
    simplex.StartFeasibility(program.right, Eigen::Vector4d(1, 1, 0, 1));
    simplex.Run(PriceOf<4>(program, false), kLimits);
    const Solution expected = Solve<3>(inner);
    ASSERT_EQ(simplex.unbalanced() > kRounding, expected.outcome == Outcome::kInfeasible) << i;
    if (expected.outcome == Outcome::kInfeasible) continue;
    simplex.StartOptimality();
    ASSERT_EQ(simplex.Run(PriceOf<4>(program, true), kLimits), End::kNoColumn);
    EXPECT_NEAR(simplex.objective(), expected.least, kRounding);
    EXPECT_EQ(simplex.dual()[2], 0);
    simplex.Refactor();
    EXPECT_NEAR(simplex.objective(), expected.least, kRounding);
    EXPECT_EQ(simplex.dual()[2], 0);
  }
}

TEST(SimplexTest, AColumnOfAnySignDoesNotLeave) {
  // x − λ_0 = −2, λ_0 + λ_1 = 1. The maximum of x is −1, with λ_0 = 1; the minimum is −2.
  using Column = ListedColumn<2>;
  const Column second{{0, 1}, 0, 1};
  for (const auto& [cost, x] : {std::pair(-1.0, -1.0), std::pair(1.0, -2.0)}) {
    Simplex<2, Column> simplex;
    simplex.StartFromBasis({Column{{-1, 0}, 0, 2}, second}, Eigen::Vector2d(-2, 1));
    const int row = simplex.EnterFree({{-1, 0}, -cost, 3});  // −x
    ASSERT_EQ(row, 0);
    ListedProgram program;
    program.columns = Eigen::MatrixXd{{-1, 0}, {1, 1}};
    program.costs = Eigen::Vector2d::Zero();
    simplex.Run(PriceOf<2>(program, true), kLimits);
    EXPECT_NEAR(-simplex.weights()[row], x, kRounding);
  }
}

struct Point {
  Eigen::Vector2d at;
  template <class Visit>
  void ForEachEntry(const Visit& visit) const {
    visit(0, at.y());
    visit(1, 1.0);
  }
  [[nodiscard]] double cost() const { return -at.x(); }
};

TEST(SimplexTest, OfADiscAsInfinitelyManyColumnsReachesItsBorder) {
  // Minimum of −x over weights of points (cos t, sin t) with Σ λ = 1 and a mean of the form (x,
  // 0.3): columns (sin t, 1), cost −cos t. The best column for a dual solution has a closed form.
  Simplex<2, Point> simplex;
  simplex.StartFromBasis({Point{{0, 1}}, Point{{0, -1}}}, Eigen::Vector2d(0.3, 1));
  const auto price = [](const Eigen::Vector2d& dual, Point& point) {
    point.at = Eigen::Vector2d(1, dual[0]).normalized();
    return Eigen::Vector2d(1, dual[0]).norm() + dual[1] > kImprovement;
  };
  EXPECT_EQ(simplex.Run(price, kLimits), End::kNoColumn);
  EXPECT_NEAR(simplex.objective(), -std::sqrt(1 - 0.3 * 0.3), kRounding);
}

TEST(UnevenWeightTest, NoTwoAreTheSame) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_GE(UnevenWeight(i), 1);
    EXPECT_LT(UnevenWeight(i), 1.5);
    for (int j = 0; j < i; ++j) EXPECT_GT(std::abs(UnevenWeight(i) - UnevenWeight(j)), 1e-3);
  }
}

}  // namespace simplex_test

namespace invert_test {

/// Rounding error for random matrices, whose condition number is at most a few thousand.
constexpr double kRounding = 1e-11;

template <int kRows>
using Square = Eigen::Matrix<double, kRows, kRows>;

template <int kRows>
Square<kRows> Draw(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> entry(-1, 1);
  Square<kRows> matrix;
  for (double& value : matrix.reshaped()) value = entry(engine);
  return matrix;
}

template <int kRows>
void ExpectInverse(const Square<kRows>& matrix) {
  const Square<kRows> inverse = Invert(matrix);
  const Square<kRows> expected = matrix.fullPivLu().inverse();
  EXPECT_LE((inverse - expected).norm(), kRounding * expected.squaredNorm()) << matrix;
  EXPECT_LE((matrix * inverse - Square<kRows>::Identity()).norm(), kRounding * inverse.norm());
}

TEST(InvertTest, IsThatOfFullPivoting) {
  std::mt19937_64 engine(5);
  for (int trial = 0; trial < 300; ++trial) {
    ExpectInverse<4>(Draw<4>(engine));
    ExpectInverse<7>(Draw<7>(engine));
    ExpectInverse<13>(Draw<13>(engine));
  }
}

TEST(InvertTest, RowsAreExchangedWhereAPivotIsZero) {
  Square<3> cyclic;
  cyclic << 0, 2, 0, 0, 0, 4, 8, 0, 0;
  Square<3> expected;
  expected << 0, 0, 0.125, 0.5, 0, 0, 0, 0.25, 0;
  EXPECT_EQ(Invert(cyclic), expected);
}

TEST(InvertTest, OfASingularMatrixIsNotFinite) {
  EXPECT_FALSE(Invert(Square<2>(Square<2>::Ones())).allFinite());
}

}  // namespace invert_test
}  // namespace regrasp::lp
