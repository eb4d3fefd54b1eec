#pragma once

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"

/// Vectors and cones over a number type without rounding errors: exact numbers, or intervals that
/// contain the exact ones.
namespace regrasp::motion::exact {

template <class Number>
using VectorOf = std::array<Number, 3>;

/// Operations that differ between number types:
/// - `Number RootAbove(const Number& x)`: upper bound on √x, larger by at most a millionth of it, x
///   not negative;
/// - `Number Min(const Number&, const Number&)` and `Max`
/// - `double Rounded(const Number&)`
template <class Number>
struct NumberTraits;

template <class Number>
Number Lesser(const Number& a, const Number& b) {
  return NumberTraits<Number>::Min(a, b);
}
template <class Number>
Number Greater(const Number& a, const Number& b) {
  return NumberTraits<Number>::Max(a, b);
}
template <class Number>
Number Root(const Number& x) {
  return NumberTraits<Number>::RootAbove(x);
}

template <class Number>
VectorOf<Number> operator+(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Number>
VectorOf<Number> operator-(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
VectorOf<Number> operator*(const Number& s, const VectorOf<Number>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class Number>
Number Dot(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
VectorOf<Number> Cross(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
Number SquaredNorm(const VectorOf<Number>& a) {
  return Dot(a, a);
}

/// Return whether all forces within `margin` of a force are strictly inside a cone.
/// The cone has friction μ about n, which need not be a unit vector. If `margin` is 0 the result is
/// exact. Otherwise it may be false although the force is inside, if less than a millionth of
/// `margin` is missing.
/// @param twist_squared  (torque / torsion)² of a soft finger. It uses friction in the same manner
///     as the square of a tangential force; `margin` then applies to both together.
template <class Number>
bool IsInsideCone(const VectorOf<Number>& force, const VectorOf<Number>& n, const Number& mu,
                  const Number& margin, const Number& twist_squared) {
  const Number normal = Dot(force, n);
  const Number length_squared = Dot(n, n);
  // For unit n the distance from the border is (μ f·n − |f × n|) / √(1 + μ²).
  const Number root = Root<Number>((1 + mu * mu) * length_squared);
  const Number reach = mu * normal - margin * root;
  if (!(reach > 0)) return false;
  return reach * reach > (Dot(force, force) + twist_squared) * length_squared - normal * normal;
}

}  // namespace regrasp::motion::exact

/// Vectors, cones and the balance of forces in rational arithmetic without rounding.
namespace regrasp::motion::exact {

using Rational = mpq_class;
using Vector = VectorOf<Rational>;

inline constexpr double kRootAbove = 1 + 5e-7;

/// Convert finite doubles to rationals without rounding.
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
