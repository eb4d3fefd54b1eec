#include "planner/kinematics/model_names.h"

#include <algorithm>

namespace regrasp::kinematics {
namespace {

std::string NameOf(const mjModel& model, int type, int id, const std::string& kind) {
  const char* name = mj_id2name(&model, type, id);
  return name != nullptr && *name != '\0' ? name : kind + " " + std::to_string(id);
}

}  // namespace

std::string BodyName(const mjModel& model, int body) {
  return NameOf(model, mjOBJ_BODY, body, "body");
}

std::string JointName(const mjModel& model, int joint) {
  return NameOf(model, mjOBJ_JOINT, joint, "joint");
}

std::string ActuatorName(const mjModel& model, int actuator) {
  return NameOf(model, mjOBJ_ACTUATOR, actuator, "actuator");
}

Eigen::Vector3d VectorAt(const mjtNum* numbers, int index) {
  return Eigen::Map<const Eigen::Vector3d>(numbers + std::ptrdiff_t{3} * index);
}

Eigen::Isometry3d PoseAt(const mjtNum* positions, const mjtNum* matrices, int index) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = VectorAt(positions, index);
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  pose.linear() = Eigen::Map<const RowMajor>(matrices + std::ptrdiff_t{9} * index);
  return pose;
}

bool Collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

int LinkOf(const mjModel& model, int body) {
  while (model.body_jntnum[body] == 0 && model.body_parentid[body] > 0) {
    body = model.body_parentid[body];
  }
  return body;
}

std::vector<int> JointsBetween(const mjModel& model, int above, int body) {
  std::vector<int> joints;
  for (; body != above && body > 0; body = model.body_parentid[body]) {
    for (int i = model.body_jntnum[body] - 1; i >= 0; --i) {
      joints.push_back(model.body_jntadr[body] + i);
    }
  }
  std::ranges::reverse(joints);
  return joints;
}

}  // namespace regrasp::kinematics
