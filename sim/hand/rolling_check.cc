#include "sim/hand/rolling_check.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "planner/base/number.h"
#include "planner/object/rotation.h"

namespace regrasp::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using plan::HandState;

/// Tolerance of the distance between a fingertip's centre and the surface, metres.
constexpr double kTouchTolerance = 1e-5;
/// Steps in which the slip between two states is integrated.
constexpr int kSlipSteps = 4;

/// Centre and orientation of a fingertip in the object's frame.
struct TipInObject {
  Vector3d centre;
  Matrix3d turn;
};

TipInObject TipOf(HandBody& body, const HandState& state, FingerIndex finger) {
  body.SetJoints(state.joints);
  return {state.pose.inverse() * body.TipCentre(finger),
          state.pose.linear().transpose() * body.TipTurn(finger)};
}

HandFinding FindingAtTip(HandBody& body, const HandState& state, FingerIndex finger,
                         plan::Reason reason, const std::string& detail, double length) {
  body.SetJoints(state.joints);
  HandFinding finding{reason, detail, {.fingers = {finger}}};
  plan::HandFaultPlace& place = finding.fault.hand.emplace();
  place.state = state;
  place.links = {{finger, static_cast<int>(body.hand().fingers[finger].joints.size())}};
  place.at = body.TipCentre(finger);
  place.number = FormatLength(length);
  return finding;
}

}  // namespace

std::optional<HandFinding> RollingCheck::Check(std::size_t state, const std::string& in_state,
                                               const std::string& after_state) {
  if (auto finding = FindContactBeside(state, in_state)) return finding;
  return state == 0 ? std::nullopt : FindSlip(state, after_state);
}

std::optional<HandFinding> RollingCheck::FindContactBeside(std::size_t state,
                                                           const std::string& when) {
  for (const plan::FingerContact& held : move_.contacts[state]) {
    const double radius = body_.hand().fingers[held.finger].tip.radius;
    const Vector3d point = scale_ * held.contact.p;
    const ConvexBody contact = MakeConvexBody({point}, 0);
    const ConvexBody centre = MakeConvexBody({point - radius * held.contact.n}, 0);
    const bool touches = std::ranges::any_of(surface_, [&](const ConvexBody& triangle) {
      return !HaveGap(contact, triangle, kTouchTolerance);
    });
    double deepest = 0;
    for (const ConvexBody& triangle : surface_) {
      if (HaveGap(centre, triangle, radius - kTouchTolerance)) continue;
      deepest = std::max(deepest, radius - NearestOf(centre, {&triangle, 1}).gap);
    }
    if (touches && deepest < kTouchTolerance) continue;
    const std::string what = touches
                                 ? FormatLength(deepest) + " inside the surface next to its contact"
                                 : "not on the surface";
    return FindingAtTip(body_, move_.path[state], held.finger, plan::Reason::kTipOffContact,
                        "the rolling fingertip of " + FingerText(body_.hand(), held.finger) +
                            " is " + what + " " + when,
                        deepest);
  }
  return std::nullopt;
}

std::optional<HandFinding> RollingCheck::FindSlip(std::size_t state, const std::string& when) {
  const HandState& from = move_.path[state - 1];
  const HandState& to = move_.path[state];
  const plan::FingerGrasp& before = move_.contacts[state - 1];
  for (const plan::FingerContact& held : before) {
    const double radius = body_.hand().fingers[held.finger].tip.radius;
    Vector3d& slip = slip_O_.try_emplace(held.finger, Vector3d::Zero()).first->second;
    TipInObject last = TipOf(body_, from, held.finger);
    for (int step = 1; step <= kSlipSteps; ++step) {
      const double share = static_cast<double>(step) / kSlipSteps;
      const TipInObject tip = TipOf(body_, plan::StateBetween(from, to, share), held.finger);
      const plan::FingerGrasp middle =
          plan::GraspBetween(before, move_.contacts[state], share - 0.5 / kSlipSteps);
      const Vector3d outward = -plan::FindFinger(middle, held.finger)->contact.n;
      const Eigen::AngleAxisd turn = object::RotationInWorld(last.turn, tip.turn);
      const Vector3d off =
          tip.centre - last.centre - (turn.angle() * turn.axis()).cross(radius * outward);
      slip += off - off.dot(outward) * outward;
      last = tip;
    }
    if (slip.norm() <= kMostRollingSlip) continue;
    const auto [value, limit] = FormatLengthWithLimit(slip.norm(), kMostRollingSlip);
    return FindingAtTip(body_, to, held.finger, plan::Reason::kSlipped,
                        "the fingertip of " + FingerText(body_.hand(), held.finger) + " slips " +
                            value + " instead of rolling " + when + ", limit " + limit,
                        slip.norm());
  }
  return std::nullopt;
}

}  // namespace regrasp::sim
