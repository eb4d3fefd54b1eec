#include "sim/hand/check_hand.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "sim/hand/hand_body.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::HandState;
using plan::Reason;
using Joints = std::vector<std::vector<double>>;

constexpr double kSameJoint = 1e-9;  // radians
constexpr double kSamePlace = 1e-9;  // metres
constexpr double kSameTurn = 1e-8;   // radians
constexpr double kTipAtRest = 1e-6;
constexpr double kTipInMove = 1e-4;
constexpr double kTipDepth = 3e-4;
/// A finger that comes or goes may be as near as a touching one this far around its contact.
constexpr double kApproach = 0.012;
constexpr double kLimitSlack = 1e-9;  // radians
constexpr double kSlack = 1e-6;       // of the clearance
/// What moves less than this between two samples and is not shown to be clear is not: metres.
constexpr double kFinest = 1e-4;
constexpr double kGoalPlace = 1e-6;
constexpr double kGoalTurn = 1e-6;

struct Fault {
  Reason reason = Reason::kNone;
  std::string detail;
};
using MaybeFault = std::optional<Fault>;

double TurnBetween(const Isometry3d& a, const Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

HandState Mix(const HandState& a, const HandState& b) {
  HandState middle;
  middle.pose.translation() = (a.pose.translation() + b.pose.translation()) / 2;
  const Eigen::AngleAxisd turn(a.pose.linear().transpose() * b.pose.linear());
  middle.pose.linear() =
      a.pose.linear() * Eigen::AngleAxisd(turn.angle() / 2, turn.axis()).toRotationMatrix();
  middle.joints = a.joints;
  for (std::size_t i = 0; i < middle.joints.size(); ++i) {
    for (std::size_t k = 0; k < middle.joints[i].size(); ++k) {
      middle.joints[i][k] = (a.joints[i][k] + b.joints[i][k]) / 2;
    }
  }
  return middle;
}

class Checker {
 public:
  Checker(HandBody& body, const object::Polyhedron& solid, const plan::Plan& plan,
          const HandCheckOptions& options)
      : body_(body), plan_(plan), clearance_(options.clearance_m - kSlack) {
    for (const auto& corners : solid.triangles()) {
      std::vector<Vector3d> points;
      for (const int corner : corners) points.push_back(plan.scale * solid.vertices()[corner]);
      triangles_.push_back(MakeSolid(std::move(points), 0));
      for (const Vector3d& point : triangles_.back().points) {
        object_reach_ = std::max(object_reach_, point.norm());
      }
    }
  }

  std::vector<plan::HandFault> Check() {
    std::vector<plan::HandFault> faults;
    const auto take = [&](plan::EntryIndex entry, const MaybeFault& fault) {
      if (fault) faults.push_back({entry, fault->reason, fault->detail});
    };
    holding_ = plan_.initial;
    state_ = plan_.hand->initial;
    take(plan::EntryIndex{0}, CheckRest());
    if (!faults.empty()) return faults;
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      const plan::EntryIndex entry(static_cast<int>(i) + 1);
      MaybeFault fault = CheckStep(plan_.steps[i]);
      if (!fault && i + 1 == plan_.steps.size()) fault = CheckGoal();
      take(entry, fault);
      if (fault) return faults;
    }
    return faults;
  }

 private:
  /// Which fingers may touch, by finger: at these contacts.
  using Touching = std::vector<const plan::FingerContact*>;

  [[nodiscard]] int finger_count() const { return static_cast<int>(body_.hand().fingers.size()); }
  [[nodiscard]] std::string NameOf(FingerIndex finger) const {
    return "finger " + std::to_string(finger) + " (" + body_.hand().fingers[finger].name + ")";
  }
  [[nodiscard]] Vector3d BallAt(const plan::FingerContact& held, const Isometry3d& pose) const {
    const double radius = body_.hand().fingers[held.finger].tip.radius;
    return pose * (plan_.scale * held.contact.p - radius * held.contact.n);
  }

  MaybeFault CheckShape(const HandState& state) const;
  MaybeFault CheckContinues(const plan::HandPath& path) const;
  MaybeFault CheckLimits(const HandState& state) const;
  MaybeFault CheckTips(const plan::FingerGrasp& grasp, const HandState& state, double tolerance);
  MaybeFault CheckRest();
  MaybeFault CheckStep(const plan::Step& step);
  MaybeFault CheckMove(const plan::Move& move);
  MaybeFault CheckSwitch(const plan::Switch& change);
  MaybeFault CheckFingersGo(const plan::HandPath& path, const plan::FingerGrasp& moving,
                            const plan::FingerGrasp& still);
  MaybeFault CheckGoal() const;
  MaybeFault CheckPath(const HandState& from, const HandState& to, const Touching& touching,
                       const plan::FingerGrasp& follow);
  MaybeFault FindNear(const HandState& middle, const std::vector<double>& bounds,
                      double object_bound, const Touching& touching);
  [[nodiscard]] double NeededFromObject(int part, const Isometry3d& pose,
                                        const Touching& touching) const;

  HandBody& body_;
  const plan::Plan& plan_;
  double clearance_;
  std::vector<Solid> triangles_;
  double object_reach_ = 0;
  plan::FingerGrasp holding_;
  HandState state_;
};

MaybeFault Checker::CheckShape(const HandState& state) const {
  const auto& fingers = body_.hand().fingers;
  bool same = state.joints.size() == fingers.size();
  for (std::size_t i = 0; same && i < fingers.size(); ++i) {
    same = state.joints[i].size() == fingers[i].joints.size();
  }
  if (same) return std::nullopt;
  return Fault{Reason::kHandJumps, "a state has other numbers of fingers or joints than the hand"};
}

MaybeFault Checker::CheckContinues(const plan::HandPath& path) const {
  if (path.empty()) return Fault{Reason::kHandJumps, "the hand has no path in this step"};
  for (const HandState& state : path) {
    if (auto fault = CheckShape(state)) return fault;
  }
  const HandState& first = path.front();
  const double off = (first.pose.translation() - state_.pose.translation()).norm();
  if (off > kSamePlace || TurnBetween(first.pose, state_.pose) > kSameTurn) {
    return Fault{Reason::kHandJumps,
                 "the object begins the step " + FormatLength(off) + " and " +
                     FormatDegrees(Degrees(TurnBetween(first.pose, state_.pose))) +
                     " from where it was"};
  }
  for (FingerIndex finger{0}; finger < finger_count(); ++finger) {
    for (std::size_t k = 0; k < first.joints[finger].size(); ++k) {
      const double jump = std::abs(first.joints[finger][k] - state_.joints[finger][k]);
      if (jump <= kSameJoint) continue;
      return Fault{Reason::kHandJumps, "joint " + body_.hand().fingers[finger].joints[k].name +
                                           " begins the step " + FormatDegrees(Degrees(jump)) +
                                           " from where it was"};
    }
  }
  return std::nullopt;
}

MaybeFault Checker::CheckLimits(const HandState& state) const {
  for (FingerIndex finger{0}; finger < finger_count(); ++finger) {
    const auto& joints = body_.hand().fingers[finger].joints;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const double angle = state.joints[finger][k];
      if (angle >= joints[k].lower - kLimitSlack && angle <= joints[k].upper + kLimitSlack)
        continue;
      return Fault{Reason::kJointLimit, "joint " + joints[k].name + " is at " +
                                            FormatDegrees(Degrees(angle)) + ", its limits are " +
                                            FormatDegrees(Degrees(joints[k].lower)) + " and " +
                                            FormatDegrees(Degrees(joints[k].upper))};
    }
  }
  return std::nullopt;
}

MaybeFault Checker::CheckTips(const plan::FingerGrasp& grasp, const HandState& state,
                              double tolerance) {
  body_.SetJoints(state.joints);
  for (const plan::FingerContact& held : grasp) {
    if (held.finger >= finger_count()) {
      return Fault{Reason::kTipOffContact, "the hand has no finger " + std::to_string(held.finger)};
    }
    const double off = (body_.TipCentre(held.finger) - BallAt(held, state.pose)).norm();
    if (off <= tolerance) continue;
    return Fault{Reason::kTipOffContact, "the tip of " + NameOf(held.finger) + " is " +
                                             FormatLength(off) +
                                             " from where it touches its contact; up to " +
                                             FormatLength(tolerance) + " is taken"};
  }
  return std::nullopt;
}

MaybeFault Checker::CheckRest() {
  if (auto fault = CheckShape(state_)) return fault;
  if (auto fault = CheckLimits(state_)) return fault;
  if (auto fault = CheckTips(holding_, state_, kTipAtRest)) return fault;
  Touching touching(finger_count(), nullptr);
  for (const plan::FingerContact& held : holding_) touching[held.finger] = &held;
  return CheckPath(state_, state_, touching, {});
}

double Checker::NeededFromObject(int part, const Isometry3d& pose, const Touching& touching) const {
  const HandPart& owner = body_.parts()[part];
  if (!owner.is_tip || touching[owner.finger] == nullptr) return clearance_;
  const double off = (body_.TipCentre(owner.finger) - BallAt(*touching[owner.finger], pose)).norm();
  return off <= kApproach ? -kTipDepth : clearance_;
}

/// Something that is nearer in the middle of an interval than what moves in it allows.
MaybeFault Checker::FindNear(const HandState& middle, const std::vector<double>& bounds,
                             double object_bound, const Touching& touching) {
  body_.SetJoints(middle.joints);
  const int count = static_cast<int>(body_.parts().size());
  std::vector<Solid> placed;
  for (int part = 0; part < count; ++part) placed.push_back(body_.Place(part));
  const Isometry3d to_object = middle.pose.inverse();
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      if (body_.MayTouch(a, b)) continue;
      if (HaveGap(placed[a], placed[b], clearance_ + (bounds[a] + bounds[b]) / 2)) continue;
      return Fault{Reason::kHandCollides, body_.parts()[a].body + " comes nearer to " +
                                              body_.parts()[b].body + " than the clearance of " +
                                              FormatLength(clearance_ + kSlack)};
    }
    const double needed = NeededFromObject(a, middle.pose, touching);
    Solid part = placed[a];
    for (Vector3d& point : part.points) point = to_object * point;
    part.centre = to_object * part.centre;
    for (const Solid& triangle : triangles_) {
      if (HaveGap(part, triangle, needed + (bounds[a] + object_bound) / 2)) continue;
      return Fault{Reason::kHandCollides,
                   body_.parts()[a].body + " comes nearer to the object than " +
                       (needed < 0 ? FormatLength(kTipDepth) + " inside its surface"
                                   : "the clearance of " + FormatLength(clearance_ + kSlack))};
    }
  }
  return std::nullopt;
}

/// Everything between two states. @param follow  tips that keep their contacts.
MaybeFault Checker::CheckPath(const HandState& from, const HandState& to, const Touching& touching,
                              const plan::FingerGrasp& follow) {
  std::vector<double> bounds;
  for (int part = 0; part < static_cast<int>(body_.parts().size()); ++part) {
    bounds.push_back(body_.MotionBound(part, from.joints, to.joints));
  }
  const double object_bound = (to.pose.translation() - from.pose.translation()).norm() +
                              TurnBetween(from.pose, to.pose) * object_reach_;
  const HandState middle = Mix(from, to);
  if (auto fault = CheckTips(follow, middle, kTipInMove)) return fault;
  const MaybeFault near = FindNear(middle, bounds, object_bound, touching);
  if (!near) return std::nullopt;
  const double largest = std::max(object_bound, *std::ranges::max_element(bounds));
  if (largest < kFinest) return near;
  if (auto fault = CheckPath(from, middle, touching, follow)) return fault;
  return CheckPath(middle, to, touching, follow);
}

MaybeFault Checker::CheckMove(const plan::Move& move) {
  if (auto fault = CheckContinues(move.path)) return fault;
  Touching touching(finger_count(), nullptr);
  for (const plan::FingerContact& held : holding_) touching[held.finger] = &held;
  for (std::size_t i = 0; i < move.path.size(); ++i) {
    if (auto fault = CheckLimits(move.path[i])) return fault;
    const double tolerance = i + 1 == move.path.size() ? kTipAtRest : kTipInMove;
    if (auto fault = CheckTips(holding_, move.path[i], tolerance)) return fault;
    if (i == 0) continue;
    if (auto fault = CheckPath(move.path[i - 1], move.path[i], touching, holding_)) return fault;
  }
  state_ = move.path.back();
  return std::nullopt;
}

/// Some fingers go, the object and all others stand still.
MaybeFault Checker::CheckFingersGo(const plan::HandPath& path, const plan::FingerGrasp& moving,
                                   const plan::FingerGrasp& still) {
  if (moving.empty()) return std::nullopt;
  if (auto fault = CheckContinues(path)) return fault;
  Touching touching(finger_count(), nullptr);
  for (const plan::FingerContact& held : still) touching[held.finger] = &held;
  for (const plan::FingerContact& held : moving) touching[held.finger] = &held;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double off = (path[i].pose.translation() - path[i - 1].pose.translation()).norm();
    if (off > kSamePlace || TurnBetween(path[i].pose, path[i - 1].pose) > kSameTurn) {
      return Fault{Reason::kHandJumps, "the object moves while fingers switch"};
    }
    if (auto fault = CheckLimits(path[i])) return fault;
    if (auto fault = CheckTips(still, path[i], kTipAtRest)) return fault;
    if (auto fault = CheckPath(path[i - 1], path[i], touching, still)) return fault;
  }
  state_ = path.back();
  return std::nullopt;
}

MaybeFault Checker::CheckSwitch(const plan::Switch& change) {
  if (!change.motion) return Fault{Reason::kHandJumps, "the hand has no path in this step"};
  for (const plan::FingerContact& placed : change.place) {
    if (placed.finger >= finger_count()) {
      return Fault{Reason::kTipOffContact,
                   "the hand has no finger " + std::to_string(placed.finger)};
    }
  }
  if (auto fault = CheckFingersGo(change.motion->place, change.place, holding_)) return fault;
  if (auto fault = CheckTips(change.place, state_, kTipAtRest)) return fault;
  plan::FingerGrasp released;
  plan::FingerGrasp still = change.place;
  for (const plan::FingerContact& held : holding_) {
    const bool leaves = std::ranges::find(change.release, held.finger) != change.release.end();
    (leaves ? released : still).push_back(held);
  }
  return CheckFingersGo(change.motion->release, released, still);
}

MaybeFault Checker::CheckStep(const plan::Step& step) {
  MaybeFault fault;
  if (const auto* move = std::get_if<plan::Move>(&step)) {
    fault = CheckMove(*move);
  } else if (const auto* change = std::get_if<plan::Switch>(&step)) {
    fault = CheckSwitch(*change);
  } else {
    fault = Fault{Reason::kHandJumps, "the hand has no path in this step"};
  }
  holding_ = plan::GraspAfter(holding_, step);
  return fault;
}

MaybeFault Checker::CheckGoal() const {
  const Isometry3d& goal = plan_.hand->goal;
  const double off = (goal.translation() - state_.pose.translation()).norm();
  const double turn = TurnBetween(goal, state_.pose);
  if (off <= kGoalPlace && turn <= kGoalTurn) return std::nullopt;
  return Fault{Reason::kGoalNotReached, "the object ends " + FormatLength(off) + " and " +
                                            FormatDegrees(Degrees(turn)) + " from its goal"};
}

}  // namespace

std::vector<plan::HandFault> CheckHand(const std::filesystem::path& hand_file,
                                       const object::Polyhedron& solid, const plan::Plan& plan,
                                       const HandCheckOptions& options) {
  HandBody body(hand_file);
  if (!plan.hand) {
    throw InputError("--hand: the plan is for fingers without a hand; leave --hand out");
  }
  if (plan.hand->sha256 != body.hand().sha256) {
    throw InputError(hand_file.string() + ": has digest " + body.hand().sha256 +
                     ", the plan was made for a hand with digest " + plan.hand->sha256);
  }
  return Checker(body, solid, plan, options).Check();
}

}  // namespace regrasp::sim
