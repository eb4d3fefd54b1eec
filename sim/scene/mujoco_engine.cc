#include "sim/scene/mujoco_engine.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>

#include "planner/base/error.h"
#include "planner/mujoco/handles.h"
#include "planner/mujoco/memory_files.h"
#include "sim/scene/engine_hooks.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

using mujoco::DataPtr;
using mujoco::ModelPtr;

constexpr const char* kFileName = "scene.xml";

ModelPtr LoadModel(const std::string& mjcf) {
  thread_local mujoco::MemoryFiles files;  // to make one took 1 % of a replay's time
  files.Replace(kFileName, mjcf);
  std::array<char, 1000> error{};
  ModelPtr model(mj_loadXML(kFileName, files.get(), error.data(), static_cast<int>(error.size())));
  if (!model) throw EnvironmentError(std::string("MuJoCo refuses the scene: ") + error.data());
  return model;
}

}  // namespace

std::string EngineVersion() { return mj_versionString(); }

struct MujocoEngine::Impl {
  EngineHooks hooks;
  EngineUnits units;
  ModelPtr model;
  DataPtr data;
  int object = 0;
  int slides = 0;  ///< of a finger: 3 in space, 2 in the plane
  std::vector<int> body_of_finger;
  std::vector<int> geom_of_finger;
  std::vector<FingerIndex> finger_of_geom;  ///< none for the object's
  std::vector<std::vector<int>> geoms_of_site;

  Impl(const std::string& mjcf, int fingers, const EngineUnits& given);
  [[nodiscard]] int First(FingerIndex finger) const;  ///< index of a finger's first coordinate
  [[nodiscard]] int BitOf(FingerIndex finger) const {
    return model->geom_contype[geom_of_finger[finger]];
  }
};

MujocoEngine::Impl::Impl(const std::string& mjcf, int fingers, const EngineUnits& given)
    : units(given), model(LoadModel(mjcf)) {
  data.reset(mj_makeData(model.get()));
  if (!data) throw EnvironmentError("MuJoCo has no memory for the scene");
  object = mj_name2id(model.get(), mjOBJ_BODY, "object");
  finger_of_geom.resize(model->ngeom);
  for (FingerIndex f{0}; f < fingers; ++f) {
    const std::string name = "finger" + std::to_string(f);
    body_of_finger.push_back(mj_name2id(model.get(), mjOBJ_BODY, name.c_str()));
    geom_of_finger.push_back(mj_name2id(model.get(), mjOBJ_GEOM, name.c_str()));
    finger_of_geom[geom_of_finger.back()] = f;
  }
  for (int site = 0;; ++site) {
    std::vector<int> geoms;
    for (int piece = 0;; ++piece) {
      const std::string name = "site" + std::to_string(site) + "_" + std::to_string(piece);
      const int geom = mj_name2id(model.get(), mjOBJ_GEOM, name.c_str());
      if (geom < 0) break;
      geoms.push_back(geom);
    }
    if (geoms.empty()) break;
    geoms_of_site.push_back(std::move(geoms));
  }
  slides = fingers > 0 ? model->body_jntnum[body_of_finger.front()] : 0;
  mj_forward(model.get(), data.get());
}

int MujocoEngine::Impl::First(FingerIndex finger) const {
  return model->body_jntadr[body_of_finger[finger]];
}

MujocoEngine::MujocoEngine(const std::string& mjcf, int fingers, const EngineUnits& units)
    : impl_(std::make_unique<Impl>(mjcf, fingers, units)) {}
MujocoEngine::~MujocoEngine() = default;

double MujocoEngine::time() const { return impl_->data->time * impl_->units.time_s; }

Eigen::Isometry3d MujocoEngine::object_pose() const {
  const mjtNum* q = impl_->data->qpos;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (impl_->model->jnt_type[0] != mjJNT_FREE) {
    pose.translation() = impl_->units.length_m * Vector3d(q[0], q[1], 0);
    pose.linear() = Eigen::AngleAxisd(q[2], Vector3d::UnitZ()).toRotationMatrix();
    return pose;
  }
  pose.translation() = impl_->units.length_m * Vector3d(q[0], q[1], q[2]);
  pose.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix();
  return pose;
}

Vector3d MujocoEngine::tip(FingerIndex finger) const {
  const mjModel& m = *impl_->model;
  const mjtNum* start = m.body_pos + 3 * impl_->body_of_finger[finger];
  const mjtNum* q = impl_->data->qpos + m.jnt_qposadr[impl_->First(finger)];
  Vector3d tip(start[0], start[1], start[2]);
  for (int k = 0; k < impl_->slides; ++k) tip[k] += q[k];
  return impl_->units.length_m * tip;
}

Vector3d MujocoEngine::contact_force(FingerIndex finger) const {
  return impl_->units.force_N() * SumOfContacts(finger, 0);
}

Vector3d MujocoEngine::contact_torque(FingerIndex finger) const {
  return impl_->units.force_N() * impl_->units.length_m * SumOfContacts(finger, 3);
}

Vector3d MujocoEngine::SumOfContacts(FingerIndex finger, int begin) const {
  const mjData& d = *impl_->data;
  Vector3d total = Vector3d::Zero();
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& contact = d.contact[i];
    const bool first = impl_->finger_of_geom[contact.geom1] == finger;
    if (!first && impl_->finger_of_geom[contact.geom2] != finger) continue;
    std::array<mjtNum, 6> local;
    mj_contactForce(impl_->model.get(), &d, i, local.data());
    std::array<mjtNum, 3> world;
    mju_rotVecMatT(world.data(), local.data() + begin, contact.frame);
    // The engine gives the force on the second geom.
    total += (first ? 1 : -1) * Vector3d(world[0], world[1], world[2]);
  }
  return total;
}

void MujocoEngine::PlaceTip(FingerIndex finger, const Vector3d& tip) {
  const mjModel& m = *impl_->model;
  const int joint = impl_->First(finger);
  const mjtNum* start = m.body_pos + 3 * impl_->body_of_finger[finger];
  for (int k = 0; k < impl_->slides; ++k) {
    impl_->data->qpos[m.jnt_qposadr[joint] + k] = tip[k] / impl_->units.length_m - start[k];
    impl_->data->qvel[m.jnt_dofadr[joint] + k] = 0;
  }
}

void MujocoEngine::ShiftTip(FingerIndex finger, const Vector3d& offset) {
  const int joint = impl_->First(finger);
  for (int k = 0; k < impl_->slides; ++k) {
    impl_->data->qpos[impl_->model->jnt_qposadr[joint] + k] += offset[k] / impl_->units.length_m;
  }
}

void MujocoEngine::SetTarget(FingerIndex finger, const Vector3d& target) {
  const mjtNum* start = impl_->model->body_pos + 3 * impl_->body_of_finger[finger];
  const int slides = impl_->slides;
  for (int k = 0; k < slides; ++k) {
    impl_->data->ctrl[slides * finger + k] = target[k] / impl_->units.length_m - start[k];
  }
}

void MujocoEngine::SetSite(FingerIndex finger, SiteIndex site) {
  mjModel& m = *impl_->model;
  for (int g = 0; g < m.ngeom; ++g) m.geom_conaffinity[g] &= ~impl_->BitOf(finger);
  if (site.valid()) AddSite(finger, site);
}

void MujocoEngine::AddSite(FingerIndex finger, SiteIndex site) {
  for (const int g : impl_->geoms_of_site[site]) {
    impl_->model->geom_conaffinity[g] |= impl_->BitOf(finger);
  }
}

void MujocoEngine::SetGravity(double gravity) {
  const EngineUnits& units = impl_->units;
  impl_->model->opt.gravity[2] = -gravity * units.time_s * units.time_s / units.length_m;
}

void MujocoEngine::SetLoad(const Vector3d& force, const Vector3d& torque) {
  mjtNum* load = impl_->data->xfrc_applied + 6 * impl_->object;
  const double newton = 1 / impl_->units.force_N();
  for (int k = 0; k < 3; ++k) {
    load[k] = force[k] * newton;
    load[3 + k] = torque[k] * newton / impl_->units.length_m;
  }
}

void MujocoEngine::Step() {
  mjData& d = *impl_->data;
  mj_step(impl_->model.get(), &d);
  CheckState(*impl_->model, d);
}

MujocoEngine::State MujocoEngine::Save() const { return SaveState(*impl_->model, *impl_->data); }

void MujocoEngine::Restore(const State& state) { RestoreState(state, *impl_->data); }

}  // namespace regrasp::sim
