#include "planner/certificate/align_certificate.h"

#include <algorithm>

#include "planner/motion/check_motion_proof.h"
#include "planner/motion/path_force_closure.h"
#include "planner/plan/locate.h"

namespace regrasp {

Grasp ContactsInOrder(const FingerGrasp& grasp, const FingerGrasp& order) {
  Grasp contacts;
  for (const FingerContact& held : order) {
    const auto found = std::ranges::find(grasp, held.finger, &FingerContact::finger);
    if (found != grasp.end()) contacts.push_back(found->contact);
  }
  return contacts;
}

std::optional<MotionSegments> FindPathProof(const Grasp& from, const Grasp& to, int dimension,
                                            double half_angle) {
  if (from.empty() || from.size() != to.size()) return std::nullopt;
  GraspMotion motion;
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  // Force closure does not depend on the frame.
  const WrenchFrame frame{Eigen::Vector3d::Zero(), 1, dimension};
  PathForceClosure path = DecidePathForceClosure(motion, frame, half_angle);
  if (!path.holds()) return std::nullopt;
  return std::move(path.pieces);
}

std::optional<AlignCertificate> FindAlignCertificate(const Align& located, int dimension,
                                                     double half_angle) {
  AlignCertificate certificate;
  for (std::size_t w = 0; w + 1 < located.waypoints.size(); ++w) {
    auto pieces = FindPathProof(ContactsOf(located.waypoints[w]),
                                ContactsInOrder(located.waypoints[w + 1], located.waypoints[w]),
                                dimension, half_angle);
    if (!pieces) return std::nullopt;
    certificate.push_back(std::move(*pieces));
  }
  return certificate;
}

ProofVerdict CheckAlignCertificate(const Align& located, int dimension, double mu,
                                   const AlignCertificate& certificate) {
  if (certificate.size() + 1 != located.waypoints.size()) {
    return {ProofVerdict::Kind::kNothing, "not one proof for each pair of waypoints"};
  }
  for (std::size_t w = 0; w < certificate.size(); ++w) {
    const Grasp to = ContactsInOrder(located.waypoints[w + 1], located.waypoints[w]);
    const ProofVerdict verdict =
        CheckMotionProof(ContactsOf(located.waypoints[w]), to, dimension, mu, certificate[w]);
    if (!verdict.proves()) {
      return {verdict.kind, "from waypoint " + std::to_string(w) + " on, " + verdict.why};
    }
  }
  return {ProofVerdict::Kind::kForceClosure, ""};
}

void AddCertificates(const Object& object, Plan& plan) {
  const Plan located = LocatePlan(object, plan);
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    auto* align = std::get_if<Align>(&plan.steps[s]);
    if (align == nullptr || align->certificate) continue;
    align->certificate =
        FindAlignCertificate(std::get<Align>(located.steps[s]), plan.dimension, plan.half_angle);
  }
}

}  // namespace regrasp
