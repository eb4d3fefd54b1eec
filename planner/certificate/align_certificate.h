#pragma once

#include <optional>

#include "planner/motion/proof_verdict.h"
#include "planner/object/object.h"
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

}  // namespace regrasp::certificate
