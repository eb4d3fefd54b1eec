#include "sim/actuation/hand_control.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/grasp/grasp_forces.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/object/rotation.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using kinematics::JointConfiguration;

/// Gains of the integrals of the deviations that the camera and the fingertips measure, 1/s. With a
/// crossover at 3 rad/s a delay of 0.08 s costs 14° of the phase margin of 90°.
constexpr double kPoseGain = 3;
constexpr double kTipGain = 3;
/// Smallest number of fingertips that determine the pose of the object.
constexpr int kTipsOfAPose = 3;
/// Damping of the least squares, metres, and the share of the offset from the planned joints that
/// each step removes in its null space.
constexpr double kDamping = 5e-3;
constexpr double kPull = 0.02;
/// Largest normal force of all sliding fingers, as a share of the grasp force.
constexpr double kMostSliding = 0.5;
/// Time constant in which the preload of a servo at attachment decays, seconds. Only the planned
/// forces remain.
constexpr double kPreloadTime = 0.1;
/// Largest speed of planned joints, rad/s.
constexpr double kFastest = 2;
/// Time constant in which the offset of a free finger decays, seconds.
constexpr double kOffsetTime = 0.1;

Matrix3d Turned(const Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                   : Matrix3d::Identity();
}

Vector3d Limited(const Vector3d& vector, double most) {
  const double norm = vector.norm();
  return norm > most ? Vector3d(vector * (most / norm)) : vector;
}

}  // namespace

JointConfiguration ConfigurationOf(const kinematics::Finger& finger,
                                   const std::vector<double>& angles) {
  JointConfiguration configuration(finger.drives);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    configuration[finger.joints[k].drive] = kinematics::DriveAngle(finger.joints[k], angles[k]);
  }
  return configuration;
}

HandControl::HandControl(HandEngine& world, const object::Polyhedron& solid, double scale,
                         const HandControlSettings& settings)
    : world_(world),
      solid_(solid),
      scale_(scale),
      reach_(scale * solid.diameter() / 2),
      settings_(settings),
      sensors_(world, settings.sensing),
      planned_(world.state()) {
  for (FingerIndex f{0}; f < std::ssize(world.hand().fingers); ++f) {
    fingers_.push_back({});
    fingers_.back().target = world.measured_configuration(f);
    fingers_.back().offset = JointConfiguration::Zero(fingers_.back().target.size());
    fingers_.back().rate = fingers_.back().offset;
  }
}

void HandControl::Steer(const plan::HandState& planned) {
  const double most = kFastest * world_.timestep();
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    const JointConfiguration before = PlannedConfiguration(f);
    const JointConfiguration change =
        ConfigurationOf(world_.hand().fingers[f], planned.joints[f]) - before;
    fingers_[f].rate = change.cwiseMax(-most).cwiseMin(most) / world_.timestep();
  }
  planned_ = planned;
}

JointConfiguration HandControl::PlannedConfiguration(FingerIndex finger) const {
  return ConfigurationOf(world_.hand().fingers[finger], planned_.joints[finger]);
}

Matrix3d HandControl::TipTurn(FingerIndex finger) const {
  const kinematics::Finger& chain = world_.hand().fingers[finger];
  const kinematics::JointFrames frames =
      kinematics::FramesOf(chain, sensors_.configuration(finger));
  return planned_.pose.linear().transpose() * frames.back().linear();
}

Vector3d HandControl::TipInObject(FingerIndex finger) const {
  const kinematics::Finger& chain = world_.hand().fingers[finger];
  return planned_.pose.inverse() * kinematics::TipAt(chain, sensors_.configuration(finger)).centre;
}

double HandControl::GapOf(FingerIndex finger) const {
  const auto near = world_.NearSphere(finger, TipInObject(finger));
  if (!near) return std::numeric_limits<double>::infinity();
  return near->distance - world_.hand().fingers[finger].tip.radius;
}

void HandControl::PlaceAnchor(FingerIndex finger, const Vector3d& centre_O) {
  Anchor& anchor = fingers_[finger].anchor;
  anchor.centre_O = centre_O;
  const auto near = world_.NearSphere(finger, centre_O);
  anchor.is_near = near.has_value();
  if (!near) return;
  anchor.point_O = near->point;
  anchor.inward_O = -near->outward;
  anchor.centre_O = near->point + world_.hand().fingers[finger].tip.radius * near->outward;
}

void HandControl::Roll(FingerIndex finger) {
  Anchor& anchor = fingers_[finger].anchor;
  const Matrix3d turn = TipTurn(finger);
  const Eigen::AngleAxisd change = object::RotationInWorld(anchor.turn_O, turn);
  const Vector3d outward = anchor.centre_O - anchor.point_O;
  anchor.turn_O = turn;
  if (!anchor.is_near) return;
  PlaceAnchor(finger, anchor.centre_O + (change.angle() * change.axis()).cross(outward));
}

void HandControl::Attach(FingerIndex finger) {
  Finger& state = fingers_[finger];
  state.mode = Mode::kAttached;
  PlaceAnchor(finger, TipInObject(finger));
  state.anchor.turn_O = TipTurn(finger);
  const kinematics::TipState tip = kinematics::TipAt(world_.hand().fingers[finger], state.target);
  state.bias = CommandedPose() * state.anchor.centre_O - tip.centre;
}

void HandControl::Detach(FingerIndex finger) {
  Finger& state = fingers_[finger];
  state.mode = Mode::kFree;
  state.keeps_offset = true;
  state.offset = state.target - PlannedConfiguration(finger);
}

void HandControl::LetOffsetGo(FingerIndex finger) { fingers_[finger].keeps_offset = false; }

void HandControl::LeadTip(FingerIndex finger, const Vector3d& centre_O) {
  fingers_[finger].mode = Mode::kLed;
  fingers_[finger].led_O = centre_O;
}

void HandControl::LeadAlongSurface(FingerIndex finger, const Vector3d& centre_O) {
  fingers_[finger].mode = Mode::kSliding;
  PlaceAnchor(finger, centre_O);
}

double HandControl::SlidingMargin(const Hold& all, const plan::FingerGrasp& end) const {
  const Hold hold = WithContacts(all);
  if (hold.fingers.empty()) return -1;
  const grasp::Grasp contacts = ContactsOf(hold.fingers);
  grasp::Grasp after = contacts;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const bool slides = std::ranges::find(hold.sliding, hold.fingers[i], &SlidingFinger::finger) !=
                        hold.sliding.end();
    if (slides) after[i] = plan::FindFinger(end, hold.fingers[i])->contact;
  }
  return std::min(PlannedForces(contacts, hold).margin, PlannedForces(after, hold).margin);
}

void HandControl::CopyState(const HandControl& other) {
  planned_ = other.planned_;
  holding_ = other.holding_;
  fingers_ = other.fingers_;
  sensors_.CopyState(other.sensors_);
  shift_ = other.shift_;
  turn_ = other.turn_;
  sent_ = other.sent_;
  step_ = other.step_;
  corrects_ = other.corrects_;
}

Isometry3d HandControl::CommandedPose() const {
  const Vector3d centre = planned_.pose * world_.centroid_O();
  return Eigen::Translation3d(centre + shift_) * Isometry3d(Turned(turn_)) *
         Eigen::Translation3d(-centre) * planned_.pose;
}

void HandControl::Measure() {
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    Finger& finger = fingers_[f];
    if (finger.mode == Mode::kAttached) Roll(f);
    if (finger.mode == Mode::kAttached || finger.mode == Mode::kSliding) {
      finger.bias *= 1 - kPeriod / kPreloadTime;
    }
  }
  IntegrateTips();
  IntegrateDeviations();
}

void HandControl::IntegrateDeviations() {
  sensors_.Update(planned_.pose);
  const double share = std::min(1.0, kPoseGain * std::max(sensors_.pose_period(), kPeriod));
  while (const std::optional<PoseDeviation> off = sensors_.TakeDeviation()) {
    if (corrects_) Integrate(share, *off);
  }
}

void HandControl::Integrate(double share, const PoseDeviation& off) {
  shift_ = Limited(shift_ + share * off.shift_m, kMostOffset);
  turn_ = Limited(turn_ + share * off.turn_rad, kMostOffset / reach_);
}

void HandControl::IntegrateTips() {
  std::vector<FingerIndex> held;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    if (fingers_[f].mode == Mode::kAttached && fingers_[f].anchor.is_near) held.push_back(f);
  }
  if (!corrects_ || std::ssize(held) < kTipsOfAPose) return;
  Eigen::Matrix3Xd planned(3, std::ssize(held));
  Eigen::Matrix3Xd measured(3, std::ssize(held));
  for (int i = 0; i < std::ssize(held); ++i) {
    const kinematics::Finger& chain = world_.hand().fingers[held[i]];
    planned.col(i) = planned_.pose * fingers_[held[i]].anchor.centre_O;
    measured.col(i) = kinematics::TipAt(chain, sensors_.configuration(held[i])).centre;
  }
  const Isometry3d back(Eigen::umeyama(measured, planned, false));
  const Vector3d centre = planned_.pose * world_.centroid_O();
  const Eigen::AngleAxisd turn(back.linear());
  PoseDeviation off;
  off.turn_rad = turn.angle() * turn.axis();
  off.shift_m = centre - back.inverse() * centre;
  Integrate(kTipGain * kPeriod, off);
}

Hold HandControl::WithContacts(const Hold& hold) const {
  Hold known = hold;
  std::erase_if(known.fingers, [this](FingerIndex f) { return !fingers_[f].anchor.is_near; });
  std::erase_if(known.sliding,
                [this](const SlidingFinger& one) { return !fingers_[one.finger].anchor.is_near; });
  return known;
}

grasp::Grasp HandControl::ContactsOf(const std::vector<FingerIndex>& fingers) const {
  grasp::Grasp contacts;
  for (const FingerIndex f : fingers) {
    const Anchor& anchor = fingers_[f].anchor;
    contacts.push_back({anchor.point_O / scale_, anchor.inward_O, {}});
  }
  return contacts;
}

grasp::GraspForces HandControl::PlannedForces(const grasp::Grasp& contacts,
                                              const Hold& hold) const {
  std::vector<grasp::SlidingContact> sliding;
  for (const SlidingFinger& one : hold.sliding) {
    const auto at = std::ranges::find(hold.fingers, one.finger) - hold.fingers.begin();
    const Vector3d& n = contacts[at].n;
    const Vector3d along = one.direction_O - one.direction_O.dot(n) * n;
    sliding.push_back({static_cast<int>(at), along.stableNormalized()});
  }
  const Matrix3d turn = planned_.pose.linear();
  const Vector3d down = -settings_.weight_N * (turn.transpose() * world_.hand().up);
  const double angle = settings_.friction_angle;
  const auto plan = [&](double normal) {
    return grasp::ComputeSlidingForces(contacts, sliding, solid_.wrench_frame(),
                                       {std::tan(angle), angle}, {down, Vector3d::Zero()},
                                       hold.grasp_force_N, normal);
  };
  if (sliding.empty()) {
    const grasp::GraspForces squeezing = plan(0);
    if (squeezing.balanced || !settings_.gravity_support) return squeezing;
    return grasp::ComputeSupportForces(contacts, solid_.wrench_frame(), angle,
                                       {down, Vector3d::Zero()}, hold.grasp_force_N);
  }
  const double most = kMostSliding * hold.grasp_force_N / static_cast<double>(sliding.size());
  const auto margin = [&](double normal) { return plan(normal).margin; };
  return plan(grasp::ChooseSlidingNormal(std::min(kTouchForce, most), most, margin).normal);
}

std::vector<Vector3d> HandControl::ForcesOf(const Hold& all) const {
  std::vector<Vector3d> forces(fingers_.size(), Vector3d::Zero());
  // A finger away from the object cannot press on it. The monitor detects its missing contact.
  const Hold hold = WithContacts(all);
  if (hold.fingers.empty()) return forces;
  const Matrix3d turn = planned_.pose.linear();
  const grasp::GraspForces planned = PlannedForces(ContactsOf(hold.fingers), hold);
  for (std::size_t i = 0; i < hold.fingers.size(); ++i) {
    forces[hold.fingers[i]] = turn * planned.forces[i];
  }
  return forces;
}

void HandControl::PlanForces() {
  const bool mixes = holding_.share < 1 && holding_.from != holding_.to;
  const std::vector<Vector3d> to = ForcesOf(holding_.to);
  const std::vector<Vector3d> from = mixes ? ForcesOf(holding_.from) : to;
  const double share = mixes ? holding_.share : 1;
  const Isometry3d& pose = planned_.pose;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    fingers_[f].force = holding_.strength * ((1 - share) * from[f] + share * to[f]);
    fingers_[f].contact = pose * fingers_[f].anchor.point_O;
    const Vector3d inward = pose.linear() * fingers_[f].anchor.inward_O;
    const double missing = kTouchForce - fingers_[f].force.dot(inward);
    if (fingers_[f].mode == Mode::kAttached && missing > 0) fingers_[f].force += missing * inward;
  }
}

void HandControl::FollowTip(FingerIndex finger) {
  Finger& state = fingers_[finger];
  const kinematics::Finger& chain = world_.hand().fingers[finger];
  const Vector3d wanted = state.mode == Mode::kLed
                              ? Vector3d(planned_.pose * state.led_O)
                              : Vector3d(CommandedPose() * state.anchor.centre_O - state.bias);
  const kinematics::TipState tip = kinematics::TipAt(chain, state.target);
  const auto& J = tip.jacobian;
  const Matrix3d inverse =
      (J * J.transpose() + kDamping * kDamping * Matrix3d::Identity()).inverse();
  const JointConfiguration pull = kPull * (PlannedConfiguration(finger) - state.target);
  const Vector3d way = wanted - tip.centre;
  const JointConfiguration change = pull + J.transpose() * (inverse * (way - J * pull));
  state.target = (state.target + change).cwiseMax(chain.lower).cwiseMin(chain.upper);
}

Eigen::VectorXd HandControl::TorquesOf(FingerIndex f) const {
  const Finger& finger = fingers_[f];
  Eigen::VectorXd torques = world_.BalancingTorques(f, finger.contact, finger.force);
  for (int drive = 0; drive < torques.size(); ++drive) {
    const DriveServo& servo = world_.servo(f, drive);
    torques[drive] += (servo.damping + servo.joint_damping) * finger.rate[drive];
  }
  return torques;
}

void HandControl::Step() {
  const int period = static_cast<int>(std::lround(kPeriod / world_.timestep()));
  if (step_ % period == 0) {
    try {
      Measure();
      PlanForces();
    } catch (const std::invalid_argument& error) {
      throw UnstableError(error.what());
    }
  }
  ++step_;
  std::vector<Command> commands;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    Finger& finger = fingers_[f];
    if (finger.mode == Mode::kFree) {
      if (!finger.keeps_offset) finger.offset *= 1 - world_.timestep() / kOffsetTime;
      finger.target = PlannedConfiguration(f) + finger.offset;
    } else {
      FollowTip(f);
    }
    commands.push_back({finger.target, TorquesOf(f)});
  }
  Send(std::move(commands));
  world_.Step();
}

void HandControl::Send(std::vector<Command> commands) {
  const double delay = settings_.sensing.command_delay_s;
  const auto steps = static_cast<std::size_t>(std::lround(delay / world_.timestep()));
  sent_.push_back(std::move(commands));
  while (sent_.size() > steps + 1) sent_.pop_front();
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    world_.Command(f, sent_.front()[f].target, sent_.front()[f].torques);
  }
}

}  // namespace regrasp::sim
