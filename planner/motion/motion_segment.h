#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace regrasp::motion {

/// Verdict of exact arithmetic on a proof.
struct ProofVerdict {
  enum class Kind {
    kForceClosure,     ///< proved
    kNotForceClosure,  ///< refuted
    kNothing,          ///< neither proved nor refuted
  };
  Kind kind = Kind::kNothing;
  std::string why;  ///< reason of kNothing, for messages

  /// Whether force closure is proved.
  [[nodiscard]] bool proves() const { return kind == Kind::kForceClosure; }
};

/// Proof that a grasp is force closure throughout a piece of a motion of its contacts.
/// Forces are linear from `start` to `end`, one per contact, balanced throughout up to rounding and
/// inside the cones of both ends. A force between two forces of a cone is in the cone. Lengths and
/// points are in the object's unit, about its origin; forces have any unit.
struct MotionSegment {
  double from = 0;  ///< share of the motion between two waypoints, 0 to 1
  double to = 1;
  std::vector<Eigen::Vector3d> start;
  std::vector<Eigen::Vector3d> end;
  /// Torques of soft fingers about the normals, also linear; empty if there are none.
  std::vector<double> start_torques = {};
  std::vector<double> end_torques = {};
};

/// Segments of one motion between two waypoints, from 0 to 1.
using MotionSegments = std::vector<MotionSegment>;

}  // namespace regrasp::motion
