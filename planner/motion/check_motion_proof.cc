#include "planner/motion/check_motion_proof.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "planner/motion/exact_balance.h"

namespace regrasp {

namespace {

using namespace exact;
using Kind = ProofVerdict::Kind;

ProofVerdict Nothing(std::string why) { return {Kind::kNothing, std::move(why)}; }

/// Contacts at both ends of a piece.
struct MovingContacts {
  std::vector<ExactContact> start;
  std::vector<ExactContact> end;
  std::vector<bool> turns;
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

/// Both forces are inside the cones of the normals at both ends.
bool StaysInsideCone(const std::array<Vector, 2>& forces, const ExactContact& start,
                     const ExactContact& end, bool turns, const Rational& mu) {
  if (!turns) {
    return IsInsideCone(forces[0], start.n, mu) && IsInsideCone(forces[1], start.n, mu);
  }
  // tan(θ − δ) ≥ tan θ − δ (1 + tan² θ), as the tangent is convex.
  const Rational narrower = mu - Rational(kTurnedNormalBound) * (1 + mu * mu);
  return narrower > 0 && std::all_of(forces.begin(), forces.end(), [&](const Vector& force) {
           return IsInsideCone(force, start.n, narrower) && IsInsideCone(force, end.n, narrower);
         });
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
  const auto balanced = balance.Corrected(x);
  if (!balanced) return Nothing("the forces cannot be balanced exactly");
  for (int i = 0; i < count; ++i) {
    const std::array forces = {layout.Force(*balanced, i * dimension),
                               layout.Force(*balanced, (count + i) * dimension)};
    if (!StaysInsideCone(forces, moving.start[i], moving.end[i], moving.turns[i], mu)) {
      return Nothing("the force at contact " + std::to_string(i) +
                     ", balanced exactly, is not inside its cone");
    }
  }
  return {Kind::kForceClosure, ""};
}

/// The normal at t of the way from n to `to`, up to its length.
Eigen::Vector3d TurnedNormal(const Eigen::Vector3d& n, const Eigen::Vector3d& to, double t) {
  const Eigen::Vector3d a = n.normalized();
  const Eigen::Vector3d b = to.normalized();
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  return std::sin((1 - t) * angle) * a + std::sin(t * angle) * b;
}

/// Whether a normal turns by more than kMostTurn, or is none.
bool TurnsTooFar(const Contact& from, const Contact& to) {
  const double cosine = from.n.normalized().dot(to.n.normalized());
  return !(cosine > std::cos(kMostTurn));
}

std::vector<ExactContact> At(std::span<const Contact> from, std::span<const Contact> to, double t) {
  std::vector<ExactContact> contacts;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vector p = Exact(from[i].p);
    const bool turns = from[i].n != to[i].n;
    contacts.push_back({p + Rational(t) * (Exact(to[i].p) - p),
                        Exact(turns ? TurnedNormal(from[i].n, to[i].n, t) : from[i].n)});
  }
  return contacts;
}

}  // namespace

ProofVerdict CheckPieceProof(std::span<const Contact> from, std::span<const Contact> to,
                             int dimension, double mu, const MotionPiece& piece) {
  if (from.size() != to.size()) return Nothing("not as many contacts after as before");
  if (!(piece.from >= 0 && piece.to > piece.from && piece.to <= 1)) {
    return Nothing("a piece is not a part of the way");
  }
  std::vector<bool> turns;
  for (std::size_t i = 0; i < from.size(); ++i) {
    turns.push_back(from[i].n != to[i].n);
    if (turns.back() && TurnsTooFar(from[i], to[i])) {
      return Nothing("the normal of contact " + std::to_string(i) + " turns by a half-turn");
    }
  }
  return CheckPiece({At(from, to, piece.from), At(from, to, piece.to), turns}, dimension, mu,
                    piece);
}

ProofVerdict CheckMotionProof(std::span<const Contact> from, std::span<const Contact> to,
                              int dimension, double mu, std::span<const MotionPiece> pieces) {
  double reached = 0;
  for (const MotionPiece& piece : pieces) {
    if (piece.from != reached) return Nothing("the pieces do not follow each other");
    ProofVerdict verdict = CheckPieceProof(from, to, dimension, mu, piece);
    if (!verdict.proves()) return verdict;
    reached = piece.to;
  }
  if (reached != 1) return Nothing("the pieces do not cover the whole way");
  return {Kind::kForceClosure, ""};
}

}  // namespace regrasp
