#pragma once

#include <memory>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/hand_visuals.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"
#include "planner/plan/snapshot.h"
#include "render/frames/hand_view.h"

namespace regrasp::report {

/// The hand of a plan as frames show it. With it frames have the palm at rest, its up direction
/// upwards, and the object moves.
class HandPicture {
 public:
  /// @param plan        with a hand; outlives this object.
  /// @param centroid_m  of the object, in its frame.
  HandPicture(const kinematics::HandFile& hand, const plan::Plan& plan,
              const Eigen::Vector3d& centroid_m);

  [[nodiscard]] const std::shared_ptr<const render::HandView>& view() const { return view_; }

  /// Brings what was seen at the end of an entry to where object and hand are then; where the
  /// hand's check failed, to where they are at that instant.
  void Place(plan::EntryIndex entry, plan::Snapshot& snapshot, plan::Fault& fault) const;

  /// What is between the end of the entry before and that of this one: hand and object at instants
  /// along the paths of its joints, evenly by how far joints turn and the object goes. Fingers that
  /// hold have the forces of the rest before until others leave, then those of the rest after.
  /// @param before, after  what was seen at the two ends, not placed yet.
  [[nodiscard]] std::vector<plan::Snapshot> Between(plan::EntryIndex entry,
                                                    const plan::Snapshot& before,
                                                    const plan::Snapshot& after) const;

  /// Points that bound, about, where the hand of a placed snapshot is.
  [[nodiscard]] std::vector<Eigen::Vector3d> Reached(const plan::Snapshot& snapshot) const;

 private:
  void Stand(const plan::HandState& state, plan::Snapshot& snapshot) const;
  [[nodiscard]] bool Fits(const plan::HandState& state) const;
  [[nodiscard]] std::vector<plan::HandState> StatesOf(const plan::Plan& plan) const;

  const plan::Plan& plan_;
  kinematics::HandModel hand_;
  std::vector<kinematics::LinkVisual> links_;
  std::shared_ptr<const render::HandView> view_;
  std::vector<plan::HandState> states_;  ///< at the end of each entry
  Eigen::Isometry3d X_WP_;               ///< of the palm in the picture
};

}  // namespace regrasp::report
