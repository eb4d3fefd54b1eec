#pragma once

#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan.h"
#include "sim/scene/align_script.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Roll all holding fingers along the surface at once, from one grasp to another.
/// Their contacts move and none slips, so no force has to overcome friction. The fingers apply
/// balanced forces inside cones of kSlideFriction μ, or of the whole μ if there are none.
///
/// A fingertip is a sphere that does not rotate. It is moved together with its stationary contact,
/// which is equivalent to rolling for the object: the engine's contacts depend on velocities along
/// the surface, not on positions on it.
/// @param to_B  grasp with the same fingers in the same order. Each moves straight inside one face,
///     or turns at a point of the border of two faces.
void RollFingers(ReplayWorld& world, const plan::FingerGrasp& from_B,
                 const plan::FingerGrasp& to_B);

/// Execute a sliding step according to its script, and return the method.
///
/// Imitated: with free fingers, every finger is handed over by finger switches. A free finger, the
/// support finger, makes contact on the finger's path. The finger lifts and reaches its target, and
/// the support finger leaves. Every finger thus ends at its planned contact.
///
/// Slid: one finger after the other moves along the surface. Its force is on the edge of its cone
/// in the direction of motion, as friction requires, and the others balance it inside cones of
/// kSlideFriction μ. If no such forces exist, the finger slides with the best approximation, and
/// the monitor decides. A failed sliding step ends there. A finger whose normal turns at a border
/// slides too.
///
/// Mixed: part of it imitated, part slid.
AlignMode PerformAlign(ReplayWorld& world, const AlignScript& script_B);

/// Record which fingers moved, and along which path, for the frame of a sliding step.
void TellMoved(ReplayWorld& world, const std::vector<plan::FingerGrasp>& waypoints_B);

/// Least force of a sliding finger over the grasp force.
inline constexpr double kSlideForce = 0.01;
inline constexpr double kSlideSpeed = 1.5e-3;  ///< D per characteristic time

/// Slide a holding finger along the surface while the others balance it.
/// The finger moves straight inside one face, or rolls about a point of the border between two
/// faces.
///
/// Its force is on the edge of its cone in the direction of motion, as friction requires. Its size
/// is the smallest that leaves the others a good margin inside cones of kSlideFriction μ. If none
/// leaves any margin, it is the one with the best margin.
void SlideFinger(ReplayWorld& world, FingerIndex finger, const grasp::Contact& from_B,
                 const grasp::Contact& to_B);

/// Return the force margin of the other fingers while a finger slides.
/// It is the smaller one (GraspForces::margin) of those at both ends; not positive if they cannot
/// balance the finger.
[[nodiscard]] double SlideMargin(const ReplayWorld& world, FingerIndex finger,
                                 const grasp::Contact& from_B, const grasp::Contact& to_B);

/// Force on the object per finger of the world, newtons in S; zero for fingers without a force.
using HandForces = std::vector<Eigen::Vector3d>;

/// Plan forces with which `fingers` balance the object's weight and `load_S` together.
/// They apply at the measured contacts, with the full grasp force and the largest margin inside
/// their cones. If there are none, the result is the best approximation of ComputeGraspForces.
/// @param load_S  load about the centroid, in addition to the weight.
[[nodiscard]] HandForces PlanHandForces(const ReplayWorld& world,
                                        const std::vector<FingerIndex>& fingers,
                                        const grasp::Wrench& load_S, double friction_angle);

/// Return the current forces of the fingers.
[[nodiscard]] HandForces CurrentForces(const ReplayWorld& world);

/// Set forces between two sets of forces.
/// Linear interpolation, because combinations of balanced forces are balanced.
void MixForces(ReplayWorld& world, const HandForces& from, const HandForces& to, double share);

/// Place the fingers at their contacts and take hold of the object.
/// Grasp force and weight grow together.
void TakeHold(ReplayWorld& world, const plan::FingerGrasp& grasp_B);

/// Move free fingers along the normals to their contacts, all at once.
/// They move quickly to kApproachGap, then increasingly slowly until each measures a force of
/// kTouchForce. It is anchored there.
void PlaceFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B);

/// Change the forces linearly into those with which `fingers` hold the object.
void TransferForces(ReplayWorld& world, const std::vector<FingerIndex>& fingers);

/// Change the forces linearly into the given ones in kTransferTime.
void BlendForces(ReplayWorld& world, const HandForces& to);

/// Move fingers without force away along the normals.
void RetractFingers(ReplayWorld& world, const std::vector<FingerIndex>& fingers);

/// Place fingers, transfer the forces to the grasp without the released fingers, and retract those.
void SwitchFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B,
                   const std::vector<FingerIndex>& released);

/// Lengths are over D, forces over the grasp force, durations in characteristic times
/// (ReplaySettings).
inline constexpr double kStandOff = 0.05;  ///< distance of a free finger before and after contact
/// Initial depth, so that all fingers of the initial grasp make contact at once.
inline constexpr double kFirstDepth = 1e-9;
inline constexpr double kApproachGap = 2e-3;  ///< 0.2 mm for an object of 10 cm
inline constexpr double kCreepGap = 2e-5;
/// Contact at this speed causes an impact below 1e-4 F.
inline constexpr double kCreepSpeed = 5e-5;
inline constexpr double kTouchForce = 2e-4;  ///< 0.01 N at a grasp force of 50 N
inline constexpr double kHoldTime = 2;
inline constexpr double kApproachTime = 1.2;
inline constexpr double kCloseTime = 1.2;
/// The creep then exceeds the tolerance of the object's motion.
inline constexpr double kMostCreepTime = 24;
inline constexpr double kTransferTime = 1.6;
inline constexpr double kRetractTime = 1.2;

}  // namespace regrasp::sim
