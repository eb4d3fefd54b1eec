#include "sim/actuation/ode_hand_bodies.h"

#include <algorithm>
#include <cstddef>

#include "planner/kinematics/finger_kinematics.h"
#include "sim/scene/engine.h"

namespace regrasp::sim {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Largest speed of this recovery, m/s.
constexpr double kMostRecovery = 0.05;
/// Depth of contacts in equilibrium, metres, so that they hold the object from step to step.
constexpr double kRestDepth = 1e-6;
/// Contact force below which the cone is not checked, newtons.
constexpr double kSlack = 1e-5;
/// Length of rods, metres; only their lines matter.
constexpr double kRodLength = 0.1;
/// Force of a contact before its first solution, newtons.
constexpr double kFirstForce = 0.05;

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

void SetMotion(dBodyID body, const OdeHandBodies::Motion& motion) {
  const auto& [v, w] = motion;
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

OdeHandBodies::Motion MotionOf(dBodyID body) {
  return {Read(dBodyGetLinearVel(body)), Read(dBodyGetAngularVel(body))};
}

bool IsFinite(const OdeHandBodies::Motion& motion) {
  return motion.velocity.allFinite() && motion.spin.allFinite();
}

}  // namespace

OdeHandBodies::OdeHandBodies(HandScene& given) : scene(given) {
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
  dWorldSetERP(world.get(), kOdeDepthRecovery);
  dWorldSetContactSurfaceLayer(world.get(), kRestDepth);
  dWorldSetContactMaxCorrectingVel(world.get(), kMostRecovery);
  MakeObject();
  MakeLinks();
}

void OdeHandBodies::MakeObject() {
  const mjModel& model = *scene.model;
  const int body = scene.object_body;
  const mjtNum* q = model.body_iquat + std::ptrdiff_t{4} * body;
  const Matrix3d axes = Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Eigen::Map<const Vector3d> inertia(model.body_inertia + std::ptrdiff_t{3} * body);
  object = dBodyCreate(world.get());
  SetInertia(object, mass, axes * inertia.asDiagonal() * axes.transpose());
}

void OdeHandBodies::MakeLinks() {
  for (std::size_t i = 0; i < tree.links().size(); ++i) {
    const LinkTree::Link& link = tree.links()[i];
    bodies.push_back(dBodyCreate(world.get()));
    SetInertia(bodies.back(), link.mass, link.inertia);
    SetPose(bodies.back(), CentreOf(i), Quaterniond(poses[i].linear()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) MakeHinge(static_cast<int>(i));
  MakeRods();
}

/// Make the revolute joint of a link, and the rows about its axis.
void OdeHandBodies::MakeHinge(int link) {
  const LinkTree::Link& made = tree.links()[link];
  const JointDrive& drive = drives[link];
  const dBodyID parent = made.parent < 0 ? nullptr : bodies[made.parent];
  const Vector3d anchor = AnchorOf(link);
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

/// Make the rods of coupled joints, which are exact and only act on velocities: SetAngles keeps the
/// angles coupled.
void OdeHandBodies::MakeRods() {
  for (const LinkCoupling& coupling : couplings) {
    const int middle = tree.links()[coupling.link].parent;
    const int first = tree.links()[middle].parent;
    const dJointID rod = dJointCreateDBall(world.get(), hinges.get());
    dJointAttach(rod, bodies[coupling.link], first < 0 ? nullptr : bodies[first]);
    dJointSetDBallParam(rod, dParamERP, 0);
    dJointSetDBallParam(rod, dParamCFM, 0);
    rods.push_back(rod);
  }
}

int OdeHandBodies::LeadingLink(FingerIndex finger, int drive) const {
  const std::vector<kinematics::Joint>& joints = scene.hand.fingers[finger].joints;
  const auto joint = std::ranges::find_if(
      joints, [&](const kinematics::Joint& one) { return one.drive == drive && !one.follows; });
  return tree.link(finger, joint - joints.begin());
}

/// Set the angles of the joints, and those of joints that follow others to the couplings.
void OdeHandBodies::SetAngles(const VectorXd& next) {
  angles = next;
  for (FingerIndex f{0}; f < std::ssize(scene.hand.fingers); ++f) {
    const kinematics::Finger& finger = scene.hand.fingers[f];
    for (std::size_t k = 0; k < finger.joints.size(); ++k) {
      const kinematics::Joint& joint = finger.joints[k];
      if (!joint.follows) continue;
      angles[tree.link(f, k)] =
          joint.ratio * angles[LeadingLink(f, joint.drive)] + joint.coupling_offset;
    }
  }
  poses = tree.Place(angles);
}

/// Set all velocities to zero, and forget contacts.
void OdeHandBodies::Stop() {
  speeds.setZero();
  forces.setZero();
  std::ranges::fill(motions, Motion());
  object_motion = {};
  touches.clear();
  scene.surface.Forget();
}

/// Find the contacts; each has the force of the last step.
void OdeHandBodies::FindTouches() {
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
void OdeHandBodies::LoadBodies() {
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

/// Set the law of every joint. Its row exerts (v − w)/c about the axis, with the speed w.
void OdeHandBodies::LoadMotors(const std::vector<int>& saturated) {
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const JointDrive::Law law = drives[i].LawFor(InputOf(i), saturated[i]);
    const bool acts = law.slope > 0;
    dJointSetAMotorParam(motors[i], dParamFMax, acts ? dInfinity : 0);
    if (!acts) continue;
    dJointSetAMotorParam(motors[i], dParamVel, law.offset / law.slope);
    dJointSetAMotorParam(motors[i], dParamCFM, 1 / law.slope);
  }
}

/// Set the rods of couplings to the poses of the links.
void OdeHandBodies::LoadRods() {
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const int link = couplings[i].link;
    const int middle = tree.links()[link].parent;
    const RodLine line = RodLineOf({AnchorOf(middle), AxisOf(middle)},
                                   {AnchorOf(link), AxisOf(link)}, couplings[i].ratio);
    const Vector3d& p = line.point;
    const Vector3d end = p + kRodLength * line.direction;
    dJointSetDBallAnchor1(rods[i], p.x(), p.y(), p.z());
    dJointSetDBallAnchor2(rods[i], end.x(), end.y(), end.z());
  }
}

void OdeHandBodies::AddContacts(int tried, std::vector<Touch>& trial,
                                std::vector<FrictionBox>& boxes,
                                std::vector<dJointFeedback>& feedback) {
  dJointGroupEmpty(contact_joints.get());
  for (std::size_t k = 0; k < trial.size(); ++k) {
    const std::size_t i = (k + static_cast<std::size_t>(tried)) % trial.size();
    const Touch& touch = trial[i];
    const bool presses = touch.force.dot(touch.inward) > 0;
    const Vector3d last = presses ? touch.force : Vector3d(kFirstForce * touch.inward);
    boxes[i] = BoxInCircle(touch.inward, last, scene.options.mu);
    boxes[i].along *= 1 - kOdeNarrower * tried * static_cast<double>(k + 1);
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
VectorXd OdeHandBodies::SolvedSpeeds() const {
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
bool OdeHandBodies::Solve(int tried, std::vector<Touch>& trial) {
  std::vector<FrictionBox> boxes(trial.size());
  std::vector<dJointFeedback> feedback(trial.size());
  std::vector<int> saturated(drives.size(), 0);
  for (int solution = 0; solution < kMostOdeSolutions; ++solution) {
    LoadBodies();
    LoadMotors(saturated);
    LoadRods();
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

void OdeHandBodies::Step() {
  FindTouches();
  double compliance = kOdeCompliance / mass * timestep;
  for (int tried = 0; tried < kMostOdeTries; ++tried, compliance *= kOdeSofter) {
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

void OdeHandBodies::TakeBodies() {
  const VectorXd solved = SolvedSpeeds();
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const int k = static_cast<int>(i);
    forces[k] = drives[i].Force(InputOf(i), solved[k]);
    motions[i] = MotionOf(bodies[i]);
  }
  speeds = solved;
  SetAngles(angles + timestep * speeds);
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

}  // namespace regrasp::sim
