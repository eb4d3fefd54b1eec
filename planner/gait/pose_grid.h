#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "planner/planning/in_hand_task.h"

namespace regrasp::gait {

using planning::Turn;

/// Poses of an object from one to another in equal steps: it turns about one axis through its
/// centre, which goes straight.
class PoseTrack {
 public:
  /// @param start   pose of the object in the palm's frame.
  /// @param centre  in the object's frame, metres.
  /// @param turn    the whole of it.
  /// @param shift   of the centre, in the palm's frame, metres.
  PoseTrack(const Eigen::Isometry3d& start, const Eigen::Vector3d& centre, const Turn& turn,
            const Eigen::Vector3d& shift, int steps)
      : start_(start), centre_(centre), turn_(turn), shift_(shift), steps_(steps) {}

  /// @returns 0 where start and goal are one pose.
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] const Turn& turn() const { return turn_; }
  [[nodiscard]] const Eigen::Vector3d& shift() const { return shift_; }
  /// @param step  in [0, steps()], whole or not.
  [[nodiscard]] Eigen::Isometry3d PoseAt(double step) const {
    const double share = steps_ == 0 ? 0 : step / steps_;
    Eigen::Isometry3d pose = start_;
    pose.linear() =
        start_.linear() * Eigen::AngleAxisd(share * turn_.angle, turn_.axis).toRotationMatrix();
    pose.translation() = start_ * centre_ + share * shift_ - pose.linear() * centre_;
    return pose;
  }

  /// From the same start the other way.
  [[nodiscard]] PoseTrack Backwards() const {
    return {start_, centre_, {turn_.axis, -turn_.angle}, -shift_, steps_};
  }

  /// The same poses from the end to the start, but for rounding.
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

/// What an object is to do, wherever it begins: turn about its centre, or go to a pose.
class ObjectTask {
 public:
  /// @param centre  of the object, in its frame, metres.
  /// @param goal    in the palm's frame; instead of the turn.
  ObjectTask(const Eigen::Vector3d& centre, const Turn& turn,
             const std::optional<Eigen::Isometry3d>& goal)
      : centre_(centre), turn_(turn), goal_(goal) {}

  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] const std::optional<Eigen::Isometry3d>& goal() const { return goal_; }

  /// In steps that fingers follow without trouble; one pose where there is nothing to do.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start) const;
  /// In so many steps, or one pose.
  [[nodiscard]] PoseTrack From(const Eigen::Isometry3d& start, int steps) const;

 private:
  Eigen::Vector3d centre_;
  Turn turn_;
  std::optional<Eigen::Isometry3d> goal_;
};

/// Poses that an object may take on its way: those of a track, and beside each of them some that
/// are a little shifted and tilted, as fingers can often go on holding an object that gives way.
///
/// A node is a pose, by number; neighbours are so near to each other that a finger which reaches a
/// contact at both can mostly follow from one to the other.
class PoseGrid {
 public:
  /// What may be at the end.
  enum class End {
    kPose,         ///< the last pose of the track
    kOrientation,  ///< its orientation, wherever the object is
  };
  /// @param up  in the palm's frame: tilts are about axes at right angles to it.
  PoseGrid(const PoseTrack& track, const Eigen::Vector3d& up, End end);

  [[nodiscard]] int size() const { return (track_.steps() + 1) * offsets(); }
  [[nodiscard]] int steps() const { return track_.steps(); }
  [[nodiscard]] int StepOf(int node) const { return node / offsets(); }
  /// A number for the tilt beside the track. Two poses with one tilt differ in their orientations
  /// by the turn between their steps alone.
  [[nodiscard]] int TiltOf(int node) const { return offsets_->tilts[node % offsets()]; }
  /// How many unit offsets a pose is from the track.
  [[nodiscard]] int OffTrack(int node) const;
  [[nodiscard]] int start() const { return 0; }
  /// The last pose of the track.
  [[nodiscard]] int goal() const { return steps() * offsets(); }
  [[nodiscard]] bool IsGoal(int node) const;

  /// The same poses from the end to the start.
  [[nodiscard]] PoseGrid Reversed() const;
  /// The node of the reversed grid that has a node's pose.
  [[nodiscard]] int Mirrored(int node) const {
    return (steps() - StepOf(node)) * offsets() + node % offsets();
  }

  /// Of the object in the palm's frame.
  [[nodiscard]] Eigen::Isometry3d PoseAt(int node) const;
  /// So many steps farther along the track, with the same offset; kNoNode beyond the end.
  [[nodiscard]] int Onward(int node, int steps = 1) const {
    const int onward = node + steps * offsets();
    return onward < size() ? onward : kNoNode;
  }
  static constexpr int kNoNode = -1;
  /// In the order of their numbers.
  [[nodiscard]] std::vector<int> Neighbours(int node) const;

 private:
  /// In units of kShift along three axes and of kTilt about them.
  using Offset = std::array<int, 6>;
  /// All that poses may be off their track.
  struct Offsets {
    explicit Offsets(int dimensions);

    std::vector<Offset> all;
    std::vector<int> tilts;                ///< by offset
    std::vector<std::vector<int>> beside;  ///< by offset: those that differ by one unit
  };
  [[nodiscard]] static const Offsets& OffsetsBeside(const PoseTrack& track);
  [[nodiscard]] int offsets() const { return static_cast<int>(offsets_->all.size()); }
  [[nodiscard]] const Offset& OffsetOf(int node) const { return offsets_->all[node % offsets()]; }

  PoseTrack track_;
  End end_;
  Eigen::Matrix3d axes_;    ///< columns: across, across, up
  const Offsets* offsets_;  ///< one set for tracks of one pose, one for all others
};

}  // namespace regrasp::gait
