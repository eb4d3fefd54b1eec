#include "planner/kinematics/hand_visuals.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Triangles = std::vector<std::array<Vector3d, 3>>;

constexpr int kVisualSides = 32;
constexpr int kLastShownGroup = 2;

/// Triangles with normals at their corners.
struct Surface {
  Triangles triangles;
  Triangles normals;

  void Add(const std::array<Vector3d, 3>& corners, const std::array<Vector3d, 3>& at_corners) {
    triangles.push_back(corners);
    normals.push_back(at_corners);
  }
  void AddFlat(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d normal = (b - a).cross(c - a).normalized();
    Add({a, b, c}, {normal, normal, normal});
  }
};

Surface BoxSurface(const Vector3d& half) {
  Surface surface;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d out = sign * half[axis] * Vector3d::Unit(axis);
      const Vector3d u = half[(axis + 1) % 3] * Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = sign * half[(axis + 2) % 3] * Vector3d::Unit((axis + 2) % 3);
      surface.AddFlat(out - u - v, out + u - v, out + u + v);
      surface.AddFlat(out - u - v, out + u + v, out - u + v);
    }
  }
  return surface;
}

Surface CylinderSurface(double radius, double half_length) {
  Surface surface;
  const auto outward = [](int i) {
    const double angle = 2 * std::numbers::pi * i / kVisualSides;
    return Vector3d(std::cos(angle), std::sin(angle), 0);
  };
  const Vector3d top(0, 0, half_length);
  for (int i = 0; i < kVisualSides; ++i) {
    const Vector3d n = outward(i);
    const Vector3d next_n = outward(i + 1);
    const Vector3d a = radius * n;
    const Vector3d b = radius * next_n;
    surface.Add({a - top, b - top, b + top}, {n, next_n, next_n});
    surface.Add({a - top, b + top, a + top}, {n, next_n, n});
    surface.AddFlat(top, a + top, b + top);
    surface.AddFlat(-top, b - top, a - top);
  }
  return surface;
}

Surface Mesh(const mjModel& model, int mesh) {
  Surface surface;
  const int* faces = model.mesh_face + std::ptrdiff_t{3} * model.mesh_faceadr[mesh];
  for (int i = 0; i < model.mesh_facenum[mesh]; ++i) {
    std::array<Vector3d, 3> corners;
    std::array<Vector3d, 3> normals;
    for (int k = 0; k < 3; ++k) {
      const std::ptrdiff_t at = std::ptrdiff_t{3} * (model.mesh_vertadr[mesh] + faces[3 * i + k]);
      corners[k] = Eigen::Map<const Eigen::Vector3f>(model.mesh_vert + at).cast<double>();
      normals[k] = Eigen::Map<const Eigen::Vector3f>(model.mesh_normal + at).cast<double>();
    }
    surface.Add(corners, normals);
  }
  return surface;
}

void AddGeom(const mjModel& model, int geom, const Isometry3d& pose, LinkVisual& link) {
  const mjtNum* size = model.geom_size + std::ptrdiff_t{3} * geom;
  Surface surface;
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      link.capsules.push_back({pose.translation(), pose.translation(), size[0]});
      return;
    case mjGEOM_CAPSULE:
      link.capsules.push_back(
          {pose * Vector3d(0, 0, -size[1]), pose * Vector3d(0, 0, size[1]), size[0]});
      return;
    case mjGEOM_BOX:
      surface = BoxSurface({size[0], size[1], size[2]});
      break;
    case mjGEOM_CYLINDER:
      surface = CylinderSurface(size[0], size[1]);
      break;
    case mjGEOM_MESH:
      surface = Mesh(model, model.geom_dataid[geom]);
      break;
    default:
      return;
  }
  for (const auto& [a, b, c] : surface.triangles) {
    link.triangles.push_back({pose * a, pose * b, pose * c});
  }
  const Eigen::Matrix3d turn = pose.linear();
  for (const auto& [a, b, c] : surface.normals)
    link.normals.push_back({turn * a, turn * b, turn * c});
}

/// Return the colour of a geom, which is that of its material if it has one.
std::array<float, 3> ColorOf(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  const float* rgba = material >= 0 ? model.mat_rgba + std::ptrdiff_t{4} * material
                                    : model.geom_rgba + std::ptrdiff_t{4} * geom;
  return {rgba[0], rgba[1], rgba[2]};
}

bool IsSeenOnly(const mjModel& model, int geom) {
  return !Collides(model, geom) && model.geom_group[geom] <= kLastShownGroup &&
         model.geom_rgba[std::ptrdiff_t{4} * geom + 3] > 0;
}

/// Return whether a body is `above` or below it in the kinematic tree.
bool IsBelow(const mjModel& model, int above, int body) {
  while (body > above) body = model.body_parentid[body];
  return body == above;
}

/// Return the visual shapes of a hand in a configuration.
/// @param posed  poses of the model. The links of the fingers of `hand` are in the frame of their
///     last joint, which requires the reference configuration.
std::vector<LinkVisual> VisualsIn(const mjData& posed, const CompiledModel& compiled,
                                  const std::string& palm_name, const HandModel& hand) {
  const mjModel* model = compiled.model.get();
  const int palm = mj_name2id(model, mjOBJ_BODY, palm_name.c_str());
  const Isometry3d from_world = PoseAt(posed.xpos, posed.xmat, palm).inverse();
  // Joint positions in the reference configuration by finger, and the joint that moves each body.
  std::map<int, std::pair<FingerIndex, int>> carried;
  std::vector<std::vector<Vector3d>> anchors;
  for (FingerIndex finger{0}; finger < std::ssize(hand.fingers); ++finger) {
    anchors.emplace_back();
    Vector3d anchor = Vector3d::Zero();
    for (const Joint& joint : hand.fingers[finger].joints) {
      anchor += joint.offset;
      anchors.back().push_back(anchor);
      const int id = mj_name2id(model, mjOBJ_JOINT, joint.name.c_str());
      carried[model->jnt_bodyid[id]] = {finger, static_cast<int>(anchors.back().size())};
    }
  }
  std::set<int> drawn_apart;  // bodies with geoms that are only visual
  for (int geom = 0; geom < model->ngeom; ++geom) {
    if (IsSeenOnly(*model, geom)) drawn_apart.insert(model->geom_bodyid[geom]);
  }
  std::map<std::tuple<int, int, bool, std::array<float, 3>>, LinkVisual> links;
  for (int geom = 0; geom < model->ngeom; ++geom) {
    const int body = model->geom_bodyid[geom];
    if (model->body_rootid[body] != model->body_rootid[palm]) continue;
    const bool is_drawn =
        drawn_apart.contains(body) ? IsSeenOnly(*model, geom) : Collides(*model, geom);
    if (!is_drawn) continue;
    std::pair<FingerIndex, int> place = {FingerIndex{}, 0};
    for (int at = body; at != 0; at = model->body_parentid[at]) {
      const auto found = carried.find(at);
      if (found == carried.end()) continue;
      place = found->second;
      break;
    }
    const bool above_palm = !IsBelow(*model, palm, body);
    const std::array<float, 3> color = ColorOf(*model, geom);
    LinkVisual& link = links[{place.first, place.second, above_palm, color}];
    link.above_palm = above_palm;
    link.color = color;
    link.finger = place.first;
    link.after = place.second;
    Isometry3d pose = from_world * PoseAt(posed.geom_xpos, posed.geom_xmat, geom);
    if (place.second > 0) pose.translation() -= anchors[place.first][place.second - 1];
    AddGeom(*model, geom, pose, link);
  }
  std::vector<LinkVisual> visuals;
  for (auto& [place, link] : links) visuals.push_back(std::move(link));
  return visuals;
}

}  // namespace

std::vector<LinkVisual> VisualsOf(const CompiledModel& compiled, const std::string& palm,
                                  const HandModel& hand) {
  return VisualsIn(*AtRest(*compiled.model), compiled, palm, hand);
}

std::vector<LinkVisual> VisualsAt(const CompiledModel& compiled, const std::string& palm,
                                  const std::map<std::string, double>& joints) {
  const mjModel& model = *compiled.model;
  const DataPtr posed = AtRest(model);
  for (int joint = 0; joint < model.njnt; ++joint) {
    const auto found = joints.find(JointName(model, joint));
    if (found != joints.end()) posed->qpos[model.jnt_qposadr[joint]] = found->second;
  }
  mj_kinematics(&model, posed.get());
  return VisualsIn(*posed, compiled, palm, {});
}

std::vector<LinkVisual> VisualsOf(const HandFile& file) {
  return VisualsOf(*file.compiled, file.description.palm, file.hand);
}

Isometry3d LinkPose(const LinkVisual& link, const HandModel& hand,
                    const std::vector<std::vector<double>>& joints) {
  if (link.after == 0) return Isometry3d::Identity();
  const Finger& finger = hand.fingers[link.finger];
  return FramesOf(finger, ConfigurationAt(finger, joints[link.finger]))[link.after - 1];
}

}  // namespace regrasp::kinematics
