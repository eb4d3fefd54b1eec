#include "planner/motion/exact_balance.h"

#include <cmath>

namespace regrasp::exact {

Vector Exact(const Eigen::Vector3d& v) {
  return {Rational(v.x()), Rational(v.y()), Rational(v.z())};
}

Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator*(const Rational& s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Rational Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector Cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool IsZero(const Vector& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

std::vector<ExactContact> Exact(std::span<const Contact> contacts) {
  std::vector<ExactContact> exact;
  for (const Contact& contact : contacts) exact.push_back({Exact(contact.p), Exact(contact.n)});
  return exact;
}

bool AllFinite(std::span<const Eigen::Vector3d> vectors) {
  for (const Eigen::Vector3d& vector : vectors) {
    if (!vector.allFinite()) return false;
  }
  return true;
}

bool IsInsideCone(const Vector& force, const Vector& n, const Rational& mu) {
  const Rational normal = Dot(force, n);
  return normal > 0 && normal * normal * (1 + mu * mu) > Dot(force, force) * Dot(n, n);
}

std::vector<Rational> Balance::Corrected(std::vector<Rational> x) const {
  std::vector<Rational> a = a_;
  std::vector<Rational> right(rows_);
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < columns_; ++c) right[r] -= a[r * columns_ + c] * x[c];
  }
  std::vector<int> column_of_row;
  for (int step = 0; step < rows_; ++step) {
    const auto pivot = Pivot(a, step);
    if (!pivot) break;  // the rows that are left are zero, and so is what they must give
    const auto [row, column] = *pivot;
    for (int c = 0; c < columns_; ++c) {
      std::swap(a[row * columns_ + c], a[step * columns_ + c]);
    }
    std::swap(right[row], right[step]);
    Eliminate(a, right, step, column);
    column_of_row.push_back(column);
  }
  for (std::size_t r = 0; r < column_of_row.size(); ++r) x[column_of_row[r]] += right[r];
  return x;
}

/// The largest entry from row `step` on.
std::optional<Balance::Place> Balance::Pivot(const std::vector<Rational>& a, int step) const {
  std::optional<Place> best;
  double largest = 0;
  for (int r = step; r < rows_; ++r) {
    for (int c = 0; c < columns_; ++c) {
      const Rational& entry = a[r * columns_ + c];
      if (entry == 0) continue;
      const double size = std::abs(entry.get_d());
      if (best && size <= largest) continue;
      largest = size;
      best = Place{r, c};
    }
  }
  return best;
}

/// Makes the pivot 1 and the rest of its column 0.
void Balance::Eliminate(std::vector<Rational>& a, std::vector<Rational>& right, int step,
                        int column) const {
  const Rational inverse = 1 / a[step * columns_ + column];
  for (int c = 0; c < columns_; ++c) a[step * columns_ + c] *= inverse;
  right[step] *= inverse;
  for (int r = 0; r < rows_; ++r) {
    const Rational factor = a[r * columns_ + column];
    if (r == step || factor == 0) continue;
    for (int c = 0; c < columns_; ++c) {
      if (a[step * columns_ + c] != 0) a[r * columns_ + c] -= factor * a[step * columns_ + c];
    }
    right[r] -= factor * right[step];
  }
}

void Layout::AddTorques(const Vector& p, int row, int column, Balance& balance) const {
  for (int axis = 0; axis < dimension; ++axis) {
    Vector unit;
    unit[axis] = 1;
    const Vector torque = Cross(p, unit);
    for (int k = 0; k < torques; ++k) {
      balance.At(row + k, column + axis) += torque[torques == 3 ? k : 2];
    }
  }
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

}  // namespace regrasp::exact
