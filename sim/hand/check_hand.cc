#include "sim/hand/check_hand.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "planner/base/error.h"
#include "planner/object/rotation.h"
#include "planner/plan/plan.h"
#include "sim/hand/hand_body.h"
#include "sim/hand/hand_finding.h"
#include "sim/hand/rolling_check.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::HandState;
using plan::Reason;
using plan::StateBetween;

constexpr double kSameJoint = 1e-9;  // radians
constexpr double kSamePlace = 1e-9;  // metres
constexpr double kSameTurn = 1e-8;   // radians
constexpr double kTipAtRest = 1e-6;
constexpr double kTipInMove = 1e-4;
constexpr double kTipDepth = 3e-4;
/// Distance from a contact within which an approaching or leaving finger may be as close as a
/// touching one.
constexpr double kApproach = 0.012;
constexpr double kLimitSlack = 1e-9;    // radians
constexpr double kSameCoupling = 1e-6;  // radians
constexpr double kSlack = 1e-6;         // subtracted from the clearance
/// Motion between two samples, in metres, at which the subdivision stops. A pair that is not proved
/// to be clear by then is too close.
constexpr double kFinest = 1e-4;

/// Number of samples of a path in the search for its smallest gap.
constexpr int kMostSamples = 96;

using MaybeFault = std::optional<HandFinding>;

/// Parts of the hand that are too close to each other.
struct NearPair {
  int part;
  int other = -1;     ///< −1: the object
  double needed = 0;  ///< required gap
};

/// Path of a step with its name in messages.
struct NamedPath {
  const plan::HandPath& states;
  std::string name = {};  ///< empty for a single state instead of a path

  [[nodiscard]] std::string InState(std::size_t index) const {
    return name.empty() ? "" : "in state " + std::to_string(index) + " of " + name;
  }
  [[nodiscard]] std::string After(std::size_t index) const {
    return name.empty() ? "" : "after state " + std::to_string(index) + " of " + name;
  }
};

bool IsSamePlace(const Isometry3d& a, const Isometry3d& b) {
  return (a.translation() - b.translation()).norm() <= kSamePlace &&
         object::RotationInBody(a.linear(), b.linear()).angle() <= kSameTurn;
}

class Checker {
 public:
  Checker(HandBody& body, const object::Polyhedron& solid, const plan::Plan& plan,
          const HandCheckOptions& options)
      : body_(body), plan_(plan), clearance_(options.clearance_m - kSlack) {
    for (const auto& corners : solid.triangles()) {
      std::vector<Vector3d> points;
      for (const int corner : corners) points.push_back(plan.scale * solid.vertices()[corner]);
      triangles_.push_back(MakeConvexBody(std::move(points), 0));
      for (const Vector3d& point : triangles_.back().points) {
        object_reach_ = std::max(object_reach_, point.norm());
      }
    }
  }

  std::vector<plan::HandFault> Check() {
    std::vector<plan::HandFault> faults;
    const auto take = [&](plan::EntryIndex entry, const MaybeFault& fault) {
      if (fault) faults.push_back({entry, fault->reason, fault->detail, fault->fault});
    };
    holding_ = plan_.initial;
    state_ = plan_.hand->initial;
    MaybeFault at_start = CheckRest();
    if (!at_start) at_start = FindMissedGoal(plan_, 0, state_);
    take(plan::EntryIndex{0}, at_start);
    if (!faults.empty()) return faults;
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      const plan::EntryIndex entry(static_cast<int>(i) + 1);
      MaybeFault fault = CheckStep(plan_.steps[i]);
      if (!fault) fault = FindMissedGoal(plan_, entry, state_);
      take(entry, fault);
      if (fault) return faults;
    }
    return faults;
  }

 private:
  /// State of the hand at an instant, and the contacts of the holding fingers.
  struct Instant {
    HandState state;
    plan::FingerGrasp holding;
  };
  static Instant MiddleOf(const Instant& a, const Instant& b);

  [[nodiscard]] int finger_count() const { return static_cast<int>(body_.hand().fingers.size()); }
  [[nodiscard]] Vector3d BallAt(const plan::FingerContact& held, const Isometry3d& pose) const {
    const double radius = body_.hand().fingers[held.finger].tip.radius;
    return pose * (plan_.scale * held.contact.p - radius * held.contact.n);
  }

  /// Check the number of fingers and joints of a state.
  MaybeFault CheckShape(const HandState& state) const;
  MaybeFault CheckContinues(const plan::HandPath& path);
  MaybeFault CheckJoints(const NamedPath& path, std::size_t index);
  MaybeFault CheckTips(const plan::FingerGrasp& grasp, const HandState& state, double tolerance,
                       const std::string& when);
  MaybeFault CheckRest();
  HandFinding AtModelsRest(HandFinding finding) const;
  MaybeFault CheckStep(const plan::Step& step);
  MaybeFault CheckMove(const plan::Move& move);
  MaybeFault CheckSwitch(const plan::Switch& change);
  MaybeFault CheckAlign(const plan::Align& align);
  MaybeFault CheckSlide(const NamedPath& path, const plan::FingerGrasp& from,
                        const plan::FingerGrasp& to);
  MaybeFault CheckFingersGo(const NamedPath& path, const plan::FingerGrasp& moving,
                            const plan::FingerGrasp& still);
  MaybeFault CheckStaysPut(const HandState& now, const HandState& before,
                           const std::string& what) const;
  /// Check everything between two consecutive instants of a path.
  /// @param index  number of the second state.
  /// @param others  contacts that fingers approach or leave.
  MaybeFault CheckPath(const NamedPath& path, std::size_t index, const Instant& from,
                       const Instant& to, const plan::FingerGrasp& others);
  using Conflict = std::variant<HandFinding, NearPair>;
  std::optional<Conflict> FindConflict(const Instant& from, const Instant& to,
                                       const plan::FingerGrasp& others, const std::string& when);
  std::optional<NearPair> FindNear(const Instant& middle, const std::vector<double>& bounds,
                                   double object_bound, const plan::FingerGrasp& others);
  HandFinding WorstOf(const NearPair& near, const NamedPath& path, std::size_t index);
  [[nodiscard]] double NeededFromObject(int part, const Isometry3d& pose,
                                        const plan::FingerContact* touched) const;

  HandBody& body_;
  const plan::Plan& plan_;
  double clearance_;
  std::vector<ConvexBody> triangles_;
  double object_reach_ = 0;
  plan::FingerGrasp holding_;
  HandState state_;
};

MaybeFault Checker::CheckShape(const HandState& state) const {
  if (std::ssize(state.joints) != finger_count()) {
    return NoSuchPath("a state has " + std::to_string(state.joints.size()) + " fingers, expected " +
                          std::to_string(finger_count()),
                      state_);
  }
  for (FingerIndex finger{0}; finger < finger_count(); ++finger) {
    const std::size_t joints = body_.hand().fingers[finger].joints.size();
    if (state.joints[finger].size() == joints) continue;
    HandFinding finding =
        NoSuchPath("a state has " + std::to_string(state.joints[finger].size()) + " joints of " +
                       FingerText(body_.hand(), finger) + ", expected " + std::to_string(joints),
                   state_);
    finding.fault.fingers = {finger};
    for (int moved = 1; moved <= static_cast<int>(joints); ++moved) {
      finding.fault.hand->links.push_back({finger, moved});
    }
    return finding;
  }
  return std::nullopt;
}

MaybeFault Checker::CheckContinues(const plan::HandPath& path) {
  if (path.empty()) return NoSuchPath("path of the hand not found in this step", state_);
  for (const HandState& state : path) {
    if (auto fault = CheckShape(state)) return fault;
  }
  const HandState& first = path.front();
  if (!IsSamePlace(first.pose, state_.pose)) {
    return ObjectJumps(first, state_.pose, "begins the step");
  }
  for (FingerIndex finger{0}; finger < finger_count(); ++finger) {
    for (int k = 0; k < std::ssize(first.joints[finger]); ++k) {
      const double before = state_.joints[finger][k];
      if (std::abs(first.joints[finger][k] - before) <= kSameJoint) continue;
      return JointJumps(body_, first, finger, k, before);
    }
  }
  return std::nullopt;
}

MaybeFault Checker::CheckJoints(const NamedPath& path, std::size_t index) {
  const HandState& state = path.states[index];
  for (FingerIndex finger{0}; finger < finger_count(); ++finger) {
    const auto& joints = body_.hand().fingers[finger].joints;
    for (int k = 0; k < std::ssize(joints); ++k) {
      const double angle = state.joints[finger][k];
      if (angle >= joints[k].lower - kLimitSlack && angle <= joints[k].upper + kLimitSlack)
        continue;
      return JointOutside(body_, state, finger, k, path.InState(index));
    }
  }
  body_.SetJoints(state.joints);
  const auto uncoupled = body_.LargestCouplingResidual();
  if (!uncoupled || uncoupled->radians <= kSameCoupling) return std::nullopt;
  return JointUncoupled(body_, state, *uncoupled, kSameCoupling, path.InState(index));
}

MaybeFault Checker::CheckTips(const plan::FingerGrasp& grasp, const HandState& state,
                              double tolerance, const std::string& when) {
  body_.SetJoints(state.joints);
  for (const plan::FingerContact& held : grasp) {
    if (held.finger >= finger_count()) return NoSuchFinger(held.finger, state);
    const Vector3d expected = BallAt(held, state.pose);
    if ((body_.TipCentre(held.finger) - expected).norm() <= tolerance) continue;
    return TipOff(body_, state, held.finger, expected, tolerance, when);
  }
  return std::nullopt;
}

MaybeFault Checker::CheckRest() {
  if (auto fault = CheckShape(state_)) return AtModelsRest(*fault);
  const plan::HandPath still = {state_, state_};
  const NamedPath path{still};
  if (auto fault = CheckJoints(path, 0)) return fault;
  if (auto fault = CheckTips(holding_, state_, kTipAtRest, "")) return fault;
  return CheckPath(path, 1, {state_, holding_}, {state_, holding_}, {});
}

/// Return the finding with the joint configuration of the hand model.
/// Used for images if the plan has no joint configuration for this hand.
HandFinding Checker::AtModelsRest(HandFinding finding) const {
  HandState& state = finding.fault.hand->state;
  state.joints.clear();
  for (const kinematics::Finger& finger : body_.hand().fingers) {
    state.joints.emplace_back();
    for (const kinematics::Joint& joint : finger.joints) state.joints.back().push_back(joint.rest);
  }
  return finding;
}

double Checker::NeededFromObject(int part, const Isometry3d& pose,
                                 const plan::FingerContact* touched) const {
  const HandPart& owner = body_.parts()[part];
  if (owner.role != HandPart::Role::kTip || touched == nullptr) return clearance_;
  const double off = (body_.TipCentre(owner.finger) - BallAt(*touched, pose)).norm();
  return off <= kApproach ? -kTipDepth : clearance_;
}

/// Find a pair that is too close at the middle of an interval.
/// Its gap there is smaller than its motion in the interval requires.
std::optional<NearPair> Checker::FindNear(const Instant& middle, const std::vector<double>& bounds,
                                          double object_bound, const plan::FingerGrasp& others) {
  body_.SetJoints(middle.state.joints);
  const int count = static_cast<int>(body_.parts().size());
  std::vector<ConvexBody> placed;
  for (int part = 0; part < count; ++part) placed.push_back(body_.Place(part));
  const Isometry3d to_object = middle.state.pose.inverse();
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      if (body_.MayTouch(a, b)) continue;
      if (HaveGap(placed[a], placed[b], clearance_ + (bounds[a] + bounds[b]) / 2)) continue;
      return NearPair{a, b, clearance_};
    }
    const HandPart& owner = body_.parts()[a];
    if (owner.role == HandPart::Role::kCovered) continue;  // its depth is limited by the replay
    const plan::FingerContact* touched = plan::FindFinger(middle.holding, owner.finger);
    if (touched == nullptr) touched = plan::FindFinger(others, owner.finger);
    const double needed = NeededFromObject(a, middle.state.pose, touched);
    const ConvexBody part = Moved(to_object, placed[a]);
    for (const ConvexBody& triangle : triangles_) {
      if (HaveGap(part, triangle, needed + (bounds[a] + object_bound) / 2)) continue;
      return NearPair{a, -1, needed};
    }
  }
  return std::nullopt;
}

Checker::Instant Checker::MiddleOf(const Instant& a, const Instant& b) {
  return {StateBetween(a.state, b.state, 0.5), plan::GraspBetween(a.holding, b.holding, 0.5)};
}

std::optional<Checker::Conflict> Checker::FindConflict(const Instant& from, const Instant& to,
                                                       const plan::FingerGrasp& others,
                                                       const std::string& when) {
  std::vector<double> bounds;
  for (int part = 0; part < static_cast<int>(body_.parts().size()); ++part) {
    bounds.push_back(body_.MotionBound(part, from.state.joints, to.state.joints));
  }
  const double object_bound =
      (to.state.pose.translation() - from.state.pose.translation()).norm() +
      object::RotationInBody(from.state.pose.linear(), to.state.pose.linear()).angle() *
          object_reach_;
  const Instant middle = MiddleOf(from, to);
  if (auto fault = CheckTips(middle.holding, middle.state, kTipInMove, when)) return *fault;
  const std::optional<NearPair> near = FindNear(middle, bounds, object_bound, others);
  if (!near) return std::nullopt;
  const double largest = std::max(object_bound, *std::ranges::max_element(bounds));
  if (largest < kFinest) return *near;
  if (auto conflict = FindConflict(from, middle, others, when)) return conflict;
  return FindConflict(middle, to, others, when);
}

/// Report the same pair at its smallest gap on the remaining path.
/// It shows the required correction, and the first violation is barely visible in an image.
HandFinding Checker::WorstOf(const NearPair& near, const NamedPath& path, std::size_t index) {
  const auto last = path.states.size() - 1;
  const double stretch = static_cast<double>(last - index + 1);
  std::vector<double> gaps;
  const auto state_at = [&](std::size_t sample) {
    const double along = stretch * static_cast<double>(sample) / kMostSamples;
    const auto step = std::min(static_cast<std::size_t>(along), last - index);
    return StateBetween(path.states[index + step - 1], path.states[index + step],
                        along - static_cast<double>(step));
  };
  for (std::size_t sample = 0; sample <= kMostSamples; ++sample) {
    gaps.push_back(near.other < 0 ? GapToObject(body_, state_at(sample), near.part, triangles_)
                                  : GapBetween(body_, state_at(sample), near.part, near.other));
  }
  // If they overlap deeply, gaps do not measure the depth: use the middle of the overlap.
  const double least = *std::ranges::min_element(gaps) + kFinest / 2;
  const auto first = std::ranges::find_if(gaps, [&](double gap) { return gap <= least; });
  const auto end = std::find_if(first, gaps.end(), [&](double gap) { return gap > least; });
  const auto worst = static_cast<std::size_t>((first - gaps.begin()) + (end - first - 1) / 2);
  const std::size_t step = std::min(
      static_cast<std::size_t>(stretch * static_cast<double>(worst) / kMostSamples), last - index);
  const std::string when = path.After(index + step - 1);
  const HandState state = state_at(worst);
  // The requirement without the slack.
  const double needed = near.needed < 0 ? near.needed : clearance_ + kSlack;
  if (near.other < 0) return PartMeetsObject(body_, state, near.part, triangles_, needed, when);
  return PartsCollide(body_, state, near.part, near.other, needed, when);
}

MaybeFault Checker::CheckPath(const NamedPath& path, std::size_t index, const Instant& from,
                              const Instant& to, const plan::FingerGrasp& others) {
  const auto conflict = FindConflict(from, to, others, path.After(index - 1));
  if (!conflict) return std::nullopt;
  if (const auto* finding = std::get_if<HandFinding>(&*conflict)) return *finding;
  return WorstOf(std::get<NearPair>(*conflict), path, index);
}

MaybeFault Checker::CheckMove(const plan::Move& move) {
  if (auto fault = CheckContinues(move.path)) return fault;
  const NamedPath path{move.path, "path"};
  const bool rolls = !move.contacts.empty();
  const auto grasp_at = [&](std::size_t i) -> const plan::FingerGrasp& {
    return rolls ? move.contacts[i] : holding_;
  };
  RollingCheck rolling(body_, triangles_, plan_.scale, move);
  for (std::size_t i = 0; i < move.path.size(); ++i) {
    const plan::FingerGrasp& grasp = grasp_at(i);
    const HandState& state = move.path[i];
    if (!plan::HaveSameFingers(grasp, holding_)) {
      return NoSuchPath("the contacts " + path.InState(i) + " are not those of all holding fingers",
                        state_);
    }
    if (auto fault = CheckJoints(path, i)) return fault;
    const double tolerance = i + 1 == move.path.size() ? kTipAtRest : kTipInMove;
    if (auto fault = CheckTips(grasp, state, tolerance, path.InState(i))) return fault;
    if (i > 0) {
      const Instant from{move.path[i - 1], grasp_at(i - 1)};
      if (auto fault = CheckPath(path, i, from, {state, grasp}, {})) return fault;
    }
    if (!rolls) continue;
    const std::string after = i == 0 ? "" : path.After(i - 1);
    if (auto fault = rolling.Check(i, path.InState(i), after)) return fault;
  }
  state_ = move.path.back();
  return std::nullopt;
}

/// Check a path on which some fingers move, while the object and all other fingers do not.
MaybeFault Checker::CheckFingersGo(const NamedPath& path, const plan::FingerGrasp& moving,
                                   const plan::FingerGrasp& still) {
  if (moving.empty()) return std::nullopt;
  const plan::HandPath& states = path.states;
  if (auto fault = CheckContinues(states)) return fault;
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (auto fault = CheckStaysPut(states[i], states[i - 1], "switch")) return fault;
    if (auto fault = CheckJoints(path, i)) return fault;
    if (auto fault = CheckTips(still, states[i], kTipAtRest, path.InState(i))) return fault;
    if (auto fault = CheckPath(path, i, {states[i - 1], still}, {states[i], still}, moving)) {
      return fault;
    }
  }
  state_ = states.back();
  return std::nullopt;
}

MaybeFault Checker::CheckStaysPut(const HandState& now, const HandState& before,
                                  const std::string& what) const {
  if (IsSamePlace(now.pose, before.pose)) return std::nullopt;
  return ObjectJumps(now, before.pose, "moves while fingers " + what + ": it is");
}

/// Check the path from one waypoint of a sliding step to the next, at equal shares of the distance.
MaybeFault Checker::CheckSlide(const NamedPath& path, const plan::FingerGrasp& from,
                               const plan::FingerGrasp& to) {
  const plan::HandPath& states = path.states;
  if (auto fault = CheckContinues(states)) return fault;
  const auto at = [&](std::size_t i) -> Instant {
    return {states[i],
            plan::GraspBetween(from, to,
                               static_cast<double>(i) / static_cast<double>(states.size() - 1))};
  };
  if (states.size() < 2)
    return NoSuchPath(path.name + " must have at least two states, found one", state_);
  for (std::size_t i = 1; i < states.size(); ++i) {
    const Instant now = at(i);
    if (auto fault = CheckStaysPut(now.state, states[i - 1], "slide")) return fault;
    if (auto fault = CheckJoints(path, i)) return fault;
    const double tolerance = i + 1 == states.size() ? kTipAtRest : kTipInMove;
    if (auto fault = CheckTips(now.holding, now.state, tolerance, path.InState(i))) return fault;
    if (auto fault = CheckPath(path, i, at(i - 1), now, {})) return fault;
  }
  state_ = states.back();
  return std::nullopt;
}

MaybeFault Checker::CheckAlign(const plan::Align& align) {
  if (!align.motion) return NoSuchPath("path of the hand not found in this step", state_);
  const std::size_t ways = align.waypoints.size() - 1;
  if (align.motion->size() != ways) {
    return NoSuchPath("the hand has " + std::to_string(align.motion->size()) +
                          " paths in this step, expected " + std::to_string(ways) +
                          " for its waypoints",
                      state_);
  }
  for (std::size_t w = 0; w < ways; ++w) {
    const NamedPath path{(*align.motion)[w], "the path to waypoint " + std::to_string(w + 1)};
    if (auto fault = CheckSlide(path, align.waypoints[w], align.waypoints[w + 1])) return fault;
  }
  return std::nullopt;
}

MaybeFault Checker::CheckSwitch(const plan::Switch& change) {
  if (!change.motion) return NoSuchPath("path of the hand not found in this step", state_);
  for (const plan::FingerContact& placed : change.place) {
    if (placed.finger >= finger_count()) return NoSuchFinger(placed.finger, state_);
  }
  const NamedPath place{change.motion->place, "place"};
  if (auto fault = CheckFingersGo(place, change.place, holding_)) return fault;
  if (auto fault = CheckTips(change.place, state_, kTipAtRest, "at the end of place")) return fault;
  plan::FingerGrasp released;
  plan::FingerGrasp still = change.place;
  for (const plan::FingerContact& held : holding_) {
    const bool leaves = std::ranges::find(change.release, held.finger) != change.release.end();
    (leaves ? released : still).push_back(held);
  }
  return CheckFingersGo({change.motion->release, "release"}, released, still);
}

MaybeFault Checker::CheckStep(const plan::Step& step) {
  MaybeFault fault;
  if (const auto* move = std::get_if<plan::Move>(&step)) {
    fault = CheckMove(*move);
  } else if (const auto* change = std::get_if<plan::Switch>(&step)) {
    fault = CheckSwitch(*change);
  } else {
    fault = CheckAlign(std::get<plan::Align>(step));
  }
  holding_ = plan::GraspAfter(holding_, step);
  return fault;
}

}  // namespace

std::vector<plan::HandFault> CheckHand(const kinematics::HandFile& file,
                                       const object::Polyhedron& solid, const plan::Plan& plan,
                                       const HandCheckOptions& options) {
  if (!plan.hand) {
    throw InputError("--hand cannot be used with a plan without a hand");
  }
  if (plan.hand->sha256 != file.hand.sha256) {
    throw InputError("--hand: " + OtherHandText(file.hand, *plan.hand));
  }
  HandBody body(file);
  return Checker(body, solid, plan, options).Check();
}

std::vector<plan::HandFault> CheckHand(const std::filesystem::path& hand_file,
                                       const object::Polyhedron& solid, const plan::Plan& plan,
                                       const HandCheckOptions& options) {
  return CheckHand(kinematics::ReadHandFile(hand_file), solid, plan, options);
}

}  // namespace regrasp::sim
