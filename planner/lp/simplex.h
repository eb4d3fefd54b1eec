#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/lp/invert.h"

namespace regrasp::lp {

/// Entries of B⁻¹ w below this (most are of the order of 1) are no pivots: the inverse would lose
/// more than half of its digits.
inline constexpr double kPivot = 1e-9;

/// Basic weights are allowed to be this much below zero in the ratio test, so that a larger pivot
/// can be taken among nearly equal ratios.
inline constexpr double kRatioSlack = 1e-13;

/// How far Simplex::Run may go.
struct Limits {
  int pivots;  ///< what takes more is stalling
  /// After so many pivots the inverse is computed afresh.
  int refactor_after = std::numeric_limits<int>::max();
};

/// Why Simplex::Run ended.
enum class End {
  kNoColumn,    ///< the pricing step gave none
  kUnbounded,   ///< the column it gave can grow without end
  kPivotLimit,  ///< more pivots than allowed
};

/// The revised simplex method with an explicit inverse of the basis, for programs of few rows and
/// any number of columns, also infinitely many:
///
///     minimise Σ cost_j λ_j   over λ ≥ 0   with   Σ λ_j w_j = b,   w_j and b of kRows numbers.
///
/// Columns are generated: the user's pricing step is given the dual solution y, and names a column
/// with a positive reduced cost y · w − cost, best the largest of all (Dantzig's rule), or none.
/// Of a circular friction cone that column is closed form, so cones need no edges. For every
/// solution with Σ λ ≤ s and every bound c on the reduced costs, Σ cost λ ≥ y · b − c s.
///
/// A program starts either from a basis that is known to be feasible, or in a first phase from
/// artificial columns ±e_r, whose weights are what is minimised there. In the second phase they
/// weigh nothing, and leave before any other.
///
/// The column that leaves is the one with the largest entry among nearly least ratios (Harris).
/// That keeps the inverse's digits; it does not exclude cycles in degenerate programs, as Bland's
/// rule would at the price of more pivots (Avis and Chvátal 1978). Limits::pivots ends them, and
/// UnevenWeight helps to avoid degenerate programs in the first place.
///
/// Sources: Dantzig 1963; Dantzig and Wolfe 1960 (column generation); Harris 1973 (ratio test);
/// Bland 1977 (cycles).
///
/// Laws: after every pivot Σ λ w = b and λ ≥ 0 up to rounding and kRatioSlack, and the objective
/// has not risen.
///
/// @tparam Column  a value that has
///                 `template <class Visit> void ForEachEntry(const Visit& visit) const`, which
///                 calls visit(row, value) for its entries that are not 0, and `double cost()
///                 const`, its cost in the second phase.
template <int kRows, class Column>
class Simplex {
 public:
  using Vector = Eigen::Matrix<double, kRows, 1>;

  /// The first phase, from artificial columns alone.
  /// @param kept  1, or 0 in rows that are left out: what columns have there counts for nothing.
  void StartFeasibility(const Vector& right, const Vector& kept = Vector::Ones()) {
    SetUnitBasis(right, kept);
    TurnArtificial();
  }

  /// The first phase, with one column in place of the artificial one of its row, where its entry is
  /// no less than kPivot. Its weight is right[row] over that entry, which must not be negative.
  void StartFeasibility(const Vector& right, const Column& column, int row) {
    SetUnitBasis(right, Vector::Ones());
    // What Replace and TurnArtificial do, where the inverse is the unit matrix: for programs of few
    // rows that is a tenth of their time.
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

  /// The second phase, from columns of which a weighted sum is the right-hand side; its weights are
  /// to be ≥ 0, or made so by EnterAt.
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

  /// The second phase, from where the first one ended.
  void StartOptimality() {
    optimising_ = true;
    ComputeDual();
  }

  /// Pivots on what `price` gives until it gives nothing.
  /// @param price  bool(const Vector& dual, Column& column): sets the column; false gives nothing.
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

  /// One pivot, the leaving column chosen by the weights. @returns the row that the column is in
  /// now, or −1 where nothing holds it.
  int Enter(const Column& column) {
    const TableauColumn alpha = TimesInverse(column);
    const int leaving = ChooseLeaving(alpha);
    if (leaving >= 0) Replace(leaving, column, alpha);
    return leaving;
  }

  /// One pivot in which the column of a given row leaves. Weights may become negative, and those
  /// that are may become positive: a step of the dual simplex method.
  /// @returns false, and leaves all as it was, where the column's entry there is no pivot.
  bool EnterAt(int row, const Column& column) {
    const TableauColumn alpha = TimesInverse(column);
    if (!(std::abs(alpha[row]) > kPivot)) return false;
    Replace(row, column, alpha);
    return true;
  }

  /// The same for a column whose weight may have any sign, so that it never leaves. Only one is.
  int EnterFree(const Column& column) {
    const int row = Enter(column);
    if (row >= 0) free_row_ = row;
    return row;
  }

  /// Computes the inverse, the weights and the dual solution afresh.
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

  /// y: what a unit of each row costs.
  [[nodiscard]] Vector dual() const { return bottom_.template head<kRows>(); }
  [[nodiscard]] double objective() const { return bottom_[kRows]; }

  /// λ of the basic columns, by rows.
  [[nodiscard]] auto weights() const { return tableau_.col(kRows).template head<kRows>(); }
  /// B⁻¹.
  [[nodiscard]] auto inverse() const { return tableau_.template topLeftCorner<kRows, kRows>(); }
  [[nodiscard]] bool is_artificial(int row) const { return artificial_[row] != 0; }
  [[nodiscard]] int artificial_count() const { return artificial_count_; }
  /// The basic column of a row; null where it is artificial, or the row is left out.
  [[nodiscard]] const Column* column(int row) const {
    return unit_entry_[row] == 0 ? &basis_[row] : nullptr;
  }

  /// Σ |b − Σ λ w|, what artificial columns carry.
  [[nodiscard]] double unbalanced() const {
    double sum = 0;
    for (int r = 0; r < kRows; ++r) {
      sum += artificial_[r] * std::max(tableau_(r, kRows), 0.0);
    }
    return sum;
  }

 private:
  static constexpr int kColumns = kRows + 1;  // and the weights
  /// And the objective; an even number, so that columns are aligned. What is beyond it is zero.
  static constexpr int kHeight = (kRows + 2) / 2 * 2;
  using TableauColumn = Eigen::Matrix<double, kHeight, 1>;
  using TableauRow = Eigen::Matrix<double, 1, kColumns>;

  /// In place of entries that are no pivots: no ratio over it is the least.
  static constexpr double kNoDivisor = 1e-200;

  [[nodiscard]] bool IsLeftOut(int row) const {
    return unit_entry_[row] != 0 && !is_artificial(row);
  }

  /// B⁻¹ w, by which the basic weights fall with the column's, and in the objective's row the
  /// reduced cost.
  [[nodiscard]] TableauColumn TimesInverse(const Column& column) const {
    TableauColumn alpha = TableauColumn::Zero();
    column.ForEachEntry([&](int row, double entry) { alpha += entry * tableau_.col(row); });
    if (optimising_) alpha[kRows] -= column.cost();
    return alpha;
  }

  [[nodiscard]] int ChooseLeaving(const TableauColumn& alpha) const {
    if (optimising_ && artificial_count_ > 0) {
      // Whichever way the entering column would move them.
      for (int r = 0; r < kRows; ++r) {
        if (is_artificial(r) && std::abs(alpha[r]) > kPivot) return r;
      }
    }
    // All rows at once: which entries can be pivots nobody predicts, and branches that are
    // mispredicted took longer than the rest of a pivot.
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

  /// Gives artificial columns the signs of what they carry.
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
  /// ±1 where the basic column is not the user's but that times the row's unit vector, otherwise 0.
  Vector unit_entry_;
  Vector artificial_;  ///< 1 where that is an artificial column
  TableauRow bottom_;  ///< the tableau's row kRows once more: the pricing step reads it at once
  int artificial_count_ = 0;
  int free_row_ = kRows;  ///< of the column that may have any sign; kRows where none has
  bool optimising_ = false;
  int pivots_since_refactor_ = 0;
  // Row r: the inverse basis's row and the weight of basis_[r]; row kRows: the dual and the
  // objective's value.
  Eigen::Matrix<double, kHeight, kColumns> tableau_;
};

}  // namespace regrasp::lp
