#include "sim/scene/mujoco_engine.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>

#include "planner/base/error.h"
#include "planner/mujoco/handles.h"
#include "sim/scene/engine.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

using mujoco::DataPtr;
using mujoco::ModelPtr;

constexpr const char* kFileName = "scene.xml";

/// Dimension of a contact without torsional friction.
constexpr int kPointDimensions = 3;

ModelPtr LoadModel(const std::string& mjcf) {
  // reused, because construction took 1 % of a replay's time
  thread_local mujoco::MemoryFiles files;
  files.Replace(kFileName, mjcf);
  std::array<char, 1000> error{};
  ModelPtr model(mj_loadXML(kFileName, files.get(), error.data(), static_cast<int>(error.size())));
  if (!model) throw EnvironmentError(std::string("scene rejected by MuJoCo: ") + error.data());
  return model;
}

/// Location of a finger in the engine's model.
struct FingerParts {
  int geom;
  int position;         ///< index of its slide joints in qpos
  int velocity;         ///< index in qvel
  const mjtNum* start;  ///< position at which they are 0
};

}  // namespace

std::string EngineVersion() { return mj_versionString(); }

struct MujocoEngine::Impl {
  EngineHooks hooks;
  EngineUnits units;
  double per_metre = 1 / units.length_m;
  ModelPtr model;
  DataPtr data;
  int object = 0;
  int slides = 0;  ///< number of slide joints of a finger: 3 in space, 2 in the plane
  std::vector<FingerParts> fingers;
  std::vector<TipForce> tip_forces;
  std::vector<FingerIndex> finger_of_geom;  ///< finger [geom]; none for those of the object
  std::vector<std::vector<int>> geoms_of_site;

  Impl(const std::string& mjcf, int finger_count, const EngineUnits& given);
  void ReadForces();
  [[nodiscard]] int BitOf(FingerIndex finger) const {
    return model->geom_contype[fingers[finger].geom];
  }
};

MujocoEngine::Impl::Impl(const std::string& mjcf, int finger_count, const EngineUnits& given)
    : units(given), model(LoadModel(mjcf)) {
  data.reset(mj_makeData(model.get()));
  if (!data) throw EnvironmentError("MuJoCo: not enough memory for the scene");
  object = mj_name2id(model.get(), mjOBJ_BODY, "object");
  finger_of_geom.resize(model->ngeom);
  tip_forces.resize(finger_count);
  for (FingerIndex f{0}; f < finger_count; ++f) {
    const std::string name = "finger" + std::to_string(f);
    const int body = mj_name2id(model.get(), mjOBJ_BODY, name.c_str());
    const int geom = mj_name2id(model.get(), mjOBJ_GEOM, name.c_str());
    const int joint = model->body_jntadr[body];
    slides = model->body_jntnum[body];
    fingers.push_back(
        {geom, model->jnt_qposadr[joint], model->jnt_dofadr[joint], model->body_pos + 3 * body});
    finger_of_geom[geom] = f;
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
  mj_forward(model.get(), data.get());
  ReadForces();
}

void MujocoEngine::Impl::ReadForces() {
  std::ranges::fill(tip_forces, TipForce());
  for (int i = 0; i < data->ncon; ++i) {
    const mjContact& contact = data->contact[i];
    if (contact.efc_address < 0) continue;
    const bool first = finger_of_geom[contact.geom1].valid();
    const FingerIndex finger = finger_of_geom[first ? contact.geom1 : contact.geom2];
    if (!finger.valid()) continue;
    // Force, then torque, on the second geom along the axes of the contact frame, its rows.
    // mj_contactForce copies the same values for elliptic cones.
    const mjtNum* local = data->efc_force + contact.efc_address;
    const Eigen::Map<const Eigen::Matrix3d> axes(contact.frame);
    const double unit = first ? units.force_N() : -units.force_N();
    TipForce& total = tip_forces[finger];
    total.force += unit * (axes * Eigen::Map<const Vector3d>(local));
    if (contact.dim == kPointDimensions) continue;
    total.torque += unit * units.length_m * (axes.col(0) * local[3]);
  }
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
  pose.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).toRotationMatrix();
  return pose;
}

Vector3d MujocoEngine::tip(FingerIndex finger) const {
  const FingerParts& parts = impl_->fingers[finger];
  Vector3d tip = Eigen::Map<const Vector3d>(parts.start);
  for (int k = 0; k < impl_->slides; ++k) tip[k] += impl_->data->qpos[parts.position + k];
  return impl_->units.length_m * tip;
}

const TipForce& MujocoEngine::tip_force(FingerIndex finger) const {
  return impl_->tip_forces[finger];
}

void MujocoEngine::PlaceTip(FingerIndex finger, const Vector3d& tip) {
  const FingerParts& parts = impl_->fingers[finger];
  for (int k = 0; k < impl_->slides; ++k) {
    impl_->data->qpos[parts.position + k] = tip[k] / impl_->units.length_m - parts.start[k];
    impl_->data->qvel[parts.velocity + k] = 0;
  }
}

void MujocoEngine::ShiftTip(FingerIndex finger, const Vector3d& offset) {
  const FingerParts& parts = impl_->fingers[finger];
  for (int k = 0; k < impl_->slides; ++k) {
    impl_->data->qpos[parts.position + k] += offset[k] / impl_->units.length_m;
  }
}

void MujocoEngine::SetTarget(FingerIndex finger, const Vector3d& target) {
  const mjtNum* start = impl_->fingers[finger].start;
  const int slides = impl_->slides;
  for (int k = 0; k < slides; ++k) {
    impl_->data->ctrl[slides * finger + k] = target[k] * impl_->per_metre - start[k];
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
  impl_->ReadForces();
}

MujocoEngine::State MujocoEngine::Save() const { return SaveState(*impl_->model, *impl_->data); }

void MujocoEngine::Restore(const State& state) { RestoreState(state, *impl_->data); }

}  // namespace regrasp::sim
