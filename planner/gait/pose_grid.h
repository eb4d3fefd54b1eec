#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "planner/plan/goal_set.h"
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

  /// Return the same motion in another number of steps.
  [[nodiscard]] PoseTrack InSteps(int steps) const {
    return {start_, centre_, turn_, shift_, steps};
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

/// Distance by which tracks end inside a goal set, if its tolerances permit.
/// Simulated execution displaces the object by a few tenths of a millimetre and of a degree.
inline constexpr plan::PoseTolerance kGoalDepth = {2e-3, Radians(2)};

/// Required motion of the object from any start: a rotation about its centre or a goal set.
class ObjectTask {
 public:
  /// @param centre  centre of rotation in the object's frame, metres.
  /// @param turn  rotation; ignored if there is a goal.
  /// @param goal  poses in the palm's frame.
  /// @param turn_tolerance  planning::InHandTask::turn_tolerance.
  /// @param shift  translation of the centre along the axes of the object at the start, metres, in
  ///     addition to the turn; ignored if there is a goal.
  ObjectTask(const Eigen::Vector3d& centre, const Turn& turn,
             const std::optional<plan::GoalSet>& goal,
             const std::optional<plan::PoseTolerance>& turn_tolerance = {},
             const Eigen::Vector3d& shift = Eigen::Vector3d::Zero())
      : centre_(centre), turn_(turn), goal_(goal), turn_tolerance_(turn_tolerance), shift_(shift) {}

  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  /// Return the turn; its angle is 0 if there is a goal.
  [[nodiscard]] Turn turn() const { return goal_ ? Turn{} : turn_; }
  /// Return the goal set from a start; nullopt for a turn without tolerance.
  [[nodiscard]] std::optional<plan::GoalSet> GoalFrom(const Eigen::Isometry3d& start) const;

  /// Return the track from a start to the goal set; a single pose if nothing moves.
  /// It ends kGoalDepth inside the set. Steps are at most 0.06 rad and 4 mm.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start) const;
  /// Return the track from a start in the given number of steps; a single pose if nothing moves.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start, int steps) const;
  /// Return tracks from a start to different poses of the goal set, shortest first.
  /// For a facing goal they differ by rotations about its direction. If the rotation to a goal pose
  /// exceeds 90°, the second track rotates about the same axis in the opposite direction.
  [[nodiscard]] std::vector<PoseTrack> Tracks(const Eigen::Isometry3d& start) const;

 private:
  /// Return the track to a pose in one step; a single pose if nothing moves.
  [[nodiscard]] PoseTrack To(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end,
                             int steps) const;

  Eigen::Vector3d centre_;
  Turn turn_;
  std::optional<plan::GoalSet> goal_;
  std::optional<plan::PoseTolerance> turn_tolerance_;
  Eigen::Vector3d shift_;
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
    kSet,          ///< any pose of a goal set
  };
  /// @param up  upward direction in the palm's frame; tilt axes are perpendicular to it.
  /// @param end  kPose or kOrientation.
  PoseGrid(const PoseTrack& track, const Eigen::Vector3d& up, End end);
  /// Create a grid that ends in a goal set.
  /// @param goal  set that contains the last pose of the track.
  PoseGrid(const PoseTrack& track, const Eigen::Vector3d& up, const plan::GoalSet& goal);

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
  [[nodiscard]] bool IsInGoal(int node) const;
  [[nodiscard]] int offsets() const { return static_cast<int>(offsets_->all.size()); }
  [[nodiscard]] const Offset& OffsetOf(int node) const { return offsets_->all[node % offsets()]; }

  PoseTrack track_;
  End end_;
  std::optional<plan::GoalSet> goal_;  ///< goal set, for kSet
  /// First step from which on the whole track is in the goal set. Earlier nodes are not goals: a
  /// full rotation begins in its goal set.
  int first_goal_step_ = 0;
  Eigen::Matrix3d axes_;    ///< columns: two horizontal axes, up
  const Offsets* offsets_;  ///< shared by all grids with one pose, and by all others
};

}  // namespace regrasp::gait
