#include "planner/certificate/check_proof.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace regrasp {

namespace {

using Rational = mpq_class;
using Vector = std::array<Rational, 3>;
using Kind = ProofVerdict::Kind;

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

struct ExactContact {
  Vector p;
  Vector n;
};

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

/// Strictly inside the cone of friction μ about n.
bool IsInsideCone(const Vector& force, const Vector& n, const Rational& mu) {
  const Rational normal = Dot(force, n);
  return normal > 0 && normal * normal * (1 + mu * mu) > Dot(force, force) * Dot(n, n);
}

/// Homogeneous linear equations A x = 0 with a solution that is exact up to rounding.
class Balance {
 public:
  Balance(int rows, int columns) : rows_(rows), columns_(columns), a_(rows * columns) {}

  Rational& At(int row, int column) { return a_[row * columns_ + column]; }

  /// x with some of its numbers changed so that A x = 0 holds exactly.
  [[nodiscard]] std::vector<Rational> Corrected(std::vector<Rational> x) const {
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

 private:
  struct Place {
    int row;
    int column;
  };

  /// The largest entry from row `step` on.
  [[nodiscard]] std::optional<Place> Pivot(const std::vector<Rational>& a, int step) const {
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
  void Eliminate(std::vector<Rational>& a, std::vector<Rational>& right, int step,
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
  void AddTorques(const Vector& p, int row, int column, Balance& balance) const {
    for (int axis = 0; axis < dimension; ++axis) {
      Vector unit;
      unit[axis] = 1;
      const Vector torque = Cross(p, unit);
      for (int k = 0; k < torques; ++k) {
        balance.At(row + k, column + axis) += torque[torques == 3 ? k : 2];
      }
    }
  }
  void AddForces(int row, int column, Balance& balance) const {
    for (int axis = 0; axis < dimension; ++axis) balance.At(row + axis, column + axis) = 1;
  }
  [[nodiscard]] Vector Force(const std::vector<Rational>& x, int column) const {
    Vector force;
    for (int axis = 0; axis < dimension; ++axis) force[axis] = x[column + axis];
    return force;
  }
  void Append(std::span<const Eigen::Vector3d> forces, std::vector<Rational>& x) const {
    for (const Eigen::Vector3d& force : forces) {
      for (int axis = 0; axis < dimension; ++axis) x.emplace_back(force[axis]);
    }
  }
};

/// Whether contacts span: three not on one line, in the plane two not at one point.
bool Span(const std::vector<ExactContact>& contacts, int dimension) {
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    const Vector first = contacts[i].p - contacts[0].p;
    if (IsZero(first)) continue;
    if (dimension == 2) return true;
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      if (!IsZero(Cross(first, contacts[j].p - contacts[0].p))) return true;
    }
  }
  return false;
}

ProofVerdict Nothing(std::string why) { return {Kind::kNothing, std::move(why)}; }

ProofVerdict CheckForces(const std::vector<ExactContact>& contacts, int dimension,
                         const Rational& mu, const GraspProof& proof) {
  if (proof.forces.size() != contacts.size()) return Nothing("not one force a contact");
  if (!AllFinite(proof.forces)) return Nothing("a force is not finite");
  if (!Span(contacts, dimension)) return Nothing("the contacts are on one line");
  const Layout layout(dimension);
  const int count = static_cast<int>(contacts.size());
  Balance balance(dimension + layout.torques, dimension * count);
  std::vector<Rational> x;
  layout.Append(proof.forces, x);
  for (int i = 0; i < count; ++i) {
    layout.AddForces(0, i * dimension, balance);
    layout.AddTorques(contacts[i].p, dimension, i * dimension, balance);
  }
  x = balance.Corrected(std::move(x));
  for (int i = 0; i < count; ++i) {
    if (!IsInsideCone(layout.Force(x, i * dimension), contacts[i].n, mu)) {
      return Nothing("the force at contact " + std::to_string(i) +
                     ", balanced exactly, is not inside its cone");
    }
  }
  return {Kind::kForceClosure, ""};
}

/// Whether velocities refute: all are in the polar cones.
ProofVerdict CheckVelocities(const std::vector<ExactContact>& contacts,
                             const std::vector<Vector>& velocities, const Rational& mu) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector& u = velocities[i];
    if (IsZero(u)) continue;
    const Vector& n = contacts[i].n;
    const Rational approach = Dot(n, u);
    if (approach >= 0 || approach * approach * (1 + mu * mu) < mu * mu * Dot(u, u) * Dot(n, n)) {
      return Nothing("some force in the cone of contact " + std::to_string(i) +
                     " works with the twist");
    }
  }
  return {Kind::kNotForceClosure, ""};
}

ProofVerdict CheckTwist(const std::vector<ExactContact>& contacts, const Rational& mu,
                        const Vector& v, const Vector& omega) {
  if (IsZero(v) && IsZero(omega)) return Nothing("the twist is zero");
  std::vector<Vector> velocities;
  for (const ExactContact& contact : contacts) velocities.push_back(v + Cross(omega, contact.p));
  return CheckVelocities(contacts, velocities, mu);
}

/// The turn about the line through two contacts, one way or the other.
ProofVerdict CheckLine(const std::vector<ExactContact>& contacts, const Rational& mu,
                       const std::array<int, 2>& line) {
  const int count = static_cast<int>(contacts.size());
  if (line[0] < 0 || line[1] < 0 || line[0] >= count || line[1] >= count) {
    return Nothing("the line is through contacts that are none");
  }
  const Vector& a = contacts[line[0]].p;
  for (const int way : {1, -1}) {
    const Vector omega = Rational(way) * (contacts[line[1]].p - a);
    const ProofVerdict verdict = CheckTwist(contacts, mu, Cross(a, omega), omega);
    if (verdict.kind == Kind::kNotForceClosure) return verdict;
  }
  return Nothing("about the line of contacts " + std::to_string(line[0]) + " and " +
                 std::to_string(line[1]) + " the others turn the object both ways");
}

/// Contacts at both ends of a piece.
struct MovingContacts {
  std::vector<ExactContact> start;
  std::vector<ExactContact> end;
};

/// The cross product of two directions that go linearly stays on one side: its three Bernstein
/// coefficients do.
bool StaysTurned(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) {
  const std::array coefficients = {Cross(a0, b0), Cross(a0, b1) + Cross(a1, b0), Cross(a1, b1)};
  const Vector side = coefficients[0] + coefficients[1] + coefficients[2];
  return std::all_of(coefficients.begin(), coefficients.end(),
                     [&](const Vector& c) { return Dot(c, side) > 0; });
}

/// Contacts that span all along the piece.
bool SpanAllAlong(const MovingContacts& moving, int dimension) {
  const std::size_t count = moving.start.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vector a0 = moving.start[j].p - moving.start[i].p;
      const Vector a1 = moving.end[j].p - moving.end[i].p;
      if (dimension == 2) {
        const Vector side = a0 + a1;
        if (Dot(a0, side) > 0 && Dot(a1, side) > 0) return true;
        continue;
      }
      for (std::size_t k = j + 1; k < count; ++k) {
        if (StaysTurned(a0, a1, moving.start[k].p - moving.start[i].p,
                        moving.end[k].p - moving.end[i].p)) {
          return true;
        }
      }
    }
  }
  return false;
}

ProofVerdict CheckPiece(const MovingContacts& moving, int dimension, const Rational& mu,
                        const MotionPiece& piece) {
  const int count = static_cast<int>(moving.start.size());
  if (piece.start.size() != moving.start.size() || piece.end.size() != moving.start.size()) {
    return Nothing("not one force a contact");
  }
  if (!AllFinite(piece.start) || !AllFinite(piece.end)) return Nothing("a force is not finite");
  if (!SpanAllAlong(moving, dimension)) return Nothing("the contacts may come to be on one line");
  const Layout layout(dimension);
  // Rows: forces at the start and at the end, torques at the start, at the end, and between.
  const int torque_row = 2 * dimension;
  Balance balance(2 * dimension + 3 * layout.torques, 2 * dimension * count);
  std::vector<Rational> x;
  layout.Append(piece.start, x);
  layout.Append(piece.end, x);
  for (int i = 0; i < count; ++i) {
    const int start = i * dimension;
    const int end = (count + i) * dimension;
    layout.AddForces(0, start, balance);
    layout.AddForces(dimension, end, balance);
    layout.AddTorques(moving.start[i].p, torque_row, start, balance);
    layout.AddTorques(moving.end[i].p, torque_row + layout.torques, end, balance);
    layout.AddTorques(moving.start[i].p, torque_row + 2 * layout.torques, end, balance);
    layout.AddTorques(moving.end[i].p, torque_row + 2 * layout.torques, start, balance);
  }
  x = balance.Corrected(std::move(x));
  for (int i = 0; i < count; ++i) {
    if (!IsInsideCone(layout.Force(x, i * dimension), moving.start[i].n, mu) ||
        !IsInsideCone(layout.Force(x, (count + i) * dimension), moving.start[i].n, mu)) {
      return Nothing("the force at contact " + std::to_string(i) +
                     ", balanced exactly, is not inside its cone");
    }
  }
  return {Kind::kForceClosure, ""};
}

std::vector<ExactContact> Between(const std::vector<ExactContact>& from,
                                  const std::vector<ExactContact>& to, const Rational& t) {
  std::vector<ExactContact> contacts = from;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contacts[i].p = from[i].p + t * (to[i].p - from[i].p);
  }
  return contacts;
}

}  // namespace

ProofVerdict CheckGraspProof(std::span<const Contact> contacts, int dimension, double mu,
                             const GraspProof& proof) {
  const std::vector<ExactContact> exact = Exact(contacts);
  switch (proof.kind) {
    case GraspProof::Kind::kForces:
      return CheckForces(exact, dimension, mu, proof);
    case GraspProof::Kind::kTwist:
      if (!proof.v.allFinite() || !proof.omega.allFinite())
        return Nothing("the twist is not finite");
      return CheckTwist(exact, mu, Exact(proof.v), Exact(proof.omega));
    case GraspProof::Kind::kLine:
      return CheckLine(exact, mu, proof.line);
    case GraspProof::Kind::kNone:
      break;
  }
  return Nothing("there is no proof");
}

ProofVerdict CheckMotionProof(std::span<const Contact> from, std::span<const Contact> to,
                              int dimension, double mu, std::span<const MotionPiece> pieces) {
  if (from.size() != to.size()) return Nothing("not as many contacts after as before");
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i].n != to[i].n) return Nothing("a normal turns");
  }
  const std::vector<ExactContact> begin = Exact(from);
  const std::vector<ExactContact> end = Exact(to);
  double reached = 0;
  for (const MotionPiece& piece : pieces) {
    if (piece.from != reached || !(piece.to > piece.from) || !(piece.to <= 1)) {
      return Nothing("the pieces do not follow each other");
    }
    const MovingContacts moving = {Between(begin, end, piece.from), Between(begin, end, piece.to)};
    ProofVerdict verdict = CheckPiece(moving, dimension, mu, piece);
    if (verdict.kind != Kind::kForceClosure) return verdict;
    reached = piece.to;
  }
  if (reached != 1) return Nothing("the pieces do not cover the whole way");
  return {Kind::kForceClosure, ""};
}

}  // namespace regrasp
