#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::certificate {

/// Proof that a grasp is force closure or is not, verifiable from contacts and friction only.
/// Lengths and points are in object units, relative to the object's origin.
struct GraspProof {
  enum class Kind {
    kNone,  ///< no proof found
    /// Balanced forces strictly inside the cones; contacts not collinear, or with a torque about
    /// their line.
    kForces,
    kTwist,  ///< twist of the object against which all forces in the cones do work
    /// No contact, or only contacts of one sign, can exert a torque about the line of two contacts.
    kLine,
  };
  Kind kind = Kind::kNone;
  std::vector<Eigen::Vector3d> forces;  ///< kForces: one per contact, balanced up to rounding
  /// Torques about the normals for kForces, one per contact; empty without soft fingers.
  std::vector<double> torques = {};
  /// Twist for kTwist: a point p of the object has the velocity v + ω × p.
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  std::array<int, 2> line = {0, 0};  ///< kLine: the two contacts
};

/// Proofs of one entry of a report: of its final grasp, and of the motions of a sliding step.
struct EntryProof {
  GraspProof rest;
  /// Proofs by pair of consecutive waypoints. Empty if none is found.
  std::vector<motion::MotionSegments> motions;
};

/// Find a proof of force closure or of its opposite.
/// @param dimension   3, or 2 for planar contacts.
/// @param friction_angle  friction angle, radians.
/// @returns kForces if there are forces with slack, otherwise a refutation; kNone for grasps too
///     close to the limit.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] GraspProof FindGraspProof(std::span<const grasp::Contact> contacts, int dimension,
                                        double friction_angle);

}  // namespace regrasp::certificate
