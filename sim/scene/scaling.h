#pragma once

#include "planner/object/body_measures.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "sim/scene/engine.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// The total normal force with which a hand would hold an object, newtons: kGripSafety times what
/// its weight needs in the grasp of the plan that carries it worst, at most kStrongestGrip_N.
///
/// With s the largest weight over the squeeze that forces inside the cones balance, smallest over
/// the grasps at rest and the waypoints of aligns, a weight W needs W / s. The plane carries a
/// planar object; to lift it out takes W / μ of fingers that stand upright around it, which is what
/// counts there, and where no grasp carries any weight.
/// @param located     contacts placed on the object.
/// @param entries     how many entries count, the hold first.
/// @param half_angle  friction, radians.
[[nodiscard]] double HandSqueeze(const object::Object& object, const plan::Plan& located,
                                 int entries, double half_angle, double mass_kg);

/// People grip an object 1.4 to 2 times as hard as what just holds it (Johansson and Westling
/// 1984).
inline constexpr double kGripSafety = 2;
/// Pinching with the palm, strong hands press some 100 N from each side (Mathiowetz et al. 1985).
inline constexpr double kStrongestGrip_N = 200;

/// Size and mass as the options have them.
[[nodiscard]] object::BodyMeasures BodyOf(const object::Object& object, double scale,
                                          const ReplayConditions& options);

/// Derives mass, squeeze, finger and time step from the body, so that every replay is the same
/// experiment up to units: two bodies of one shape move through the same positions relative to
/// their size, after the same number of steps, whatever their size and mass.
///
/// With D the diameter, M the mass, W = M g and F the squeeze (total normal force of a grasp
/// at rest):
/// - F = W / (kWeightOfShake · shake): the weight is a tenth of the shake, so that a grasp of
///   quality a little above `shake` resists both together. Less squeeze, by option, asks more
///   friction of every grasp. The same F serves a planar object, although the plane carries it.
/// - finger stiffness k = kStiffness · F / D. Below 5 F / D a grasp buckles under its own squeeze.
/// - finger mass m = kFingerMass · M. Heavier fingers shake a light body out of good grasps: of 56
///   good random grasps 8 were lost at 50 M, of 536 two at M / 2 and none at M / 5.
/// - time step dt so that damping · dt / m = 2 √(k / m) dt is kDampingStep: above 0.6 the explicit
///   damping of the finger's motion turns unstable. Time thus goes with √(M D / F): who squeezes
///   harder moves faster.
///   Needles turn about their long axis faster than that: dt is at most kRollingStep of the time
///   √(I / (F r)), I the smallest moment of inertia and r the fingertip's radius, in which they
///   turn under a squeeze that is off the axis by r, as it is once a fingertip has rolled.
/// - fingertip radius = kTipRadius · D, or kTipOfGyration times the smallest radius of gyration, or
///   half of `clearance` where that is less; the radius that the options ask for, or `clearance`
///   where that is less. Thicker tips on a needle turn it the more the more they roll.
///
/// A planar object is the prism of its polygon, object::kPrismThickness · D thick unless the
/// options say otherwise; M = density · area · thickness. The thickness matters through M only.
///
/// @param half_angle  θ, radians.
/// @param scale       metres per unit of the object.
/// @param options     a `hand_squeeze` is in `squeeze_N` already.
/// @param clearance   metres: the largest ball that touches the object only at a contact, smallest
///                    over the plan's contacts (planner/criteria/reach.h).
/// @throws InputError  size, thickness, mass or squeeze out of the range that can be simulated; a
///                     thickness for a solid.
[[nodiscard]] ReplaySettings DeriveSettings(const object::Object& object, double scale,
                                            double half_angle, double clearance,
                                            const ReplayOptions& options);

/// Units in which every body has the diameter kEngineDiameter, the mass 1 and the natural time
/// kEngineTime. The engine takes volumes and inertias below 1e-15 for zero: pieces of surface of a
/// millionth of D on each side have 1e-14. With a diameter of 100 capsules miss touches at corners.
/// It solves for accelerations until they change by less than 1e-10: F / M is 1e4, as it is of a
/// body of 10 cm and 0.1 kg at 1000 weights.
[[nodiscard]] EngineUnits UnitsOf(const ReplaySettings& settings);

inline constexpr double kEngineDiameter = 1;
inline constexpr double kEngineTime = 0.01;
inline constexpr double kGravity = 9.81;               ///< m/s²
inline constexpr double kWeightOfShake = 0.1;          ///< weight over shake force
inline constexpr double kLeastShakeForSqueeze = 1e-3;  ///< a shake of 0 still needs a squeeze
inline constexpr double kStiffness = 20;               ///< k D / F
inline constexpr double kFingerMass = 0.2;             ///< m / M
inline constexpr double kDampingStep = 0.4;            ///< damping · step / mass
inline constexpr double kTipRadius = 0.04;             ///< over D
inline constexpr double kTipOfGyration = 4;            ///< over the smallest radius of gyration
inline constexpr double kRollingStep = 0.3;            ///< step over √(I / (F r))
/// Over D. Nearer to a concave corner the finger is as thin as this and no thinner, or a contact
/// would be deeper than the finger is thick; it touches its own face only, all the same.
inline constexpr double kLeastTipRadius = 1e-4;
/// Over D: where no larger ball fits, a finger cannot stand. What is read to within kPointTolerance
/// cannot be told from a contact in the corner itself, where no ball fits.
inline constexpr double kLeastClearance = object::kPointTolerance;
inline constexpr double kPatchSize = 0.02;       ///< over D: 20 times the allowed slip
inline constexpr double kPatchThickness = 0.01;  ///< over D

}  // namespace regrasp::sim
