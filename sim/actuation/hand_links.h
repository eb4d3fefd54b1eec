#pragma once

#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/collision/convex_shape.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_model.h"

namespace regrasp::sim {

/// The links of a hand as convex shapes, and which of them may touch each other.
///
/// They are those of the hand model (kinematics::HandModel), whose fingertips are capsules from the
/// body's origin to the fingertip sphere.
class HandLinks {
 public:
  using Role = kinematics::LinkShape::Role;
  struct Link : kinematics::LinkShape {
    FingerIndex finger;                ///< finger of the link; not valid for the palm
    collision::BoundingSphere sphere;  ///< bounding sphere of the shape, in the link's frame
  };
  /// Link with its shape in the palm's frame.
  struct Placed : collision::PosedShape {
    const Link* link = nullptr;
  };

  explicit HandLinks(const kinematics::HandModel& hand);

  [[nodiscard]] const std::vector<Link>& links() const { return links_; }
  /// Return all links, in order, at the joint configurations of the fingers.
  [[nodiscard]] std::vector<Placed> Place(
      const kinematics::HandModel& hand,
      const std::vector<kinematics::JointConfiguration>& configurations) const;
  /// Return whether two links of one Place may touch (kinematics::HandModel::ignored).
  [[nodiscard]] bool MayTouch(const Placed& a, const Placed& b) const;

 private:
  [[nodiscard]] int IndexOf(const Placed& placed) const {
    return static_cast<int>(placed.link - links_.data());
  }

  std::vector<Link> links_;
  std::vector<bool> may_touch_;  ///< whether each pair may touch, row by row
};

}  // namespace regrasp::sim
