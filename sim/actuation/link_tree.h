#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "planner/base/index.h"
#include "sim/actuation/hand_scene.h"

namespace regrasp::sim {

/// The rigid links of a hand between the joints of its fingers, from the bodies of its model.
///
/// Bodies that are fixed to each other are one link. Joints of no finger are fixed at their
/// reference positions. Kinematics and inertias are computed here and not by MuJoCo, so that an
/// engine other than MuJoCo shares only the numbers of the model. All poses are in the world of the
/// model, metres and kilograms.
class LinkTree {
 public:
  /// A link and the revolute joint that moves it against its parent.
  struct Link {
    int joint = 0;    ///< joint of the model
    int parent = -1;  ///< index of the parent; −1: the palm, which is fixed
    /// pose in the frame of the parent (of the world without one) in the reference configuration
    Eigen::Isometry3d in_parent = Eigen::Isometry3d::Identity();
    Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  ///< point on the axis, in the link's frame
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit vector in the link's frame
    double rest = 0;                                   ///< angle in the reference configuration
    double mass = 0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< centre of mass in the link's frame
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about `centre`, in the link's frame
  };
  /// A fingertip's body: the link that it is part of, and its pose in the link's frame.
  struct Tip {
    int link = -1;
    Eigen::Isometry3d in_link = Eigen::Isometry3d::Identity();
  };

  /// @throws InputError  if a body has several joints, or a link has no mass.
  explicit LinkTree(const HandScene& scene);

  [[nodiscard]] const std::vector<Link>& links() const { return links_; }
  [[nodiscard]] const Tip& tip(FingerIndex finger) const { return tips_[finger]; }
  /// Return the index of the link that a joint of a finger moves.
  [[nodiscard]] int link(FingerIndex finger, std::size_t joint) const {
    return of_finger_[finger][joint];
  }

  /// Return the poses of all links.
  /// @param angles  angles of their joints, radians.
  [[nodiscard]] std::vector<Eigen::Isometry3d> Place(const Eigen::VectorXd& angles) const;

 private:
  void AddBody(const HandScene& scene, int body);
  void AddInertia(const HandScene& scene, int body);

  std::vector<Link> links_;
  std::vector<Tip> tips_;
  std::vector<std::vector<int>> of_finger_;
  // The link of each body of the model, and the pose of the body in the frame of its link (in the
  // world without a link).
  std::vector<int> link_of_body_;
  std::vector<Eigen::Isometry3d> in_link_;
};

}  // namespace regrasp::sim
