#pragma once

#include <array>

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
