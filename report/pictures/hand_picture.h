#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/hand_visuals.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "planner/plan/reason.h"
#include "render/frames/hand_view.h"

namespace regrasp::report {

/// A state during a replay by a hand, in the palm's frame.
struct HandSample {
  plan::EntryIndex entry{0};
  double time_s = 0;
  plan::HandState state;
  std::vector<plan::FingerState> fingers = {};  ///< fingers that press on the object
};

/// The hand of a plan in frames. The palm is fixed, its up direction is vertical, and the object
/// moves.
class HandPicture {
 public:
  /// @param plan        plan with a hand; outlives this object.
  /// @param centroid_m  centroid of the object in its frame, metres.
  HandPicture(const kinematics::HandFile& hand, const plan::Plan& plan,
              const Eigen::Vector3d& centroid_m);

  [[nodiscard]] const std::shared_ptr<const render::HandView>& view() const { return view_; }

  [[nodiscard]] const kinematics::HandModel& hand() const { return hand_; }
  /// Return the names of the fingers by index.
  [[nodiscard]] std::vector<std::string> FingerNames() const;
  [[nodiscard]] const Eigen::Isometry3d& X_WP() const { return X_WP_; }
  /// Return the planned state of hand and object at the end of an entry.
  [[nodiscard]] const plan::HandState& EndOf(plan::EntryIndex entry) const {
    return states_[entry];
  }
  /// Return the planned states of an entry from its start to its end, evenly spaced in joint angle
  /// and object motion.
  [[nodiscard]] std::vector<plan::HandState> StatesAlong(plan::EntryIndex entry) const;

  /// Return the poses of the object along the whole plan, in the world frame.
  [[nodiscard]] std::vector<Eigen::Isometry3d> PlannedPoses() const;

  /// Return whether a state has the joints of the hand.
  [[nodiscard]] bool Fits(const plan::HandState& state) const;
  /// Return the length of the motion between two states, in frames of an animation.
  [[nodiscard]] static double Distance(const plan::HandState& a, const plan::HandState& b);

  /// Place the snapshot of the end of an entry at the poses of object and hand at that time.
  /// If the check of the hand failed, they are those of the failing instant.
  /// @param actual  replayed state at the end of the entry; null: the planned state.
  void Place(plan::EntryIndex entry, plan::Snapshot& snapshot, plan::Fault& fault,
             const plan::HandState* actual = nullptr) const;

  /// Mark the fingers that a finger switch places and releases, and the paths of fingertips that
  /// roll in an in-hand motion. Other entries do not change.
  /// @param snapshot  static grasp after the entry, not placed yet.
  void MarkActions(plan::EntryIndex entry, plan::Snapshot& snapshot) const;

  /// Set the links of a snapshot.
  /// @param joints  joint angles of all fingers, one after the other, radians.
  void Pose(std::span<const double> joints, plan::Snapshot& snapshot) const;

 private:
  void MarkRolling(const plan::Move& move, plan::Snapshot& snapshot) const;
  void Stand(const plan::HandState& state, plan::Snapshot& snapshot) const;
  void PlaceLinks(const std::vector<std::vector<double>>& joints, plan::Snapshot& snapshot) const;
  [[nodiscard]] std::vector<plan::HandState> StatesOf(const plan::Plan& plan) const;

  const plan::Plan& plan_;
  kinematics::HandModel hand_;
  std::vector<kinematics::LinkVisual> links_;
  std::shared_ptr<const render::HandView> view_;
  std::vector<plan::HandState> states_;  ///< poses at the end of each entry
  Eigen::Isometry3d X_WP_;               ///< pose of the palm in the image
};

}  // namespace regrasp::report
