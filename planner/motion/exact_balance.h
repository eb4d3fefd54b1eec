#pragma once

#include <gmpxx.h>

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/motion/vectors_of.h"

/// Vectors, cones and the balance of forces in rational arithmetic without rounding.
namespace regrasp::motion::exact {

using Rational = mpq_class;
using Vector = VectorOf<Rational>;

inline constexpr double kRootAbove = 1 + 5e-7;

/// Return the exact values of doubles, which must be finite.
[[nodiscard]] Vector Exact(const Eigen::Vector3d& v);

[[nodiscard]] bool IsZero(const Vector& a);

/// Return an upper bound on √x, larger by at most a millionth of it.
/// It is the root of a double times kRootAbove.
/// @param x  number ≥ 0.
[[nodiscard]] Rational RootAbove(const Rational& x);

template <>
struct NumberTraits<Rational> {
  static Rational RootAbove(const Rational& x) { return exact::RootAbove(x); }
  static Rational Min(const Rational& a, const Rational& b) { return a < b ? a : b; }
  static Rational Max(const Rational& a, const Rational& b) { return a < b ? b : a; }
  static double Rounded(const Rational& x) { return x.get_d(); }
};

struct ExactContact {
  Vector p;
  Vector n;
  Rational torsion = 0;
};
[[nodiscard]] std::vector<ExactContact> Exact(std::span<const grasp::Contact> contacts);

[[nodiscard]] bool AllFinite(std::span<const Eigen::Vector3d> vectors);

/// Homogeneous linear equations A x = 0 with a solution that is exact up to rounding.
class Balance {
 public:
  Balance(int rows, int columns) : rows_(rows), columns_(columns), a_(rows * columns) {}

  [[nodiscard]] Rational& At(int row, int column) { return a_[row * columns_ + column]; }

  /// Return a positive integer multiple of x, corrected so that A x = 0 is exact.
  /// Only the unknowns of columns that elimination in floating point picks as pivots are changed.
  /// Their values are found by fraction-free integer elimination (Bareiss 1968), which needs no
  /// greatest common divisors.
  /// @returns the solution; nullopt if these columns cannot balance the remainder.
  [[nodiscard]] std::optional<std::vector<Rational>> Corrected(
      const std::vector<Rational>& x) const;

 private:
  int rows_;
  int columns_;
  std::vector<Rational> a_;
};

/// Rows and columns of forces in space or in the plane.
struct Layout {
  explicit Layout(int space) : dimension(space), torques(space == 3 ? 3 : 1) {}

  int dimension;
  int torques;

  /// Add the torques of unit forces at p as columns from `column` and rows from `row`.
  void AddTorques(const Vector& p, int row, int column, Balance& balance) const;
  void AddForces(int row, int column, Balance& balance) const;
  [[nodiscard]] Vector Force(const std::vector<Rational>& x, int column) const;
  void Append(std::span<const Eigen::Vector3d> forces, std::vector<Rational>& x) const;
};

}  // namespace regrasp::motion::exact
