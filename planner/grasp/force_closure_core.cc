#include "planner/grasp/force_closure_core.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/grasp/cone_support.h"

namespace regrasp::grasp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Number of contacts up to which the lines through pairs are tested first, because that decides
/// most grasps. With more contacts they seldom decide, and are tested only if the simplex cannot
/// decide.
constexpr std::size_t kPairLinesFirst = 4;

/// Reach beyond the origin that suffices: a larger one would not make a decision more certain.
constexpr double kClearReach = 1e-6;

/// Moment arm about every line at which contacts span space by much more than rounding.
constexpr double kClearSpread = 1e-6;

/// Return Σ w(n_i), the wrench of unit normal forces.
template <int kDim>
typename WrenchSimplex<kDim>::Vector NormalWrench(const UnitContacts& contacts) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (const UnitContact& contact : contacts) {
    force += contact.n;
    torque += contact.q.cross(contact.n);
  }
  if constexpr (kDim == 6) {
    return {force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z()};
  } else {
    return {force.x(), force.y(), torque.z()};
  }
}

template <int kDim>
double Dot(const typename WrenchSimplex<kDim>::Vector& a,
           const typename WrenchSimplex<kDim>::Vector& b) {
  double sum = 0;
  for (int r = 0; r < kDim; ++r) sum += a[r] * b[r];
  return sum;
}

/// Forces along the normals attain −1/k, so ε* is at least that.
ForceClosure No(std::size_t count, double upper) {
  const double lower = -1 / static_cast<double>(count);
  return {Decision::kNo, lower, std::max(lower, upper)};
}

/// Return the bound of a twist y: ε* ≤ max y·w / (−y·W), the columns w of unit normal force.
template <int kDim>
double UpperBound(const UnitContacts& contacts, const typename WrenchSimplex<kDim>::Vector& twist) {
  const double descent = -Dot<kDim>(twist, NormalWrench<kDim>(contacts));
  if (!(descent > 0)) return kInfinity;
  return WrenchSimplex<kDim>::Support(contacts, twist) / (contacts[0].axial * descent);
}

template <int kDim>
ForceClosure Yes(const UnitContacts& contacts, double lower) {
  auto ascent = NormalWrench<kDim>(contacts);
  for (double& value : ascent) value = -value;
  return {Decision::kYes, lower, std::max(lower, UpperBound<kDim>(contacts, ascent))};
}

template <int kDim>
void StoreForces(const WrenchSimplex<kDim>& simplex, std::size_t count,
                 ForceClosureProof<kDim>* proof) {
  if (proof == nullptr) return;
  proof->forces.clear();
  for (std::size_t i = 0; i < count; ++i) {
    proof->forces.push_back(simplex.ForceOf(static_cast<int>(i)));
  }
}

/// Return the bound of the basic columns if the origin is inside their simplex.
/// It follows from how far they reach against W.
template <int kDim>
double LowerBound(const UnitContacts& contacts, const WrenchSimplex<kDim>& simplex) {
  auto direction = NormalWrench<kDim>(contacts);
  for (double& value : direction) value = -value;
  return std::min(simplex.Reach(direction) / contacts[0].axial, std::numeric_limits<double>::max());
}

/// Return the largest arm at which a contact resists a turn about the line of the contacts.
/// The line passes through the centre and the contact farthest from it. The arm is the contact's
/// distance from the line, or its torsion weighted by the normal's direction. 0 if all contacts are
/// collinear and nothing resists a turn about their line.
double ArmAboutLine(const UnitContacts& contacts) {
  const auto farthest = std::max_element(
      contacts.begin(), contacts.end(),
      [](const auto& a, const auto& b) { return a.q.squaredNorm() < b.q.squaredNorm(); });
  double arm = 0;
  for (const UnitContact& contact : contacts) {
    arm = std::max({arm, farthest->q.cross(contact.q).norm(),
                    contact.torsion * std::abs(farthest->q.dot(contact.n))});
  }
  return arm;
}

/// Bound the margin if the origin is on the border of the basic columns' simplex.
/// This occurs, for example, if two contacts alone balance. The origin is inside the hull iff the
/// ray from a point inside, the simplex's start c, reaches beyond it, to −s c with s > 0. With a
/// the smallest weight of c = Σ a_i w(n_i),
///
///     −s a W = −s c + s Σ (a_i − a) w(n_i)  ∈  (1 + s (1 − k a)) hull,
///
/// which bounds the margin.
///
/// The start is inside the hull, and the hull is not flat, only if a turn about every line is
/// resisted. This requires contacts that are not collinear, or a soft finger that turns about their
/// line (ArmAboutLine).
template <int kDim>
double LowerBoundBeyondStart(const UnitContacts& contacts, WrenchSimplex<kDim>& simplex) {
  const double reach =
      simplex.Maximise(simplex.start(), 0, {.gap = kForceClosureEpsilon, .enough = kClearReach})
          .lower;
  if (!(reach > kForceClosureEpsilon) || !std::isfinite(reach)) return 0;
  double least = 1;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    least = std::min(least, simplex.StartWeight(static_cast<int>(i)));
  }
  return reach * least / (1 + reach * (1 - static_cast<double>(contacts.size()) * least));
}

}  // namespace

template <int kDim>
ForceClosure DecideOpenForceClosure(const UnitContacts& contacts, ForceClosureProof<kDim>* proof,
                                    typename WrenchSimplex<kDim>::Vector* twist,
                                    std::optional<WrenchSimplex<kDim>>* used) {
  using Simplex = WrenchSimplex<kDim>;
  std::optional<Simplex> own;
  Simplex& simplex = (used == nullptr ? own : *used).emplace(contacts, typename Simplex::Vector{});
  const typename Simplex::Status status = simplex.FindWeights(/*stop_early=*/true);
  if (status == Simplex::Status::kInfeasible) {
    if (proof != nullptr) proof->twist = simplex.twist();
    if (twist != nullptr) *twist = simplex.twist();
    return No(contacts.size(), UpperBound<kDim>(contacts, simplex.twist()));
  }
  const bool feasible = status == Simplex::Status::kFeasible;
  if (feasible) StoreForces<kDim>(simplex, contacts.size(), proof);
  if (feasible && simplex.BallRadius() > kForceClosureEpsilon) {
    return Yes<kDim>(contacts, LowerBound<kDim>(contacts, simplex));
  }
  const double spread = kDim == 6 ? ArmAboutLine(contacts) : 1;
  if (spread <= kForceClosureEpsilon) return No(contacts.size(), 0);
  if (feasible && spread > kClearSpread) {
    const double lower = LowerBoundBeyondStart<kDim>(contacts, simplex);
    if (lower > 0) return Yes<kDim>(contacts, lower);
  }
  return {Decision::kTooClose, -kForceClosureEpsilon, kForceClosureEpsilon};
}

template <int kDim>
Decision DecideOnly(const UnitContacts& contacts, typename WrenchSimplex<kDim>::Vector& twist) {
  using Simplex = WrenchSimplex<kDim>;
  Simplex simplex(contacts, typename Simplex::Vector{});
  const typename Simplex::Status status = simplex.FindWeights(/*stop_early=*/true);
  if (status == Simplex::Status::kInfeasible) {
    twist = simplex.twist();
    return Decision::kNo;
  }
  if (status == Simplex::Status::kFeasible && simplex.BallRadius() > kForceClosureEpsilon) {
    return Decision::kYes;
  }
  twist = {};
  return DecideOpenForceClosure<kDim>(contacts).decision;
}

template <int kDim>
ForceClosure DecideForceClosure(const UnitContacts& contacts, ForceClosureProof<kDim>* proof,
                                typename WrenchSimplex<kDim>::Vector* twist,
                                std::optional<WrenchSimplex<kDim>>* used) {
  if (twist != nullptr) *twist = {};
  const bool space = kDim == 6;
  const bool few = contacts.size() <= kPairLinesFirst;
  // The torque of a soft finger may resist turns that a pair line refutes.
  const bool soft = space && HasTorsion(contacts);
  if (contacts.size() < (space && !soft ? 3 : 2)) return No(contacts.size(), 0);
  if (space && few) {
    const PairLineVerdict verdict = TestPairLines(contacts);
    if (verdict == PairLineVerdict::kNo && !soft) return No(contacts.size(), 0);
    // This kYes has no forces for the proof.
    if (verdict == PairLineVerdict::kYes && proof == nullptr) {
      return Yes<kDim>(contacts, std::numeric_limits<double>::min());
    }
  }
  const ForceClosure answer = DecideOpenForceClosure<kDim>(contacts, proof, twist, used);
  const bool unsettled = space && !few && !soft && answer.decision == Decision::kTooClose;
  return unsettled && TestPairLines(contacts) == PairLineVerdict::kNo ? No(contacts.size(), 0)
                                                                      : answer;
}

template ForceClosure DecideForceClosure<3>(const UnitContacts&, ForceClosureProof<3>*,
                                            WrenchSimplex<3>::Vector*,
                                            std::optional<WrenchSimplex<3>>*);
template ForceClosure DecideForceClosure<6>(const UnitContacts&, ForceClosureProof<6>*,
                                            WrenchSimplex<6>::Vector*,
                                            std::optional<WrenchSimplex<6>>*);
template ForceClosure DecideOpenForceClosure<6>(const UnitContacts&, ForceClosureProof<6>*,
                                                WrenchSimplex<6>::Vector*,
                                                std::optional<WrenchSimplex<6>>*);
template Decision DecideOnly<6>(const UnitContacts&, WrenchSimplex<6>::Vector&);

template <int kDim>
FrictionSearch<kDim>::FrictionSearch(UnitContacts contacts)
    : contacts_(std::move(contacts)), first_(0), count_(contacts_.size()) {}

template <int kDim>
FrictionSearch<kDim>::FrictionSearch(UnitContacts contacts, std::size_t finger)
    : contacts_(std::move(contacts)), first_(finger), count_(1) {}

template <int kDim>
Decision FrictionSearch<kDim>::Decide(double friction_angle) {
  if (friction_angle <= refuted_) return Decision::kNo;
  SetRims(friction_angle);
  Twist twist{};
  const Decision decision = DecideAtRims(twist);
  if (decision == Decision::kNo) RefuteUpTo(twist);
  return decision;
}

template <int kDim>
Decision FrictionSearch<kDim>::DecideAlone(double friction_angle) {
  SetRims(friction_angle);
  return DecideForceClosure<kDim>(contacts_).decision;
}

template <int kDim>
void FrictionSearch<kDim>::SetRims(double friction_angle) {
  for (UnitContact& contact : searched()) {
    contact.axial = std::cos(friction_angle);
    contact.tangential = std::sin(friction_angle);
  }
}

template <int kDim>
Decision FrictionSearch<kDim>::DecideAtRims(Twist& twist) {
  using Status = typename WrenchSimplex<kDim>::Status;
  if (simplex_) {
    const Status status = simplex_->Resume(twist);
    if (status == Status::kInfeasible) return Decision::kNo;
    if (status == Status::kFeasible && simplex_->BallRadius() > kForceClosureEpsilon) {
      return Decision::kYes;
    }
  }
  return DecideForceClosure<kDim>(contacts_, nullptr, &twist, &simplex_).decision;
}

template <int kDim>
void FrictionSearch<kDim>::RefuteUpTo(const Twist& twist) {
  double angle = std::numbers::pi / 2;
  for (const UnitContact& contact : searched()) {
    angle = std::min(angle, HeldOffFrictionAngle<kDim>(contact, twist.data()));
  }
  refuted_ = std::max(refuted_, angle - kClearlyRefuted);
}

template class FrictionSearch<3>;
template class FrictionSearch<6>;

namespace {

/// Torque that may be rounding, for lengths and forces of the order of 1. A hundred times the
/// rounding of the cross product, the dot products and the coordinates.
constexpr double kTorqueRounding = 1e-13;

}  // namespace

Turn TurnAboutLine(const UnitContact& a, const UnitContact& b, const UnitContact& c) {
  const Eigen::Vector3d line = b.q - a.q;
  const double length_squared = line.squaredNorm();
  if (length_squared <= kOnLine * kOnLine) return Turn::kUnclear;  // coincident: no line
  const Eigen::Vector3d u = line.cross(c.q - a.q);
  if (u.squaredNorm() <= kOnLine * kOnLine * length_squared) return Turn::kNone;
  const double along = c.n.dot(u);
  const double normal = std::abs(c.axial * along);
  const double sliding_squared = c.tangential * c.tangential * (u - along * c.n).squaredNorm();
  // |normal − sliding| > rounding without a square root: x² − y² = (x − y)(x + y).
  const double difference = normal * normal - sliding_squared;
  if (difference > 2 * kTorqueRounding * normal) {
    return along > 0 ? Turn::kPositive : Turn::kNegative;
  }
  const double sliding = std::sqrt(sliding_squared);
  return sliding - normal > kTorqueRounding ? Turn::kBoth : Turn::kUnclear;
}

bool IsAntipodal(const UnitContact& a, const UnitContact& b) {
  const Eigen::Vector3d d = b.q - a.q;
  const double along_a = a.n.dot(d);
  const double along_b = -b.n.dot(d);
  if (!(along_a * along_b > 0)) return false;
  const double sliding_a = (d - along_a * a.n).norm();
  const double sliding_b = (d + along_b * b.n).norm();
  return a.tangential * std::abs(along_a) - a.axial * sliding_a > kTorqueRounding &&
         b.tangential * std::abs(along_b) - b.axial * sliding_b > kTorqueRounding;
}

PairLineVerdict TestPairLines(std::span<const UnitContact> contacts) {
  bool accepted = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      bool positive = false;
      bool negative = false;
      bool unclear = false;
      for (std::size_t m = 0; m < contacts.size(); ++m) {
        if (m == i || m == j) continue;
        switch (TurnAboutLine(contacts[i], contacts[j], contacts[m])) {
          case Turn::kPositive:
            positive = true;
            break;
          case Turn::kNegative:
            negative = true;
            break;
          case Turn::kBoth:
            positive = negative = true;
            break;
          case Turn::kNone:
            break;
          case Turn::kUnclear:
            unclear = true;
            break;
        }
        if (positive && negative) break;
      }
      if (positive && negative) {
        accepted = accepted || IsAntipodal(contacts[i], contacts[j]);
      } else if (!unclear) {
        return PairLineVerdict::kNo;
      }
    }
  }
  return accepted ? PairLineVerdict::kYes : PairLineVerdict::kOpen;
}

}  // namespace regrasp::grasp
