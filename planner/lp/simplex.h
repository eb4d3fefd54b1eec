#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// Smallest pivot among the entries of B⁻¹ w, which are typically of order 1.
/// Below it the inverse would lose more than half of its digits.
inline constexpr double kPivot = 1e-9;

/// Tolerance of negative basic weights in the ratio test.
/// It allows a larger pivot among nearly equal ratios.
inline constexpr double kRatioSlack = 1e-13;

/// Limits of Simplex::Run.
struct Limits {
  int pivots;  ///< largest number of pivots; beyond it the program stalls
  /// Number of pivots after which the inverse is recomputed.
  int refactor_after = std::numeric_limits<int>::max();
};

/// Reason why Simplex::Run ended.
enum class End {
  kNoColumn,    ///< the pricing step gave no column
  kUnbounded,   ///< the column of the pricing step can grow without bound
  kPivotLimit,  ///< the limit of pivots is reached
};

/// Revised simplex method with an explicit inverse of the basis, for programs with few rows and any
/// number of columns, even infinitely many:
///
///     minimise Σ cost_j λ_j   over λ ≥ 0   with   Σ λ_j w_j = b,   w_j and b of kRows numbers.
///
/// Columns are generated. The caller's pricing step gets the dual solution y and returns a column
/// with positive reduced cost y · w − cost, or none. The column with the largest reduced cost is
/// best (Dantzig's rule). For a circular friction cone this column has a closed form, so cones are
/// not linearized. For every solution with Σ λ ≤ s and every bound c on the reduced costs, Σ cost λ
/// ≥ y · b − c s.
///
/// A program starts from a feasible basis, or in a first phase from artificial columns ±e_r. The
/// first phase minimizes the weights of the artificial columns. In the second phase they cost
/// nothing and leave before all other columns.
///
/// The leaving column has the largest entry among nearly minimal ratios (Harris), which preserves
/// the accuracy of the inverse. This rule does not exclude cycles in degenerate programs, as
/// Bland's rule would at the price of more pivots (Avis and Chvátal 1978). Limits::pivots ends
/// cycles, and UnevenWeight helps to avoid degenerate programs.
///
/// Sources: Dantzig 1963, Dantzig and Wolfe 1960 (column generation), Harris 1973 (ratio test),
/// Bland 1977 (cycles).
///
/// Laws: after every pivot Σ λ w = b and λ ≥ 0 up to rounding and kRatioSlack, and the objective
/// has not increased.
///
/// @tparam Column  value type with `template <class Visit> void ForEachEntry(const Visit& visit)
///     const`, which calls visit(row, value) for its nonzero entries, and with `double cost()
///     const`, its cost in the second phase.
template <int kRows, class Column>
class Simplex {
 public:
  using Vector = Eigen::Matrix<double, kRows, 1>;

  /// Start the first phase from artificial columns only.
  /// @param right  right-hand side b.
  /// @param kept  1, or 0 in rows that are omitted: entries of columns there are ignored.
  void StartFeasibility(const Vector& right, const Vector& kept = Vector::Ones()) {
    SetUnitBasis(right, kept);
    TurnArtificial();
  }

  /// Start the first phase with one column instead of the artificial column of its row.
  /// The column's entry in this row is at least kPivot. Its weight, right[row] divided by that
  /// entry, must not be negative.
  void StartFeasibility(const Vector& right, const Column& column, int row) {
    SetUnitBasis(right, Vector::Ones());
    // Same as Replace and TurnArtificial for a unit inverse. For programs with few rows this saves
    // a tenth of their time.
    TableauColumn entries = TableauColumn::Zero();
    column.ForEachEntry([&](int r, double value) { entries[r] = value; });
    const double scale = 1 / entries[row];
    const double weight = right_[row] * scale;
    entries[row] = 0;
    tableau_.col(row) = entries * -scale;
    tableau_.col(kRows) -= entries * weight;
    tableau_(row, row) = scale;
    tableau_(row, kRows) = weight;
    for (int r = 0; r < kRows; ++r) {
      if (r == row) continue;
      const double sign = tableau_(r, kRows) < 0 ? -1 : 1;
      for (const int c : {r, row, kRows}) tableau_(r, c) *= sign;
      unit_entry_[r] = sign;
    }
    --artificial_count_;
    artificial_[row] = 0;
    unit_entry_[row] = 0;
    basis_[row] = column;
    ComputeDual();
  }

  /// Start the second phase from a basis.
  /// The weights must be at least 0, or made so by EnterAt.
  /// @param columns  columns of which a weighted sum is the right-hand side.
  void StartFromBasis(const std::array<Column, kRows>& columns, const Vector& right) {
    right_ = right;
    basis_ = columns;
    unit_entry_.setZero();
    artificial_.setZero();
    artificial_count_ = 0;
    free_row_ = kRows;
    optimising_ = true;
    Refactor();
  }

  /// Start the second phase from the end of the first.
  void StartOptimality() {
    optimising_ = true;
    ComputeDual();
  }

  /// Pivot on the columns of a pricing step until it gives none.
  /// @param price  bool(const Vector& dual, Column& column): sets the column; returns false for
  ///     none.
  template <class Price>
  End Run(const Price& price, const Limits& limits) {
    Column column;
    for (int pivot = 0; pivot < limits.pivots; ++pivot) {
      if (!price(dual(), column)) return End::kNoColumn;
      if (Enter(column) < 0) return End::kUnbounded;
      if (pivots_since_refactor_ >= limits.refactor_after) Refactor();
    }
    return End::kPivotLimit;
  }

  /// Pivot once; the weights determine the leaving column.
  /// @returns the column's row, or −1 if its weight is unbounded.
  int Enter(const Column& column) {
    const TableauColumn alpha = TimesInverse(column);
    const int leaving = ChooseLeaving(alpha);
    if (leaving >= 0) Replace(leaving, column, alpha);
    return leaving;
  }

  /// Pivot once in a given row, which is a step of the dual simplex method.
  /// Weights can become negative, and negative weights positive.
  /// @returns false, without any change, if the column's entry in the row is too small for a pivot.
  bool EnterAt(int row, const Column& column) {
    const TableauColumn alpha = TimesInverse(column);
    if (!(std::abs(alpha[row]) > kPivot)) return false;
    Replace(row, column, alpha);
    return true;
  }

  /// Pivot once with a free column: its weight can have any sign, so it never leaves. At most one
  /// column is free.
  int EnterFree(const Column& column) {
    const int row = Enter(column);
    if (row >= 0) free_row_ = row;
    return row;
  }

  /// Recompute the inverse, the weights and the dual solution.
  void Refactor() {
    Eigen::Matrix<double, kRows, kRows> matrix = Eigen::Matrix<double, kRows, kRows>::Zero();
    for (int c = 0; c < kRows; ++c) {
      matrix(c, c) = unit_entry_[c];
      if (unit_entry_[c] != 0) continue;
      basis_[c].ForEachEntry([&](int r, double value) {
        if (!IsLeftOut(r)) matrix(r, c) = value;
      });
    }
    const Eigen::Matrix<double, kRows, kRows> inverse = Invert(matrix);
    Vector weights = inverse.col(kRows - 1) * right_[kRows - 1];
    for (int c = 0; c < kRows - 1; ++c) weights += inverse.col(c) * right_[c];
    tableau_.setZero();
    tableau_.template topLeftCorner<kRows, kRows>() = inverse;
    tableau_.col(kRows).template head<kRows>() = weights;
    for (int r = 0; r < kRows; ++r) {
      if (IsLeftOut(r)) tableau_(r, r) = 0;
    }
    ComputeDual();
    pivots_since_refactor_ = 0;
  }

  /// Return y: the cost per unit of each row.
  [[nodiscard]] Vector dual() const { return bottom_.template head<kRows>(); }
  [[nodiscard]] double objective() const { return bottom_[kRows]; }

  /// Return λ of the basic columns, by row.
  [[nodiscard]] auto weights() const { return tableau_.col(kRows).template head<kRows>(); }
  /// Return B⁻¹.
  [[nodiscard]] auto inverse() const { return tableau_.template topLeftCorner<kRows, kRows>(); }
  [[nodiscard]] bool is_artificial(int row) const { return artificial_[row] != 0; }
  [[nodiscard]] int artificial_count() const { return artificial_count_; }
  /// Return the basic column of a row; null if it is artificial or the row is omitted.
  [[nodiscard]] const Column* column(int row) const {
    return unit_entry_[row] == 0 ? &basis_[row] : nullptr;
  }

  /// Return Σ |b − Σ λ w|, the sum of the artificial weights.
  [[nodiscard]] double unbalanced() const {
    double sum = 0;
    for (int r = 0; r < kRows; ++r) {
      sum += artificial_[r] * std::max(tableau_(r, kRows), 0.0);
    }
    return sum;
  }

 private:
  static constexpr int kColumns = kRows + 1;  // including the weights
  /// Including the objective. An even number keeps columns aligned; rows beyond the objective are
  /// zero.
  static constexpr int kHeight = (kRows + 2) / 2 * 2;
  using TableauColumn = Eigen::Matrix<double, kHeight, 1>;
  using TableauRow = Eigen::Matrix<double, 1, kColumns>;

  /// Replacement of entries that are too small for pivots, so that their ratios are never minimal.
  static constexpr double kNoDivisor = 1e-200;

  [[nodiscard]] bool IsLeftOut(int row) const {
    return unit_entry_[row] != 0 && !is_artificial(row);
  }

  /// Return B⁻¹ w, the decrease of the basic weights per unit of the column's weight. The
  /// objective's row is the reduced cost.
  [[nodiscard]] TableauColumn TimesInverse(const Column& column) const {
    TableauColumn alpha = TableauColumn::Zero();
    column.ForEachEntry([&](int row, double entry) { alpha += entry * tableau_.col(row); });
    if (optimising_) alpha[kRows] -= column.cost();
    return alpha;
  }

  [[nodiscard]] int ChooseLeaving(const TableauColumn& alpha) const {
    if (optimising_ && artificial_count_ > 0) {
      // Artificial columns leave first, whatever the sign of their change.
      for (int r = 0; r < kRows; ++r) {
        if (is_artificial(r) && std::abs(alpha[r]) > kPivot) return r;
      }
    }
    // All rows are computed without branches: mispredicted branches took longer than the rest of a
    // pivot.
    TableauColumn divisors;
    for (int r = 0; r < kHeight; ++r) divisors[r] = alpha[r] > kPivot ? alpha[r] : kNoDivisor;
    divisors[free_row_] = kNoDivisor;
    divisors[kRows] = kNoDivisor;
    const TableauColumn weights = tableau_.col(kRows).cwiseMax(0);
    const double bound = ((weights.array() + kRatioSlack) / divisors.array()).minCoeff();
    int leaving = -1;
    double largest = 0;
    for (int r = 0; r < kRows; ++r) {
      if (!(weights[r] <= bound * divisors[r]) || divisors[r] == kNoDivisor) continue;
      const double preference = (1 + artificial_[r]) * alpha[r];
      if (preference > largest) {
        largest = preference;
        leaving = r;
      }
    }
    return leaving;
  }

  void Replace(int leaving, const Column& column, TableauColumn alpha) {
    const TableauRow row = tableau_.row(leaving) * (1 / alpha[leaving]);
    bottom_ -= alpha[kRows] * row;
    alpha[leaving] = 0;
    tableau_.noalias() -= alpha * row;
    tableau_.row(leaving) = row;
    artificial_count_ -= is_artificial(leaving) ? 1 : 0;
    artificial_[leaving] = 0;
    unit_entry_[leaving] = 0;
    basis_[leaving] = column;
    ++pivots_since_refactor_;
  }

  void SetUnitBasis(const Vector& right, const Vector& kept) {
    optimising_ = false;
    pivots_since_refactor_ = 0;
    right_ = right.cwiseProduct(kept);
    unit_entry_.setOnes();
    artificial_ = kept;
    artificial_count_ = static_cast<int>(kept.sum());
    free_row_ = kRows;
    tableau_.setZero();
    bottom_.setZero();
    tableau_.diagonal().template head<kRows>() = kept;
    tableau_.col(kRows).template head<kRows>() = right_;
  }

  /// Give artificial columns the signs of their weights.
  void TurnArtificial() {
    for (int r = 0; r < kRows; ++r) {
      if (!is_artificial(r)) continue;
      if (tableau_(r, kRows) < 0) tableau_.row(r) *= -1;
      unit_entry_[r] = tableau_(r, r);
    }
    ComputeDual();
  }

  void ComputeDual() {
    Vector costs;
    for (int r = 0; r < kRows; ++r) {
      const bool unit = unit_entry_[r] != 0;
      costs[r] = !optimising_ ? artificial_[r] : unit ? 0 : basis_[r].cost();
    }
    for (int c = 0; c < kColumns; ++c) {
      double sum = 0;
      for (int r = 0; r < kRows; ++r) sum += costs[r] * tableau_(r, c);
      bottom_[c] = tableau_(kRows, c) = sum;
    }
  }

  Vector right_;
  std::array<Column, kRows> basis_;
  /// ±1 if the basic column is an artificial or omitted unit vector of the row, otherwise 0.
  Vector unit_entry_;
  Vector artificial_;  ///< 1 if the basic column is artificial
  TableauRow bottom_;  ///< copy of the tableau's row kRows, which the pricing step reads often
  int artificial_count_ = 0;
  int free_row_ = kRows;  ///< row of the free column; kRows if there is none
  bool optimising_ = false;
  int pivots_since_refactor_ = 0;
  // Row r: row of the inverse basis, and weight of basis_[r]. Row kRows: dual solution, and value
  // of the objective.
  Eigen::Matrix<double, kHeight, kColumns> tableau_;
};

/// Return a weight in [1, 1.5), different for each i.
/// Multiples of the golden ratio modulo 1 never repeat. In symmetric programs many basic weights
/// would be zero at the same time. A right-hand side that is a sum with uneven weights avoids these
/// degenerate pivots (the perturbation of Charnes 1952, with fixed numbers).
[[nodiscard]] inline double UnevenWeight(int i) {
  const double turns = i * 0.6180339887498949;
  return 1 + 0.5 * (turns - std::floor(turns));
}

}  // namespace regrasp::lp
