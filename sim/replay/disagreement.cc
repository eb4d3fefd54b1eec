#include "sim/replay/disagreement.h"

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/quality.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/scaling.h"
#include "sim/world/motion_monitor.h"

namespace regrasp::sim {
namespace {

using Finding = std::optional<Disagreement>;

/// Ratio to the clearance above which a fingertip is too thick; it exceeds rounding errors.
constexpr double kThicker = 1 + 1e-6;

std::string Finger(FingerIndex finger) { return "finger " + std::to_string(finger); }

/// After a finger slides off its face it presses on another one. Its margin to the planned cone is
/// then meaningless and is not reported.
Disagreement ConeReached(const std::string& what, FingerIndex finger, double margin) {
  const double degrees = Degrees(std::max(margin, 0.0));
  return {.cause = Cause::kConeReached,
          .text = what + ": margin " + FormatDegrees(degrees),
          .values = {{"finger", finger}, {"cone_margin_deg", degrees}}};
}

/// Checks the possible causes of a failed replay, one after the other.
class ReplayFault {
 public:
  explicit ReplayFault(const ExaminedStep& step)
      : step_(step),
        friction_angle_(std::atan(step.settings.mu)),
        frame_(step.object.wrench_frame()),
        grasps_(GraspsOfEntry(step.projected, step.check.index)) {}

  [[nodiscard]] Disagreement Explain() const {
    for (const auto examine :
         {&ReplayFault::CheckClearance, &ReplayFault::CheckWeight, &ReplayFault::CheckQuality,
          &ReplayFault::CheckWeightUnderDisturbance, &ReplayFault::CheckEdge,
          &ReplayFault::CheckCones}) {
      if (Finding found = (this->*examine)()) return *found;
    }
    return {.cause = Cause::kUnknown,
            .text = "no cause found: quality " + FormatShort(quality()) + ", disturbance " +
                    FormatShort(step_.settings.disturbance_ratio),
            .values = {{"quality", quality()}, {"shake", step_.settings.disturbance_ratio}}};
  }

  [[nodiscard]] Finding CheckEdge() const {
    const double slip = step_.settings.tolerance * step_.object.diameter();
    for (const plan::FingerGrasp& grasp : grasps_) {
      for (const plan::FingerContact& held : grasp) {
        const double away = step_.object.DistanceToBorder(held.contact.face, held.contact.p);
        if (away >= slip) continue;
        const auto [border, most] = FormatLengthWithLimit(Metres(away), Metres(slip));
        return Disagreement{.cause = Cause::kEdge,
                            .text = Finger(held.finger) + " is " + border +
                                    " from the border of its face, and may slip " + most,
                            .values = {{"finger", held.finger},
                                       {"border_m", Metres(away)},
                                       {"allowed_slip_m", Metres(slip)}}};
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] double Metres(double length) const { return length * step_.projected.scale; }

  [[nodiscard]] grasp::Wrench Weight() const {
    const double share =
        step_.settings.mass_kg * step_.settings.gravity_m_s2 / step_.settings.grasp_force_N;
    return {-share * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  }

  [[nodiscard]] double quality() const {
    double least = 1;
    for (const plan::FingerGrasp& grasp : grasps_) {
      if (grasp.empty()) return 0;
      const grasp::Grasp contacts = plan::ContactsOf(grasp);
      // A lower bound of the quality is much cheaper than its value.
      if (grasp::QualityAtLeast(contacts, frame_, friction_angle_, least)) continue;
      least = std::min(least, grasp::ComputeQuality(contacts, frame_, friction_angle_).lower);
    }
    return least;
  }

  [[nodiscard]] Finding CheckClearance() const {
    const double tip = step_.settings.fingertip_radius_m / step_.projected.scale;
    for (const plan::FingerGrasp& grasp : grasps_) {
      for (const plan::FingerContact& held : grasp) {
        const double clearance = criteria::ComputeClearance(step_.object, held.contact, 2 * tip);
        const bool corner = clearance < kLeastClearance * step_.object.diameter();
        if (!corner && tip <= kThicker * clearance) continue;
        const double away = step_.object.DistanceToBorder(held.contact.face, held.contact.p);
        Disagreement found{.cause = corner ? Cause::kConcaveCorner : Cause::kNoClearance,
                           .values = {{"finger", held.finger},
                                      {"clearance_m", Metres(clearance)},
                                      {"fingertip_radius_m", Metres(tip)},
                                      {"border_m", Metres(away)}}};
        found.text = corner ? Finger(held.finger) + " is in a concave corner, " +
                                  FormatLength(Metres(away)) + " from the border of its face"
                            : "a fingertip of radius " + FormatLength(Metres(tip)) +
                                  " does not fit at " + Finger(held.finger) + ", clearance " +
                                  FormatLength(Metres(clearance));
        return found;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] Finding CheckWeight() const {
    const double weight = Weight().force.norm();
    if (weight == 0) return std::nullopt;
    const grasp::Wrench down{-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
    for (const plan::FingerGrasp& grasp : grasps_) {
      if (grasp.empty()) continue;
      const auto carried =
          grasp::ComputeLargestLoad(plan::ContactsOf(grasp), frame_, friction_angle_, {}, down, 1);
      if (!carried || carried->upper >= weight) continue;
      const auto [load, most] = FormatWithLimit(weight, carried->lower, 4);
      return Disagreement{.cause = Cause::kWeight,
                          .text = "the grasp force does not support the weight: the weight is " +
                                  load + " of the grasp force, the grasp supports " + most,
                          .values = {{"weight", weight}, {"carried", carried->lower}}};
    }
    return std::nullopt;
  }

  [[nodiscard]] Finding CheckQuality() const {
    const double disturbance_ratio = step_.settings.disturbance_ratio;
    if (quality() >= disturbance_ratio) return std::nullopt;
    const auto [reached, needed] = FormatWithLimit(quality(), disturbance_ratio, 4);
    return Disagreement{
        .cause = Cause::kQuality,
        .text = "the quality is below the disturbance: ε = " + reached + ", disturbance " + needed,
        .values = {{"quality", quality()}, {"shake", disturbance_ratio}}};
  }

  /// Check for a grasp whose quality falls below ρ only because it supports the weight.
  [[nodiscard]] Finding CheckWeightUnderDisturbance() const {
    if (grasps_.back().empty()) return std::nullopt;
    const grasp::Grasp rest = plan::ContactsOf(grasps_.back());
    for (const Disturbance& disturbance : DisturbanceDirections(frame_.dimension)) {
      const auto left = grasp::ComputeLargestLoad(rest, frame_, friction_angle_, Weight(),
                                                  DisturbanceWrench(disturbance, 1), 1);
      if (left && left->upper >= step_.settings.disturbance_ratio) continue;
      const double least = left ? left->lower : 0;
      const auto [resisted, needed] = FormatWithLimit(least, step_.settings.disturbance_ratio, 4);
      return Disagreement{
          .cause = Cause::kWeight,
          .text = "in addition to the weight, " + FormatShort(Weight().force.norm()) +
                  " of the grasp force, the grasp resists " + resisted + " in " +
                  DisturbanceName(disturbance) + ", less than the disturbance of " + needed,
          .values = {{"weight", Weight().force.norm()},
                     {"resisted", least},
                     {"shake", step_.settings.disturbance_ratio}}};
    }
    return std::nullopt;
  }

  [[nodiscard]] Finding CheckCones() const {
    for (const auto& [margins, when] :
         {std::pair{&step_.replay.motion_margins, "during the motion"},
          {&step_.replay.static_margins, "in the static grasp"},
          {&step_.replay.disturbance_margins, "under a disturbance"}}) {
      const auto least = SmallestMargin(*margins);
      if (!least || *least >= kConeReached) continue;
      const FingerIndex finger = FingerOfSmallestMargin(*margins);
      return ConeReached("the force of " + Finger(finger) + " reaches its friction cone " + when,
                         finger, *least);
    }
    return std::nullopt;
  }

  const ExaminedStep& step_;
  double friction_angle_;
  object::WrenchFrame frame_;
  std::vector<plan::FingerGrasp> grasps_;
};

Disagreement ExplainFixed(const ExaminedStep& step) {
  const StepMotion& fixed = *step.replay.fixed;
  const auto least = SmallestMargin(fixed.disturbance_margins);
  if (least && *least < kConeReached) {
    const FingerIndex finger = FingerOfSmallestMargin(fixed.disturbance_margins);
    return ConeReached("with the grasp force of the static grasp the force of " + Finger(finger) +
                           " reaches its friction cone",
                       finger, *least);
  }
  if (Finding edge = ReplayFault(step).CheckEdge()) return *edge;
  return {.cause = Cause::kUnknown,
          .text = "no cause found: the object yields by " + FormatLength(fixed.give_m) +
                  " on the servos, and no force reaches its cone",
          .values = {{"give_m", fixed.give_m}}};
}

Disagreement ExplainAnalysis(const ExaminedStep& step) {
  if (step.check.reason != plan::Reason::kNotForceClosure &&
      step.check.reason != plan::Reason::kNotProved) {
    return {
        .cause = Cause::kNotSimulated,
        .text = "the replay does not model " + std::string(plan::ReasonName(step.check.reason))};
  }
  if (step.settings.disturbance_ratio == 0) {
    return {.cause = Cause::kNoDisturbance,
            .text = "without a disturbance the replay does not test the grasp",
            .values = {{"shake", 0}}};
  }
  const double friction_angle = std::atan(step.settings.mu);
  if (!step.check.required) {
    return {.cause = Cause::kUnknown,
            .text = "no cause found: no friction angle below 90° is sufficient"};
  }
  const double required = step.check.required->upper;
  if (required <= friction_angle) {
    return {.cause = Cause::kNotSimulated,
            .text = "the replay uses the normals of triangles, not of contact patches"};
  }
  const LimitText text = FormatRequiredDegrees(Degrees(required), Degrees(friction_angle));
  const bool near = step.settings.mu >= kNearCritical * std::tan(required);
  return {.cause = near ? Cause::kRequiredFriction : Cause::kUnknown,
          .text = std::string(near ? "the friction is less than 2 % below the required one"
                                   : "no cause found") +
                  ": friction angle " + text.limit + "°, required " + text.value + "°",
          .values = {{"half_angle_deg", Degrees(friction_angle)},
                     {"required_half_angle_deg", Degrees(required)}}};
}

/// Check whether friction near the required one explains a disagreement of the two engines.
Finding CheckRequiredFriction(const ExaminedStep& step) {
  if (!step.check.required) return std::nullopt;
  const double critical = std::tan(step.check.required->upper);
  const double ratio = step.settings.mu / critical;
  if (std::abs(ratio - 1) > kNearCriticalOfTwo) return std::nullopt;
  return Disagreement{.cause = Cause::kRequiredFriction,
                      .text = "the friction is " + FormatShort(ratio) + " times the required one",
                      .values = {{"half_angle_deg", Degrees(std::atan(step.settings.mu))},
                                 {"required_half_angle_deg", Degrees(step.check.required->upper)}}};
}

Disagreement Named(Between between, Disagreement found) {
  found.between = between;
  return found;
}

}  // namespace

std::optional<Disagreement> ExplainDisagreement(const ExaminedStep& step) {
  if (step.check.skipped) return std::nullopt;
  const bool analysis = step.check.reason == plan::Reason::kNone;
  const bool replay = step.replay.reason == plan::Reason::kNone;
  if (analysis && !replay) return Named(Between::kReplayFails, ReplayFault(step).Explain());
  if (!analysis && replay) return Named(Between::kAnalysisFails, ExplainAnalysis(step));
  const bool fixed_differs = step.replay.adapted && step.replay.fixed &&
                             step.replay.adapted->reason == plan::Reason::kNone &&
                             step.replay.fixed->reason != plan::Reason::kNone;
  if (fixed_differs) return Named(Between::kFixedFails, ExplainFixed(step));
  return std::nullopt;
}

std::optional<Disagreement> ExplainEngines(const ExaminedStep& step) {
  if (step.check.skipped || !step.replay.ode) return std::nullopt;
  const bool mujoco = step.replay.reason == plan::Reason::kNone;
  const bool ode = step.replay.ode->reason == plan::Reason::kNone;
  if (mujoco == ode) return std::nullopt;
  const Between between = mujoco ? Between::kOdeFails : Between::kOdePasses;
  if (Finding critical = CheckRequiredFriction(step)) return Named(between, *critical);
  const plan::Reason reason = mujoco ? step.replay.ode->reason : step.replay.reason;
  if (reason == plan::Reason::kSimulationUnstable) {
    return Named(between, {.cause = Cause::kUnstable,
                           .text = std::string(mujoco ? "ODE" : "MuJoCo") + " did not converge: " +
                                   (mujoco ? step.replay.ode->detail : step.replay.detail)});
  }
  if (step.settings.hand) return Named(between, {.text = "likely cause: unknown"});
  if (!mujoco) return Named(between, ReplayFault(step).Explain());
  StepReplay failed = step.replay;
  static_cast<StepMotion&>(failed) = *step.replay.ode;
  return Named(
      between,
      ReplayFault({step.object, step.projected, step.check, failed, step.settings}).Explain());
}

std::string LikelyCauseText(const Disagreement& found) {
  return (found.cause == Cause::kUnknown ? "" : "likely cause: ") + found.text;
}

std::string_view BetweenName(Between between) {
  switch (between) {
    case Between::kReplayFails:
      return "replay-fails";
    case Between::kAnalysisFails:
      return "analysis-fails";
    case Between::kFixedFails:
      return "fixed-fails";
    case Between::kOdeFails:
      return "ode-fails";
    case Between::kOdePasses:
      return "ode-passes";
  }
  return "";
}

std::string_view CauseName(Cause cause) {
  switch (cause) {
    case Cause::kConcaveCorner:
      return "concave-corner";
    case Cause::kNoClearance:
      return "no-room";
    case Cause::kWeight:
      return "weight";
    case Cause::kQuality:
      return "quality-below-shake";
    case Cause::kEdge:
      return "edge";
    case Cause::kConeReached:
      return "cone-reached";
    case Cause::kNotSimulated:
      return "not-simulated";
    case Cause::kNoDisturbance:
      return "no-shake";
    case Cause::kRequiredFriction:
      return "critical-friction";
    case Cause::kUnstable:
      return "unstable";
    case Cause::kUnknown:
      return "unknown";
  }
  return "";
}

}  // namespace regrasp::sim
