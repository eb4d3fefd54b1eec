#include "planner/motion/find_motion_proof.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/motion/moving_forces.h"

namespace regrasp::motion {

ContactMotion::ContactMotion(const grasp::Contact& from, const grasp::Contact& to)
    : from_(from), to_(to), turn_(grasp::AngleBetween(from.n, to.n)) {
  turn_direction_ = (to.n - to.n.dot(from.n) * from.n).stableNormalized();
}

grasp::Contact ContactMotion::At(double t) const {
  const Eigen::Vector3d normal =
      std::cos(t * turn_) * from_.n + std::sin(t * turn_) * turn_direction_;
  return {(1 - t) * from_.p + t * to_.p, normal.normalized(), t < 1 ? from_.face : to_.face,
          from_.torsion};
}

grasp::Grasp GraspAt(const GraspMotion& motion, double t) {
  grasp::Grasp grasp;
  grasp.reserve(motion.size());
  for (const ContactMotion& contact : motion) grasp.push_back(contact.At(t));
  return grasp;
}

namespace {

using Eigen::Vector3d;

/// Limits on how close to the limit of force closure the search goes.
struct Nearness {
  double largest_weight;  ///< parameter of FindMovingForces
  /// Distance of forces from the cone's border, over the largest force. It covers the exact
  /// correction of their rounding, and the rounding of decimals in files.
  double slack;
  /// Whether to retry without redundant equations if nothing is found, which doubles the time.
  bool without_redundancy;
};
constexpr Nearness kForPlans = {kLargestWeight, 1e-9, false};
/// Limits for the analytic check, in which a piece counts only if exact arithmetic accepts it
/// unchanged.
constexpr Nearness kForChecks = {kLargestWeightNearLimit, 1e-13, true};

/// Angle by which the cones of turning normals are narrower, radians: more than the exact check
/// subtracts.
constexpr double kTurnRoom = 4 * kTurnedNormalBound;

/// Instants that are tested if the whole motion has no proof in one piece, the most informative
/// first. If one is not force closure, there is no proof.
constexpr std::array kProbes = {0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875, 0.0, 1.0};
constexpr double kBetweenProbes = 0.125;

/// Least one-sided component of the cross product of two sides with which three contacts span a
/// plane, in the frame of the piece.
constexpr double kSpread = 1e-9;

/// Part of a motion from t = from to t = to.
struct Piece {
  double from;
  double to;

  [[nodiscard]] double middle() const { return from + (to - from) / 2; }
};

template <int kSpace>
class MotionProofSearch {
 public:
  MotionProofSearch(const GraspMotion& motion, double friction_angle, const Nearness& nearness)
      : motion_(motion), friction_angle_(friction_angle), nearness_(nearness) {}

  /// Find proofs of consecutive pieces.
  /// @param shortest  length of the shortest pieces.
  std::optional<std::vector<MotionSegment>> Find(double shortest) {
    std::vector<MotionSegment> pieces;
    if (!Cover({0, 1}, shortest, pieces)) return std::nullopt;
    return pieces;
  }

  [[nodiscard]] std::optional<MotionSegment> Prove(const Piece& piece) const {
    const MovingContacts contacts = ContactsOn(piece);
    if (contacts.empty() || !Span(contacts)) return std::nullopt;
    MovingForces<1> forces;
    MovingTorques<1> torques;
    if (!FindForces(contacts, forces, torques)) return std::nullopt;
    MotionSegment proved{piece.from, piece.to, {}, {}};
    proved.start.reserve(forces.size());
    proved.end.reserve(forces.size());
    for (const ForceCoefficients<1>& coefficients : forces) {
      proved.start.push_back(coefficients[0]);
      proved.end.push_back(coefficients[1]);
    }
    if (std::ranges::any_of(contacts, [](const auto& c) { return c.torsion > 0; })) {
      AddTorques(contacts, torques, proved);
    }
    return proved;
  }

 private:
  static constexpr int kDim = kSpace == 3 ? 6 : 3;

  /// Convert torques from the unit of length of the piece's frame to that of the motion.
  void AddTorques(const MovingContacts& contacts, const MovingTorques<1>& torques,
                  MotionSegment& proved) const {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const double torsion = contacts[i].torsion;
      const double unit = torsion > 0 ? motion_[i].from().torsion / torsion : 0;
      proved.start_torques.push_back(unit * torques[i][0]);
      proved.end_torques.push_back(unit * torques[i][1]);
    }
  }

  bool Cover(const Piece& piece, double shortest, std::vector<MotionSegment>& pieces) const {
    if (auto proved = Prove(piece)) {
      pieces.push_back(*std::move(proved));
      return true;
    }
    const double length = piece.to - piece.from;
    if (length < 2 * shortest) return false;
    if (length == 1 && !std::all_of(kProbes.begin(), kProbes.end(),
                                    [this](double t) { return IsForceClosureAt(t); })) {
      return false;
    }
    if (length <= kBetweenProbes && !IsForceClosureAt(piece.middle())) return false;
    return Cover({piece.from, piece.middle()}, shortest, pieces) &&
           Cover({piece.middle(), piece.to}, shortest, pieces);
  }

  [[nodiscard]] static Vector3d PointAt(const ContactMotion& contact, double t) {
    return (1 - t) * contact.from().p + t * contact.to().p;
  }
  [[nodiscard]] static bool Turns(const ContactMotion& contact) {
    return contact.from().n != contact.to().n;
  }
  [[nodiscard]] static Vector3d NormalAt(const ContactMotion& contact, double t) {
    return Turns(contact) ? contact.At(t).n : contact.from().n;
  }

  [[nodiscard]] bool IsForceClosureAt(double t) const {
    grasp::UnitContacts contacts;
    for (const ContactMotion& contact : motion_) {
      contacts.push_back({PointAt(contact, t), NormalAt(contact, t), 0, 0, contact.from().torsion});
    }
    grasp::Recentre(contacts);
    grasp::SetUnitForces(contacts, friction_angle_);
    return grasp::DecideForceClosure<kDim>(contacts).decision == grasp::Decision::kYes;
  }

  /// Return the contacts on a piece; empty if a normal turns too far for its cones to intersect.
  [[nodiscard]] MovingContacts ContactsOn(const Piece& piece) const {
    Vector3d start_centre = Vector3d::Zero();
    Vector3d end_centre = Vector3d::Zero();
    Vector3d velocity = Vector3d::Zero();
    MovingContacts contacts;
    for (const ContactMotion& contact : motion_) {
      double angle = friction_angle_;
      if (Turns(contact)) angle -= contact.turn() * (piece.to - piece.from) / 2 + kTurnRoom;
      if (!(angle > 0)) return {};
      contacts.push_back({PointAt(contact, piece.from), PointAt(contact, piece.to),
                          contact.velocity(), NormalAt(contact, piece.middle()), std::cos(angle),
                          std::sin(angle), Turns(contact) ? 0 : contact.from().torsion});
      start_centre += contacts.back().start;
      end_centre += contacts.back().end;
      velocity += contacts.back().velocity;
    }
    // Torques of balanced forces are the same about every point, including a moving one.
    const double share = 1 / static_cast<double>(motion_.size());
    double radius = 0;
    for (MovingContact& contact : contacts) {
      contact.start -= share * start_centre;
      contact.end -= share * end_centre;
      contact.velocity -= share * velocity;
      radius = std::max({radius, contact.start.norm(), contact.end.norm()});
    }
    if (!(radius > 0)) return {};
    for (MovingContact& contact : contacts) {
      contact.start /= radius;
      contact.end /= radius;
      contact.torsion /= radius;
    }
    return contacts;
  }

  bool FindForces(const MovingContacts& contacts, MovingForces<1>& forces,
                  MovingTorques<1>& torques) const {
    const double most = nearness_.largest_weight;
    if (FindMovingForces<kSpace, 1>(contacts, forces, most, &torques) &&
        AreInside(forces, torques, contacts)) {
      return true;
    }
    return nearness_.without_redundancy &&
           FindMovingForcesWithoutRedundancy<kSpace>(contacts, forces, most, &torques) &&
           AreInside(forces, torques, contacts);
  }

  [[nodiscard]] bool AreInside(const MovingForces<1>& forces, const MovingTorques<1>& torques,
                               const MovingContacts& contacts) const {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      for (const int end : {0, 1}) {
        if (!IsInside(forces[i][end], torques[i][end], contacts[i])) return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool IsInside(const Vector3d& force, double torque,
                              const MovingContact& contact) const {
    const double normal = force.dot(contact.n);
    double tangential = (force - normal * contact.n).norm();
    if (torque != 0) tangential = std::hypot(tangential, torque / contact.torsion);
    return normal * contact.tangential - tangential * contact.axial > nearness_.slack;
  }

  /// Return whether a soft finger resists a turn about the line of some two contacts throughout.
  [[nodiscard]] static bool TwistSpans(const MovingContacts& contacts) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i].torsion == 0) continue;
      for (std::size_t j = 0; j < contacts.size(); ++j) {
        const double start = contacts[i].n.dot(contacts[j].start - contacts[i].start);
        const double end = contacts[i].n.dot(contacts[j].end - contacts[i].end);
        if (std::min(start, end) > kSpread || std::max(start, end) < -kSpread) return true;
      }
    }
    return false;
  }

  /// Return whether some three contacts (two in the plane) never become collinear (coincide).
  /// A soft finger may replace the third contact.
  [[nodiscard]] static bool Span(const MovingContacts& contacts) {
    if (TwistSpans(contacts)) return true;
    const std::size_t count = contacts.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        const Vector3d a0 = contacts[j].start - contacts[i].start;
        const Vector3d a1 = contacts[j].end - contacts[i].end;
        if constexpr (kSpace == 2) {
          if (std::min(a0.dot(a0 + a1), a1.dot(a0 + a1)) > kSpread) return true;
        }
        for (std::size_t k = j + 1; kSpace == 3 && k < count; ++k) {
          const Vector3d b0 = contacts[k].start - contacts[i].start;
          const Vector3d b1 = contacts[k].end - contacts[i].end;
          const Vector3d first = a0.cross(b0);
          const Vector3d middle = a0.cross(b1) + a1.cross(b0);
          const Vector3d last = a1.cross(b1);
          const Vector3d side = first + middle + last;
          if (std::min({first.dot(side), middle.dot(side), last.dot(side)}) > kSpread) return true;
        }
      }
    }
    return false;
  }

  const GraspMotion& motion_;
  double friction_angle_;
  Nearness nearness_;
};

/// Return whether a proof is possible at all.
bool CanBeProved(const GraspMotion& motion) {
  const auto flips = [](const ContactMotion& contact) { return contact.turn() > kMostTurn; };
  return !motion.empty() && std::none_of(motion.begin(), motion.end(), flips);
}

}  // namespace

std::optional<MotionSegment> FindSegmentProof(const GraspMotion& motion, int dimension,
                                              double friction_angle, double from, double to) {
  grasp::CheckFrictionAngle(friction_angle);
  if (!CanBeProved(motion)) return std::nullopt;
  const Piece piece{from, to};
  return dimension == 3 ? MotionProofSearch<3>(motion, friction_angle, kForChecks).Prove(piece)
                        : MotionProofSearch<2>(motion, friction_angle, kForChecks).Prove(piece);
}

std::optional<std::vector<MotionSegment>> FindMotionProof(const GraspMotion& motion, int dimension,
                                                          double friction_angle, double shortest) {
  grasp::CheckFrictionAngle(friction_angle);
  if (!CanBeProved(motion)) return std::nullopt;
  return dimension == 3 ? MotionProofSearch<3>(motion, friction_angle, kForPlans).Find(shortest)
                        : MotionProofSearch<2>(motion, friction_angle, kForPlans).Find(shortest);
}

}  // namespace regrasp::motion
