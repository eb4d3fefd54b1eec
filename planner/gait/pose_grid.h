#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "planner/planning/in_hand_task.h"

namespace regrasp::gait {

using planning::Turn;

/// Object poses between two poses in equal steps.
/// The object rotates about one axis through its centre, and the centre moves on a straight line.
class PoseTrack {
 public:
  /// @param start  object pose in the palm's frame.
  /// @param centre  centre of rotation in the object's frame, metres.
  /// @param turn  total rotation.
  /// @param shift  total translation of the centre in the palm's frame, metres.
  /// @param steps  number of steps; 0 for a single pose.
  PoseTrack(const Eigen::Isometry3d& start, const Eigen::Vector3d& centre, const Turn& turn,
            const Eigen::Vector3d& shift, int steps)
      : start_(start), centre_(centre), turn_(turn), shift_(shift), steps_(steps) {}

  /// Number of steps; 0 if start and goal are the same pose.
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] const Turn& turn() const { return turn_; }
  [[nodiscard]] const Eigen::Vector3d& shift() const { return shift_; }
  /// Return the pose at a step.
  /// @param step  real number in [0, steps()].
  [[nodiscard]] Eigen::Isometry3d PoseAt(double step) const {
    const double fraction = steps_ == 0 ? 0 : step / steps_;
    Eigen::Isometry3d pose = start_;
    pose.linear() =
        start_.linear() * Eigen::AngleAxisd(fraction * turn_.angle, turn_.axis).toRotationMatrix();
    pose.translation() = start_ * centre_ + fraction * shift_ - pose.linear() * centre_;
    return pose;
  }

  /// Return the track from the same start in the opposite direction.
  [[nodiscard]] PoseTrack Backwards() const {
    return {start_, centre_, {turn_.axis, -turn_.angle}, -shift_, steps_};
  }

  /// Return the same poses from the end to the start, up to rounding.
  [[nodiscard]] PoseTrack Reversed() const {
    if (steps_ == 0) return *this;
    return {PoseAt(steps_), centre_, {turn_.axis, -turn_.angle}, -shift_, steps_};
  }

 private:
  Eigen::Isometry3d start_;
  Eigen::Vector3d centre_;
  Turn turn_;
  Eigen::Vector3d shift_;
  int steps_;
};

/// Required motion of the object from any start: a rotation about its centre or a goal pose.
class ObjectTask {
 public:
  /// @param centre  centre of rotation in the object's frame, metres.
  /// @param turn  rotation; ignored if there is a goal.
  /// @param goal  goal pose in the palm's frame.
  ObjectTask(const Eigen::Vector3d& centre, const Turn& turn,
             const std::optional<Eigen::Isometry3d>& goal)
      : centre_(centre), turn_(turn), goal_(goal) {}

  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] const std::optional<Eigen::Isometry3d>& goal() const { return goal_; }

  /// Return the track from a start; a single pose if nothing moves.
  /// Steps are at most 0.06 rad and 4 mm.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start) const;
  /// Return the track from a start in the given number of steps; a single pose if nothing moves.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start, int steps) const;

 private:
  Eigen::Vector3d centre_;
  Turn turn_;
  std::optional<Eigen::Isometry3d> goal_;
};

/// Discrete object poses: those of a track, and offsets from them.
/// Each pose of the track has neighbours that are shifted and tilted by small offsets.
/// The offsets let fingers keep their contacts on an object that yields. A grid node is the number
/// of a pose. A finger that reaches a contact at two adjacent nodes can usually follow from one to
/// the other.
class PoseGrid {
 public:
  /// Goal condition at the last step.
  enum class End {
    kPose,         ///< the last pose of the track
    kOrientation,  ///< the last orientation of the track, at any offset in position
  };
  /// @param up  upward direction in the palm's frame; tilt axes are perpendicular to it.
  PoseGrid(const PoseTrack& track, const Eigen::Vector3d& up, End end);

  [[nodiscard]] int size() const { return (track_.steps() + 1) * offsets(); }
  [[nodiscard]] int steps() const { return track_.steps(); }
  [[nodiscard]] int StepOf(int node) const { return node / offsets(); }
  /// Return the number of the tilt offset.
  /// The orientations of two nodes with equal tilt differ by the rotation between their steps only.
  [[nodiscard]] int TiltOf(int node) const { return offsets_->tilts[node % offsets()]; }
  /// Return the number of unit offsets between a node and the track.
  [[nodiscard]] int OffTrack(int node) const;
  [[nodiscard]] int start() const { return 0; }
  /// Node of the last pose of the track.
  [[nodiscard]] int goal() const { return steps() * offsets(); }
  [[nodiscard]] bool IsGoal(int node) const;

  /// Return the grid of the same poses from the end to the start.
  [[nodiscard]] PoseGrid Reversed() const;
  /// Return the node of the reversed grid that has the pose of `node`.
  [[nodiscard]] int Mirrored(int node) const {
    return (steps() - StepOf(node)) * offsets() + node % offsets();
  }

  /// Return the object pose in the palm's frame.
  [[nodiscard]] Eigen::Isometry3d PoseAt(int node) const;
  /// Return the node farther along the track at the same offset.
  /// @param steps  number of steps [default: 1].
  /// @returns the node; kNoNode beyond the end.
  [[nodiscard]] int Onward(int node, int steps = 1) const {
    const int onward = node + steps * offsets();
    return onward < size() ? onward : kNoNode;
  }
  static constexpr int kNoNode = -1;
  /// Return the adjacent nodes in ascending order.
  [[nodiscard]] std::vector<int> Neighbours(int node) const;

 private:
  /// Offset in units of kShift along three axes and of kTilt about them.
  using Offset = std::array<int, 6>;
  /// Set of all offsets from the track.
  struct Offsets {
    explicit Offsets(int dimensions);

    std::vector<Offset> all;
    std::vector<int> tilts;                ///< tilt number [offset]
    std::vector<std::vector<int>> beside;  ///< adjacent offsets [offset], which differ by one unit
  };
  [[nodiscard]] static const Offsets& OffsetsBeside(const PoseTrack& track);
  [[nodiscard]] int offsets() const { return static_cast<int>(offsets_->all.size()); }
  [[nodiscard]] const Offset& OffsetOf(int node) const { return offsets_->all[node % offsets()]; }

  PoseTrack track_;
  End end_;
  Eigen::Matrix3d axes_;    ///< columns: two horizontal axes, up
  const Offsets* offsets_;  ///< shared by all grids with one pose, and by all others
};

}  // namespace regrasp::gait
