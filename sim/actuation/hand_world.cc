#include "sim/actuation/hand_world.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/scene/damped_step.h"
#include "sim/scene/engine.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using kinematics::VectorAt;

Isometry3d PoseAt(const mjData& data, int body) {
  return kinematics::PoseAt(data.xpos, data.xmat, body);
}

}  // namespace

struct HandWorld::Impl {
  HandScene& scene;
  kinematics::HandModel& hand = scene.hand;
  TipSurface& surface = scene.surface;
  HandWorldOptions& options = scene.options;
  mjModel* model = scene.model.get();
  mjData* data = scene.data.get();
  Isometry3d& palm = scene.palm;
  Vector3d& centroid = scene.centroid;
  int object_body = scene.object_body;
  int object_geom = scene.object_geom;
  int object_qpos = scene.object_qpos;
  std::vector<HandScene::Finger>& fingers = scene.fingers;
  bool pinned = false;  ///< whether the object is fixed

  explicit Impl(HandScene& scene_of_engine) : scene(scene_of_engine) {}

  [[nodiscard]] Isometry3d ObjectInWorld() const {
    Isometry3d pose = PoseAt(*data, object_body);
    pose.translation() -= pose.linear() * centroid;
    return pose;
  }

  [[nodiscard]] kinematics::JointConfiguration ConfigurationOf(FingerIndex finger) const {
    const kinematics::Finger& chain = hand.fingers[finger];
    // A constraint couples joints only softly; their mean is used.
    kinematics::JointConfiguration sum = kinematics::JointConfiguration::Zero(chain.drives);
    VectorXd count = VectorXd::Zero(chain.drives);
    for (std::size_t k = 0; k < chain.joints.size(); ++k) {
      const kinematics::Joint& joint = chain.joints[k];
      const double angle = data->qpos[model->jnt_qposadr[fingers[finger].joints[k]]];
      sum[joint.drive] += kinematics::DriveAngle(joint, angle);
      ++count[joint.drive];
    }
    return sum.cwiseQuotient(count);
  }

  /// Return the centre of the fingertip sphere, with the actual angles of coupled joints.
  [[nodiscard]] Vector3d BallInWorld(FingerIndex finger) const {
    const HandScene::Finger& state = fingers[finger];
    return PoseAt(*data, state.tip_body) * surface.ball(finger);
  }

  /// Return the velocity of the point of a body that is at `point`.
  [[nodiscard]] Vector3d SpeedAt(int body, const Vector3d& point) const {
    const mjtNum* velocity = data->cvel + std::ptrdiff_t{6} * body;
    const Vector3d about = VectorAt(data->subtree_com, model->body_rootid[body]);
    const Vector3d turning(velocity[0], velocity[1], velocity[2]);
    const Vector3d moving(velocity[3], velocity[4], velocity[5]);
    return moving + turning.cross(point - about);
  }

  void AddTipContacts() {
    const Isometry3d pose = ObjectInWorld();
    const Isometry3d to_object = pose.inverse();
    for (FingerIndex finger{0}; finger < std::ssize(fingers); ++finger) {
      const Isometry3d link = PoseAt(*data, fingers[finger].tip_body);
      for (const auto& contact : surface.FindContacts(finger, link, to_object)) {
        mjContact made = MakeTipContact(contact, pose, options.mu, options.physics);
        made.geom1 = object_geom;
        made.geom2 = fingers[finger].tip_geom;
        mj_addContact(model, data, &made);
      }
    }
  }

  [[nodiscard]] ContactSum SumContacts(FingerIndex finger) const {
    return SumTipContacts(*model, *data, object_geom, fingers[finger].tip_geom);
  }
};

HandWorld::HandWorld(const kinematics::HandFile& file, const object::Polyhedron& solid,
                     double scale, const HandWorldOptions& options)
    : HandEngine(std::make_unique<HandScene>(file, solid, scale, options)),
      impl_(std::make_unique<Impl>(scene())) {}
HandWorld::~HandWorld() = default;

const mjModel& HandWorld::model() const { return *impl_->model; }
double HandWorld::time() const { return impl_->data->time; }

void HandWorld::Place(const plan::HandState& state) {
  Impl& impl = *impl_;
  mj_resetData(impl.model, impl.data);
  // Later results must not depend on earlier ones, to the bit.
  impl.surface.Forget();
  for (std::size_t i = 0; i < impl.fingers.size(); ++i) {
    for (std::size_t k = 0; k < impl.fingers[i].joints.size(); ++k) {
      impl.data->qpos[impl.model->jnt_qposadr[impl.fingers[i].joints[k]]] = state.joints[i][k];
    }
  }
  const Isometry3d pose = impl.palm * state.pose;
  const Vector3d centre = pose * impl.centroid;
  const Eigen::Quaterniond turn(pose.linear());
  mjtNum* q = impl.data->qpos + impl.object_qpos;
  std::copy_n(centre.data(), 3, q);
  q[3] = turn.w();
  q[4] = turn.x();
  q[5] = turn.y();
  q[6] = turn.z();
  mj_forward(impl.model, impl.data);
  impl.AddTipContacts();
}

plan::HandState HandWorld::state() const {
  plan::HandState state{object_pose(), {}};
  for (FingerIndex f{0}; f < std::ssize(impl_->fingers); ++f) {
    state.joints.push_back(joint_angles_of(f));
  }
  return state;
}

std::vector<double> HandWorld::joint_angles_of(FingerIndex finger) const {
  std::vector<double> angles;
  for (const int joint : impl_->fingers[finger].joints) {
    angles.push_back(impl_->data->qpos[impl_->model->jnt_qposadr[joint]]);
  }
  return angles;
}

Isometry3d HandWorld::object_pose() const { return impl_->palm.inverse() * impl_->ObjectInWorld(); }

double HandWorld::largest_speed() const {
  double largest = 0;
  for (int i = 0; i < impl_->model->nv; ++i) {
    largest = std::max(largest, std::abs(impl_->data->qvel[i]));
  }
  return largest;
}

kinematics::JointConfiguration HandWorld::configuration(FingerIndex finger) const {
  return impl_->ConfigurationOf(finger);
}

Vector3d HandWorld::tip(FingerIndex finger) const {
  return impl_->palm.inverse() * impl_->BallInWorld(finger);
}

TipTouch HandWorld::touch(FingerIndex finger) const {
  const Impl& impl = *impl_;
  TipTouch touch;
  const Isometry3d pose = impl.ObjectInWorld();
  const std::optional<collision::SurfaceContact>& near = impl.surface.nearest(finger);
  if (!near) return touch;
  touch.point_O = near->point;
  touch.inward_O = -near->outward;
  touch.gap = near->gap;
  const ContactSum sum = impl.SumContacts(finger);
  touch.force = impl.palm.linear().transpose() * sum.force;
  const Vector3d mean = (pose.linear().transpose() * sum.normal).stableNormalized();
  // Forces on both sides of a fingertip have no common normal. The nearest point is then the
  // contact.
  if (impl.options.tip == TipShape::kGeometry && sum.pressing > 0 && mean != Vector3d::Zero()) {
    touch.point_O = pose.inverse() * (sum.point / sum.pressing);
    touch.inward_O = -mean;
  }
  const Vector3d at = pose * touch.point_O;
  const Vector3d speed =
      pose.linear().transpose() *
      (impl.SpeedAt(impl.fingers[finger].tip_body, at) - impl.SpeedAt(impl.object_body, at));
  touch.sliding_O = speed - speed.dot(touch.inward_O) * touch.inward_O;
  return touch;
}

std::optional<collision::NearPoint> HandWorld::NearBall(FingerIndex finger) const {
  const Vector3d centre = impl_->ObjectInWorld().inverse() * impl_->BallInWorld(finger);
  return impl_->surface.NearBall(finger, centre);
}

std::vector<std::string> HandWorld::control_names() const {
  std::vector<std::string> names;
  for (int actuator = 0; actuator < impl_->model->nu; ++actuator) {
    const char* name = mj_id2name(impl_->model, mjOBJ_ACTUATOR, actuator);
    names.push_back(name == nullptr ? "actuator " + std::to_string(actuator) : name);
  }
  return names;
}

std::vector<double> HandWorld::controls() const {
  return {impl_->data->ctrl, impl_->data->ctrl + impl_->model->nu};
}

void HandWorld::SetControls(const std::vector<double>& controls) {
  assert(std::ssize(controls) == impl_->model->nu);
  std::ranges::copy(controls, impl_->data->ctrl);
}

std::vector<std::string> HandWorld::joint_names() const {
  std::vector<std::string> names;
  for (int joint = 0; joint < impl_->model->njnt; ++joint) {
    if (!scene().IsScalar(joint)) continue;
    const char* name = mj_id2name(impl_->model, mjOBJ_JOINT, joint);
    names.push_back(name == nullptr ? "joint " + std::to_string(joint) : name);
  }
  return names;
}

std::vector<double> HandWorld::joint_angles() const {
  std::vector<double> angles;
  for (int joint = 0; joint < impl_->model->njnt; ++joint) {
    if (!scene().IsScalar(joint)) continue;
    angles.push_back(impl_->data->qpos[impl_->model->jnt_qposadr[joint]]);
  }
  return angles;
}

double HandWorld::torque(FingerIndex finger, int drive) const {
  const DriveActuator& found = impl_->fingers[finger].drives[drive];
  return impl_->data->actuator_force[found.actuator] * found.moment;
}

bool HandWorld::is_control_at_limit(FingerIndex finger, int drive) const {
  const DriveActuator& found = impl_->fingers[finger].drives[drive];
  const auto& range = found.servo.control_range;
  const double control = impl_->data->ctrl[found.actuator];
  return range && (control <= range->front() || control >= range->back());
}

JointCouplings::Residual HandWorld::largest_coupling_residual() const {
  return scene().couplings->Largest(*impl_->model, *impl_->data);
}

VectorXd HandWorld::BalancingTorques(FingerIndex finger, const Vector3d& at,
                                     const Vector3d& force) const {
  const Impl& impl = *impl_;
  const HandScene::Finger& state = impl.fingers[finger];
  const kinematics::Finger& chain = impl.hand.fingers[finger];
  const Vector3d at_W = impl.palm * at;
  const Vector3d force_W = impl.palm.linear() * force;
  VectorXd torques = VectorXd::Zero(chain.drives);
  for (std::size_t k = 0; k < state.joints.size(); ++k) {
    const int joint = state.joints[k];
    const Vector3d axis = VectorAt(impl.data->xaxis, joint);
    const Vector3d lever = at_W - VectorAt(impl.data->xanchor, joint);
    const double weight = impl.data->qfrc_bias[impl.model->jnt_dofadr[joint]];
    torques[chain.joints[k].drive] +=
        chain.joints[k].ratio * (axis.dot(lever.cross(force_W)) + weight);
  }
  return torques;
}

void HandWorld::Command(FingerIndex finger, const kinematics::JointConfiguration& target,
                        const VectorXd& torques) {
  Impl& impl = *impl_;
  const kinematics::JointConfiguration now = measured_configuration(finger);
  for (int drive = 0; drive < now.size(); ++drive) {
    const DriveActuator& found = impl.fingers[finger].drives[drive];
    const int a = found.actuator;
    const double nominal = 1 / impl.options.physics.gain_factor;
    const double gain = nominal * impl.model->actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a];
    const double length = impl.data->actuator_length[a];
    const double off = (target[drive] - now[drive]) * found.moment;
    const double force = torques[drive] / found.moment;
    const mjtNum* bias = impl.model->actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
    const double control = (force - nominal * bias[0] - nominal * bias[1] * (length + off)) / gain;
    const auto& range = found.servo.control_range;
    // Recorded controls, too, must be within the range of the model.
    impl.data->ctrl[a] = range ? std::clamp(control, range->front(), range->back()) : control;
  }
}

void HandWorld::SetLoad(const Vector3d& force, const Vector3d& torque) {
  mjtNum* load = impl_->data->xfrc_applied + std::ptrdiff_t{6} * impl_->object_body;
  const Vector3d force_W = impl_->palm.linear() * force;
  const Vector3d torque_W = impl_->palm.linear() * torque;
  std::copy_n(force_W.data(), 3, load);
  std::copy_n(torque_W.data(), 3, load + 3);
}

void HandWorld::PinObject(bool on) { impl_->pinned = on; }

void HandWorld::Step() {
  const mjModel* m = impl_->model;
  mjData* d = impl_->data;
  mjtNum* object = d->qpos + impl_->object_qpos;
  std::array<mjtNum, 7> place;
  std::copy_n(object, 7, place.begin());
  DampedStep(*m, *d, [this] { impl_->AddTipContacts(); });
  if (impl_->pinned) {
    std::ranges::copy(place, object);
    std::fill_n(d->qvel + m->body_dofadr[impl_->object_body], 6, 0);
  }
  for (const int joint : scene().frozen) {
    d->qpos[m->jnt_qposadr[joint]] = m->qpos0[m->jnt_qposadr[joint]];
    d->qvel[m->jnt_dofadr[joint]] = 0;
  }
  CheckState(*m, *d);
}

HandWorld::State HandWorld::Save() const {
  return {SaveState(*impl_->model, *impl_->data), controls()};
}

void HandWorld::Restore(const State& state) {
  const mjModel* m = impl_->model;
  mjData* d = impl_->data;
  impl_->surface.Forget();
  // A reset would clear the engine's entire memory for every disturbance.
  RestoreState(state.engine, *d);
  std::fill_n(d->xfrc_applied, std::ptrdiff_t{6} * m->nbody, 0);
  SetControls(state.controls);
  mj_forward(m, d);
  std::ranges::copy(state.engine.qacc_warmstart, d->qacc_warmstart);
  impl_->AddTipContacts();
}

}  // namespace regrasp::sim
