#pragma once

#include <filesystem>
#include <vector>

#include "planner/kinematics/hand_model.h"
#include "planner/kinematics/hand_visuals.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"
#include "planner/plan/snapshot.h"
#include "render/frames/hand_view.h"

namespace regrasp::apps {

/// The hand of a plan as frames show it. With it frames have the palm at rest, its up direction
/// upwards, and the object moves.
class HandPicture {
 public:
  /// @param plan        with a hand; outlives this object.
  /// @param centroid_m  of the object, in its frame.
  /// @throws InputError  as kinematics::ReadHand.
  HandPicture(const std::filesystem::path& hand_file, const plan::Plan& plan,
              const Eigen::Vector3d& centroid_m);

  [[nodiscard]] const render::HandView& view() const { return view_; }

  /// Brings what was seen at the end of an entry to where object and hand are then.
  void Place(plan::EntryIndex entry, plan::Snapshot& snapshot, plan::Fault& fault) const;

 private:
  kinematics::HandModel hand_;
  std::vector<kinematics::LinkVisual> links_;
  render::HandView view_;
  std::vector<plan::HandState> states_;  ///< at the end of each entry
  Eigen::Isometry3d X_WP_;               ///< of the palm in the picture
};

}  // namespace regrasp::apps
