#pragma once

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"

/// Vectors, cones and the balance of forces in rational arithmetic, without rounding.
namespace regrasp::motion::exact {

using Rational = mpq_class;
using Vector = std::array<Rational, 3>;

/// The values of doubles, which must be finite.
[[nodiscard]] Vector Exact(const Eigen::Vector3d& v);

[[nodiscard]] Vector operator+(const Vector& a, const Vector& b);
[[nodiscard]] Vector operator-(const Vector& a, const Vector& b);
[[nodiscard]] Vector operator*(const Rational& s, const Vector& a);
[[nodiscard]] Rational Dot(const Vector& a, const Vector& b);
[[nodiscard]] Vector Cross(const Vector& a, const Vector& b);
[[nodiscard]] bool IsZero(const Vector& a);
[[nodiscard]] Rational SquaredNorm(const Vector& a);

/// √x from above, larger by a millionth of it at most. @param x  not negative.
[[nodiscard]] Rational RootAbove(const Rational& x);

struct ExactContact {
  Vector p;
  Vector n;
  Rational torsion = 0;
};
[[nodiscard]] std::vector<ExactContact> Exact(std::span<const grasp::Contact> contacts);

[[nodiscard]] bool AllFinite(std::span<const Eigen::Vector3d> vectors);

/// A force, and all that differ from it by no more than `margin`, are strictly inside the cone of
/// friction μ about n, which need not be unit. Where `margin` is 0 the answer is exact; otherwise
/// it may be no where less than a millionth of `margin` is missing.
/// @param twist_squared  of a soft finger (torque / torsion)², which takes of the friction as the
///     square of a tangential force does; `margin` is then of both together.
[[nodiscard]] bool IsInsideCone(const Vector& force, const Vector& n, const Rational& mu,
                                const Rational& margin = 0, const Rational& twist_squared = 0);

/// Homogeneous linear equations A x = 0 with a solution that is exact up to rounding.
class Balance {
 public:
  Balance(int rows, int columns) : rows_(rows), columns_(columns), a_(rows * columns) {}

  [[nodiscard]] Rational& At(int row, int column) { return a_[row * columns_ + column]; }

  /// A positive multiple of x, of integers, with some numbers changed so that A x = 0 holds
  /// exactly: those of columns that elimination in floating point picks as pivots. What they take
  /// up is found by elimination of integers without fractions (Bareiss 1968), which needs no
  /// greatest common divisors.
  /// @returns nullopt where the columns picked cannot take up what is left.
  [[nodiscard]] std::optional<std::vector<Rational>> Corrected(
      const std::vector<Rational>& x) const;

 private:
  int rows_;
  int columns_;
  std::vector<Rational> a_;
};

/// The rows and columns that forces have in space or in the plane.
struct Layout {
  explicit Layout(int space) : dimension(space), torques(space == 3 ? 3 : 1) {}

  int dimension;
  int torques;

  /// Adds the torques of unit forces at p, as columns from `column` on and rows from `row` on.
  void AddTorques(const Vector& p, int row, int column, Balance& balance) const;
  void AddForces(int row, int column, Balance& balance) const;
  [[nodiscard]] Vector Force(const std::vector<Rational>& x, int column) const;
  void Append(std::span<const Eigen::Vector3d> forces, std::vector<Rational>& x) const;
};

}  // namespace regrasp::motion::exact
