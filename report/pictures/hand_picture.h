#pragma once

#include <memory>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/hand_visuals.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "planner/plan/reason.h"
#include "render/frames/hand_view.h"

namespace regrasp::report {

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
  [[nodiscard]] const Eigen::Isometry3d& X_WP() const { return X_WP_; }
  /// Return the planned state of hand and object at the end of an entry.
  [[nodiscard]] const plan::HandState& EndOf(plan::EntryIndex entry) const {
    return states_[entry];
  }
  /// Return the planned states of an entry from its start to its end, evenly spaced in joint angle
  /// and object motion.
  [[nodiscard]] std::vector<plan::HandState> StatesAlong(plan::EntryIndex entry) const;

  /// Return whether a state has the joints of the hand.
  [[nodiscard]] bool Fits(const plan::HandState& state) const;
  /// Return the length of the motion between two states, in frames of an animation.
  [[nodiscard]] static double Distance(const plan::HandState& a, const plan::HandState& b);

  /// Place the snapshot of the end of an entry at the poses of object and hand at that time.
  /// If the check of the hand failed, they are those of the failing instant.
  /// @param actual  replayed state at the end of the entry; null: the planned state.
  void Place(plan::EntryIndex entry, plan::Snapshot& snapshot, plan::Fault& fault,
             const plan::HandState* actual = nullptr) const;

  /// Return hand and object at instants between the ends of the previous entry and of this one.
  /// The instants are evenly spaced in joint angle and object motion. Until fingers break contact,
  /// holding fingers have the forces of the static grasp before, then those of the static grasp
  /// after.
  /// @param before, after  snapshots of the two ends, not placed yet.
  [[nodiscard]] std::vector<plan::Snapshot> Between(plan::EntryIndex entry,
                                                    const plan::Snapshot& before,
                                                    const plan::Snapshot& after) const;

  /// Return points that approximately bound the hand of a placed snapshot.
  [[nodiscard]] std::vector<Eigen::Vector3d> Reached(const plan::Snapshot& snapshot) const;

 private:
  void Stand(const plan::HandState& state, plan::Snapshot& snapshot) const;
  [[nodiscard]] std::vector<plan::HandState> StatesOf(const plan::Plan& plan) const;

  const plan::Plan& plan_;
  kinematics::HandModel hand_;
  std::vector<kinematics::LinkVisual> links_;
  std::shared_ptr<const render::HandView> view_;
  std::vector<plan::HandState> states_;  ///< poses at the end of each entry
  Eigen::Isometry3d X_WP_;               ///< pose of the palm in the image
};

}  // namespace regrasp::report
