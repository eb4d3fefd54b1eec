#include "planner/motion/check_motion_proof.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/motion/exact_balance.h"

namespace regrasp::motion {

namespace {

using namespace exact;
using Kind = ProofVerdict::Kind;

ProofVerdict Nothing(std::string why) { return {Kind::kNothing, std::move(why)}; }

/// Contacts at both ends of a piece.
struct MovingContacts {
  std::vector<ExactContact> start;
  std::vector<ExactContact> end;
  std::vector<bool> turns;
  std::vector<Rational> torsion;  ///< 0 of hard points, and of soft fingers whose normal turns

  [[nodiscard]] std::size_t size() const { return start.size(); }
};

/// A point or a difference of points that goes linearly from one end of a piece to the other.
struct Linear {
  Vector start;
  Vector end;
};

Linear Difference(const MovingContacts& moving, std::size_t to, std::size_t from) {
  return {moving.start[to].p - moving.start[from].p, moving.end[to].p - moving.end[from].p};
}

/// The Bernstein coefficients of a(t) × b(t).
std::array<Vector, 3> CrossCoefficients(const Linear& a, const Linear& b) {
  const Vector middle = Cross(a.start, b.end) + Cross(a.end, b.start);
  return {Cross(a.start, b.start), Rational(1, 2) * middle, Cross(a.end, b.end)};
}

/// A lower bound on |v(t)|², v with these Bernstein coefficients: its part along their sum. 0 where
/// that does not keep to one side.
template <std::size_t kCount>
Rational LeastSquaredLength(const std::array<Vector, kCount>& coefficients) {
  Vector side;
  for (const Vector& c : coefficients) side = side + c;
  Rational least = Dot(coefficients[0], side);
  for (const Vector& c : coefficients) least = std::min<Rational>(least, Dot(c, side));
  return least > 0 ? least * least / SquaredNorm(side) : Rational(0);
}

/// Contacts that can apply any wrench all along a piece, three or in the plane two of them: to
/// apply a force r and a torque τ about their middle takes forces no larger than per_force · |r| +
/// per_torque · |τ|.
///
/// Two soft fingers can too: one of them twists, by a torque of per_twist · |τ| about its normal.
struct Support {
  std::vector<std::size_t> contacts;
  Rational per_force;
  Rational per_torque_squared;
  std::size_t twisting = 0;  ///< contact
  Rational per_twist = 0;    ///< times its normal, of any length
};

/// Two opposite forces at a distance d apply the torque d · force.
std::optional<Rational> PairTorqueFactor(const MovingContacts& moving, std::size_t i,
                                         std::size_t j) {
  const Linear side = Difference(moving, j, i);
  const Rational length = LeastSquaredLength(std::array{side.start, side.end});
  if (length == 0) return std::nullopt;
  return Rational(1 / length);
}

/// Forces ω × d_i at arms d_i from the middle of three contacts apply the torque J ω, and the sum
/// of their squares is ω·J ω ≤ |τ|² / λ, λ the least eigenvalue of J = Σ (|d|² 1 − d dᵀ). With c
/// the cross product of two sides λ ≥ Σ_{i<j} |d_i × d_j|² / Σ |d|² = |c|² / (3 Σ |d|²), and 3 Σ
/// |d|² is the sum over the sides, convex in t.
std::optional<Rational> TripleTorqueFactor(const MovingContacts& moving, std::size_t i,
                                           std::size_t j, std::size_t k) {
  const std::array sides = {Difference(moving, j, i), Difference(moving, k, i),
                            Difference(moving, k, j)};
  const Rational area = LeastSquaredLength(CrossCoefficients(sides[0], sides[1]));
  if (area == 0) return std::nullopt;
  Rational start = 0;
  Rational end = 0;
  for (const Linear& side : sides) {
    start += SquaredNorm(side.start);
    end += SquaredNorm(side.end);
  }
  return Rational(std::max(start, end) / area);
}

/// A torque s n about the normal of `twisting` takes up the part of τ along the arm d to the other
/// contact, s = τ·d / n·d, and two opposite forces at the distance |d| the rest, at most |τ| + |s
/// n|.
std::optional<Support> TwistSupport(const MovingContacts& moving, std::size_t twisting,
                                    std::size_t other) {
  const Linear arm = Difference(moving, other, twisting);
  const Vector& n = moving.start[twisting].n;
  Rational start = Dot(n, arm.start);
  Rational end = Dot(n, arm.end);
  if (start < 0) {
    start = -start;
    end = -end;
  }
  const Rational along = std::min(start, end);
  const Rational least = LeastSquaredLength(std::array{arm.start, arm.end});
  if (along <= 0 || least == 0) return std::nullopt;
  const Rational longest = std::max(SquaredNorm(arm.start), SquaredNorm(arm.end));
  const Rational rest = 1 + RootAbove(longest * SquaredNorm(n)) / along;
  return Support{
      {twisting, other}, Rational(1, 2), rest * rest / least, twisting, RootAbove(longest) / along};
}

/// A point at both ends of a piece, in floating point.
struct RoundedEnds {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
};

Eigen::Vector3d Rounded(const Vector& v) { return {v[0].get_d(), v[1].get_d(), v[2].get_d()}; }

/// The inverse of the pair's torque factor, roughly: the shorter of both distances.
double PairMerit(const RoundedEnds& a, const RoundedEnds& b) {
  const Eigen::Vector3d start = b.start - a.start;
  const Eigen::Vector3d end = b.end - a.end;
  return start.dot(end) > 0 ? std::min(start.norm(), end.norm()) : 0;
}

/// The inverse of the triple's torque factor, roughly.
double TripleMerit(const RoundedEnds& a, const RoundedEnds& b, const RoundedEnds& c) {
  const Eigen::Vector3d ab[] = {b.start - a.start, b.end - a.end};
  const Eigen::Vector3d ac[] = {c.start - a.start, c.end - a.end};
  const Eigen::Vector3d first = ab[0].cross(ac[0]);
  const Eigen::Vector3d last = ab[1].cross(ac[1]);
  const Eigen::Vector3d middle = (ab[0].cross(ac[1]) + ab[1].cross(ac[0])) / 2;
  const Eigen::Vector3d side = first + middle + last;
  const double least = std::min({first.dot(side), middle.dot(side), last.dot(side)});
  const double sides = std::max(ab[0].squaredNorm() + ac[0].squaredNorm(),
                                ab[1].squaredNorm() + ac[1].squaredNorm());
  return least > 0 && sides > 0 ? least / side.norm() / std::sqrt(sides) : 0;
}

/// The pair or triple that supports best, found in floating point.
std::vector<std::size_t> BestSupport(const MovingContacts& moving, int dimension) {
  std::vector<RoundedEnds> points;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    points.push_back({Rounded(moving.start[i].p - moving.start[0].p),
                      Rounded(moving.end[i].p - moving.start[0].p)});
  }
  std::vector<std::size_t> best;
  double largest = 0;
  const auto consider = [&](double merit, std::vector<std::size_t> contacts) {
    if (!(merit > largest)) return;
    largest = merit;
    best = std::move(contacts);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (dimension == 2) consider(PairMerit(points[i], points[j]), {i, j});
      for (std::size_t k = j + 1; dimension == 3 && k < points.size(); ++k) {
        consider(TripleMerit(points[i], points[j], points[k]), {i, j, k});
      }
    }
  }
  return best;
}

/// The two contacts of which one twists best; nullopt where none surely does.
std::optional<Support> FindTwistSupport(const MovingContacts& moving) {
  std::optional<Support> best;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    for (std::size_t j = 0; moving.torsion[i] > 0 && j < moving.size(); ++j) {
      if (i == j) continue;
      const std::optional<Support> found = TwistSupport(moving, i, j);
      if (found && (!best || found->per_torque_squared < best->per_torque_squared)) best = found;
    }
  }
  return best;
}

/// @returns nullopt where the contacts are on one line somewhere, or not surely off it, and no soft
///          finger twists.
std::optional<Support> FindSupport(const MovingContacts& moving, int dimension) {
  const std::vector<std::size_t> best = BestSupport(moving, dimension);
  if (best.empty()) return FindTwistSupport(moving);
  const auto factor = dimension == 2 ? PairTorqueFactor(moving, best[0], best[1])
                                     : TripleTorqueFactor(moving, best[0], best[1], best[2]);
  if (!factor) return FindTwistSupport(moving);
  return Support{best, Rational(1, static_cast<long>(best.size())), *factor};
}

/// The contacts' forces at both ends of a piece.
std::vector<Linear> ForcesOf(const MotionSegment& piece, int dimension) {
  std::vector<Linear> forces;
  for (std::size_t i = 0; i < piece.start.size(); ++i) {
    Linear& force = forces.emplace_back(Linear{Exact(piece.start[i]), Exact(piece.end[i])});
    if (dimension == 2) force.start[2] = force.end[2] = 0;
  }
  return forces;
}

/// A torque about a normal at both ends of a piece.
struct Twist {
  Rational start = 0;
  Rational end = 0;
};

std::vector<Twist> TorquesOf(const MotionSegment& piece) {
  std::vector<Twist> torques(piece.start.size());
  for (std::size_t i = 0; i < piece.start_torques.size(); ++i) {
    torques[i] = {Rational(piece.start_torques[i]), Rational(piece.end_torques[i])};
  }
  return torques;
}

/// The middle of the supporting contacts.
Linear MiddleOf(const MovingContacts& moving, const Support& support) {
  Linear middle{};
  for (const std::size_t i : support.contacts) {
    middle.start = middle.start + moving.start[i].p;
    middle.end = middle.end + moving.end[i].p;
  }
  const Rational share(1, static_cast<long>(support.contacts.size()));
  return {share * middle.start, share * middle.end};
}

/// What supporting contacts need at most to take up what forces and torques leave unbalanced.
struct Correction {
  Rational force;  ///< of each of them
  Rational twist;  ///< of the one that twists, about its normal, times that
};

/// Anywhere on a piece, from above.
Correction LargestCorrection(const MovingContacts& moving, const std::vector<Linear>& forces,
                             const std::vector<Twist>& torques, const Support& support) {
  const Linear middle = MiddleOf(moving, support);
  Linear force{};
  std::array<Vector, 3> torque{};
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Linear arm = {moving.start[i].p - middle.start, moving.end[i].p - middle.end};
    const auto of_contact = CrossCoefficients(arm, forces[i]);
    for (std::size_t k = 0; k < torque.size(); ++k) torque[k] = torque[k] + of_contact[k];
    const Vector& n = moving.start[i].n;  // those that twist do not turn
    const auto& [first, last] = torques[i];
    torque[0] = torque[0] + first * n;
    torque[1] = torque[1] + Rational((first + last) / 2) * n;
    torque[2] = torque[2] + last * n;
    force.start = force.start + forces[i].start;
    force.end = force.end + forces[i].end;
  }
  const Rational force_squared = std::max(SquaredNorm(force.start), SquaredNorm(force.end));
  Rational torque_squared = 0;
  for (const Vector& c : torque)
    torque_squared = std::max<Rational>(torque_squared, SquaredNorm(c));
  return {support.per_force * RootAbove(force_squared) +
              RootAbove(support.per_torque_squared * torque_squared),
          support.per_twist * RootAbove(torque_squared)};
}

/// A force at one end of a piece, and all within `margin` of it, are inside the cones of the
/// normals at both ends.
/// @param twist  of a contact that does not turn: its torque over its torsion, times the normal.
bool StaysInsideCone(const Vector& force, const Rational& twist, const Rational& margin,
                     const ExactContact& start, const ExactContact& end, bool turns,
                     const Rational& mu) {
  if (!turns) {
    return IsInsideCone(force, start.n, mu, margin, twist * twist * SquaredNorm(start.n));
  }
  // tan(θ − δ) ≥ tan θ − δ (1 + tan² θ), as the tangent is convex.
  const Rational narrower = mu - Rational(kTurnedNormalBound) * (1 + mu * mu);
  return narrower > 0 && IsInsideCone(force, start.n, narrower, margin) &&
         IsInsideCone(force, end.n, narrower, margin);
}

/// Why the torques of a piece are none.
std::string TorqueFault(const MovingContacts& moving, const MotionSegment& piece) {
  const std::vector<double>& start = piece.start_torques;
  const std::vector<double>& end = piece.end_torques;
  if (start.empty() && end.empty()) return "";
  if (start.size() != moving.size() || end.size() != moving.size())
    return "not one torque a contact";
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!std::isfinite(start[i]) || !std::isfinite(end[i])) return "a torque is not finite";
    if (moving.torsion[i] == 0 && (start[i] != 0 || end[i] != 0)) {
      return "contact " + std::to_string(i) + " has a torque, and is a hard point or turns";
    }
  }
  return "";
}

ProofVerdict CheckPiece(const MovingContacts& moving, int dimension, const Rational& mu,
                        const MotionSegment& piece) {
  if (piece.start.size() != moving.size() || piece.end.size() != moving.size()) {
    return Nothing("not one force a contact");
  }
  if (!AllFinite(piece.start) || !AllFinite(piece.end)) return Nothing("a force is not finite");
  if (const std::string fault = TorqueFault(moving, piece); !fault.empty()) return Nothing(fault);
  const std::optional<Support> support = FindSupport(moving, dimension);
  if (!support) return Nothing("the contacts may come to be on one line");
  const std::vector<Linear> forces = ForcesOf(piece, dimension);
  const std::vector<Twist> torques = TorquesOf(piece);
  const Correction correction = LargestCorrection(moving, forces, torques, *support);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const bool supports = std::ranges::find(support->contacts, i) != support->contacts.end();
    Rational margin = supports ? correction.force : Rational(0);
    const Rational& torsion = moving.torsion[i];
    if (supports && support->per_twist > 0 && i == support->twisting) {
      margin += correction.twist / torsion * RootAbove(SquaredNorm(moving.start[i].n));
    }
    for (const bool at_end : {false, true}) {
      const Vector& force = at_end ? forces[i].end : forces[i].start;
      Rational twist = 0;
      if (torsion > 0) twist = (at_end ? torques[i].end : torques[i].start) / torsion;
      if (!StaysInsideCone(force, twist, margin, moving.start[i], moving.end[i], moving.turns[i],
                           mu)) {
        return Nothing("the force at contact " + std::to_string(i) +
                       ", balanced exactly, may leave its cone");
      }
    }
  }
  return {Kind::kForceClosure, ""};
}

/// The normal at t on the path from n to `to`, up to its length.
Eigen::Vector3d TurnedNormal(const Eigen::Vector3d& n, const Eigen::Vector3d& to, double t) {
  const Eigen::Vector3d a = n.normalized();
  const Eigen::Vector3d b = to.normalized();
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  return std::sin((1 - t) * angle) * a + std::sin(t * angle) * b;
}

/// Whether a normal turns by more than kMostTurn, or is none.
bool TurnsTooFar(const grasp::Contact& from, const grasp::Contact& to) {
  const double cosine = from.n.normalized().dot(to.n.normalized());
  return !(cosine > std::cos(kMostTurn));
}

std::vector<ExactContact> At(std::span<const grasp::Contact> from,
                             std::span<const grasp::Contact> to, double t) {
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

ProofVerdict CheckSegmentProof(std::span<const grasp::Contact> from,
                               std::span<const grasp::Contact> to, int dimension, double mu,
                               const MotionSegment& piece) {
  if (from.size() != to.size()) return Nothing("not as many contacts after as before");
  if (!(piece.from >= 0 && piece.to > piece.from && piece.to <= 1)) {
    return Nothing("a piece is not a part of the way");
  }
  std::vector<bool> turns;
  std::vector<Rational> torsion;
  for (std::size_t i = 0; i < from.size(); ++i) {
    turns.push_back(from[i].n != to[i].n);
    torsion.emplace_back(turns.back() ? 0 : from[i].torsion);
    if (turns.back() && TurnsTooFar(from[i], to[i])) {
      return Nothing("the normal of contact " + std::to_string(i) + " turns by a half-turn");
    }
  }
  return CheckPiece({At(from, to, piece.from), At(from, to, piece.to), turns, torsion}, dimension,
                    mu, piece);
}

ProofVerdict CheckMotionProof(std::span<const grasp::Contact> from,
                              std::span<const grasp::Contact> to, int dimension, double mu,
                              std::span<const MotionSegment> pieces) {
  double reached = 0;
  for (const MotionSegment& piece : pieces) {
    if (piece.from != reached) return Nothing("the pieces do not follow each other");
    ProofVerdict verdict = CheckSegmentProof(from, to, dimension, mu, piece);
    if (!verdict.proves()) return verdict;
    reached = piece.to;
  }
  if (reached != 1) return Nothing("the pieces do not cover the whole way");
  return {Kind::kForceClosure, ""};
}

}  // namespace regrasp::motion
