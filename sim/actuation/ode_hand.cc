#include "sim/actuation/ode_hand.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planner/base/error.h"
#include "planner/kinematics/finger_kinematics.h"
#include "sim/actuation/hand_scene.h"
#include "sim/actuation/ode_hand_bodies.h"

namespace regrasp::sim {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct OdeHand::Impl : OdeHandBodies {
  using OdeHandBodies::OdeHandBodies;
};

void CheckOdePhysics(const HandPhysics& physics) {
  const auto refuse = [](const std::string& what) {
    throw InputError("engine ode: " + what + " not supported");
  };
  if (physics.pyramidal_cones) refuse("pyramidal friction cones are");
  if (physics.contacts != TipContactModel::kStiff) refuse("the default contacts of MuJoCo are");
  if (physics.torsion_m > 0) refuse("torsional friction is");
}

OdeHand::OdeHand(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
                 const HandWorldOptions& options)
    : HandEngine(std::make_unique<HandScene>(file, solid, scale, options)) {
  CheckOdePhysics(options.physics);
  impl_ = std::make_unique<Impl>(scene());
}
OdeHand::~OdeHand() = default;

double OdeHand::time() const { return impl_->time; }
void OdeHand::Place(const plan::HandState& state) {
  Impl& impl = *impl_;
  impl.Stop();
  impl.time = 0;
  Eigen::VectorXd angles = impl.angles;
  for (FingerIndex f{0}; f < std::ssize(scene().fingers); ++f) {
    for (std::size_t k = 0; k < scene().fingers[f].joints.size(); ++k) {
      angles[impl.tree.link(f, k)] = state.joints[f][k];
    }
  }
  impl.SetAngles(angles);
  std::ranges::fill(impl.controls, 0);
  impl.load = impl.torque = Vector3d::Zero();
  const Isometry3d pose = scene().palm * state.pose;
  impl.centre = pose * scene().centroid;
  impl.turn = Quaterniond(pose.linear());
  impl.FindTouches();
}

plan::HandState OdeHand::state() const {
  plan::HandState state{object_pose(), {}};
  for (FingerIndex f{0}; f < std::ssize(scene().fingers); ++f) {
    state.joints.push_back(joint_angles_of(f));
  }
  return state;
}

Isometry3d OdeHand::object_pose() const { return scene().palm.inverse() * impl_->ObjectPose(); }

double OdeHand::largest_speed() const {
  const OdeHandBodies::Motion& motion = impl_->object_motion;
  return std::max({motion.velocity.cwiseAbs().maxCoeff(), motion.spin.cwiseAbs().maxCoeff(),
                   impl_->speeds.cwiseAbs().maxCoeff()});
}

kinematics::JointConfiguration OdeHand::configuration(FingerIndex finger) const {
  return kinematics::ConfigurationAt(scene().hand.fingers[finger], joint_angles_of(finger));
}

std::vector<double> OdeHand::joint_angles_of(FingerIndex finger) const {
  std::vector<double> angles;
  for (std::size_t k = 0; k < scene().fingers[finger].joints.size(); ++k) {
    angles.push_back(impl_->angles[impl_->tree.link(finger, k)]);
  }
  return angles;
}

Vector3d OdeHand::tip(FingerIndex finger) const {
  return scene().palm.inverse() * (impl_->TipLink(finger) * scene().surface.ball(finger));
}

TipTouch OdeHand::touch(FingerIndex finger) const {
  const Impl& impl = *impl_;
  TipTouch touch;
  const std::optional<collision::SurfaceContact>& near = scene().surface.nearest(finger);
  if (!near) return touch;
  const Isometry3d pose = impl.ObjectPose();
  touch.point_O = near->point;
  touch.inward_O = -near->outward;
  touch.gap = near->gap;
  Vector3d force = Vector3d::Zero();
  Vector3d point = Vector3d::Zero();
  Vector3d inward = Vector3d::Zero();
  double pressing = 0;
  for (const OdeHandBodies::Touch& one : impl.touches) {
    if (one.finger != finger) continue;
    const double normal = one.force.dot(one.inward);
    force += one.force;
    pressing += normal;
    point += normal * one.point;
    inward += normal * one.inward;
  }
  touch.force = scene().palm.linear().transpose() * force;
  if (scene().options.tip == TipShape::kGeometry && pressing > 0 && inward != Vector3d::Zero()) {
    touch.point_O = pose.inverse() * (point / pressing);
    touch.inward_O = (pose.linear().transpose() * inward).normalized();
  }
  const Vector3d at = pose * touch.point_O;
  const Vector3d speed =
      pose.linear().transpose() *
      (impl.SpeedOfLinkAt(impl.tree.tip(finger).link, at) - impl.SpeedOfObjectAt(at));
  touch.sliding_O = speed - speed.dot(touch.inward_O) * touch.inward_O;
  return touch;
}

std::optional<collision::NearPoint> OdeHand::NearBall(FingerIndex finger) const {
  return NearSphere(finger, object_pose().inverse() * tip(finger));
}

double OdeHand::torque(FingerIndex finger, int drive) const {
  const int link = impl_->LeadingLink(finger, drive);
  return impl_->forces[link] * impl_->drives[link].moment;
}

bool OdeHand::is_control_at_limit(FingerIndex finger, int drive) const {
  const DriveActuator& found = scene().fingers[finger].drives[drive];
  const auto& range = found.servo.control_range;
  const double control = impl_->controls[found.actuator];
  return range && (control <= range->front() || control >= range->back());
}

JointCouplings::Residual OdeHand::largest_coupling_residual() const { return {}; }

VectorXd OdeHand::BalancingTorques(FingerIndex finger, const Vector3d& at,
                                   const Vector3d& force) const {
  const Impl& impl = *impl_;
  const kinematics::Finger& chain = scene().hand.fingers[finger];
  const Vector3d at_W = scene().palm * at;
  const Vector3d force_W = scene().palm.linear() * force;
  const Eigen::Map<const Vector3d> gravity(scene().model->opt.gravity);
  VectorXd torques = VectorXd::Zero(chain.drives);
  // The sums start at the fingertip, because a joint supports all links that it moves.
  double mass = 0;
  Vector3d moment = Vector3d::Zero();  // sum of mass times centre
  for (std::size_t k = chain.joints.size(); k-- > 0;) {
    const int i = impl.tree.link(finger, k);
    const LinkTree::Link& link = impl.tree.links()[i];
    mass += link.mass;
    moment += link.mass * impl.CentreOf(i);
    const Vector3d axis = impl.AxisOf(i);
    const Vector3d anchor = impl.poses[i] * link.anchor;
    const double weight = -axis.dot((moment - mass * anchor).cross(gravity));
    torques[chain.joints[k].drive] +=
        chain.joints[k].ratio * (axis.dot((at_W - anchor).cross(force_W)) + weight);
  }
  return torques;
}

void OdeHand::Command(FingerIndex finger, const kinematics::JointConfiguration& target,
                      const VectorXd& torques) {
  const kinematics::JointConfiguration now = measured_configuration(finger);
  const double nominal = 1 / scene().options.physics.gain_factor;
  for (int drive = 0; drive < now.size(); ++drive) {
    const int i = impl_->LeadingLink(finger, drive);
    const JointDrive& law = impl_->drives[i];
    const double angle = impl_->angles[i] + target[drive] - now[drive];
    const double force = torques[drive] / law.moment;
    const double control =
        (force - nominal * (law.constant + law.per_angle * angle)) / (nominal * law.gain);
    const auto& range = scene().fingers[finger].drives[drive].servo.control_range;
    impl_->controls[law.actuator] =
        range ? std::clamp(control, range->front(), range->back()) : control;
  }
}

void OdeHand::SetLoad(const Vector3d& force, const Vector3d& torque) {
  impl_->load = scene().palm.linear() * force;
  impl_->torque = scene().palm.linear() * torque;
}

void OdeHand::PinObject(bool on) { impl_->pinned = on; }

void OdeHand::Step() {
  for (int i = 0; i < OdeHandBodies::kSubsteps; ++i) impl_->Step();
}

// Positions: joint angles, centre, rotation as w x y z. Velocities: joint speeds, links, object. In
// place of MuJoCo's warm start there are the contacts: finger, number, and force.
OdeHand::State OdeHand::Save() const {
  const Impl& impl = *impl_;
  State state;
  EngineState& saved = state.engine;
  saved.time = impl.time;
  saved.qpos.assign(impl.angles.begin(), impl.angles.end());
  AppendVector(impl.centre, saved.qpos);
  saved.qpos.insert(saved.qpos.end(), {impl.turn.w(), impl.turn.x(), impl.turn.y(), impl.turn.z()});
  saved.qvel.assign(impl.speeds.begin(), impl.speeds.end());
  for (const OdeHandBodies::Motion& motion : impl.motions) {
    AppendVector(motion.velocity, saved.qvel);
    AppendVector(motion.spin, saved.qvel);
  }
  AppendVector(impl.object_motion.velocity, saved.qvel);
  AppendVector(impl.object_motion.spin, saved.qvel);
  for (const OdeHandBodies::Touch& touch : impl.touches) {
    saved.qacc_warmstart.push_back(touch.finger);
    saved.qacc_warmstart.push_back(touch.number);
    AppendVector(touch.force, saved.qacc_warmstart);
  }
  state.controls = impl.controls;
  return state;
}

void OdeHand::Restore(const State& state) {
  Impl& impl = *impl_;
  impl.Stop();
  impl.time = state.engine.time;
  const double* q = state.engine.qpos.data();
  const double* v = state.engine.qvel.data();
  for (double& angle : impl.angles) angle = *q++;
  for (double& speed : impl.speeds) speed = *v++;
  impl.centre = TakeVector(q);
  impl.turn = Quaterniond(q[0], q[1], q[2], q[3]);
  for (OdeHandBodies::Motion& motion : impl.motions) {
    motion.velocity = TakeVector(v);
    motion.spin = TakeVector(v);
  }
  impl.object_motion.velocity = TakeVector(v);
  impl.object_motion.spin = TakeVector(v);
  impl.controls = state.controls;
  impl.load = impl.torque = Vector3d::Zero();
  impl.poses = impl.tree.Place(impl.angles);
  const std::vector<double>& contacts = state.engine.qacc_warmstart;
  for (const double* c = contacts.data(); c != contacts.data() + contacts.size();) {
    OdeHandBodies::Touch touch{FingerIndex(static_cast<int>(c[0])), static_cast<int>(c[1])};
    c += 2;
    touch.force = TakeVector(c);
    impl.touches.push_back(touch);
  }
  impl.FindTouches();
}

}  // namespace regrasp::sim
