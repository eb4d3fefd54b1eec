#include "sim/actuation/hand_control.h"

#include <algorithm>
#include <cmath>

#include "planner/grasp/grasp_forces.h"
#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using kinematics::Posture;

/// Gain of the integral of the object's offset, 1/s.
constexpr double kIntegralGain = 20;
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

Vector3d RotationVector(const Matrix3d& turn) {
  const Eigen::AngleAxisd angle(turn);
  return angle.angle() * angle.axis();
}

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

Posture PostureOf(const kinematics::Finger& finger, const std::vector<double>& angles) {
  Posture posture(finger.drives);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    posture[finger.joints[k].drive] = kinematics::DriveAngle(finger.joints[k], angles[k]);
  }
  return posture;
}

HandControl::HandControl(HandWorld& world, const object::Polyhedron& solid, double scale,
                         const HandControlSettings& settings)
    : world_(world),
      solid_(solid),
      scale_(scale),
      reach_(scale * solid.diameter() / 2),
      settings_(settings),
      planned_(world.state()) {
  for (FingerIndex f{0}; f < std::ssize(world.hand().fingers); ++f) {
    fingers_.push_back({});
    fingers_.back().target = world.measured_posture(f);
    fingers_.back().offset = Posture::Zero(fingers_.back().target.size());
    fingers_.back().rate = fingers_.back().offset;
  }
}

void HandControl::Steer(const plan::HandState& planned) {
  const double most = kFastest * world_.timestep();
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    const Posture before = PlannedPosture(f);
    const Posture change = PostureOf(world_.hand().fingers[f], planned.joints[f]) - before;
    fingers_[f].rate = change.cwiseMax(-most).cwiseMin(most) / world_.timestep();
  }
  planned_ = planned;
}

Posture HandControl::PlannedPosture(FingerIndex finger) const {
  return PostureOf(world_.hand().fingers[finger], planned_.joints[finger]);
}

void HandControl::Attach(FingerIndex finger) {
  Finger& state = fingers_[finger];
  state.mode = Mode::kAttached;
  state.centre_O = world_.object_pose().inverse() * world_.tip(finger);
  state.touched = world_.touch(finger);
  const kinematics::TipState tip = kinematics::TipAt(world_.hand().fingers[finger], state.target);
  state.bias = CorrectedPose() * state.centre_O - tip.centre;
}

void HandControl::Detach(FingerIndex finger) {
  Finger& state = fingers_[finger];
  state.mode = Mode::kFree;
  state.keeps_offset = true;
  state.offset = state.target - PlannedPosture(finger);
}

void HandControl::LetOffsetGo(FingerIndex finger) { fingers_[finger].keeps_offset = false; }

void HandControl::LeadTip(FingerIndex finger, const Vector3d& centre_O) {
  fingers_[finger].mode = Mode::kLed;
  fingers_[finger].centre_O = centre_O;
}

void HandControl::LeadAlongSurface(FingerIndex finger, const Vector3d& centre_O) {
  fingers_[finger].mode = Mode::kSliding;
  fingers_[finger].led_O = centre_O;
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
  shift_ = other.shift_;
  turn_ = other.turn_;
  step_ = other.step_;
  corrects_ = other.corrects_;
}

Isometry3d HandControl::CorrectedPose() const {
  const Vector3d centre = planned_.pose * world_.centroid_O();
  return Eigen::Translation3d(centre + shift_) * Isometry3d(Turned(turn_)) *
         Eigen::Translation3d(-centre) * planned_.pose;
}

void HandControl::Measure() {
  const Isometry3d pose = world_.object_pose();
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    Finger& finger = fingers_[f];
    if (finger.mode != Mode::kAttached && finger.mode != Mode::kSliding) continue;
    finger.centre_O = pose.inverse() * world_.tip(f);
    finger.bias *= 1 - kPeriod / kPreloadTime;
    if (const TipTouch touch = world_.touch(f); std::isfinite(touch.gap)) finger.touched = touch;
  }
  if (!settings_.feedback || !corrects_) return;
  const Vector3d off = planned_.pose * world_.centroid_O() - pose * world_.centroid_O();
  const Vector3d turned = RotationVector(planned_.pose.linear() * pose.linear().transpose());
  shift_ = Limited(shift_ + kIntegralGain * kPeriod * off, kMostOffset);
  turn_ = Limited(turn_ + kIntegralGain * kPeriod * turned, kMostOffset / reach_);
}

std::optional<TipTouch> HandControl::KnownTouch(FingerIndex finger) const {
  const TipTouch touch = world_.touch(finger);
  if (std::isfinite(touch.gap)) return touch;
  const TipTouch& before = fingers_[finger].touched;
  return std::isfinite(before.gap) ? std::optional(before) : std::nullopt;
}

Hold HandControl::WithContacts(const Hold& hold) const {
  Hold known = hold;
  std::erase_if(known.fingers, [this](FingerIndex f) { return !KnownTouch(f); });
  std::erase_if(known.sliding,
                [this](const SlidingFinger& one) { return !KnownTouch(one.finger); });
  return known;
}

grasp::Grasp HandControl::ContactsOf(const std::vector<FingerIndex>& fingers) const {
  grasp::Grasp contacts;
  for (const FingerIndex f : fingers) {
    const TipTouch touch = *KnownTouch(f);
    contacts.push_back({touch.point_O / scale_, touch.inward_O, {}});
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
  const Matrix3d turn = world_.object_pose().linear();
  const Vector3d down = -settings_.weight_N * (turn.transpose() * world_.hand().up);
  const double angle = settings_.half_angle;
  const auto plan = [&](double normal) {
    return grasp::ComputeSlidingForces(contacts, sliding, solid_.wrench_frame(),
                                       {std::tan(angle), angle}, {down, Vector3d::Zero()},
                                       settings_.squeeze_N, normal);
  };
  if (sliding.empty()) return plan(0);
  const double most = kMostSliding * settings_.squeeze_N / static_cast<double>(sliding.size());
  const auto margin = [&](double normal) { return plan(normal).margin; };
  return plan(grasp::ChooseSlidingNormal(std::min(kTouchForce, most), most, margin).normal);
}

std::vector<Vector3d> HandControl::ForcesOf(const Hold& all) const {
  std::vector<Vector3d> forces(fingers_.size(), Vector3d::Zero());
  // A finger that never touched the object cannot press on it. The monitor detects its missing
  // contact.
  const Hold hold = WithContacts(all);
  if (hold.fingers.empty()) return forces;
  const Matrix3d turn = world_.object_pose().linear();
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
  const Isometry3d pose = world_.object_pose();
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    fingers_[f].force = holding_.strength * ((1 - share) * from[f] + share * to[f]);
    const TipTouch touch = world_.touch(f);
    fingers_[f].contact = pose * touch.point_O;
    const Vector3d inward = pose.linear() * touch.inward_O;
    const double missing = kTouchForce - fingers_[f].force.dot(inward);
    if (fingers_[f].mode == Mode::kAttached && missing > 0) fingers_[f].force += missing * inward;
  }
}

void HandControl::FollowTip(FingerIndex finger) {
  Finger& state = fingers_[finger];
  const kinematics::Finger& chain = world_.hand().fingers[finger];
  const Isometry3d pose = state.mode == Mode::kLed ? world_.object_pose() : CorrectedPose();
  Vector3d centre_O = state.centre_O;
  if (state.mode == Mode::kSliding) {
    const Vector3d n = world_.touch(finger).inward_O;
    const Vector3d way = state.led_O - centre_O;
    centre_O += way - way.dot(n) * n;
  }
  const Vector3d wanted =
      pose * centre_O - (state.mode == Mode::kLed ? Vector3d::Zero() : state.bias);
  const kinematics::TipState tip = kinematics::TipAt(chain, state.target);
  const auto& J = tip.jacobian;
  const Matrix3d inverse =
      (J * J.transpose() + kDamping * kDamping * Matrix3d::Identity()).inverse();
  const Posture pull = kPull * (PlannedPosture(finger) - state.target);
  const Vector3d way = wanted - tip.centre;
  const Posture change = pull + J.transpose() * (inverse * (way - J * pull));
  state.target = (state.target + change).cwiseMax(chain.lower).cwiseMin(chain.upper);
}

Eigen::VectorXd HandControl::TorquesOf(FingerIndex f) const {
  const Finger& finger = fingers_[f];
  Eigen::VectorXd torques = world_.BalancingTorques(f, finger.contact, finger.force);
  // A holding finger must comply as it rolls. Compensation of its damping would increase slip.
  if (finger.mode == Mode::kAttached) return torques;
  for (int drive = 0; drive < torques.size(); ++drive) {
    const DriveServo& servo = world_.servo(f, drive);
    torques[drive] += (servo.damping + servo.joint_damping) * finger.rate[drive];
  }
  return torques;
}

void HandControl::Step() {
  const int period = static_cast<int>(std::lround(kPeriod / world_.timestep()));
  if (step_ % period == 0) {
    Measure();
    PlanForces();
  }
  ++step_;
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) {
    Finger& finger = fingers_[f];
    if (finger.mode == Mode::kFree) {
      if (!finger.keeps_offset) finger.offset *= 1 - world_.timestep() / kOffsetTime;
      finger.target = PlannedPosture(f) + finger.offset;
    } else {
      FollowTip(f);
    }
    world_.Command(f, finger.target, TorquesOf(f));
  }
  world_.Step();
}

}  // namespace regrasp::sim
