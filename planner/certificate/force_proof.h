#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::certificate {

/// Why a grasp is force closure, or why it is not: numbers that anyone can check with the contacts
/// and the friction alone. Lengths and points are in the object's unit, about its origin.
struct GraspProof {
  enum class Kind {
    kNone,    ///< none was found
    kForces,  ///< balanced forces strictly inside the cones, and contacts that are not on one line,
              ///< or a soft finger that resists a turn about it
    kTwist,   ///< a motion of the object that all forces in the cones work against
    kLine,  ///< about the line through two contacts all others turn the object the same way, or not
  };
  Kind kind = Kind::kNone;
  std::vector<Eigen::Vector3d> forces;  ///< kForces: one a contact, balanced up to rounding
  /// kForces, of soft fingers: with the forces, about the normals; empty where there are none.
  std::vector<double> torques = {};
  /// kTwist: velocities v + ω × p of points of the object; (v, ω).
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  std::array<int, 2> line = {0, 0};  ///< kLine: the two contacts
};

/// The proofs of one entry of a report: of the grasp that it ends in, and of an align's motions.
struct EntryProof {
  GraspProof rest;
  /// By pair of waypoints that follow each other; empty where no proof was found.
  std::vector<motion::MotionSegments> motions;
};

/// A proof of force closure where there is one with slack, otherwise of the opposite; kNone for
/// grasps too close to the limit.
/// @param dimension   3, or 2 for planar contacts. @param half_angle  radians.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] GraspProof FindGraspProof(std::span<const grasp::Contact> contacts, int dimension,
                                        double half_angle);

}  // namespace regrasp::certificate
