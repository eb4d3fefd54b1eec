#include "planner/lp/invert.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace regrasp::lp {
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
