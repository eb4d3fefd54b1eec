#include "planner/motion/exact_balance.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace regrasp::motion::exact {

namespace {

using Integer = mpz_class;

/// Return the least common denominator.
Integer CommonDenominator(std::span<const Rational> numbers) {
  Integer common = 1;
  for (const Rational& number : numbers) common = lcm(common, number.get_den());
  return common;
}

/// Return number · multiple, which is an integer.
Integer Multiple(const Rational& number, const Integer& multiple) {
  return number.get_num() * (multiple / number.get_den());
}

/// Return x · 2^exponent.
Rational Shifted(const Rational& x, long exponent) {
  Rational shifted;
  if (exponent >= 0) {
    mpq_mul_2exp(shifted.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(shifted.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return shifted;
}

/// Linear equations of integers.
class Elimination {
 public:
  Elimination(int rows, int columns) : rows_(rows), columns_(columns), m_(rows * (columns + 1)) {}

  Integer& At(int row, int column) { return m_[row * (columns_ + 1) + column]; }
  Integer& Right(int row) { return At(row, columns_); }

  /// Solution numerators / denominator; the denominator is positive.
  struct Solution {
    std::vector<Integer> numerators;
    Integer denominator = 1;
  };

  /// Return a solution with one unknown per nonzero pivot on the diagonal; the others are 0.
  /// @returns nullopt if it leaves a row unsolved.
  std::optional<Solution> Solve() {
    int rank = 0;
    Integer before = 1;
    for (; rank < std::min(rows_, columns_) && At(rank, rank) != 0; ++rank) {
      for (int r = rank + 1; r < rows_; ++r) EliminateRow(r, rank, before);
      before = At(rank, rank);
    }
    for (int r = rank; r < rows_; ++r) {
      if (Right(r) != 0) return std::nullopt;
    }
    Solution solution{std::vector<Integer>(rank), before};
    for (int r = rank - 1; r >= 0; --r) {
      Integer sum = before * Right(r);
      for (int c = r + 1; c < rank; ++c) sum -= At(r, c) * solution.numerators[c];
      solution.numerators[r] = sum / At(r, r);
    }
    if (before < 0) {
      solution.denominator = -before;
      for (Integer& numerator : solution.numerators) numerator = -numerator;
    }
    return solution;
  }

 private:
  /// All entries stay minors of the equations, so the division is exact.
  void EliminateRow(int row, int pivot, const Integer& before) {
    const Integer factor = At(row, pivot);
    for (int c = pivot + 1; c <= columns_; ++c) {
      Integer& entry = At(row, c);
      if (entry != 0) entry *= At(pivot, pivot);
      if (factor != 0 && At(pivot, c) != 0) entry -= factor * At(pivot, c);
      if (entry != 0) mpz_divexact(entry.get_mpz_t(), entry.get_mpz_t(), before.get_mpz_t());
    }
    At(row, pivot) = 0;
  }

  int rows_;
  int columns_;
  std::vector<Integer> m_;  ///< rows, each with its right-hand side at its end
};

/// Order of the rows and columns of A by the pivots of floating-point elimination, the largest
/// first.
struct Order {
  std::vector<int> rows;
  std::vector<int> columns;
};

Order PivotsOf(std::span<const Rational> a, int rows, int columns) {
  Eigen::MatrixXd rounded(rows, columns);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) rounded(r, c) = a[r * columns + c].get_d();
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(rounded);
  const auto of_row = (lu.permutationP() * Eigen::VectorXi::LinSpaced(rows, 0, rows - 1)).eval();
  const auto of_column = lu.permutationQ().indices();
  return {{of_row.begin(), of_row.end()},
          {of_column.begin(), of_column.begin() + std::min(rows, columns)}};
}

}  // namespace

Vector Exact(const Eigen::Vector3d& v) {
  return {Rational(v.x()), Rational(v.y()), Rational(v.z())};
}

bool IsZero(const Vector& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

Rational RootAbove(const Rational& x) {
  if (x == 0) return 0;
  // Scaled to about 1, at which doubles neither overflow nor underflow; roots halve an even
  // exponent.
  long exponent = static_cast<long>(mpz_sizeinbase(x.get_num_mpz_t(), 2)) -
                  static_cast<long>(mpz_sizeinbase(x.get_den_mpz_t(), 2));
  exponent -= exponent % 2;
  return Shifted(Rational(std::sqrt(Shifted(x, -exponent).get_d()) * kRootAbove), exponent / 2);
}

std::vector<ExactContact> Exact(std::span<const grasp::Contact> contacts) {
  std::vector<ExactContact> exact;
  for (const grasp::Contact& contact : contacts)
    exact.push_back({Exact(contact.p), Exact(contact.n), Rational(contact.torsion)});
  return exact;
}

bool AllFinite(std::span<const Eigen::Vector3d> vectors) {
  for (const Eigen::Vector3d& vector : vectors) {
    if (!vector.allFinite()) return false;
  }
  return true;
}

std::optional<std::vector<Rational>> Balance::Corrected(const std::vector<Rational>& x) const {
  const Order order = PivotsOf(a_, rows_, columns_);
  const Integer scale = CommonDenominator(x);
  Elimination elimination(static_cast<int>(order.rows.size()),
                          static_cast<int>(order.columns.size()));
  for (std::size_t r = 0; r < order.rows.size(); ++r) {
    const std::span row(a_.data() + order.rows[r] * columns_, static_cast<std::size_t>(columns_));
    const Integer per_row = CommonDenominator(row);
    Integer& right = elimination.Right(static_cast<int>(r));
    for (int c = 0; c < columns_; ++c) {
      if (row[c] != 0) right -= Multiple(row[c], per_row) * Multiple(x[c], scale);
    }
    for (std::size_t c = 0; c < order.columns.size(); ++c) {
      elimination.At(static_cast<int>(r), static_cast<int>(c)) =
          Multiple(row[order.columns[c]], per_row);
    }
  }
  const auto change = elimination.Solve();
  if (!change) return std::nullopt;
  std::vector<Rational> corrected;
  for (const Rational& number : x) {
    corrected.emplace_back(Multiple(number, scale) * change->denominator);
  }
  for (std::size_t c = 0; c < change->numerators.size(); ++c) {
    corrected[order.columns[c]] += change->numerators[c];
  }
  return corrected;
}

void Layout::AddTorques(const Vector& p, int row, int column, Balance& balance) const {
  const auto add = [&](int torque, int axis, const Rational& arm) {
    balance.At(row + torque, column + axis) += arm;
  };
  const int about_z = torques == 3 ? 2 : 0;
  add(about_z, 0, -p[1]);
  add(about_z, 1, p[0]);
  if (dimension == 2) return;
  add(0, 1, -p[2]);
  add(0, 2, p[1]);
  add(1, 0, p[2]);
  add(1, 2, -p[0]);
}

void Layout::AddForces(int row, int column, Balance& balance) const {
  for (int axis = 0; axis < dimension; ++axis) balance.At(row + axis, column + axis) = 1;
}

Vector Layout::Force(const std::vector<Rational>& x, int column) const {
  Vector force;
  for (int axis = 0; axis < dimension; ++axis) force[axis] = x[column + axis];
  return force;
}

void Layout::Append(std::span<const Eigen::Vector3d> forces, std::vector<Rational>& x) const {
  for (const Eigen::Vector3d& force : forces) {
    for (int axis = 0; axis < dimension; ++axis) x.emplace_back(force[axis]);
  }
}

}  // namespace regrasp::motion::exact
