#include "planner/kinematics/hand_visuals.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "planner/base/file.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_description.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Triangles = std::vector<std::array<Vector3d, 3>>;

constexpr int kSides = 32;

Isometry3d PoseAt(const mjtNum* positions, const mjtNum* matrices, int index) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = Eigen::Map<const Vector3d>(positions + std::ptrdiff_t{3} * index);
  pose.linear() = Eigen::Map<const RowMajor>(matrices + std::ptrdiff_t{9} * index);
  return pose;
}

void AddQuad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
             Triangles& triangles) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

Triangles Box(const Vector3d& half) {
  Triangles triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d out = sign * half[axis] * Vector3d::Unit(axis);
      const Vector3d u = half[(axis + 1) % 3] * Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = sign * half[(axis + 2) % 3] * Vector3d::Unit((axis + 2) % 3);
      AddQuad(out - u - v, out + u - v, out + u + v, out - u + v, triangles);
    }
  }
  return triangles;
}

Triangles Cylinder(double radius, double half_length) {
  Triangles triangles;
  const auto corner = [&](int i, double z) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    return Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  const double h = half_length;
  for (int i = 0; i < kSides; ++i) {
    AddQuad(corner(i, -h), corner(i + 1, -h), corner(i + 1, h), corner(i, h), triangles);
    triangles.push_back({Vector3d(0, 0, h), corner(i, h), corner(i + 1, h)});
    triangles.push_back({Vector3d(0, 0, -h), corner(i + 1, -h), corner(i, -h)});
  }
  return triangles;
}

Triangles Mesh(const mjModel& model, int mesh) {
  Triangles triangles;
  const float* vertices = model.mesh_vert + std::ptrdiff_t{3} * model.mesh_vertadr[mesh];
  const int* faces = model.mesh_face + std::ptrdiff_t{3} * model.mesh_faceadr[mesh];
  const auto vertex = [&](int index) -> Vector3d {
    return Eigen::Map<const Eigen::Vector3f>(vertices + std::ptrdiff_t{3} * index).cast<double>();
  };
  for (int i = 0; i < model.mesh_facenum[mesh]; ++i) {
    triangles.push_back({vertex(faces[3 * i]), vertex(faces[3 * i + 1]), vertex(faces[3 * i + 2])});
  }
  return triangles;
}

void AddGeom(const mjModel& model, int geom, const Isometry3d& pose, LinkVisual& link) {
  const mjtNum* size = model.geom_size + std::ptrdiff_t{3} * geom;
  Triangles triangles;
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      link.capsules.push_back({pose.translation(), pose.translation(), size[0]});
      return;
    case mjGEOM_CAPSULE:
      link.capsules.push_back(
          {pose * Vector3d(0, 0, -size[1]), pose * Vector3d(0, 0, size[1]), size[0]});
      return;
    case mjGEOM_BOX:
      triangles = Box({size[0], size[1], size[2]});
      break;
    case mjGEOM_CYLINDER:
      triangles = Cylinder(size[0], size[1]);
      break;
    case mjGEOM_MESH:
      triangles = Mesh(model, model.geom_dataid[geom]);
      break;
    default:
      return;
  }
  for (const auto& [a, b, c] : triangles) link.triangles.push_back({pose * a, pose * b, pose * c});
}

}  // namespace

std::vector<LinkVisual> ReadHandVisuals(const std::filesystem::path& hand_file,
                                        const HandModel& hand) {
  const HandDescription description = ParseHandDescription(ReadFile(hand_file), hand_file.string());
  const ModelPtr model = CompileModel(hand_file.parent_path() / description.model).model;
  const DataPtr rest = AtRest(*model);
  const int palm = mj_name2id(model.get(), mjOBJ_BODY, description.palm.c_str());
  const Isometry3d from_world = PoseAt(rest->xpos, rest->xmat, palm).inverse();
  // Where each joint of a finger is at rest, and what its body carries.
  std::map<int, std::pair<FingerIndex, int>> carried;
  std::vector<std::vector<Vector3d>> anchors;
  for (FingerIndex finger{0}; finger < std::ssize(hand.fingers); ++finger) {
    anchors.emplace_back();
    Vector3d anchor = Vector3d::Zero();
    for (const Joint& joint : hand.fingers[finger].joints) {
      anchor += joint.offset;
      anchors.back().push_back(anchor);
      const int id = mj_name2id(model.get(), mjOBJ_JOINT, joint.name.c_str());
      carried[model->jnt_bodyid[id]] = {finger, static_cast<int>(anchors.back().size())};
    }
  }
  std::set<int> drawn_apart;  // bodies that have geoms only to be seen
  const auto is_seen_only = [&](int geom) {
    return model->geom_contype[geom] == 0 && model->geom_conaffinity[geom] == 0;
  };
  for (int geom = 0; geom < model->ngeom; ++geom) {
    if (is_seen_only(geom)) drawn_apart.insert(model->geom_bodyid[geom]);
  }
  std::map<std::pair<int, int>, LinkVisual> links;
  for (int geom = 0; geom < model->ngeom; ++geom) {
    const int body = model->geom_bodyid[geom];
    if (model->body_rootid[body] != model->body_rootid[palm]) continue;
    if (!is_seen_only(geom) && drawn_apart.contains(body)) continue;
    std::pair<FingerIndex, int> place = {FingerIndex{}, 0};
    for (int at = body; at != 0; at = model->body_parentid[at]) {
      const auto found = carried.find(at);
      if (found == carried.end()) continue;
      place = found->second;
      break;
    }
    LinkVisual& link = links[{place.first, place.second}];
    link.finger = place.first;
    link.after = place.second;
    Isometry3d pose = from_world * PoseAt(rest->geom_xpos, rest->geom_xmat, geom);
    if (place.second > 0) pose.translation() -= anchors[place.first][place.second - 1];
    AddGeom(*model, geom, pose, link);
  }
  std::vector<LinkVisual> visuals;
  for (auto& [place, link] : links) visuals.push_back(std::move(link));
  return visuals;
}

Isometry3d LinkPose(const LinkVisual& link, const HandModel& hand,
                    const std::vector<std::vector<double>>& joints) {
  if (link.after == 0) return Isometry3d::Identity();
  const Finger& finger = hand.fingers[link.finger];
  Posture posture(finger.drives);
  for (std::size_t i = 0; i < finger.joints.size(); ++i) {
    posture[finger.joints[i].drive] = joints[link.finger][i] / finger.joints[i].ratio;
  }
  return FramesOf(finger, posture)[link.after - 1];
}

}  // namespace regrasp::kinematics
