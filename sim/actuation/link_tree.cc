#include "sim/actuation/link_tree.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "planner/base/error.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d Vector(const mjtNum* values, int index) {
  return Eigen::Map<const Vector3d>(values + std::ptrdiff_t{3} * index);
}

Quaterniond Rotation(const mjtNum* values, int index) {
  const mjtNum* q = values + std::ptrdiff_t{4} * index;
  return Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

/// Return the inertia of a point mass about the origin.
Matrix3d PointInertia(double mass, const Vector3d& at) {
  return mass * (at.squaredNorm() * Matrix3d::Identity() - at * at.transpose());
}

/// Return the joint of a finger that moves a body; −1 if none does.
/// @throws InputError  if there are several.
int JointOf(const HandScene& scene, int body) {
  int found = -1;
  for (const HandScene::Finger& finger : scene.fingers) {
    for (const int joint : finger.joints) {
      if (scene.model->jnt_bodyid[joint] != body) continue;
      if (found >= 0) {
        throw InputError(std::string("engine ode: several joints of body ") +
                         mj_id2name(scene.model.get(), mjOBJ_BODY, body) + " not supported");
      }
      found = joint;
    }
  }
  return found;
}

}  // namespace

LinkTree::LinkTree(const HandScene& scene)
    : link_of_body_(scene.model->nbody, -1), in_link_(scene.model->nbody, Isometry3d::Identity()) {
  // Parents precede their children in a model.
  for (int body = 1; body < scene.model->nbody; ++body) {
    if (body != scene.object_body) AddBody(scene, body);
  }
  for (const Link& link : links_) {
    if (link.mass > 0) continue;
    throw InputError(std::string("engine ode: the mass of the link at joint ") +
                     mj_id2name(scene.model.get(), mjOBJ_JOINT, link.joint) + " must be positive");
  }
  for (const HandScene::Finger& finger : scene.fingers) {
    tips_.push_back({link_of_body_[finger.tip_body], in_link_[finger.tip_body]});
    std::vector<int>& links = of_finger_.emplace_back();
    for (const int joint : finger.joints) {
      const auto at = std::ranges::find(links_, joint, &Link::joint);
      links.push_back(static_cast<int>(at - links_.begin()));
    }
  }
}

void LinkTree::AddBody(const HandScene& scene, int body) {
  const mjModel& model = *scene.model;
  const int parent = model.body_parentid[body];
  const Isometry3d in_parent =
      Eigen::Translation3d(Vector(model.body_pos, body)) * Rotation(model.body_quat, body);
  link_of_body_[body] = link_of_body_[parent];
  in_link_[body] = in_link_[parent] * in_parent;
  const int joint = JointOf(scene, body);
  if (joint >= 0) {
    Link& link = links_.emplace_back();
    link.joint = joint;
    link.parent = link_of_body_[parent];
    link.in_parent = in_link_[body];
    link.anchor = Vector(model.jnt_pos, joint);
    link.axis = Vector(model.jnt_axis, joint).normalized();
    link.rest = model.qpos0[model.jnt_qposadr[joint]];
    link_of_body_[body] = static_cast<int>(links_.size()) - 1;
    in_link_[body] = Isometry3d::Identity();
  }
  if (link_of_body_[body] >= 0) AddInertia(scene, body);
}

void LinkTree::AddInertia(const HandScene& scene, int body) {
  const mjModel& model = *scene.model;
  Link& link = links_[link_of_body_[body]];
  const double mass = model.body_mass[body];
  if (mass == 0) return;
  const Vector3d at = in_link_[body] * Vector(model.body_ipos, body);
  const Matrix3d turn =
      in_link_[body].linear() * Rotation(model.body_iquat, body).toRotationMatrix();
  const Matrix3d about = turn * Vector(model.body_inertia, body).asDiagonal() * turn.transpose();
  const double sum = link.mass + mass;
  const Vector3d centre = (link.mass * link.centre + mass * at) / sum;
  link.inertia +=
      PointInertia(link.mass, link.centre - centre) + about + PointInertia(mass, at - centre);
  link.mass = sum;
  link.centre = centre;
}

std::vector<Isometry3d> LinkTree::Place(const Eigen::VectorXd& angles) const {
  std::vector<Isometry3d> poses;
  poses.reserve(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const Isometry3d turn = Eigen::Translation3d(link.anchor) *
                            Eigen::AngleAxisd(angles[static_cast<int>(i)] - link.rest, link.axis) *
                            Eigen::Translation3d(-link.anchor);
    poses.push_back(link.parent < 0 ? Isometry3d(link.in_parent * turn)
                                    : Isometry3d(poses[link.parent] * link.in_parent * turn));
  }
  return poses;
}

}  // namespace regrasp::sim
