#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace regrasp::motion {

/// What exact arithmetic says of a proof.
struct ProofVerdict {
  enum class Kind {
    kForceClosure,     ///< proved
    kNotForceClosure,  ///< refuted
    kNothing,          ///< the proof proves neither
  };
  Kind kind = Kind::kNothing;
  std::string why;  ///< of kNothing, for people

  /// Force closure is proved.
  [[nodiscard]] bool proves() const { return kind == Kind::kForceClosure; }
};

/// Why a grasp is force closure everywhere on a piece of a motion of its contacts: forces that go
/// linearly from `start` to `end`, one a contact, balanced throughout up to rounding and inside
/// the cones of both ends. A force between two of a cone is in the cone. Lengths and points are in
/// the object's unit, about its origin; forces have any unit.
struct MotionSegment {
  double from = 0;  ///< share of the motion between two waypoints, 0 to 1
  double to = 1;
  std::vector<Eigen::Vector3d> start;
  std::vector<Eigen::Vector3d> end;
  /// Of soft fingers the torques about the normals, which go linearly too; empty where none twists.
  std::vector<double> start_torques = {};
  std::vector<double> end_torques = {};
};

/// The segments of one motion between two waypoints, from 0 to 1.
using MotionSegments = std::vector<MotionSegment>;

}  // namespace regrasp::motion
