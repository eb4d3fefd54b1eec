#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planner/motion/motion_segment.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::certificate {

/// Return the contacts of the fingers in `order`, in its order. Missing fingers are skipped.
[[nodiscard]] grasp::Grasp ContactsInOrder(const plan::FingerGrasp& grasp,
                                           const plan::FingerGrasp& order);

/// Find a proof of force closure during the motion between two waypoints.
/// It is the certificate of the analytic check (DecidePathForceClosure).
/// @param from, to    contacts at both waypoints, with the same finger at each index.
/// @param friction_angle  friction angle, radians.
/// @returns nullopt if the analytic check does not accept the motion.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] std::optional<motion::MotionSegments> FindPathProof(const grasp::Grasp& from,
                                                                  const grasp::Grasp& to,
                                                                  int dimension,
                                                                  double friction_angle);

/// Find proofs of force closure during a sliding step, one per pair of consecutive waypoints.
/// @param located  sliding step with contacts placed on the object.
/// @param friction_angle  friction angle, radians.
/// @returns nullopt if FindPathProof finds none for a pair.
[[nodiscard]] std::optional<plan::AlignCertificate> FindAlignCertificate(
    const plan::Align& projected, int dimension, double friction_angle);

/// Check the proofs of a sliding step in exact arithmetic (CheckMotionProof).
/// @returns kForceClosure, or kNothing with the first unproved motion.
[[nodiscard]] motion::ProofVerdict CheckAlignCertificate(const plan::Align& projected,
                                                         int dimension, double mu,
                                                         const plan::AlignCertificate& certificate);

/// Add a certificate to every sliding step of a plan that has none, if one is found.
void AddCertificates(const object::Object& object, plan::Plan& plan);

/// Origin of a plan, in addition to the planner's own data.
struct PlanOrigin {
  double friction_angle = 0;                            ///< friction angle, radians
  double scale = 1;                                     ///< metres per object unit
  std::optional<object::Shells> shells = std::nullopt;  ///< how the object was read
  std::optional<double> patch_radius = std::nullopt;  ///< radius of the contact patch, object units
  /// Points to which contacts are restricted, null for none. Outlives the call.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
};

/// Complete a planner's plan so that its file is self-contained.
/// Adds the origin and the certificates of sliding steps, and runs the checker.
/// @returns the checker's result. A failure is a defect of the planner.
[[nodiscard]] plan::PlanCheck FinishPlan(const object::ObjectFile& object, const PlanOrigin& origin,
                                         plan::Plan& plan);

/// Return the warnings of a finished plan: a failed check, and contacts on filled surface.
/// @param check  result of FinishPlan.
[[nodiscard]] std::vector<std::string> PlanWarnings(const object::Object& object,
                                                    const plan::PlanCheck& check);

}  // namespace regrasp::certificate
