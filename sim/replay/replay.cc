#include "sim/replay/replay.h"

#include <algorithm>
#include <cmath>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/grasp_forces.h"
#include "sim/control/slide.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/align_script.h"
#include "sim/scene/scene.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {
namespace {

void RestoreRoles(ReplayWorld& world) {
  for (WorldFinger& finger : world.fingers()) {
    finger.role = finger.holding ? plan::FingerRole::kHolding : plan::FingerRole::kFree;
  }
}

/// Execute entry `index` of the report, between two static grasps.
void Perform(ReplayWorld& world, const object::Object& object, const plan::Plan& plan,
             plan::EntryIndex index, StepReplay& result) {
  if (index == 0) {
    TakeHold(world, ToScene(object, plan.scale, plan.initial));
    return;
  }
  const plan::Step& step = plan::StepOf(plan, index);
  if (const auto* change = std::get_if<plan::Switch>(&step)) {
    SwitchFingers(world, ToScene(object, plan.scale, change->place), change->release);
    return;
  }
  const auto* align = std::get_if<plan::Align>(&step);
  if (align == nullptr) return;  // an in-hand motion: there is no hand to execute it
  const auto& waypoints = align->waypoints;
  if (waypoints.empty()) return;
  const AlignScript& script = *world.scene().entries[index].script;
  result.align_mode = PerformAlign(world, script);
  result.align_shares = script.shares;
  std::vector<plan::FingerGrasp> waypoints_B;
  for (const plan::FingerGrasp& grasp : waypoints) {
    waypoints_B.push_back(ToScene(object, plan.scale, grasp));
  }
  TellMoved(world, waypoints_B);
}

/// Return the measurements of the monitor for a step.
StepMotion Describe(const MotionMonitor& monitor) {
  StepMotion result;
  static_cast<Violation&>(result) = {monitor.reason(), monitor.detail(), {}};
  result.displacement_m = monitor.displacement_m();
  result.rotation_deg = Degrees(monitor.rotation_rad());
  result.moved_m = monitor.moved_m();
  result.give_m = monitor.give_m();
  result.slip_m = monitor.slip_m();
  result.contact_lost = monitor.contact_lost();
  return result;
}

StepMotion Unstable(const MotionMonitor& monitor, const UnstableError& error) {
  StepMotion result = Describe(monitor);
  // After the object is lost, an unstable simulation is expected and changes no reason.
  if (result.reason != plan::Reason::kNone) return result;
  result.reason = plan::Reason::kSimulationUnstable;
  const std::string why = error.what();
  // The engine's first sentence contains the reason.
  result.detail =
      "the simulation diverges " + monitor.phase() + ": " + why.substr(0, why.find(". "));
  return result;
}

/// Return the phase of the motion of an entry in messages.
std::string PhaseOf(const plan::Plan& plan, plan::EntryIndex index) {
  if (index == 0) return "while the fingers grasp";
  const plan::Step& step = plan::StepOf(plan, index);
  return std::holds_alternative<plan::Align>(step)
             ? "during the sliding step"
             : std::string("during the ") + plan::StepKind(step);
}

/// Return the fault that the monitor found, with the present state of the world.
plan::Fault DescribeFault(const ReplayWorld& world, const object::Object& object, double scale) {
  const MotionMonitor& monitor = world.monitor();
  const Eigen::Vector3d& centroid = object.mass_properties().centroid;
  plan::Fault fault;
  if (monitor.reason() == plan::Reason::kNone) return fault;
  const Eigen::Translation3d p_WS(scale * centroid);
  fault.X_WO_before = p_WS * monitor.start() * p_WS.inverse();
  const FingerIndex f = monitor.finger();
  if (!f.valid()) return fault;
  const WorldFinger& finger = world.fingers()[f];
  const auto contact_at = [&](const Eigen::Vector3d& p_B) {
    return grasp::Contact{centroid + p_B / scale, finger.contact.n, finger.contact.face,
                          world.settings().torsion_m / scale};
  };
  const Eigen::Vector3d found = world.ContactPoint_B(f);
  const Eigen::Vector3d& n = finger.contact.n;
  const bool slipped = monitor.reason() == plan::Reason::kSlipped;
  fault.fingers = {f};
  fault.found = contact_at(found);
  // A slide is along the surface. A place off the surface is projected onto it.
  const Eigen::Vector3d along = n * n.dot(finger.contact.p - found);
  const Eigen::Vector3d slide = finger.touch_B - found;
  fault.expected = {
      contact_at(found + (slipped ? Eigen::Vector3d(slide - slide.dot(n) * n) : along))};
  return fault;
}

/// Return the step with its disturbance tests; the monitor is restored.
StepMotion DisturbStaticGrasp(ReplayWorld& world, const object::Object& object, double scale,
                              DisturbanceResponse response) {
  const MotionMonitor before = world.monitor();
  StepMotion seen;
  seen.fault = DescribeFault(world, object, scale);
  seen.detail = world.monitor().detail();
  seen.snapshot = world.TakeSnapshot();
  const auto see_fault = [&](const plan::FaultDisturbance& disturbance) {
    // A failure that precedes the disturbance is not caused by it.
    if (world.monitor().reason() == before.reason()) return;
    seen.fault = DescribeFault(world, object, scale);
    seen.detail = world.monitor().detail();
    seen.fault.disturbance = disturbance;
    seen.snapshot = world.TakeSnapshot();
  };
  StepMotion result;
  world.monitor().ForgetForces();
  try {
    ApplyDisturbances(world, response, see_fault);
    result = Describe(world.monitor());
    result.detail = seen.detail;
  } catch (const UnstableError& error) {
    result = Unstable(world.monitor(), error);
  }
  result.disturbance_margins = world.monitor().margins();
  result.fault = seen.fault;
  result.snapshot = seen.snapshot;
  world.monitor() = before;
  return result;
}

FingerMargins MarginsNow(const ReplayWorld& world) {
  FingerMargins margins;
  for (const FingerIndex f : world.HoldingFingers()) {
    const Eigen::Vector3d force = world.engine().tip_force(f).force;
    const Eigen::Vector3d normal = world.X_SB().linear() * world.fingers()[f].contact.n;
    if (force.dot(normal) < kPressing * world.settings().grasp_force_N) continue;
    AddMargin(f, ConeMargin(force, normal, world.friction_angle(), world.Twist(f)), margins);
  }
  return margins;
}

/// Test the static grasp after a step.
void ExamineRest(ReplayWorld& world, const object::Object& object, double scale,
                 StepReplay& result) {
  const ReplaySettings& settings = world.settings();
  result.static_margins = MarginsNow(world);
  const auto disturb = [&](DisturbanceResponse response) {
    return DisturbStaticGrasp(world, object, scale, response);
  };
  if (settings.protocol != Protocol::kFixed)
    result.adapted = disturb(DisturbanceResponse::kAdapted);
  if (settings.protocol != Protocol::kAdapted) result.fixed = disturb(DisturbanceResponse::kFixed);
  static_cast<StepMotion&>(result) = result.adapted ? *result.adapted : *result.fixed;
  // A grasp that loses the object without a disturbance resists no wrench.
  if (settings.resisted_wrench && world.monitor().reason() == plan::Reason::kNone)
    result.resisted_wrench = MeasureResistedWrenches(world);
}

StepReplay ReplayStep(ReplayWorld& world, const object::Object& object, const plan::Plan& plan,
                      plan::EntryIndex index) {
  StepReplay result;
  result.index = index;
  if (const auto& obstacle = world.scene().entries[index].unreachable) {
    result.reason = plan::Reason::kUnreachable;
    result.detail = obstacle->detail;
    result.fault = obstacle->fault;
    result.snapshot = world.TakeSnapshot();
    return result;
  }
  RestoreRoles(world);
  world.StartMonitoring();
  try {
    world.monitor().SetPhase(PhaseOf(plan, index));
    Perform(world, object, plan, index, result);
    world.monitor().SetPhase("after the fingers stop");
    ComeToRest(world);
    result.motion_margins = world.monitor().margins();
    ExamineRest(world, object, plan.scale, result);
  } catch (const UnstableError& error) {
    static_cast<StepMotion&>(result) = Unstable(world.monitor(), error);
  }
  result.drift_m =
      MeasureMotion(Eigen::Isometry3d::Identity(), world.X_SB(), world.settings().diameter_m / 2);
  return result;
}

/// Return the controls of the fingers in the initial static grasp, for the keyframe.
std::vector<Eigen::Vector3d> HoldControls(const Scene& scene, const object::Object& body,
                                          const plan::Plan& plan) {
  const ReplaySettings& s = scene.settings;
  const Eigen::Vector3d up = s.gravity_m_s2 * Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Vector3d> targets(scene.fingers.size(), s.finger_mass_kg * up);
  const grasp::Grasp contacts = plan::ContactsOf(ToScene(body, plan.scale, plan.initial));
  const grasp::GraspForces forces = grasp::ComputeGraspForces(
      contacts, {Eigen::Vector3d::Zero(), s.diameter_m / 2, scene.dimension}, std::atan(s.mu),
      {-s.mass_kg * up, Eigen::Vector3d::Zero()}, s.grasp_force_N);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    targets[plan.initial[i].finger] += forces.forces[i];
  }
  for (Eigen::Vector3d& control : targets) control /= s.finger_stiffness_N_m;
  return targets;
}

}  // namespace

namespace {

/// Replay a plan in one engine.
ReplayResult ReplayOnce(const object::Object& object, const plan::Plan& plan,
                        const ReplayOptions& options, const ReplayObserver& observer, int steps) {
  const int all = static_cast<int>(plan.steps.size()) + 1;
  const int total = steps < 0 ? all : std::min(steps, all);
  ReplayResult result;
  if (total == 0) return result;
  ReplayWorld world(object, plan, MakeScene(object, plan, total - 1, options), observer);
  result.settings = world.settings();
  CheckDisturbance(result.settings);
  for (plan::EntryIndex index{0}; index < total; ++index) {
    result.steps.push_back(ReplayStep(world, object, plan, index));
    if (observer.on_progress) observer.on_progress(index + 1, total);
    if (result.steps.back().reason != plan::Reason::kNone) break;
  }
  return result;
}

ReplayOptions In(EngineChoice engine, ReplayOptions options) {
  options.engine = engine;
  return options;
}

}  // namespace

ReplayResult ReplayPlan(const object::Object& object, const plan::Plan& plan,
                        const ReplayOptions& options, const ReplayObserver& observer, int steps) {
  if (options.engine != EngineChoice::kBoth) {
    return ReplayOnce(object, plan, options, observer, steps);
  }
  ReplayResult result =
      ReplayOnce(object, plan, In(EngineChoice::kMujoco, options), observer, steps);
  const int replayed = static_cast<int>(result.steps.size());
  ReplayOptions by_ode = In(EngineChoice::kOde, options);
  by_ode.resisted_wrench = false;  // no verdict depends on it
  ReplayResult second = ReplayOnce(object, plan, by_ode, {}, replayed);
  for (StepReplay& step : second.steps) {
    result.steps[step.index].ode = std::move(static_cast<StepMotion&>(step));
  }
  result.settings.engine = EngineChoice::kBoth;
  return result;
}

std::string SceneMjcf(const object::Object& object, const plan::Plan& plan,
                      const ReplayOptions& options) {
  const Scene scene = MakeScene(object, plan, static_cast<int>(plan.steps.size()), options);
  return FormatScene(scene, object, HoldControls(scene, object, plan), /*surface=*/true);
}

}  // namespace regrasp::sim
