#include "sim/scene/scaling.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/grasp_forces.h"

namespace regrasp::sim {

namespace {

/// Return the grasps before, between and after the steps.
std::vector<grasp::Grasp> GraspsOf(const plan::Plan& plan, int entries) {
  std::vector<grasp::Grasp> grasps = {plan::ContactsOf(plan.initial)};
  plan::FingerGrasp holding = plan.initial;
  for (int i = 1; i < entries; ++i) {
    const plan::Step& step = plan.steps[i - 1];
    if (const auto* align = std::get_if<plan::Align>(&step)) {
      for (const auto& waypoint : align->waypoints) grasps.push_back(plan::ContactsOf(waypoint));
    }
    holding = plan::GraspAfter(holding, step);
    grasps.push_back(plan::ContactsOf(holding));
  }
  return grasps;
}

/// Return the largest weight over the grasp force that all grasps carry.
/// Ignores grasps that carry none.
double CarriedShare(const object::Object& object, const std::vector<grasp::Grasp>& grasps,
                    double friction_angle) {
  const grasp::Wrench down{-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  double least = std::numeric_limits<double>::infinity();
  for (const grasp::Grasp& grasp : grasps) {
    if (grasp.empty()) continue;
    const auto carried =
        grasp::ComputeLargestLoad(grasp, object.wrench_frame(), friction_angle, {}, down, 1);
    if (carried && carried->lower > 0) least = std::min(least, carried->lower);
  }
  return std::isfinite(least) ? least : std::tan(friction_angle);
}

}  // namespace

double HandGraspForce(const object::Object& object, const plan::Plan& projected, int entries,
                      double friction_angle, double mass_kg) {
  const double share = object.dimension() == 2
                           ? std::tan(friction_angle)
                           : CarriedShare(object, GraspsOf(projected, entries), friction_angle);
  return std::min(kGripSafety * mass_kg * kGravity / share, kStrongestGrip_N);
}

namespace {

/// Range of the simulation. Every object looks alike to the engine (UnitsOf). These sizes, between
/// molecules and planets, exclude typing errors.
constexpr double kLeastDiameter = 1e-9, kLargestDiameter = 1e7;        // metres
constexpr double kLeastThickness = 1e-3, kLargestThickness = 1e3;      // over the diameter
constexpr double kLeastMass = 1e-30, kLargestMass = 1e30;              // kilograms
constexpr double kLeastGraspForce = 1e-30, kLargestGraspForce = 1e36;  // newtons

/// Limits on the constants of the header; see DeriveSettings.
static_assert(kStiffness >= 5);
static_assert(kDampingStep <= 0.6);

void CheckRange(const char* what, double value, double least, double largest, const char* unit,
                const char* look_at = "--scale and --mass") {
  if (value >= least && value <= largest) return;
  throw InputError(std::string(what) + ": expected " + FormatShort(least) + " to " +
                   FormatShort(largest) + " " + unit + ", found " + FormatShort(value) + " " +
                   unit + "; help: check " + look_at);
}

}  // namespace

void CheckDiameter(double diameter_m) {
  CheckRange("diameter of the object", diameter_m, kLeastDiameter, kLargestDiameter, "m");
}

namespace {

void CheckBody(const object::Object& object, const ReplayOptions& options,
               const object::BodyMeasures& body) {
  CheckDiameter(body.diameter_m);
  if (object.dimension() == 2) {
    CheckRange("thickness of the object", body.thickness_m / body.diameter_m, kLeastThickness,
               kLargestThickness, "diameters", "--thickness");
  } else if (options.thickness) {
    throw InputError("--thickness: cannot be used with a solid");
  }
  CheckRange("mass of the object", body.mass_kg, kLeastMass, kLargestMass, "kg");
}

/// Return the smallest radius of gyration over all axes, in the object's unit.
/// In the plane there is one axis only.
double LeastGyration(const object::Object& object) {
  const object::MassProperties& mass = object.mass_properties();
  const double least = object.dimension() == 2 ? mass.inertia(2, 2)
                                               : Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                                                     mass.inertia, Eigen::EigenvaluesOnly)
                                                     .eigenvalues()[0];
  return std::sqrt(std::max(least, 0.0) / mass.volume);
}

/// Return √(I / (F · arm)), seconds, the characteristic time of rotation about the long axis.
/// The grasp force has a moment arm about this axis once fingertips roll.
double RollingTime(const ReplaySettings& s, double gyration) {
  const double arm = std::max(s.fingertip_radius_m, gyration);
  return gyration * std::sqrt(s.mass_kg / (s.grasp_force_N * arm));
}

}  // namespace

void UseMassOf(const plan::Plan& plan, ReplayConditions& options) {
  const bool is_stated = options.mass_kg || options.density_kg_m3;
  if (!is_stated && plan.hand) options.mass_kg = plan.hand->mass_kg;
}

object::BodyMeasures BodyOf(const object::Object& object, double scale,
                            const ReplayConditions& options) {
  object::BodyMeasures body = object::MeasureBody(
      object, scale, options.density_kg_m3.value_or(object::kUsualDensity), options.thickness);
  if (options.mass_kg) body.mass_kg = *options.mass_kg;
  return body;
}

ReplaySettings DeriveSettings(const object::Object& object, double scale, double friction_angle,
                              double clearance, const ReplayOptions& options) {
  ReplaySettings s;
  const object::BodyMeasures body = BodyOf(object, scale, options);
  CheckBody(object, options, body);
  s.diameter_m = body.diameter_m;
  s.mu = std::tan(friction_angle);
  s.thickness_m = body.thickness_m;
  s.mass_kg = body.mass_kg;
  s.disturbance_ratio = options.disturbance_ratio;
  s.engine = options.engine;
  s.protocol = options.protocol;
  s.resisted_wrench = options.resisted_wrench;
  s.tolerance = options.tolerance;
  s.align = options.align;
  s.friction_factor = options.friction_factor;
  s.mass_factor = options.mass_factor;
  s.gravity_m_s2 = options.gravity && object.dimension() == 3 ? kGravity : 0;
  s.grasp_force_N = options.grasp_force_N.value_or(
      s.mass_kg * kGravity /
      (kWeightOfDisturbance * std::max(s.disturbance_ratio, kLeastDisturbanceForGraspForce)));
  if (options.grasp_force_N) {
    s.grasp_force_source =
        options.hand_grasp_force ? GraspForceSource::kHand : GraspForceSource::kGiven;
  }
  CheckRange("grasp force", s.grasp_force_N, kLeastGraspForce, kLargestGraspForce, "N",
             options.grasp_force_N ? "--grasp-force" : "--disturbance, --scale and --mass");
  s.characteristic_time_s = std::sqrt(s.mass_kg * s.diameter_m / s.grasp_force_N);
  const double steps = 2 / kDampingStep;
  const double gyration = LeastGyration(object) * scale;
  s.finger_mass_kg = kFingerMass * s.mass_kg;
  s.finger_stiffness_N_m = options.stiffness_factor * kStiffness * s.grasp_force_N / s.diameter_m;
  s.finger_damping_Ns_m = 2 * std::sqrt(s.finger_stiffness_N_m * s.finger_mass_kg);
  const double wanted = options.finger_radius
                            ? *options.finger_radius * scale
                            : std::min(kTipRadius * s.diameter_m, kTipOfGyration * gyration);
  const double fits = options.finger_radius ? clearance : clearance / 2;
  s.fingertip_radius_m = std::max(std::min(wanted, fits), kLeastTipRadius * s.diameter_m);
  s.timestep_s = options.timestep_factor *
                 std::min(std::sqrt(s.finger_mass_kg / s.finger_stiffness_N_m) / steps,
                          kRollingStep * RollingTime(s, gyration));
  s.patch_size_m = kPatchSize * s.diameter_m;
  s.patch_thickness_m = kPatchThickness * s.diameter_m;
  return s;
}

EngineUnits UnitsOf(const ReplaySettings& settings) {
  return {settings.diameter_m / kEngineDiameter, settings.mass_kg,
          settings.characteristic_time_s / kEngineTime};
}

}  // namespace regrasp::sim
