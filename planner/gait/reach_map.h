#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/gait/hand_scene.h"
#include "planner/gait/pose_track.h"
#include "planner/grasp/contact.h"
#include "planner/kinematics/inverse_kinematics.h"

namespace regrasp::gait {

/// A contact of the object in its own frame, metres.
struct SurfacePoint {
  Eigen::Vector3d p;
  Eigen::Vector3d n;  ///< inward, of length 1
};

/// What a finger is asked for at a contact: the centre of its ball is one radius outside.
/// @param pose  of the object in the palm's frame.
[[nodiscard]] kinematics::TipTarget TargetAt(const kinematics::Finger& finger,
                                             const SurfacePoint& contact,
                                             const Eigen::Isometry3d& pose);

/// Which fingers can be at which contacts, and how they stand there, for the poses of a track: the
/// finger alone, whatever the others do. Worked out when first asked for.
class ReachMap {
 public:
  /// @param scene, inverse, points, track  outlive this object; `inverse` has one for each finger.
  ReachMap(const HandScene& scene, const std::vector<kinematics::InverseKinematics>& inverse,
           const std::vector<SurfacePoint>& points, const PoseTrack& track);

  /// How the finger stands at a contact at a step of the track, keeping off the palm, itself and
  /// the object; null where it does not reach it.
  [[nodiscard]] const Posture* Find(FingerIndex finger, int point, int step);

  /// The last step to which the finger can keep the contact from `step` on, without a jump in its
  /// posture, forwards along the track or (direction −1) backwards; `step` itself where it goes
  /// nowhere. @param step  where it reaches the contact.
  [[nodiscard]] int RunEnd(FingerIndex finger, int point, int step, int direction);

 private:
  struct Entry {
    bool known = false;
    std::optional<Posture> posture;
  };
  [[nodiscard]] std::size_t Key(FingerIndex finger, int point, int step) const;
  void WorkOut(FingerIndex finger, int point, int step, Entry& entry);

  const HandScene& scene_;
  const std::vector<kinematics::InverseKinematics>& inverse_;
  const std::vector<SurfacePoint>& points_;
  const PoseTrack& track_;
  std::vector<Entry> entries_;
};

}  // namespace regrasp::gait
