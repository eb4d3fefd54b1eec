#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>

namespace regrasp::lp {

/// Return the inverse of a small matrix by Gauss-Jordan elimination.
/// Pivoting is partial (Golub and Van Loan).
/// It is as accurate as LU factorization for simplex bases. For seven rows it is three times as
/// fast as Eigen, which uses blocked algorithms. The result is not finite if a pivot is 0.
/// @tparam kStride  number of stored rows, of which the first kRows are the matrix. An even number
///     keeps columns aligned.
template <int kRows, int kStride = (kRows + 1) / 2 * 2>
[[nodiscard]] Eigen::Matrix<double, kRows, kRows> Invert(
    const Eigen::Matrix<double, kRows, kRows>& matrix) {
  using Column = Eigen::Matrix<double, kStride, 1>;
  Eigen::Matrix<double, kStride, kRows> work = Eigen::Matrix<double, kStride, kRows>::Zero();
  work.template topRows<kRows>() = matrix;
  std::array<int, kRows> exchanged;
  for (int k = 0; k < kRows; ++k) {
    int pivot = 0;
    work.col(k).segment(k, kRows - k).cwiseAbs().maxCoeff(&pivot);
    pivot += k;
    exchanged[k] = pivot;
    if (pivot != k) work.row(k).swap(work.row(pivot));
    Column factors = work.col(k);
    work.col(k).setZero();
    work(k, k) = 1;
    work.row(k) *= 1 / factors[k];
    factors[k] = 0;
    const Eigen::Matrix<double, 1, kRows> row = work.row(k);
    work.noalias() -= factors * row;
  }
  for (int k = kRows - 1; k >= 0; --k) {
    if (exchanged[k] != k) work.col(k).swap(work.col(exchanged[k]));
  }
  return work.template topRows<kRows>();
}

}  // namespace regrasp::lp
