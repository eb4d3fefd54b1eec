#include "sim/actuation/hand_world.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <deque>
#include <mutex>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/drive_servo.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/scene_model.h"
#include "sim/actuation/tip_geometry.h"
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

/// Allocate memory for `contacts` contacts and the largest number of constraint rows. Rows are
/// those of contacts, range limits, joint friction and couplings. The memory is cleared whenever a
/// state is placed.
void SetRoom(int contacts, const HandPhysics& physics, mjModel& model) {
  const int tangents = physics.torsion_m > 0 ? 3 : 2;
  const int rows_of_contact = physics.pyramidal_cones ? 2 * tangents : 1 + tangents;
  constexpr int kRowsOfWeld = 6;  // largest number of rows of a coupling
  model.nconmax = contacts;
  model.njmax = rows_of_contact * contacts + kRowsOfWeld * model.neq +
                2 * (model.njnt + model.ntendon) + model.nv + model.ntendon;
}

/// Compiled scenes that were used last. To compile a hand with large meshes takes seconds, and many
/// replays differ only in what is set after that.
class CompiledScenes {
 public:
  /// Return a copy of the compiled scene of a hand and an object.
  static kinematics::ModelPtr Get(const kinematics::HandFile& file,
                                  const kinematics::ModelText& scene) {
    std::string text = kinematics::FormatXml(scene.root);
    static CompiledScenes scenes;
    const std::scoped_lock lock(scenes.mutex_);
    std::deque<Entry>& known = scenes.entries_;
    auto found = std::ranges::find_if(known, [&](const Entry& entry) {
      return entry.hand == file.compiled && entry.text == text;
    });
    if (found == known.end()) {
      kinematics::ModelPtr model =
          kinematics::CompileText(file.compiled->text.files.front(), scene);
      known.push_front({file.compiled, std::move(text), std::move(model)});
      if (known.size() > kMostKnown) known.pop_back();
      found = known.begin();
    }
    kinematics::ModelPtr copy(mj_copyModel(nullptr, found->model.get()));
    if (!copy) throw EnvironmentError("MuJoCo has no memory for a hand");
    return copy;
  }

 private:
  static constexpr std::size_t kMostKnown = 4;
  struct Entry {
    std::shared_ptr<const kinematics::CompiledModel> hand;
    std::string text;
    kinematics::ModelPtr model;
  };
  std::mutex mutex_;
  std::deque<Entry> entries_;
};

}  // namespace

struct HandWorld::Impl {
  struct FingerState {
    std::vector<int> joints;  ///< joints of the model
    int tip_body = 0;
    int tip_geom = 0;  ///< geom that represents all touching shapes
    std::vector<DriveActuator> drives;
  };

  EngineHooks hooks;
  kinematics::HandModel hand;
  HandLinks links;
  TipSurface surface;
  HandWorldOptions options;
  kinematics::ModelPtr model;
  kinematics::DataPtr data;
  Isometry3d palm = Isometry3d::Identity();  ///< pose in the engine's world
  Vector3d centroid;
  int object_body = 0, object_geom = 0, object_qpos = 0;
  std::vector<FingerState> fingers;
  std::vector<int> frozen;  ///< frozen joints
  bool pinned = false;      ///< whether the object is fixed
  std::optional<JointCouplings> couplings;

  Impl(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
       const HandWorldOptions& given)
      : hand(file.hand), links(file), surface(file, given.tip, solid, scale), options(given) {
    model = CompiledScenes::Get(file, HandSceneText(file, solid, scale, options.mass_kg));
    SetRoom(surface.most_contacts(), options.physics, *model);
    data.reset(mj_makeData(model.get()));
    if (!data) throw EnvironmentError("MuJoCo has no memory for a hand");
    centroid = scale * solid.mass_properties().centroid;
    FindParts(file);
    CheckObjectMass(file);
    FindFrozen();
    FreezeJoints(frozen, *model);
    FindServos();
    SetTruePhysics();
    UpdateConstants(*model, *data);
    SetReplayOptions(-options.gravity_m_s2 * (palm.linear() * hand.up), options.physics, frozen,
                     *model);
    couplings.emplace(*model);
    // Contacts of links are violations that ExecutionMonitor finds, not forces. The engine checks
    // only named pairs, and there are none.
    model->opt.collision = mjCOL_PAIR;
    model->npair = 0;
    std::fill_n(model->geom_contype, model->ngeom, 0);
    std::fill_n(model->geom_conaffinity, model->ngeom, 0);
  }

  [[nodiscard]] int Id(int kind, const std::string& name) const {
    const int id = mj_name2id(model.get(), kind, name.c_str());
    if (id < 0) throw InputError("the hand's model has no \"" + name + "\"");
    return id;
  }

  void FindParts(const kinematics::HandFile& file) {
    object_body = Id(mjOBJ_BODY, kHandSceneObject);
    object_geom = model->body_geomadr[object_body];
    object_qpos = model->jnt_qposadr[model->body_jntadr[object_body]];
    mj_forward(model.get(), data.get());
    palm = PoseAt(*data, Id(mjOBJ_BODY, file.description.palm));
    for (const kinematics::Finger& finger : hand.fingers) {
      FingerState& state = fingers.emplace_back();
      for (const kinematics::Joint& joint : finger.joints) {
        state.joints.push_back(Id(mjOBJ_JOINT, joint.name));
      }
      state.tip_body = Id(mjOBJ_BODY, finger.tip.body);
      if (model->body_geomnum[state.tip_body] == 0) {
        throw InputError(file.description.model + ": the body " + finger.tip.body + " has no geom");
      }
      state.tip_geom = model->body_geomadr[state.tip_body];
    }
  }

  /// Check that the hand's model does not change the mass of the object.
  void CheckObjectMass(const kinematics::HandFile& file) const {
    constexpr double kTolerance = 1e-9;
    const double mass = model->body_mass[object_body];
    if (std::abs(mass - options.mass_kg) <= kTolerance * options.mass_kg) return;
    throw InputError(file.description.model +
                     ": the model's compiler settings change the mass of the object, expected " +
                     FormatShort(options.mass_kg) + " kg, found " + FormatShort(mass) + " kg");
  }

  /// Return whether a joint is revolute or prismatic.
  [[nodiscard]] bool IsScalar(int joint) const {
    return model->jnt_type[joint] == mjJNT_HINGE || model->jnt_type[joint] == mjJNT_SLIDE;
  }

  /// Find the joints of no finger.
  void FindFrozen() {
    for (int joint = 0; joint < model->njnt; ++joint) {
      const bool of_finger = std::ranges::any_of(fingers, [&](const FingerState& finger) {
        return std::ranges::find(finger.joints, joint) != finger.joints.end();
      });
      if (of_finger || model->jnt_bodyid[joint] == object_body) continue;
      if (IsScalar(joint)) frozen.push_back(joint);
    }
  }

  /// Find the actuator and the servo of each independent joint.
  void FindServos() {
    mj_forward(model.get(), data.get());
    for (std::size_t i = 0; i < fingers.size(); ++i) {
      const kinematics::Finger& finger = hand.fingers[i];
      for (int drive = 0; drive < finger.drives; ++drive) {
        fingers[i].drives.push_back(
            FindServo(finger, fingers[i].joints, drive, options.force_factor, *data, *model));
      }
    }
  }

  /// Set gains and joint friction that the controller does not know.
  void SetTruePhysics() {
    const HandPhysics& physics = options.physics;
    for (FingerState& finger : fingers) {
      for (const DriveActuator& drive : finger.drives) {
        const int a = drive.actuator;
        model->actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a] *= physics.gain_factor;
        mjtNum* bias = model->actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
        for (int i = 0; i < 3; ++i) bias[i] *= physics.gain_factor;
      }
      for (const int joint : finger.joints) {
        model->dof_frictionloss[model->jnt_dofadr[joint]] += physics.joint_friction_Nm;
      }
    }
  }

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
    const FingerState& state = fingers[finger];
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
        mj_addContact(model.get(), data.get(), &made);
      }
    }
  }

  [[nodiscard]] ContactSum SumContacts(FingerIndex finger) const {
    return SumTipContacts(*model, *data, object_geom, fingers[finger].tip_geom);
  }
};

HandWorld::HandWorld(const kinematics::HandFile& file, const object::Polyhedron& solid,
                     double scale, const HandWorldOptions& options)
    : impl_(std::make_unique<Impl>(file, solid, scale, options)) {}
HandWorld::~HandWorld() = default;

const kinematics::HandModel& HandWorld::hand() const { return impl_->hand; }
const mjModel& HandWorld::model() const { return *impl_->model; }
double HandWorld::time() const { return impl_->data->time; }
double HandWorld::timestep() const { return impl_->model->opt.timestep; }
const Vector3d& HandWorld::centroid_O() const { return impl_->centroid; }

void HandWorld::Place(const plan::HandState& state) {
  Impl& impl = *impl_;
  mj_resetData(impl.model.get(), impl.data.get());
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
  mj_forward(impl.model.get(), impl.data.get());
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

kinematics::JointConfiguration HandWorld::measured_configuration(FingerIndex finger) const {
  const std::vector<kinematics::JointConfiguration>& offsets = impl_->options.joint_offsets;
  if (offsets.empty()) return configuration(finger);
  return configuration(finger) + offsets[finger];
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

std::optional<collision::NearPoint> HandWorld::NearSphere(FingerIndex finger,
                                                          const Vector3d& centre_O) const {
  return impl_->surface.NearBall(finger, centre_O);
}

const DriveServo& HandWorld::servo(FingerIndex finger, int drive) const {
  return impl_->fingers[finger].drives[drive].servo;
}

std::vector<std::string> HandWorld::control_names() const {
  std::vector<std::string> names;
  for (int actuator = 0; actuator < impl_->model->nu; ++actuator) {
    const char* name = mj_id2name(impl_->model.get(), mjOBJ_ACTUATOR, actuator);
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
    if (!impl_->IsScalar(joint)) continue;
    const char* name = mj_id2name(impl_->model.get(), mjOBJ_JOINT, joint);
    names.push_back(name == nullptr ? "joint " + std::to_string(joint) : name);
  }
  return names;
}

std::vector<double> HandWorld::joint_angles() const {
  std::vector<double> angles;
  for (int joint = 0; joint < impl_->model->njnt; ++joint) {
    if (!impl_->IsScalar(joint)) continue;
    angles.push_back(impl_->data->qpos[impl_->model->jnt_qposadr[joint]]);
  }
  return angles;
}

double HandWorld::load_share(FingerIndex finger, int drive) const {
  const DriveActuator& found = impl_->fingers[finger].drives[drive];
  if (!std::isfinite(found.servo.limit)) return 0;
  return std::abs(impl_->data->actuator_force[found.actuator] * found.moment) / found.servo.limit;
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

std::vector<DriveLimits> HandWorld::limits() const {
  std::vector<DriveLimits> limits;
  for (FingerIndex f{0}; f < std::ssize(impl_->fingers); ++f) {
    const kinematics::Finger& chain = impl_->hand.fingers[f];
    for (int drive = 0; drive < chain.drives; ++drive) {
      const DriveActuator& found = impl_->fingers[f].drives[drive];
      const auto joint = std::ranges::find(chain.joints, drive, &kinematics::Joint::drive);
      limits.push_back({f, joint->name, kinematics::ActuatorName(*impl_->model, found.actuator),
                        found.servo.limit, found.servo.control_range, joint->lower, joint->upper});
    }
  }
  return limits;
}

JointCouplings::Residual HandWorld::largest_coupling_residual() const {
  return impl_->couplings->Largest(*impl_->model, *impl_->data);
}

std::string HandWorld::CouplingText(int equality) const {
  return impl_->couplings->TextOf(*impl_->model, equality);
}

std::pair<FingerIndex, int> HandWorld::JointOfCoupling(int equality) const {
  const int joint = impl_->couplings->JointOf(*impl_->model, equality);
  for (FingerIndex f{0}; f < std::ssize(impl_->fingers); ++f) {
    const std::vector<int>& joints = impl_->fingers[f].joints;
    const auto at = std::ranges::find(joints, joint);
    if (at != joints.end()) return {f, static_cast<int>(at - joints.begin())};
  }
  return {FingerIndex(), -1};
}

const HandLinks& HandWorld::links() const { return impl_->links; }
TipShape HandWorld::tip_shape() const { return impl_->options.tip; }

VectorXd HandWorld::BalancingTorques(FingerIndex finger, const Vector3d& at,
                                     const Vector3d& force) const {
  const Impl& impl = *impl_;
  const Impl::FingerState& state = impl.fingers[finger];
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
  const mjModel* m = impl_->model.get();
  mjData* d = impl_->data.get();
  // The calls of mj_step, with the contacts of the fingertips inserted.
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_tendon(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_collision(m, d);
  impl_->AddTipContacts();
  mj_makeConstraint(m, d);
  mj_transmission(m, d);
  mj_projectConstraint(m, d);
  mj_fwdVelocity(m, d);
  mjtNum* object = d->qpos + impl_->object_qpos;
  std::array<mjtNum, 7> place;
  std::copy_n(object, 7, place.begin());
  mj_step2(m, d);
  if (impl_->pinned) {
    std::ranges::copy(place, object);
    std::fill_n(d->qvel + m->body_dofadr[impl_->object_body], 6, 0);
  }
  for (const int joint : impl_->frozen) {
    d->qpos[m->jnt_qposadr[joint]] = m->qpos0[m->jnt_qposadr[joint]];
    d->qvel[m->jnt_dofadr[joint]] = 0;
  }
  CheckState(*m, *d);
}

HandWorld::State HandWorld::Save() const {
  return {SaveState(*impl_->model, *impl_->data), controls()};
}

void HandWorld::Restore(const State& state) {
  const mjModel* m = impl_->model.get();
  mjData* d = impl_->data.get();
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
