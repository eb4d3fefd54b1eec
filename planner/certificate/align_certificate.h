#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/motion/motion_segment.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::certificate {

/// The contacts of the fingers of `order`, in its order; fewer where a finger is missing.
[[nodiscard]] grasp::Grasp ContactsInOrder(const plan::FingerGrasp& grasp,
                                           const plan::FingerGrasp& order);

/// A proof of force closure all along the motion from one waypoint to the next: the one by which
/// the analytic check passes it (DecidePathForceClosure), nullopt where that does not.
/// @param from, to    the contacts of each finger at the same place.
/// @param half_angle  radians.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] std::optional<motion::MotionSegments> FindPathProof(const grasp::Grasp& from,
                                                                  const grasp::Grasp& to,
                                                                  int dimension, double half_angle);

/// Proofs of force closure all along an align, for each pair of waypoints that follow each other;
/// nullopt where FindPathProof finds none for one of them.
/// @param located  its contacts placed on the object. @param half_angle  radians.
[[nodiscard]] std::optional<plan::AlignCertificate> FindAlignCertificate(const plan::Align& located,
                                                                         int dimension,
                                                                         double half_angle);

/// Checks in exact arithmetic that proofs hold for an align (CheckMotionProof).
/// @returns kForceClosure, or kNothing with the first motion that is not proved.
[[nodiscard]] motion::ProofVerdict CheckAlignCertificate(const plan::Align& located, int dimension,
                                                         double mu,
                                                         const plan::AlignCertificate& certificate);

/// Gives every align of a plan that has no certificate one, where it is found.
void AddCertificates(const object::Object& object, plan::Plan& plan);

/// What a plan says of where it comes from, besides what the planner knows.
struct PlanOrigin {
  double half_angle = 0;                                ///< of the friction that is there, radians
  double scale = 1;                                     ///< metres per unit of the object
  std::optional<object::Shells> shells = std::nullopt;  ///< as it was read with
  std::optional<double> patch_radius = std::nullopt;    ///< of what a fingertip feels, its unit
  /// Of contacts at these points only; outlives the call.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
};

/// Makes a planner's plan one that stands alone: says what it is a plan for, adds the proofs of its
/// aligns, and asks the checker.
/// @returns what the checker says; a plan that it fails is a defect of the planner.
[[nodiscard]] plan::PlanCheck FinishPlan(const object::ObjectFile& object, const PlanOrigin& origin,
                                         plan::Plan& plan);

}  // namespace regrasp::certificate
