#include "planner/certificate/check_proof.h"

#include <algorithm>
#include <array>

#include "planner/motion/exact_balance.h"

namespace regrasp::certificate {

namespace {

using namespace motion::exact;
using Kind = motion::ProofVerdict::Kind;

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

motion::ProofVerdict Nothing(std::string why) { return {Kind::kNothing, std::move(why)}; }

motion::ProofVerdict CheckForces(const std::vector<ExactContact>& contacts, int dimension,
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
  const auto balanced = balance.Corrected(x);
  if (!balanced) return Nothing("the forces cannot be balanced exactly");
  for (int i = 0; i < count; ++i) {
    if (!IsInsideCone(layout.Force(*balanced, i * dimension), contacts[i].n, mu)) {
      return Nothing("the force at contact " + std::to_string(i) +
                     ", balanced exactly, is not inside its cone");
    }
  }
  return {Kind::kForceClosure, ""};
}

/// Whether velocities refute: all are in the polar cones.
motion::ProofVerdict CheckVelocities(const std::vector<ExactContact>& contacts,
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

motion::ProofVerdict CheckTwist(const std::vector<ExactContact>& contacts, const Rational& mu,
                                const Vector& v, const Vector& omega) {
  if (IsZero(v) && IsZero(omega)) return Nothing("the twist is zero");
  std::vector<Vector> velocities;
  for (const ExactContact& contact : contacts) velocities.push_back(v + Cross(omega, contact.p));
  return CheckVelocities(contacts, velocities, mu);
}

/// The turn about the line through two contacts, with one sign or the other.
motion::ProofVerdict CheckLine(const std::vector<ExactContact>& contacts, const Rational& mu,
                               const std::array<int, 2>& line) {
  const int count = static_cast<int>(contacts.size());
  if (line[0] < 0 || line[1] < 0 || line[0] >= count || line[1] >= count) {
    return Nothing("the line is through contacts that are none");
  }
  const Vector& a = contacts[line[0]].p;
  for (const int sign : {1, -1}) {
    const Vector omega = Rational(sign) * (contacts[line[1]].p - a);
    const motion::ProofVerdict verdict = CheckTwist(contacts, mu, Cross(a, omega), omega);
    if (verdict.kind == Kind::kNotForceClosure) return verdict;
  }
  return Nothing("about the line of contacts " + std::to_string(line[0]) + " and " +
                 std::to_string(line[1]) + " the others turn the object both ways");
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
        return Nothing("the twist is not finite");
      return CheckTwist(exact, mu, Exact(proof.v), Exact(proof.omega));
    case GraspProof::Kind::kLine:
      return CheckLine(exact, mu, proof.line);
    case GraspProof::Kind::kNone:
      break;
  }
  return Nothing("there is no proof");
}

}  // namespace regrasp::certificate
