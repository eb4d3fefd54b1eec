#include "sim/actuation/hand_links.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/tip_geometry.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using kinematics::HandModel;

/// Distance in the reference configuration below which links are near by construction, metres.
constexpr double kNearWhileAtRest = 1e-3;

/// Return the origin of a link's frame in the reference configuration, with parallel frames.
Vector3d OriginAtRest(const HandModel& hand, const HandLinks::Link& link) {
  Vector3d origin = Vector3d::Zero();
  for (int k = 0; k < link.after; ++k) origin += hand.fingers[link.finger].joints[k].offset;
  return origin;
}

}  // namespace

HandLinks::HandLinks(const kinematics::HandFile& file) {
  const auto add = [this](FingerIndex finger, const std::vector<kinematics::LinkShape>& shapes) {
    for (const kinematics::LinkShape& shape : shapes) {
      shape_of_.push_back(static_cast<int>(&shape - shapes.data()));
      links_.push_back({finger, shape.after, shape.link,
                        shape.is_tip ? Kind::kCapsule : Kind::kLink, shape.shape});
    }
  };
  add({}, file.hand.palm);
  for (FingerIndex f{0}; f < std::ssize(file.hand.fingers); ++f) {
    add(f, file.hand.fingers[f].shapes);
  }
  AddCovered(file);
  FindPairs(file.hand);
}

void HandLinks::AddCovered(const kinematics::HandFile& file) {
  const mjModel& model = *file.compiled->model;
  const kinematics::DataPtr rest = kinematics::AtRest(model);
  const auto pose = [&](const std::string& body) {
    return kinematics::PoseAt(rest->xpos, rest->xmat, mj_name2id(&model, mjOBJ_BODY, body.c_str()));
  };
  const Isometry3d to_palm = pose(file.description.palm).inverse();
  for (FingerIndex f{0}; f < std::ssize(file.hand.fingers); ++f) {
    const kinematics::Finger& finger = file.hand.fingers[f];
    Link link{f, static_cast<int>(finger.joints.size()), finger.tip.body, Kind::kCovered, {}};
    Isometry3d placed = to_palm * pose(finger.tip.body);
    placed.translation() -= OriginAtRest(file.hand, link);
    for (const collision::ConvexShape& shape : CollisionShapesOf(model, finger.tip.body)) {
      link.shape = collision::Moved(placed, shape);
      shape_of_.push_back(-1);
      links_.push_back(link);
    }
  }
}

void HandLinks::FindPairs(const HandModel& hand) {
  std::vector<collision::ConvexShape> at_rest;
  for (const Link& link : links_) {
    const Isometry3d pose(Eigen::Translation3d(OriginAtRest(hand, link)));
    at_rest.push_back(collision::Moved(pose, link.shape));
  }
  const auto may_touch = [&](std::size_t i, std::size_t j) {
    const Link& a = links_[i];
    const Link& b = links_[j];
    if (shape_of_[i] >= 0 && shape_of_[j] >= 0) {
      const std::pair<HandModel::Part, HandModel::Part> pair = std::minmax(
          HandModel::Part{a.finger, shape_of_[i]}, HandModel::Part{b.finger, shape_of_[j]});
      return std::ranges::binary_search(hand.ignored, pair);
    }
    const bool same_chain = a.finger == b.finger || !a.finger.valid() || !b.finger.valid();
    return (same_chain && std::abs(a.after - b.after) <= 1) ||
           !collision::AreApart(at_rest[i], at_rest[j], kNearWhileAtRest);
  };
  may_touch_.assign(links_.size() * links_.size(), true);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    for (std::size_t j = i + 1; j < links_.size(); ++j) {
      const bool may = may_touch(i, j);
      may_touch_[i * links_.size() + j] = may;
      may_touch_[j * links_.size() + i] = may;
    }
  }
}

std::vector<HandLinks::Placed> HandLinks::Place(
    const HandModel& hand,
    const std::vector<kinematics::JointConfiguration>& configurations) const {
  std::vector<kinematics::JointFrames> frames;
  for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
    frames.push_back(kinematics::FramesOf(hand.fingers[i], configurations[i]));
  }
  std::vector<Placed> placed;
  placed.reserve(links_.size());
  for (const Link& link : links_) {
    Placed& one = placed.emplace_back();
    one.link = &link;
    one.shape = link.after == 0 ? link.shape
                                : collision::Moved(frames[link.finger][link.after - 1], link.shape);
    one.ball = collision::BoundingSphereOf(one.shape);
  }
  return placed;
}

bool HandLinks::MayTouch(const Placed& a, const Placed& b) const {
  return may_touch_[IndexOf(a) * links_.size() + IndexOf(b)];
}

}  // namespace regrasp::sim
