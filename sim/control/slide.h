#pragma once

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

/// Return the margin with which the others can balance the finger during its slide.
/// It is the smaller margin of their forces (GraspForces::margin) at both ends; not positive if
/// they cannot balance it.
[[nodiscard]] double SlideMargin(const ReplayWorld& world, FingerIndex finger,
                                 const grasp::Contact& from_B, const grasp::Contact& to_B);

}  // namespace regrasp::sim
