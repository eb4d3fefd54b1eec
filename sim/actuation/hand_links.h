#pragma once

#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/collision/convex_shape.h"
#include "planner/kinematics/hand_file.h"

namespace regrasp::sim {

/// The links of a hand as convex shapes, and which of them may touch each other.
///
/// They are those of the hand model (kinematics::HandModel), whose fingertips are capsules from the
/// body's origin to the fingertip sphere. The collision geometry of the fingertip bodies, which
/// these capsules replace, is included.
class HandLinks {
 public:
  enum class Kind {
    kLink,     ///< must not touch the object
    kCapsule,  ///< represents a fingertip
    kCovered,  ///< collision geometry of a fingertip's body
  };
  struct Link {
    FingerIndex finger;  ///< finger of the link; not valid for the palm
    int after = 0;       ///< number of joints of the finger that move it
    std::string body;
    Kind kind = Kind::kLink;
    collision::ConvexShape shape;  ///< shape in the frame of the last of these joints
  };
  struct Placed {
    const Link* link = nullptr;
    collision::ConvexShape shape;    ///< shape in the palm's frame
    collision::BoundingSphere ball;  ///< bounding sphere of the shape
  };

  explicit HandLinks(const kinematics::HandFile& file);

  [[nodiscard]] const std::vector<Link>& links() const { return links_; }
  /// Return all links, in order, at the joint configurations of the fingers.
  [[nodiscard]] std::vector<Placed> Place(
      const kinematics::HandModel& hand,
      const std::vector<kinematics::JointConfiguration>& configurations) const;
  /// Return whether two links of one Place may touch.
  /// Neighbours along a finger may, and links that are near each other in the reference
  /// configuration.
  [[nodiscard]] bool MayTouch(const Placed& a, const Placed& b) const;

 private:
  void AddCovered(const kinematics::HandFile& file);
  void FindPairs(const kinematics::HandModel& hand);
  [[nodiscard]] int IndexOf(const Placed& placed) const {
    return static_cast<int>(placed.link - links_.data());
  }

  std::vector<Link> links_;
  std::vector<int> shape_of_;  ///< index among the shapes of its finger or the palm; −1: covered
  std::vector<bool> may_touch_;  ///< whether each pair may touch, row by row
};

}  // namespace regrasp::sim
