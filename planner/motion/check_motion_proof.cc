#include "planner/motion/check_motion_proof.h"

#include <CGAL/Interval_nt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/motion/exact_balance.h"

namespace regrasp::motion {

namespace {

/// Interval that contains the exact value. CGAL throws if it cannot decide a comparison.
using Interval = CGAL::Interval_nt<false>;

}  // namespace

template <>
struct exact::NumberTraits<Interval> {
  /// Contains the result of the exact type, which rounds to nearest four times.
  static Interval RootAbove(const Interval& x) {
    constexpr double kRoundings = 1e-15;
    return CGAL::sqrt(x) * Interval(kRootAbove - kRoundings, kRootAbove + kRoundings);
  }
  static Interval Min(const Interval& a, const Interval& b) { return CGAL::min(a, b); }
  static Interval Max(const Interval& a, const Interval& b) { return CGAL::max(a, b); }
  static double Rounded(const Interval& x) { return (x.inf() + x.sup()) / 2; }
};

namespace {

using namespace exact;
using Kind = ProofVerdict::Kind;

ProofVerdict Nothing(std::string why) { return {Kind::kNothing, std::move(why)}; }

/// Point, or difference of points, that is linear between both ends of a piece.
template <class Number>
struct Linear {
  VectorOf<Number> start;
  VectorOf<Number> end;
};

/// Contact on a piece.
template <class Number>
struct CheckedContact {
  Linear<Number> p;
  Linear<Number> n;  ///< normals at both ends; between them, a normal that turns is not linear
  bool turns = false;
  Number torsion = 0;  ///< 0 for hard-finger contacts, and for soft fingers whose normal turns
};

template <class Number>
using CheckedContacts = std::vector<CheckedContact<Number>>;

template <class Number>
Linear<Number> Difference(const CheckedContacts<Number>& moving, std::size_t to, std::size_t from) {
  return {moving[to].p.start - moving[from].p.start, moving[to].p.end - moving[from].p.end};
}

/// Return the Bernstein coefficients of a(t) × b(t).
template <class Number>
std::array<VectorOf<Number>, 3> CrossCoefficients(const Linear<Number>& a,
                                                  const Linear<Number>& b) {
  const VectorOf<Number> middle = Cross(a.start, b.end) + Cross(a.end, b.start);
  return {Cross(a.start, b.start), Number(0.5) * middle, Cross(a.end, b.end)};
}

/// Return a lower bound on |v(t)|² for v with these Bernstein coefficients.
/// It uses the component along their sum. 0 if that component changes its sign.
template <class Number, std::size_t kCount>
Number LeastSquaredLength(const std::array<VectorOf<Number>, kCount>& coefficients) {
  VectorOf<Number> side = coefficients[0];
  for (std::size_t k = 1; k < kCount; ++k) side = side + coefficients[k];
  Number least = Dot(coefficients[0], side);
  for (std::size_t k = 1; k < kCount; ++k) least = Lesser(least, Dot(coefficients[k], side));
  if (!(least > 0)) return 0;
  return least * least / SquaredNorm(side);
}

/// Contacts that can apply any wrench throughout a piece: three, or two in the plane.
/// To apply a force r and a torque τ about their middle requires forces of at most per_force · |r|
/// + per_torque · |τ|.
///
/// Two soft fingers can apply any wrench too: one of them applies a torque of per_twist · |τ| about
/// its normal.
template <class Number>
struct Support {
  std::vector<std::size_t> contacts;
  Number per_force;
  Number per_torque_squared;
  std::size_t twisting = 0;  ///< contact number
  Number per_twist = 0;      ///< factor of its normal, which has any length
};

/// Return the force per torque of a pair. Two opposite forces at a distance d apply the torque d ·
/// force.
template <class Number>
std::optional<Number> PairTorqueFactor(const CheckedContacts<Number>& moving, std::size_t i,
                                       std::size_t j) {
  const Linear<Number> side = Difference(moving, j, i);
  const Number length = LeastSquaredLength<Number, 2>({side.start, side.end});
  if (length == 0) return std::nullopt;
  return Number(1) / length;
}

/// Return the force per torque of three contacts.
/// Forces ω × d_i at arms d_i from the middle of three contacts apply the torque J ω. The sum of
/// their squares is ω·J ω ≤ |τ|² / λ, λ the least eigenvalue of J = Σ (|d|² 1 − d dᵀ). With c the
/// cross product of two sides, λ ≥ Σ_{i<j} |d_i × d_j|² / Σ |d|² = |c|² / (3 Σ |d|²), and 3 Σ |d|²
/// is the sum over the sides, convex in t.
template <class Number>
std::optional<Number> TripleTorqueFactor(const CheckedContacts<Number>& moving, std::size_t i,
                                         std::size_t j, std::size_t k) {
  const std::array sides = {Difference(moving, j, i), Difference(moving, k, i),
                            Difference(moving, k, j)};
  const Number area = LeastSquaredLength(CrossCoefficients(sides[0], sides[1]));
  if (area == 0) return std::nullopt;
  Number start = 0;
  Number end = 0;
  for (const Linear<Number>& side : sides) {
    start += SquaredNorm(side.start);
    end += SquaredNorm(side.end);
  }
  return Greater(start, end) / area;
}

/// Return the support of two contacts of which one is a soft finger.
/// A torque s n about the normal of `twisting` balances the part of τ along the arm d to the other
/// contact, s = τ·d / n·d. Two opposite forces at the distance |d| balance the remainder, at most
/// |τ| + |s n|.
template <class Number>
std::optional<Support<Number>> TwistSupport(const CheckedContacts<Number>& moving,
                                            std::size_t twisting, std::size_t other) {
  const Linear<Number> arm = Difference(moving, other, twisting);
  const VectorOf<Number>& n = moving[twisting].n.start;
  Number start = Dot(n, arm.start);
  Number end = Dot(n, arm.end);
  if (start < 0) {
    start = -start;
    end = -end;
  }
  const Number along = Lesser(start, end);
  const Number least = LeastSquaredLength<Number, 2>({arm.start, arm.end});
  if (along <= 0 || least == 0) return std::nullopt;
  const Number longest = Greater(SquaredNorm(arm.start), SquaredNorm(arm.end));
  const Number rest = Number(1) + Root<Number>(longest * SquaredNorm(n)) / along;
  return Support<Number>{
      {twisting, other}, 0.5, rest * rest / least, twisting, Root(longest) / along};
}

/// Point at both ends of a piece, in floating point.
struct RoundedEnds {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
};

template <class Number>
Eigen::Vector3d Rounded(const VectorOf<Number>& v) {
  using Traits = NumberTraits<Number>;
  return {Traits::Rounded(v[0]), Traits::Rounded(v[1]), Traits::Rounded(v[2])};
}

/// Return the approximate inverse of the pair's torque factor: the shorter of both distances.
double PairMerit(const RoundedEnds& a, const RoundedEnds& b) {
  const Eigen::Vector3d start = b.start - a.start;
  const Eigen::Vector3d end = b.end - a.end;
  return start.dot(end) > 0 ? std::min(start.norm(), end.norm()) : 0;
}

/// Return the approximate inverse of the triple's torque factor.
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

/// Return the pair or triple with the best support, found in floating point.
template <class Number>
std::vector<std::size_t> BestSupport(const CheckedContacts<Number>& moving, int dimension) {
  std::vector<RoundedEnds> points;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    points.push_back({Rounded(moving[i].p.start - moving[0].p.start),
                      Rounded(moving[i].p.end - moving[0].p.start)});
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

/// Return the best support of two contacts with a soft finger; nullopt if none is certain.
template <class Number>
std::optional<Support<Number>> FindTwistSupport(const CheckedContacts<Number>& moving) {
  std::optional<Support<Number>> best;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    for (std::size_t j = 0; moving[i].torsion > 0 && j < moving.size(); ++j) {
      if (i == j) continue;
      const auto found = TwistSupport(moving, i, j);
      if (found && (!best || found->per_torque_squared < best->per_torque_squared)) best = found;
    }
  }
  return best;
}

/// Return the support of a piece.
/// @returns nullopt if the contacts may be collinear at an instant, and no soft finger resists a
///     turn about their line.
template <class Number>
std::optional<Support<Number>> FindSupport(const CheckedContacts<Number>& moving, int dimension) {
  const std::vector<std::size_t> best = BestSupport(moving, dimension);
  if (best.empty()) return FindTwistSupport(moving);
  const auto factor = dimension == 2 ? PairTorqueFactor(moving, best[0], best[1])
                                     : TripleTorqueFactor(moving, best[0], best[1], best[2]);
  if (!factor) return FindTwistSupport(moving);
  return Support<Number>{best, Number(1) / Number(static_cast<int>(best.size())), *factor};
}

/// Forces and torques of a contact on a piece.
template <class Number>
struct Applied {
  Linear<Number> force;
  Number start_torque = 0;  ///< about its normal
  Number end_torque = 0;
};

template <class Number>
VectorOf<Number> NumbersOf(const Eigen::Vector3d& v) {
  return {Number(v.x()), Number(v.y()), Number(v.z())};
}

template <class Number>
std::vector<Applied<Number>> AppliedOn(const MotionSegment& piece, int dimension) {
  std::vector<Applied<Number>> applied(piece.start.size());
  for (std::size_t i = 0; i < applied.size(); ++i) {
    Linear<Number>& force = applied[i].force;
    force = {NumbersOf<Number>(piece.start[i]), NumbersOf<Number>(piece.end[i])};
    if (dimension == 2) force.start[2] = force.end[2] = 0;
    if (piece.start_torques.empty()) continue;
    applied[i].start_torque = piece.start_torques[i];
    applied[i].end_torque = piece.end_torques[i];
  }
  return applied;
}

/// Return the middle of the supporting contacts.
template <class Number>
Linear<Number> MiddleOf(const CheckedContacts<Number>& moving, const Support<Number>& support) {
  Linear<Number> sum = moving[support.contacts.front()].p;
  for (std::size_t k = 1; k < support.contacts.size(); ++k) {
    sum.start = sum.start + moving[support.contacts[k]].p.start;
    sum.end = sum.end + moving[support.contacts[k]].p.end;
  }
  const Number share = Number(1) / Number(static_cast<int>(support.contacts.size()));
  return {share * sum.start, share * sum.end};
}

/// Upper bounds on the loads of supporting contacts that balance the remaining forces and torques.
template <class Number>
struct Correction {
  Number force;  ///< force of each of them
  Number twist;  ///< torque of the soft finger about its normal, as a factor of the normal
};

/// Return an upper bound on the correction at any instant of a piece.
template <class Number>
Correction<Number> LargestCorrection(const CheckedContacts<Number>& moving,
                                     const std::vector<Applied<Number>>& applied,
                                     const Support<Number>& support) {
  const VectorOf<Number> zero = {0, 0, 0};
  const Linear<Number> middle = MiddleOf(moving, support);
  Linear<Number> force = {zero, zero};
  std::array<VectorOf<Number>, 3> torque = {zero, zero, zero};
  for (std::size_t i = 0; i < applied.size(); ++i) {
    const auto& [of_contact, first, last] = applied[i];
    const Linear<Number>& p = moving[i].p;
    const Linear<Number> arm = {p.start - middle.start, p.end - middle.end};
    const auto coefficients = CrossCoefficients(arm, of_contact);
    for (std::size_t k = 0; k < torque.size(); ++k) torque[k] = torque[k] + coefficients[k];
    force.start = force.start + of_contact.start;
    force.end = force.end + of_contact.end;
    if (!(moving[i].torsion > 0)) continue;
    const VectorOf<Number>& n = moving[i].n.start;  // normals with a torque do not turn
    torque[0] = torque[0] + first * n;
    torque[1] = torque[1] + Number((first + last) / 2) * n;
    torque[2] = torque[2] + last * n;
  }
  const Number force_squared = Greater(SquaredNorm(force.start), SquaredNorm(force.end));
  Number torque_squared = 0;
  for (const VectorOf<Number>& c : torque) torque_squared = Greater(torque_squared, SquaredNorm(c));
  return {support.per_force * Root(force_squared) +
              Root<Number>(support.per_torque_squared * torque_squared),
          support.per_twist * Root(torque_squared)};
}

/// Return whether all forces within `margin` of a force at one end of a piece are inside the cones
/// of the normals at both ends.
/// @param twist  torque over torsion, times the normal, for a contact that does not turn.
template <class Number>
bool StaysInsideCone(const VectorOf<Number>& force, const Number& twist, const Number& margin,
                     const CheckedContact<Number>& contact, const Number& mu) {
  const Linear<Number>& n = contact.n;
  if (!contact.turns) {
    return IsInsideCone<Number>(force, n.start, mu, margin, twist * twist * SquaredNorm(n.start));
  }
  // tan(θ − δ) ≥ tan θ − δ (1 + tan² θ), because the tangent is convex.
  const Number narrower = mu - Number(kTurnedNormalBound) * (1 + mu * mu);
  return narrower > 0 && IsInsideCone<Number>(force, n.start, narrower, margin, 0) &&
         IsInsideCone<Number>(force, n.end, narrower, margin, 0);
}

/// Contact on a piece, as doubles for conversion to number types.
struct GivenContact {
  Eigen::Vector3d from;  ///< point at the start of the whole motion
  Eigen::Vector3d to;
  Eigen::Vector3d start_n;  ///< normal at the start of the piece
  Eigen::Vector3d end_n;
  bool turns;
  double torsion;
};

/// Return the reason why the torques of a piece are invalid.
std::string TorqueFault(const std::vector<GivenContact>& contacts, const MotionSegment& piece) {
  const std::vector<double>& start = piece.start_torques;
  const std::vector<double>& end = piece.end_torques;
  if (start.empty() && end.empty()) return "";
  if (start.size() != contacts.size() || end.size() != contacts.size())
    return "expected one torque per contact";
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!std::isfinite(start[i]) || !std::isfinite(end[i])) return "torques must be finite";
    if (contacts[i].torsion == 0 && (start[i] != 0 || end[i] != 0)) {
      return "contact " + std::to_string(i) + " is a hard point or rotates, expected torque 0";
    }
  }
  return "";
}

/// Return the reason why a piece is invalid without evaluation of its numbers.
std::string PieceFault(const std::vector<GivenContact>& contacts, const MotionSegment& piece) {
  if (piece.start.size() != contacts.size() || piece.end.size() != contacts.size()) {
    return "expected one force per contact";
  }
  if (!AllFinite(piece.start) || !AllFinite(piece.end)) return "forces must be finite";
  return TorqueFault(contacts, piece);
}

template <class Number>
CheckedContacts<Number> ContactsOn(const std::vector<GivenContact>& given,
                                   const MotionSegment& piece) {
  CheckedContacts<Number> contacts;
  contacts.reserve(given.size());
  for (const GivenContact& contact : given) {
    const VectorOf<Number> from = NumbersOf<Number>(contact.from);
    const VectorOf<Number> way = NumbersOf<Number>(contact.to) - from;
    contacts.push_back({{from + Number(piece.from) * way, from + Number(piece.to) * way},
                        {NumbersOf<Number>(contact.start_n), NumbersOf<Number>(contact.end_n)},
                        contact.turns,
                        Number(contact.torsion)});
  }
  return contacts;
}

/// Check a piece without PieceFault.
template <class Number>
ProofVerdict CheckPiece(const std::vector<GivenContact>& given, int dimension, const Number& mu,
                        const MotionSegment& piece) {
  const CheckedContacts<Number> moving = ContactsOn<Number>(given, piece);
  const std::optional<Support<Number>> support = FindSupport(moving, dimension);
  if (!support) return Nothing("the contacts may become collinear");
  const std::vector<Applied<Number>> applied = AppliedOn<Number>(piece, dimension);
  const Correction<Number> correction = LargestCorrection(moving, applied, *support);
  for (std::size_t i = 0; i < applied.size(); ++i) {
    const bool supports = std::ranges::find(support->contacts, i) != support->contacts.end();
    Number margin = supports ? correction.force : Number(0);
    const Number& torsion = moving[i].torsion;
    if (supports && support->per_twist > 0 && i == support->twisting) {
      margin += correction.twist / torsion * Root(SquaredNorm(moving[i].n.start));
    }
    for (const bool at_end : {false, true}) {
      const auto& [force, start_torque, end_torque] = applied[i];
      Number twist = 0;
      if (torsion > 0) twist = (at_end ? end_torque : start_torque) / torsion;
      if (!StaysInsideCone(at_end ? force.end : force.start, twist, margin, moving[i], mu)) {
        return Nothing("the force at contact " + std::to_string(i) +
                       ", balanced exactly, may leave its cone");
      }
    }
  }
  return {Kind::kForceClosure, ""};
}

/// Check a piece by intervals if they can decide, otherwise by rational numbers.
/// Rational numbers are far slower. Both use the same steps, and each proves only true statements.
/// If two supports are equally good, they may use different ones.
ProofVerdict CheckFiltered(const std::vector<GivenContact>& given, int dimension, double mu,
                           const MotionSegment& piece) {
  try {
    const CGAL::Protect_FPU_rounding<true> upward;
    return CheckPiece<Interval>(given, dimension, mu, piece);
  } catch (const CGAL::Uncertain_conversion_exception&) {
  }
  return CheckPiece<Rational>(given, dimension, Rational(mu), piece);
}

/// Return the normal at t between n and `to`, up to its length.
Eigen::Vector3d TurnedNormal(const Eigen::Vector3d& n, const Eigen::Vector3d& to, double t) {
  const Eigen::Vector3d a = n.normalized();
  const Eigen::Vector3d b = to.normalized();
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  return std::sin((1 - t) * angle) * a + std::sin(t * angle) * b;
}

/// Return whether a normal turns by more than kMostTurn, or is not a normal.
bool TurnsTooFar(const grasp::Contact& from, const grasp::Contact& to) {
  const double cosine = from.n.normalized().dot(to.n.normalized());
  return !(cosine > std::cos(kMostTurn));
}

/// Return the contacts at both ends of a piece, with their normals in floating point.
std::vector<GivenContact> GivenOn(std::span<const grasp::Contact> from,
                                  std::span<const grasp::Contact> to, const MotionSegment& piece) {
  std::vector<GivenContact> given;
  given.reserve(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const grasp::Contact& a = from[i];
    const grasp::Contact& b = to[i];
    if (a.n == b.n) {
      given.push_back({a.p, b.p, a.n, a.n, false, a.torsion});
    } else {
      given.push_back({a.p, b.p, TurnedNormal(a.n, b.n, piece.from),
                       TurnedNormal(a.n, b.n, piece.to), true, 0});
    }
  }
  return given;
}

}  // namespace

ProofVerdict CheckSegmentProof(std::span<const grasp::Contact> from,
                               std::span<const grasp::Contact> to, int dimension, double mu,
                               const MotionSegment& piece) {
  if (from.size() != to.size())
    return Nothing("expected as many contacts after the motion as before");
  if (!(piece.from >= 0 && piece.to > piece.from && piece.to <= 1)) {
    return Nothing("a piece must be part of the path");
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i].n != to[i].n && TurnsTooFar(from[i], to[i])) {
      return Nothing("the normal of contact " + std::to_string(i) + " rotates by 180°");
    }
  }
  const std::vector<GivenContact> given = GivenOn(from, to, piece);
  if (const std::string fault = PieceFault(given, piece); !fault.empty()) return Nothing(fault);
  return CheckFiltered(given, dimension, mu, piece);
}

ProofVerdict CheckMotionProof(std::span<const grasp::Contact> from,
                              std::span<const grasp::Contact> to, int dimension, double mu,
                              std::span<const MotionSegment> pieces) {
  double reached = 0;
  for (const MotionSegment& piece : pieces) {
    if (piece.from != reached) return Nothing("the pieces must be consecutive");
    ProofVerdict verdict = CheckSegmentProof(from, to, dimension, mu, piece);
    if (!verdict.proves()) return verdict;
    reached = piece.to;
  }
  if (reached != 1) return Nothing("the pieces must cover the whole path");
  return {Kind::kForceClosure, ""};
}

}  // namespace regrasp::motion
