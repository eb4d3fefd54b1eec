#include "planner/certificate/align_certificate.h"

#include <algorithm>
#include <utility>

#include "planner/motion/check_motion_proof.h"
#include "planner/motion/path_force_closure.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/projection.h"
#include "planner/plan/reason.h"

namespace regrasp::certificate {

grasp::Grasp ContactsInOrder(const plan::FingerGrasp& grasp, const plan::FingerGrasp& order) {
  grasp::Grasp contacts;
  for (const plan::FingerContact& held : order) {
    const plan::FingerContact* found = plan::FindFinger(grasp, held.finger);
    if (found != nullptr) contacts.push_back(found->contact);
  }
  return contacts;
}

std::optional<motion::MotionSegments> FindPathProof(const grasp::Grasp& from,
                                                    const grasp::Grasp& to, int dimension,
                                                    double friction_angle) {
  if (from.empty() || from.size() != to.size()) return std::nullopt;
  motion::GraspMotion motion;
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  // Force closure does not depend on the frame.
  const object::WrenchFrame frame{Eigen::Vector3d::Zero(), 1, dimension};
  motion::PathForceClosure path = motion::DecidePathForceClosure(motion, frame, friction_angle);
  if (!path.holds()) return std::nullopt;
  return std::move(path.pieces);
}

std::optional<plan::AlignCertificate> FindAlignCertificate(const plan::Align& projected,
                                                           int dimension, double friction_angle) {
  plan::AlignCertificate certificate;
  for (std::size_t w = 0; w + 1 < projected.waypoints.size(); ++w) {
    auto pieces = FindPathProof(plan::ContactsOf(projected.waypoints[w]),
                                ContactsInOrder(projected.waypoints[w + 1], projected.waypoints[w]),
                                dimension, friction_angle);
    if (!pieces) return std::nullopt;
    certificate.push_back(std::move(*pieces));
  }
  return certificate;
}

motion::ProofVerdict CheckAlignCertificate(const plan::Align& projected, int dimension, double mu,
                                           const plan::AlignCertificate& certificate) {
  if (certificate.size() + 1 != projected.waypoints.size()) {
    return {motion::ProofVerdict::Kind::kNothing, "expected one proof per pair of waypoints"};
  }
  for (std::size_t w = 0; w < certificate.size(); ++w) {
    const grasp::Grasp to = ContactsInOrder(projected.waypoints[w + 1], projected.waypoints[w]);
    const motion::ProofVerdict verdict = motion::CheckMotionProof(
        plan::ContactsOf(projected.waypoints[w]), to, dimension, mu, certificate[w]);
    if (!verdict.proves()) {
      return {verdict.kind, "from waypoint " + std::to_string(w) + " on, " + verdict.why};
    }
  }
  return {motion::ProofVerdict::Kind::kForceClosure, ""};
}

void AddCertificates(const object::Object& object, plan::Plan& plan) {
  const plan::Plan projected = plan::ProjectPlan(object, plan);
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    auto* align = std::get_if<plan::Align>(&plan.steps[s]);
    if (align == nullptr || align->certificate) continue;
    align->certificate = FindAlignCertificate(std::get<plan::Align>(projected.steps[s]),
                                              plan.dimension, plan.friction_angle);
  }
}

plan::PlanCheck FinishPlan(const object::ObjectFile& object, const PlanOrigin& origin,
                           plan::Plan& plan) {
  plan.object_file = object.file;
  plan.object_sha256 = object.sha256;
  plan.repair = object.repair;
  plan.shells = origin.shells;
  plan.patch_radius = origin.patch_radius;
  plan.at_given_points = origin.given_points != nullptr;
  plan.friction_angle = origin.friction_angle;
  plan.scale = origin.scale;
  AddCertificates(*object.object, plan);
  plan::CheckOptions options;
  options.given_points = origin.given_points;
  return plan::CheckPlan(*object.object, plan, options);
}

std::vector<std::string> PlanWarnings(const object::Object& object, const plan::PlanCheck& check) {
  std::vector<std::string> warnings;
  const auto failed = std::ranges::find_if(
      check.steps, [](const plan::StepCheck& step) { return step.reason != plan::Reason::kNone; });
  if (failed != check.steps.end()) {
    warnings.push_back("the plan fails the analytic check at step " +
                       std::to_string(failed->index) + ", " + failed->kind + ": " + failed->detail);
  }
  std::string filled = plan::FilledContactsWarning(object, check.projected);
  if (!filled.empty()) warnings.push_back(std::move(filled));
  return warnings;
}

}  // namespace regrasp::certificate
