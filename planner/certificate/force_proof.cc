#include "planner/certificate/force_proof.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::certificate {

namespace {

using Eigen::Vector3d;

/// Relative distance of forces from the cone's boundary, so that the exact correction of rounding
/// errors keeps them inside.
constexpr double kSlack = 1e-9;

bool IsInside(const Vector3d& force, double torque, const grasp::Contact& contact,
              double friction_angle) {
  const double normal = force.dot(contact.n);
  double tangential = (force - normal * contact.n).norm();
  if (torque != 0) tangential = std::hypot(tangential, torque / contact.torsion);
  const double inside = normal * std::sin(friction_angle) - tangential * std::cos(friction_angle);
  return inside > kSlack * (1 + force.norm());
}

object::WrenchFrame OwnFrame(std::span<const grasp::Contact> contacts, int dimension) {
  return grasp::ContactFrame(contacts, dimension);
}

/// Return a refutation by the line of two contacts; kNone if there is none.
GraspProof FindLine(const grasp::UnitContacts& contacts) {
  const int count = static_cast<int>(contacts.size());
  GraspProof proof;
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      bool positive = false;
      bool negative = false;
      bool other = false;
      for (int c = 0; c < count; ++c) {
        if (c == a || c == b) continue;
        const grasp::Turn turn = grasp::TurnAboutLine(contacts[a], contacts[b], contacts[c]);
        positive = positive || turn == grasp::Turn::kPositive;
        negative = negative || turn == grasp::Turn::kNegative;
        other = other || turn == grasp::Turn::kBoth || turn == grasp::Turn::kUnclear;
      }
      if (other || (positive && negative)) continue;
      proof.kind = GraspProof::Kind::kLine;
      proof.line = {a, b};
      return proof;
    }
  }
  return proof;
}

/// Transform a twist from the contacts' frame to object coordinates.
template <int kDim>
GraspProof TwistProof(const typename grasp::WrenchSimplex<kDim>::Vector& twist,
                      const object::WrenchFrame& frame) {
  GraspProof proof;
  proof.kind = GraspProof::Kind::kTwist;
  if constexpr (kDim == 6) {
    proof.omega = Vector3d(twist[3], twist[4], twist[5]) / frame.radius;
    proof.v = Vector3d(twist[0], twist[1], twist[2]) - proof.omega.cross(frame.origin);
  } else {
    proof.omega = Vector3d(0, 0, twist[2]) / frame.radius;
    proof.v = Vector3d(twist[0], twist[1], 0) - proof.omega.cross(frame.origin);
  }
  return proof;
}

template <int kDim>
GraspProof FindRefutation(std::span<const grasp::Contact> contacts,
                          const object::WrenchFrame& frame, double friction_angle) {
  grasp::UnitContacts units = grasp::MakeUnitContacts(contacts, frame);
  grasp::SetUnitForces(units, friction_angle);
  if constexpr (kDim == 6) {
    // Soft-finger contacts on the line can resist a rotation about it.
    const GraspProof line = grasp::HasTorsion(units) ? GraspProof() : FindLine(units);
    if (line.kind != GraspProof::Kind::kNone) return line;
  }
  grasp::ForceClosureProof<kDim> found;
  const grasp::ForceClosure answer = grasp::DecideForceClosure<kDim>(units, &found);
  const bool has_twist =
      std::any_of(found.twist.begin(), found.twist.end(), [](double x) { return x != 0; });
  if (answer.decision != grasp::Decision::kNo || !has_twist) return {};
  return TwistProof<kDim>(found.twist, frame);
}

bool HaveTorsion(std::span<const grasp::Contact> contacts) {
  return std::ranges::any_of(contacts, [](const grasp::Contact& c) { return c.torsion > 0; });
}

/// Return whether all contacts are collinear; then no force resists a rotation about their line.
bool AreOnOneLine(std::span<const grasp::Contact> contacts, const object::WrenchFrame& frame) {
  double farthest = 0;
  for (const grasp::Contact& a : contacts) {
    for (const grasp::Contact& b : contacts) {
      farthest = std::max(farthest, (a.p - contacts[0].p).cross(b.p - contacts[0].p).norm());
    }
  }
  return farthest <= grasp::kOnLine * frame.radius * frame.radius;
}

}  // namespace

GraspProof FindGraspProof(std::span<const grasp::Contact> contacts, int dimension,
                          double friction_angle) {
  const object::WrenchFrame frame = OwnFrame(contacts, dimension);
  grasp::CheckFrictionAngle(friction_angle);
  if (!(frame.radius > 0)) return {};
  const grasp::GraspForces internal =
      grasp::ComputeGraspForces(contacts, frame, friction_angle, grasp::Wrench(), 1);
  const bool soft = HaveTorsion(contacts);
  bool inside = internal.balanced && internal.margin > 0 &&
                !(dimension == 3 && !soft && AreOnOneLine(contacts, frame));
  for (std::size_t i = 0; inside && i < contacts.size(); ++i) {
    inside = IsInside(internal.forces[i], internal.torques[i], contacts[i], friction_angle);
  }
  if (inside) {
    GraspProof proof;
    proof.kind = GraspProof::Kind::kForces;
    proof.forces = internal.forces;
    if (soft) proof.torques = internal.torques;
    return proof;
  }
  return dimension == 3 ? FindRefutation<6>(contacts, frame, friction_angle)
                        : FindRefutation<3>(contacts, frame, friction_angle);
}

}  // namespace regrasp::certificate
