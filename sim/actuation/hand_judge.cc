#include "sim/actuation/hand_judge.h"

#include <algorithm>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/limit_text.h"
#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "planner/kinematics/finger_kinematics.h"
#include "sim/hand/hand_finding.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::Reason;

/// Links are looked at every hundredth of a second.
constexpr int kLinkSteps = 10;
/// Newtons: a finger that presses with less holds nothing.
constexpr double kNoForce = 1e-3;
/// Of a limit: no actuator gives more.
constexpr double kAtLimit = 0.999;

}  // namespace

HandJudge::HandJudge(const HandWorld& world, const object::Polyhedron& solid, double scale,
                     const HandTolerance& tolerance)
    : world_(world),
      surface_(std::make_shared<const collision::SurfaceTree>(solid, scale)),
      tolerance_(tolerance) {
  for (const kinematics::Finger& finger : world.hand().fingers) {
    fingers_.push_back({});
    fingers_.back().at_limit.assign(finger.drives, 0);
  }
}

void HandJudge::Start() {
  measures_ = {};
  breach_.reset();
  for (Finger& finger : fingers_) std::ranges::fill(finger.at_limit, 0);
}

void HandJudge::CopyState(const HandJudge& other) {
  phase_ = other.phase_;
  push_ = other.push_;
  fingers_ = other.fingers_;
  measures_ = other.measures_;
  breach_ = other.breach_;
  steps_ = other.steps_;
}

void HandJudge::WatchContacts(const plan::FingerGrasp& grasp, double scale, double known_off) {
  for (const plan::FingerContact& held : grasp) {
    // Contacts are planned for balls: another tip touches elsewhere.
    const std::optional<collision::NearPoint> near = world_.NearBall(held.finger);
    const double radius = world_.hand().fingers[held.finger].tip.radius;
    const double off = near ? std::max((near->point - scale * held.contact.p).norm(),
                                       std::abs(near->distance - radius))
                            : std::numeric_limits<double>::infinity();
    if (off <= tolerance_.slip_m + known_off) continue;
    const std::string how = std::isfinite(off) ? FormatLength(off) + " from" : "far from";
    const int joints = static_cast<int>(world_.hand().fingers[held.finger].joints.size());
    Fail(Reason::kContactLost,
         FingerText(world_.hand(), held.finger) + " is " + how + " its contact",
         {how, {held.finger}, {{held.finger, joints}}, world_.tip(held.finger)});
  }
}

void HandJudge::SetHolding(FingerIndex finger, bool holds) {
  Finger& state = fingers_[finger];
  state.holds = holds;
  state.slides_to_O.reset();
  state.without_force = 0;
  state.slip.setZero();
  state.first_O = world_.touch(finger).point_O;
}

void HandJudge::SetSliding(FingerIndex finger, const Vector3d& centre_O) {
  fingers_[finger].slides_to_O = centre_O;
}

void HandJudge::Fail(Reason reason, const std::string& what, Marks marks) {
  if (breach_) return;
  HandBreach& breach = breach_.emplace();
  breach.reason = reason;
  breach.detail = what + (phase_.empty() ? "" : " " + phase_);
  breach.fault.fingers = std::move(marks.fingers);
  breach.fault.push = push_;
  plan::HandFaultPlace& place = breach.fault.hand.emplace();
  place.state = world_.state();
  place.links = std::move(marks.links);
  place.number = std::move(marks.number);
  place.at = marks.at;
  place.pose = marks.pose;
}

void HandJudge::WatchObject(const Isometry3d& planned, double share, double& off_m,
                            double& off_rad) {
  const Isometry3d pose = world_.object_pose();
  const Vector3d& centre = world_.centroid_O();
  const double off = (pose * centre - planned * centre).norm();
  const double turned = Eigen::AngleAxisd(pose.linear().transpose() * planned.linear()).angle();
  off_m = std::max(off_m, off);
  off_rad = std::max(off_rad, turned);
  const double most_m = share * tolerance_.length_m;
  const double most_rad = share * tolerance_.angle_rad;
  if (off <= most_m && turned <= most_rad) return;
  const bool by_length = off / most_m >= turned / most_rad;
  const std::string number =
      by_length ? FormatLength(off, 2) + " off" : FormatDegrees(Degrees(turned)) + " off";
  const auto [value, limit] = by_length
                                  ? FormatLengthWithLimit(off, most_m)
                                  : FormatDegreesWithLimit(Degrees(turned), Degrees(most_rad));
  Fail(Reason::kObjectMoved,
       "the object is " + value + " from where the plan has it, of " + limit + " allowed",
       {.number = number, .pose = planned});
}

void HandJudge::WatchContact(FingerIndex f) {
  Finger& state = fingers_[f];
  const double dt = world_.timestep();
  const TipTouch touch = world_.touch(f);
  state.without_force = touch.force.norm() > kNoForce ? 0 : state.without_force + dt;
  double slip = 0;
  if (state.slides_to_O) {
    const Vector3d off = world_.object_pose().inverse() * world_.tip(f) - *state.slides_to_O;
    slip = (off - off.dot(touch.inward_O) * touch.inward_O).norm();
  } else {
    state.slip += dt * touch.sliding_O;
    slip = state.slip.norm();
    if (std::isfinite(touch.gap)) {
      measures_.roll_m = std::max(measures_.roll_m, (touch.point_O - state.first_O).norm());
    }
  }
  measures_.slip_m = std::max(measures_.slip_m, slip);
  if (state.without_force <= tolerance_.lost_s && slip <= tolerance_.slip_m) return;
  const std::string name = FingerText(world_.hand(), f);
  const int joints = static_cast<int>(world_.hand().fingers[f].joints.size());
  if (state.without_force > tolerance_.lost_s) {
    Fail(Reason::kContactLost, name + " has lost its contact",
         {"no force", {f}, {{f, joints}}, world_.tip(f)});
  } else {
    const std::string how = state.slides_to_O ? " off its way" : " slipped";
    const auto [value, limit] = FormatLengthWithLimit(slip, tolerance_.slip_m);
    Fail(Reason::kSlipped,
         name + (state.slides_to_O ? " is " + value + " off its way" : " slipped by " + value) +
             ", of " + limit + " allowed,",
         {FormatLength(slip, 2) + how, {f}, {{f, joints}}, world_.tip(f)});
  }
}

void HandJudge::WatchFinger(FingerIndex f) {
  if (fingers_[f].holds) WatchContact(f);
  WatchActuators(f);
}

void HandJudge::WatchActuators(FingerIndex f) {
  Finger& state = fingers_[f];
  const double dt = world_.timestep();
  for (std::size_t drive = 0; drive < state.at_limit.size(); ++drive) {
    const double share = world_.load_share(f, static_cast<int>(drive));
    measures_.torque_share = std::max(measures_.torque_share, share);
    double& seconds = state.at_limit[drive];
    seconds = share >= kAtLimit ? seconds + dt : 0;
    if (seconds <= tolerance_.limit_s) continue;
    const kinematics::Finger& chain = world_.hand().fingers[f];
    const auto joint =
        std::ranges::find(chain.joints, static_cast<int>(drive), &kinematics::Joint::drive);
    const int number = static_cast<int>(joint - chain.joints.begin());
    Fail(Reason::kTorqueLimit,
         "the actuator of joint " + joint->name + " of " + FingerText(world_.hand(), f) +
             " is at its limit of " +
             FormatShort(world_.servo(f, static_cast<int>(drive)).limit, 3) +
             " N·m for longer than " + FormatShort(1e3 * tolerance_.limit_s) + " ms",
         {FormatShort(world_.servo(f, static_cast<int>(drive)).limit, 3) + " N·m",
          {f},
          {{f, number + 1}},
          kinematics::FramesOf(chain, world_.posture(f))[number].translation()});
  }
}

std::vector<HandJudge::PlacedLink> HandJudge::PlaceLinks() const {
  const kinematics::HandModel& hand = world_.hand();
  std::vector<PlacedLink> placed;
  const auto add = [&](FingerIndex f, int index, const kinematics::LinkShape& link,
                       const Isometry3d& pose) {
    PlacedLink& one = placed.emplace_back();
    one.part = {f, index};
    one.link = &link;
    one.shape = collision::Moved(pose, link.shape);
    one.ball = collision::BallAround(one.shape);
  };
  for (std::size_t i = 0; i < hand.palm.size(); ++i) {
    add({}, static_cast<int>(i), hand.palm[i], Isometry3d::Identity());
  }
  for (FingerIndex f{0}; f < std::ssize(hand.fingers); ++f) {
    const kinematics::JointFrames frames = kinematics::FramesOf(hand.fingers[f], world_.posture(f));
    const std::vector<kinematics::LinkShape>& links = hand.fingers[f].shapes;
    for (std::size_t i = 0; i < links.size(); ++i) {
      add(f, static_cast<int>(i), links[i], frames[links[i].after - 1]);
    }
  }
  return placed;
}

std::string HandJudge::LinkText(const PlacedLink& placed) const {
  return placed.link->link + " of " +
         (placed.part.finger.valid() ? FingerText(world_.hand(), placed.part.finger) : "the palm");
}

HandJudge::Marks HandJudge::MarksOf(std::initializer_list<const PlacedLink*> links) {
  Marks marks{"touch"};
  Vector3d sum = Vector3d::Zero();
  for (const PlacedLink* placed : links) {
    const FingerIndex f = placed->part.finger;
    marks.links.push_back({f, placed->link->after});
    sum += placed->ball.centre;
    if (f.valid() && std::ranges::find(marks.fingers, f) == marks.fingers.end()) {
      marks.fingers.push_back(f);
    }
  }
  marks.at = sum / static_cast<double>(links.size());
  return marks;
}

void HandJudge::WatchLinks() {
  const Isometry3d to_object = world_.object_pose().inverse();
  const std::vector<PlacedLink> placed = PlaceLinks();
  for (const PlacedLink& link : placed) {
    if (link.link->is_tip || surface_->IsApart(collision::Moved(to_object, link.shape), 0))
      continue;
    Fail(Reason::kHandCollides, LinkText(link) + " touches the object", MarksOf({&link}));
  }
  for (auto a = placed.begin(); a != placed.end(); ++a) {
    for (auto b = a + 1; b != placed.end(); ++b) {
      const double near = a->ball.radius + b->ball.radius;
      if ((a->ball.centre - b->ball.centre).squaredNorm() > near * near) continue;
      if (MayTouch(a->part, b->part) || collision::AreApart(a->shape, b->shape, 0)) continue;
      Fail(Reason::kHandCollides, LinkText(*a) + " touches " + LinkText(*b), MarksOf({&*a, &*b}));
    }
  }
}

bool HandJudge::MayTouch(const kinematics::HandModel::Part& a,
                         const kinematics::HandModel::Part& b) const {
  const std::pair<kinematics::HandModel::Part, kinematics::HandModel::Part> pair =
      std::minmax(a, b);
  return std::ranges::binary_search(world_.hand().ignored, pair);
}

void HandJudge::Watch(const Isometry3d& planned) {
  measures_.simulated_s += world_.timestep();
  for (FingerIndex f{0}; f < std::ssize(fingers_); ++f) WatchFinger(f);
  if (steps_++ % kLinkSteps == 0) WatchLinks();
  WatchObject(planned, 1, measures_.off_m, measures_.off_rad);
}

void HandJudge::WatchRest(const Isometry3d& planned) {
  WatchObject(planned, tolerance_.at_rest, measures_.rest_off_m, measures_.rest_off_rad);
}

}  // namespace regrasp::sim
