#include "planner/certificate/check_proof.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/motion/exact_balance.h"

namespace regrasp::certificate {

namespace {

using namespace motion::exact;
using VerdictKind = motion::ProofVerdict::Kind;

/// Return whether a soft-finger torque resists rotation about the line to another contact.
bool Twists(const std::vector<ExactContact>& contacts) {
  for (const ExactContact& soft : contacts) {
    if (soft.torsion == 0) continue;
    for (const ExactContact& other : contacts) {
      if (Dot(soft.n, other.p - soft.p) != 0) return true;
    }
  }
  return false;
}

/// Return whether contacts can span all wrenches: three are not collinear (in 2-D: two do not
/// coincide), or Twists.
bool Span(const std::vector<ExactContact>& contacts, int dimension) {
  if (dimension == 3 && Twists(contacts)) return true;
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

motion::ProofVerdict Nothing(std::string why) { return {VerdictKind::kNothing, std::move(why)}; }

/// Return why the torques of a proof are invalid; empty if they are valid.
std::string TorqueFault(const std::vector<ExactContact>& contacts, const GraspProof& proof) {
  if (proof.torques.empty()) return "";
  if (proof.torques.size() != contacts.size()) return "expected one torque per contact";
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!std::isfinite(proof.torques[i])) return "torques must be finite";
    if (contacts[i].torsion == 0 && proof.torques[i] != 0) {
      return "contact " + std::to_string(i) + " is a hard point, expected torque 0";
    }
  }
  return "";
}

/// Return (torque / torsion)² of a torque times the normal.
Rational TwistSquared(const ExactContact& contact, const Rational& torque) {
  if (contact.torsion == 0) return 0;
  return torque * torque * SquaredNorm(contact.n) / (contact.torsion * contact.torsion);
}

motion::ProofVerdict CheckForces(const std::vector<ExactContact>& contacts, int dimension,
                                 const Rational& mu, const GraspProof& proof) {
  if (proof.forces.size() != contacts.size()) return Nothing("expected one force per contact");
  if (!AllFinite(proof.forces)) return Nothing("forces must be finite");
  if (const std::string fault = TorqueFault(contacts, proof); !fault.empty()) return Nothing(fault);
  if (!Span(contacts, dimension)) return Nothing("the contacts are collinear");
  const Layout layout(dimension);
  const int count = static_cast<int>(contacts.size());
  const int first_torque = dimension * count;
  const bool twist = !proof.torques.empty();
  Balance balance(dimension + layout.torques, first_torque + (twist ? count : 0));
  std::vector<Rational> x;
  layout.Append(proof.forces, x);
  for (int i = 0; i < count; ++i) {
    layout.AddForces(0, i * dimension, balance);
    layout.AddTorques(contacts[i].p, dimension, i * dimension, balance);
    if (!twist) continue;
    x.emplace_back(proof.torques[i]);
    if (contacts[i].torsion == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      balance.At(dimension + axis, first_torque + i) = contacts[i].n[axis];
    }
  }
  const auto balanced = balance.Corrected(x);
  if (!balanced) return Nothing("the forces cannot be balanced exactly");
  for (int i = 0; i < count; ++i) {
    const Rational torque = twist ? (*balanced)[first_torque + i] : Rational(0);
    if (!IsInsideCone(layout.Force(*balanced, i * dimension), contacts[i].n, mu, Rational(0),
                      TwistSquared(contacts[i], torque))) {
      return Nothing("the force at contact " + std::to_string(i) +
                     ", balanced exactly, is not inside its cone");
    }
  }
  return {VerdictKind::kForceClosure, ""};
}

/// Check whether velocities refute force closure: all are in the polar cones, with the spins n·ω of
/// soft-finger contacts.
motion::ProofVerdict CheckVelocities(const std::vector<ExactContact>& contacts,
                                     const std::vector<Vector>& velocities, const Vector& omega,
                                     const Rational& mu) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector& u = velocities[i];
    const Vector& n = contacts[i].n;
    const Rational turning = contacts[i].torsion * Dot(n, omega);
    if (IsZero(u) && turning == 0) continue;
    const Rational approach = Dot(n, u);
    if (approach >= 0 || approach * approach * (1 + mu * mu) <
                             mu * mu * (Dot(u, u) * Dot(n, n) + turning * turning)) {
      return Nothing("a force in the cone of contact " + std::to_string(i) +
                     " has positive power with the twist");
    }
  }
  return {VerdictKind::kNotForceClosure, ""};
}

motion::ProofVerdict CheckTwist(const std::vector<ExactContact>& contacts, const Rational& mu,
                                const Vector& v, const Vector& omega) {
  if (IsZero(v) && IsZero(omega)) return Nothing("the twist must not be zero");
  std::vector<Vector> velocities;
  for (const ExactContact& contact : contacts) velocities.push_back(v + Cross(omega, contact.p));
  return CheckVelocities(contacts, velocities, omega, mu);
}

/// Check the rotation about the line of two contacts, in both directions.
motion::ProofVerdict CheckLine(const std::vector<ExactContact>& contacts, const Rational& mu,
                               const std::array<int, 2>& line) {
  const int count = static_cast<int>(contacts.size());
  if (line[0] < 0 || line[1] < 0 || line[0] >= count || line[1] >= count) {
    return Nothing("the line has contacts that do not exist");
  }
  const Vector& a = contacts[line[0]].p;
  for (const int sign : {1, -1}) {
    const Vector omega = Rational(sign) * (contacts[line[1]].p - a);
    const motion::ProofVerdict verdict = CheckTwist(contacts, mu, Cross(a, omega), omega);
    if (verdict.kind == VerdictKind::kNotForceClosure) return verdict;
  }
  return Nothing("neither rotation about the line of contacts " + std::to_string(line[0]) +
                 " and " + std::to_string(line[1]) + " refutes force closure");
}

}  // namespace

motion::ProofVerdict CheckGraspProof(std::span<const grasp::Contact> contacts, int dimension,
                                     double mu, const GraspProof& proof) {
  const std::vector<ExactContact> exact = Exact(contacts);
  switch (proof.kind) {
    case GraspProof::Kind::kForces:
      return CheckForces(exact, dimension, mu, proof);
    case GraspProof::Kind::kTwist:
      if (!proof.v.allFinite() || !proof.omega.allFinite())
        return Nothing("the twist must be finite");
      return CheckTwist(exact, mu, Exact(proof.v), Exact(proof.omega));
    case GraspProof::Kind::kLine:
      return CheckLine(exact, mu, proof.line);
    case GraspProof::Kind::kNone:
      break;
  }
  return Nothing("proof not found");
}

}  // namespace regrasp::certificate
