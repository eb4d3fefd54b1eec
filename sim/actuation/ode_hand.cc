#include "sim/actuation/ode_hand.h"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planner/base/error.h"
#include "planner/kinematics/finger_kinematics.h"
#include "sim/actuation/hand_scene.h"
#include "sim/actuation/joint_drive.h"
#include "sim/actuation/link_tree.h"
#include "sim/ode/ode_world.h"

namespace regrasp::sim {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Compliance of all constraints over the mobility of the object. It makes the friction of a grasp
/// with redundant contacts unique; an object creeps by less than 0.1 µm/s.
constexpr double kCompliance = 1e-7;
/// Share of a contact's depth that a step recovers, ODE's default.
constexpr double kDepthRecovery = 0.2;
/// Largest speed of this recovery, m/s.
constexpr double kMostRecovery = 0.05;
/// Depth of contacts in equilibrium, metres, so that they hold the object from step to step.
constexpr double kRestDepth = 1e-6;
/// Largest number of solutions of a step until all contacts obey their cones and all actuators
/// their limits. If forces alternate, the last ones are used.
constexpr int kMostSolutions = 20;
/// Contact force below which the cone is not checked, newtons.
constexpr double kSlack = 1e-5;
/// Force of a contact before its first solution, newtons.
constexpr double kFirstForce = 0.05;
// Perturbations of steps that fail: see sim/ode/ode_engine.cc.
constexpr double kNarrower = 1e-6;
constexpr double kSofter = 3;
constexpr int kMostTries = 8;

/// Position and velocity of a body: its centre of mass, and its rotation.
struct Motion {
  Vector3d velocity = Vector3d::Zero(), spin = Vector3d::Zero();
};

/// Contact of a fingertip in a step, in the world.
struct Touch {
  FingerIndex finger;
  int number = 0;  ///< among those of the finger
  Vector3d point = Vector3d::Zero();
  Vector3d inward = Vector3d::Zero();  ///< unit normal into the object
  double depth = 0;
  Vector3d force = Vector3d::Zero();  ///< on the object
};

Vector3d Read(const dReal* values) { return {values[0], values[1], values[2]}; }

void SetInertia(dBodyID body, double mass, const Matrix3d& I) {
  dMass values;
  dMassSetParameters(&values, mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  dBodySetMass(body, &values);
}

void SetPose(dBodyID body, const Vector3d& centre, const Quaterniond& turn) {
  dBodySetPosition(body, centre.x(), centre.y(), centre.z());
  const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
  dBodySetQuaternion(body, q);
}

void SetMotion(dBodyID body, const Motion& motion) {
  const auto& [v, w] = motion;
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

Motion MotionOf(dBodyID body) {
  return {Read(dBodyGetLinearVel(body)), Read(dBodyGetAngularVel(body))};
}

bool IsFinite(const Motion& motion) {
  return motion.velocity.allFinite() && motion.spin.allFinite();
}

}  // namespace

struct OdeHand::Impl {
  HandScene& scene;
  LinkTree tree{scene};
  std::vector<JointDrive> drives = JointDrivesOf(scene, tree);
  double timestep = scene.options.physics.timestep_s;

  OdeWorld world = MakeOdeWorld();
  OdeJointsPtr hinges{dJointGroupCreate(0)};
  OdeJointsPtr contact_joints{dJointGroupCreate(0)};
  dBodyID object = nullptr;
  std::vector<dBodyID> bodies;   ///< by link
  std::vector<dJointID> motors;  ///< by link
  double mass = 0;               ///< of the object

  // State.
  double time = 0;
  VectorXd angles, speeds;      ///< of the joints, by link
  std::vector<Motion> motions;  ///< of the links' centres
  Vector3d centre = Vector3d::Zero();
  Quaterniond turn = Quaterniond::Identity();
  Motion object_motion;
  std::vector<Touch> touches;  ///< contacts in the last step

  // Inputs.
  std::vector<double> controls;  ///< by actuator
  Vector3d load = Vector3d::Zero(), torque = Vector3d::Zero();
  bool pinned = false;

  // Results.
  std::vector<Isometry3d> poses;  ///< of the links
  VectorXd forces;                ///< forces of actuators, by link
  long steps = 0, solutions = 0;

  explicit Impl(HandScene& given);
  void MakeObject();
  void MakeLinks();
  void MakeHinge(int link);

  [[nodiscard]] Isometry3d ObjectPose() const {
    Isometry3d pose = Eigen::Translation3d(centre) * turn;
    pose.translation() -= pose.linear() * scene.centroid;
    return pose;
  }
  [[nodiscard]] Isometry3d TipLink(FingerIndex f) const {
    const LinkTree::Tip& tip = tree.tip(f);
    return poses[tip.link] * tip.in_link;
  }
  [[nodiscard]] JointDrive::Input InputOf(std::size_t link) const {
    const int i = static_cast<int>(link);
    const int a = drives[link].actuator;
    return {angles[i], speeds[i], a < 0 ? 0 : controls[a], timestep};
  }
  [[nodiscard]] Vector3d CentreOf(std::size_t link) const {
    return poses[link] * tree.links()[link].centre;
  }
  [[nodiscard]] Vector3d AxisOf(std::size_t link) const {
    return poses[link].linear() * tree.links()[link].axis;
  }
  [[nodiscard]] Vector3d SpeedOfLinkAt(int link, const Vector3d& point) const {
    const Motion& motion = motions[link];
    return motion.velocity + motion.spin.cross(point - CentreOf(link));
  }
  [[nodiscard]] Vector3d SpeedOfObjectAt(const Vector3d& point) const {
    return object_motion.velocity + object_motion.spin.cross(point - centre);
  }

  void Stop();
  void FindTouches();
  void LoadBodies();
  void LoadMotors(const std::vector<int>& saturated);
  void AddContacts(int tried, std::vector<Touch>& trial, std::vector<FrictionBox>& boxes,
                   std::vector<dJointFeedback>& feedback);
  [[nodiscard]] VectorXd SolvedSpeeds() const;
  [[nodiscard]] bool Solve(int tried, std::vector<Touch>& trial);
  void Step();
  void TakeBodies();
};

OdeHand::Impl::Impl(HandScene& given) : scene(given) {
  const mjModel& model = *scene.model;
  mass = model.body_mass[scene.object_body];
  controls.assign(model.nu, 0);
  const auto count = static_cast<int>(tree.links().size());
  angles.resize(count);
  for (int i = 0; i < count; ++i) angles[i] = tree.links()[i].rest;
  speeds = forces = VectorXd::Zero(count);
  motions.resize(count);
  poses = tree.Place(angles);
  const mjtNum* g = model.opt.gravity;
  dWorldSetGravity(world.get(), g[0], g[1], g[2]);
  dWorldSetERP(world.get(), kDepthRecovery);
  dWorldSetContactSurfaceLayer(world.get(), kRestDepth);
  dWorldSetContactMaxCorrectingVel(world.get(), kMostRecovery);
  MakeObject();
  MakeLinks();
}

void OdeHand::Impl::MakeObject() {
  const mjModel& model = *scene.model;
  const int body = scene.object_body;
  const mjtNum* q = model.body_iquat + std::ptrdiff_t{4} * body;
  const Matrix3d axes = Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Eigen::Map<const Vector3d> inertia(model.body_inertia + std::ptrdiff_t{3} * body);
  object = dBodyCreate(world.get());
  SetInertia(object, mass, axes * inertia.asDiagonal() * axes.transpose());
}

void OdeHand::Impl::MakeLinks() {
  for (std::size_t i = 0; i < tree.links().size(); ++i) {
    const LinkTree::Link& link = tree.links()[i];
    bodies.push_back(dBodyCreate(world.get()));
    SetInertia(bodies.back(), link.mass, link.inertia);
    SetPose(bodies.back(), CentreOf(i), Quaterniond(poses[i].linear()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) MakeHinge(static_cast<int>(i));
}

/// Make the hinge of a link, and the motors about its axis.
void OdeHand::Impl::MakeHinge(int link) {
  const LinkTree::Link& made = tree.links()[link];
  const JointDrive& drive = drives[link];
  const dBodyID parent = made.parent < 0 ? nullptr : bodies[made.parent];
  const Vector3d anchor = poses[link] * made.anchor;
  const Vector3d axis = AxisOf(link);
  const dJointID hinge = dJointCreateHinge(world.get(), hinges.get());
  dJointAttach(hinge, bodies[link], parent);
  dJointSetHingeAnchor(hinge, anchor.x(), anchor.y(), anchor.z());
  dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
  if (drive.is_limited) {
    dJointSetHingeParam(hinge, dParamLoStop, drive.lower - made.rest);
    dJointSetHingeParam(hinge, dParamHiStop, drive.upper - made.rest);
    // Stops are set again because ODE refuses a lower one above the present upper one.
    dJointSetHingeParam(hinge, dParamLoStop, drive.lower - made.rest);
  }
  const auto add_motor = [&] {
    const dJointID motor = dJointCreateAMotor(world.get(), hinges.get());
    dJointAttach(motor, bodies[link], parent);
    dJointSetAMotorMode(motor, dAMotorUser);
    dJointSetAMotorNumAxes(motor, 1);
    dJointSetAMotorAxis(motor, 0, 1, axis.x(), axis.y(), axis.z());
    return motor;
  };
  motors.push_back(add_motor());
  if (drive.friction > 0) {
    const dJointID brake = add_motor();
    dJointSetAMotorParam(brake, dParamVel, 0);
    dJointSetAMotorParam(brake, dParamFMax, drive.friction);
  }
}

/// Set all velocities to zero, and forget contacts.
void OdeHand::Impl::Stop() {
  speeds.setZero();
  forces.setZero();
  std::ranges::fill(motions, Motion());
  object_motion = {};
  touches.clear();
  scene.surface.Forget();
}

/// Find the contacts; each has the force of the last step.
void OdeHand::Impl::FindTouches() {
  const std::vector<Touch> last = std::move(touches);
  touches.clear();
  const Isometry3d pose = ObjectPose();
  const Isometry3d to_object = pose.inverse();
  for (FingerIndex f{0}; f < std::ssize(scene.fingers); ++f) {
    int number = 0;
    for (const auto& found : scene.surface.FindContacts(f, TipLink(f), to_object)) {
      if (found.gap >= 0) continue;
      Touch touch{f, number++, pose * found.point, -(pose.linear() * found.outward), -found.gap};
      const auto known = std::ranges::find_if(
          last, [&](const Touch& one) { return one.finger == f && one.number == touch.number; });
      if (known != last.end()) touch.force = known->force;
      touches.push_back(touch);
    }
  }
}

/// Set ODE's bodies to the state, with all loads on them.
void OdeHand::Impl::LoadBodies() {
  SetPose(object, centre, turn);
  SetMotion(object, object_motion);
  if (pinned) {
    dBodySetKinematic(object);
  } else {
    dBodySetDynamic(object);
  }
  dBodySetForce(object, load.x(), load.y(), load.z());
  dBodySetTorque(object, torque.x(), torque.y(), torque.z());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    SetPose(bodies[i], CentreOf(i), Quaterniond(poses[i].linear()));
    SetMotion(bodies[i], motions[i]);
    dBodySetForce(bodies[i], 0, 0, 0);
    dBodySetTorque(bodies[i], 0, 0, 0);
  }
}

/// Set the law of every joint. A motor exerts (v − w)/c about its axis, with the speed w.
void OdeHand::Impl::LoadMotors(const std::vector<int>& saturated) {
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const JointDrive::Law law = drives[i].LawFor(InputOf(i), saturated[i]);
    const bool acts = law.slope > 0;
    dJointSetAMotorParam(motors[i], dParamFMax, acts ? dInfinity : 0);
    if (!acts) continue;
    dJointSetAMotorParam(motors[i], dParamVel, law.offset / law.slope);
    dJointSetAMotorParam(motors[i], dParamCFM, 1 / law.slope);
  }
}

void OdeHand::Impl::AddContacts(int tried, std::vector<Touch>& trial,
                                std::vector<FrictionBox>& boxes,
                                std::vector<dJointFeedback>& feedback) {
  dJointGroupEmpty(contact_joints.get());
  for (std::size_t k = 0; k < trial.size(); ++k) {
    const std::size_t i = (k + static_cast<std::size_t>(tried)) % trial.size();
    const Touch& touch = trial[i];
    const bool presses = touch.force.dot(touch.inward) > 0;
    const Vector3d last = presses ? touch.force : Vector3d(kFirstForce * touch.inward);
    boxes[i] = BoxInCircle(touch.inward, last, scene.options.mu);
    boxes[i].along *= 1 - kNarrower * tried * static_cast<double>(k + 1);
    dContact contact{};
    contact.surface.mode = dContactMu2 | dContactFDir1;
    contact.surface.mu = boxes[i].along;
    contact.surface.mu2 = boxes[i].across;
    contact.geom.depth = touch.depth;
    for (int axis = 0; axis < 3; ++axis) {
      contact.geom.pos[axis] = touch.point[axis];
      contact.geom.normal[axis] = touch.inward[axis];
      contact.fdir1[axis] = boxes[i].direction[axis];
    }
    const dJointID joint = dJointCreateContact(world.get(), contact_joints.get(), &contact);
    // ODE's normals point into the first body.
    dJointAttach(joint, object, bodies[tree.tip(touch.finger).link]);
    dJointSetFeedback(joint, &feedback[i]);
  }
}

/// Return the speeds of the joints after ODE's step.
VectorXd OdeHand::Impl::SolvedSpeeds() const {
  VectorXd solved(speeds.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Vector3d spin = Read(dBodyGetAngularVel(bodies[i]));
    const int parent = tree.links()[i].parent;
    if (parent >= 0) spin -= Read(dBodyGetAngularVel(bodies[parent]));
    solved[static_cast<int>(i)] = AxisOf(i).dot(spin);
  }
  return solved;
}

/// Solve the step repeatedly until contacts obey their cones and actuators their limits.
/// @return whether ODE's solver converged.
bool OdeHand::Impl::Solve(int tried, std::vector<Touch>& trial) {
  std::vector<FrictionBox> boxes(trial.size());
  std::vector<dJointFeedback> feedback(trial.size());
  std::vector<int> saturated(drives.size(), 0);
  for (int solution = 0; solution < kMostSolutions; ++solution) {
    ++solutions;
    LoadBodies();
    LoadMotors(saturated);
    AddContacts(tried, trial, boxes, feedback);
    if (!StepOde(world.get(), timestep)) return false;
    bool kept = true;
    const VectorXd solved = SolvedSpeeds();
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const int now = drives[i].Saturation(InputOf(i), solved[static_cast<int>(i)]);
      kept = kept && now == saturated[i];
      saturated[i] = now;
    }
    for (std::size_t i = 0; i < trial.size(); ++i) {
      trial[i].force = Read(feedback[i].f1);
      kept = kept && KeepsCone(trial[i].inward, boxes[i], trial[i].force, scene.options.mu, kSlack);
    }
    if (kept) break;
  }
  return true;
}

void OdeHand::Impl::Step() {
  ++steps;
  FindTouches();
  double compliance = kCompliance / mass * timestep;
  for (int tried = 0; tried < kMostTries; ++tried, compliance *= kSofter) {
    dWorldSetCFM(world.get(), compliance);
    std::vector<Touch> trial = touches;
    if (!Solve(tried, trial)) continue;
    touches = std::move(trial);
    TakeBodies();
    time += timestep;
    return;
  }
  throw UnstableError("the solver of ODE did not converge");
}

void OdeHand::Impl::TakeBodies() {
  const VectorXd solved = SolvedSpeeds();
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const int k = static_cast<int>(i);
    forces[k] = drives[i].Force(InputOf(i), solved[k]);
    motions[i] = MotionOf(bodies[i]);
  }
  speeds = solved;
  angles += timestep * speeds;
  poses = tree.Place(angles);
  if (!pinned) {
    centre = Read(dBodyGetPosition(object));
    const dReal* q = dBodyGetQuaternion(object);
    turn = Quaterniond(q[0], q[1], q[2], q[3]);
    object_motion = MotionOf(object);
  } else {
    object_motion = {};
  }
  const bool finite = angles.allFinite() && speeds.allFinite() && centre.allFinite() &&
                      turn.coeffs().allFinite() && IsFinite(object_motion) &&
                      std::ranges::all_of(motions, IsFinite);
  if (!finite) throw UnstableError("the state is not finite");
}

namespace {

/// Refuse physics that only MuJoCo has.
void CheckPhysics(const HandPhysics& physics) {
  const auto refuse = [](const std::string& what) {
    throw InputError("engine ode: " + what + " not supported");
  };
  if (physics.pyramidal_cones) refuse("pyramidal friction cones are");
  if (physics.contacts != TipContactModel::kStiff) refuse("the default contacts of MuJoCo are");
  if (physics.torsion_m > 0) refuse("torsional friction is");
}

}  // namespace

OdeHand::OdeHand(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
                 const HandWorldOptions& options)
    : HandEngine(std::make_unique<HandScene>(file, solid, scale, options)) {
  CheckPhysics(options.physics);
  impl_ = std::make_unique<Impl>(scene());
}
OdeHand::~OdeHand() = default;

double OdeHand::time() const { return impl_->time; }
double OdeHand::solutions_per_step() const {
  return impl_->steps == 0 ? 0 : static_cast<double>(impl_->solutions) / impl_->steps;
}

void OdeHand::Place(const plan::HandState& state) {
  Impl& impl = *impl_;
  impl.Stop();
  impl.time = 0;
  for (FingerIndex f{0}; f < std::ssize(scene().fingers); ++f) {
    for (std::size_t k = 0; k < scene().fingers[f].joints.size(); ++k) {
      impl.angles[impl.tree.link(f, k)] = state.joints[f][k];
    }
  }
  std::ranges::fill(impl.controls, 0);
  impl.load = impl.torque = Vector3d::Zero();
  const Isometry3d pose = scene().palm * state.pose;
  impl.centre = pose * scene().centroid;
  impl.turn = Quaterniond(pose.linear());
  impl.poses = impl.tree.Place(impl.angles);
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
  const Motion& motion = impl_->object_motion;
  return std::max({motion.velocity.cwiseAbs().maxCoeff(), motion.spin.cwiseAbs().maxCoeff(),
                   impl_->speeds.cwiseAbs().maxCoeff()});
}

kinematics::JointConfiguration OdeHand::configuration(FingerIndex finger) const {
  const kinematics::Finger& chain = scene().hand.fingers[finger];
  kinematics::JointConfiguration configuration(chain.drives);
  for (std::size_t k = 0; k < chain.joints.size(); ++k) {
    const double angle = impl_->angles[impl_->tree.link(finger, k)];
    configuration[chain.joints[k].drive] = kinematics::DriveAngle(chain.joints[k], angle);
  }
  return configuration;
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
  for (const Touch& one : impl.touches) {
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
  const kinematics::Finger& chain = scene().hand.fingers[finger];
  const auto joint = std::ranges::find(chain.joints, drive, &kinematics::Joint::drive);
  const int link = impl_->tree.link(finger, joint - chain.joints.begin());
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
  // From the fingertip to the palm: the weight of all links that a joint moves.
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
  const kinematics::Finger& chain = scene().hand.fingers[finger];
  const double nominal = 1 / scene().options.physics.gain_factor;
  for (std::size_t k = 0; k < chain.joints.size(); ++k) {
    const int i = impl_->tree.link(finger, k);
    const JointDrive& law = impl_->drives[i];
    const int drive = chain.joints[k].drive;
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

void OdeHand::Step() { impl_->Step(); }

namespace {

void Append(const Vector3d& v, std::vector<double>& values) {
  values.insert(values.end(), v.data(), v.data() + 3);
}

Vector3d Take(const double*& values) {
  const Vector3d v(values[0], values[1], values[2]);
  values += 3;
  return v;
}

}  // namespace

// Positions: joint angles, centre, rotation as w x y z. Velocities: joint speeds, links, object. In
// place of MuJoCo's warm start there are the contacts: finger, number, and force.
OdeHand::State OdeHand::Save() const {
  const Impl& impl = *impl_;
  State state;
  EngineState& saved = state.engine;
  saved.time = impl.time;
  saved.qpos.assign(impl.angles.begin(), impl.angles.end());
  Append(impl.centre, saved.qpos);
  saved.qpos.insert(saved.qpos.end(), {impl.turn.w(), impl.turn.x(), impl.turn.y(), impl.turn.z()});
  saved.qvel.assign(impl.speeds.begin(), impl.speeds.end());
  for (const Motion& motion : impl.motions) {
    Append(motion.velocity, saved.qvel);
    Append(motion.spin, saved.qvel);
  }
  Append(impl.object_motion.velocity, saved.qvel);
  Append(impl.object_motion.spin, saved.qvel);
  for (const Touch& touch : impl.touches) {
    saved.qacc_warmstart.push_back(touch.finger);
    saved.qacc_warmstart.push_back(touch.number);
    Append(touch.force, saved.qacc_warmstart);
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
  impl.centre = Take(q);
  impl.turn = Quaterniond(q[0], q[1], q[2], q[3]);
  for (Motion& motion : impl.motions) {
    motion.velocity = Take(v);
    motion.spin = Take(v);
  }
  impl.object_motion.velocity = Take(v);
  impl.object_motion.spin = Take(v);
  impl.controls = state.controls;
  impl.load = impl.torque = Vector3d::Zero();
  impl.poses = impl.tree.Place(impl.angles);
  const std::vector<double>& contacts = state.engine.qacc_warmstart;
  for (const double* c = contacts.data(); c != contacts.data() + contacts.size();) {
    Touch touch{FingerIndex(static_cast<int>(c[0])), static_cast<int>(c[1])};
    c += 2;
    touch.force = Take(c);
    impl.touches.push_back(touch);
  }
  impl.FindTouches();
}

}  // namespace regrasp::sim
