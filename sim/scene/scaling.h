#pragma once

#include "planner/object/body_measures.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "sim/scene/engine.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// Return the grasp force with which a hand would hold an object, newtons.
/// This is kGripSafety times the force that the object's weight requires in the worst grasp of the
/// plan, at most kStrongestGrip_N.
///
/// Let s be the largest weight over the grasp force that forces inside the cones balance, smallest
/// over the static grasps and the waypoints of sliding steps. A weight W then requires W / s. A
/// planar object is supported by the plane. To lift it out requires W / μ from fingers that stand
/// upright around it. This value is used for planar objects, and if no grasp carries any weight.
/// @param located     plan with contacts placed on the object.
/// @param entries     number of entries that count, the initial grasp first.
/// @param friction_angle  friction angle in radians.
[[nodiscard]] double HandGraspForce(const object::Object& object, const plan::Plan& projected,
                                    int entries, double friction_angle, double mass_kg);

/// Ratio of the grip force of humans to the force that just holds an object, which is 1.4 to 2
/// (Johansson and Westling 1984).
inline constexpr double kGripSafety = 2;
/// Largest grasp force: strong hands apply about 100 N from each side in a palmar pinch (Mathiowetz
/// et al. 1985).
inline constexpr double kStrongestGrip_N = 200;

/// Use the mass of a plan for a hand, unless the options state mass or density.
void UseMassOf(const plan::Plan& plan, ReplayConditions& options);

/// Check that an object is neither smaller than a molecule nor larger than a planet, which
/// indicates a wrong unit of length.
/// @throws InputError  otherwise.
void CheckDiameter(double diameter_m);

/// Return the size and mass of the object for the options.
[[nodiscard]] object::BodyMeasures BodyOf(const object::Object& object, double scale,
                                          const ReplayConditions& options);

/// Derive mass, grasp force, finger and time step from the object.
/// Every replay is then the same experiment up to units. Two objects of one shape pass through the
/// same positions relative to their size, after the same number of steps, whatever their size and
/// mass.
///
/// With D the diameter, M the mass, W = M g and F the grasp force (total normal force of a static
/// grasp):
/// - F = W / (kWeightOfDisturbance · shake): the weight is a tenth of the disturbance. A grasp of
/// quality
///   slightly above `disturbance_ratio` thus resists both together. A smaller grasp force, by
///   option, requires more friction of every grasp. The same F is used for a planar object,
///   although the plane supports it.
/// - finger stiffness k = kStiffness · F / D. Below 5 F / D a grasp buckles under its own grasp
///   force.
/// - finger mass m = kFingerMass · M. Heavier fingers eject a light object from good grasps in the
///   disturbance test. The test lost 8 of 56 good random grasps at 50 M, 2 of 536 at M / 2 and none
///   at M / 5.
/// - time step dt so that damping · dt / m = 2 √(k / m) dt is kDampingStep: above 0.6 the explicit
///   damping of the finger's motion is unstable. Times are thus proportional to √(M D / F): a
///   larger grasp force means faster motion. Needles rotate about their long axis faster than that.
///   Therefore dt is at most kRollingStep of the time √(I / (F r)), I the smallest moment of
///   inertia and r the fingertip's radius. In this time they rotate under a grasp force with a
///   moment arm of r, which it has once a fingertip has rolled.
/// - fingertip radius = kTipRadius · D, or kTipOfGyration times the smallest radius of gyration, or
///   half of `clearance`, whichever is least. With a radius in the options: that radius, or
///   `clearance` if that is less. The thicker the fingertips, the more they rotate a needle by
///   rolling.
///
/// A planar object is the prism of its polygon, object::kPrismThickness · D thick unless the
/// options set its thickness; M = density · area · thickness. The thickness matters through M only.
///
/// @param friction_angle  friction angle θ, radians.
/// @param scale       metres per unit of the object.
/// @param options     options; a `hand_grasp_force` is in `grasp_force_N` already.
/// @param clearance   radius in metres of the largest sphere that touches the object only at a
///     contact, smallest over the plan's contacts (planner/criteria/reach.h).
/// @throws InputError  if size, thickness, mass or grasp force is outside the range of the
///     simulation, or a solid has a thickness.
[[nodiscard]] ReplaySettings DeriveSettings(const object::Object& object, double scale,
                                            double friction_angle, double clearance,
                                            const ReplayOptions& options);

/// Return units in which every object looks alike to the engine.
/// It has the diameter kEngineDiameter, mass 1 and the characteristic time kEngineTime. The engine
/// treats volumes and inertias below 1e-15 as zero: pieces of surface of a millionth of D on each
/// side have 1e-14. With a diameter of 100, capsules miss contacts at corners. The engine solves
/// for accelerations until they change by less than 1e-10. F / M is 1e4, the value of an object of
/// 10 cm and 0.1 kg at 1000 weights.
[[nodiscard]] EngineUnits UnitsOf(const ReplaySettings& settings);

inline constexpr double kEngineDiameter = 1;
inline constexpr double kEngineTime = 0.01;
inline constexpr double kGravity = 9.81;             ///< m/s²
inline constexpr double kWeightOfDisturbance = 0.1;  ///< weight over disturbance force
/// Smallest disturbance size for the grasp force, because a size of 0 requires one too.
inline constexpr double kLeastDisturbanceForGraspForce = 1e-3;
inline constexpr double kStiffness = 20;     ///< k D / F
inline constexpr double kFingerMass = 0.2;   ///< m / M
inline constexpr double kDampingStep = 0.4;  ///< damping · step / mass
inline constexpr double kTipRadius = 0.04;   ///< over D
inline constexpr double kTipOfGyration = 4;  ///< over the smallest radius of gyration
inline constexpr double kRollingStep = 0.3;  ///< step over √(I / (F r))
/// Least radius of fingertips over D. Closer to a concave corner fingers are not thinner, because a
/// contact would be deeper than the finger is thick. A finger touches only its own face anyway.
inline constexpr double kLeastTipRadius = 1e-4;
/// Least clearance over D at which a finger can be in contact. Within kPointTolerance, a contact
/// cannot be distinguished from one in the corner itself, at which no sphere fits.
inline constexpr double kLeastClearance = object::kPointTolerance;
inline constexpr double kPatchSize = 0.02;       ///< over D: 20 times the slip limit
inline constexpr double kPatchThickness = 0.01;  ///< over D

}  // namespace regrasp::sim
