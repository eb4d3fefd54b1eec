#pragma once

#include <array>
#include <vector>

#include "planner/gait/pose_track.h"

namespace regrasp::gait {

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
