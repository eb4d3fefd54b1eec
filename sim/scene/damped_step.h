#pragma once

#include <functional>

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// Advance a simulation by one time step h. Constraint forces account for implicit damping.
///
/// MuJoCo integrates the damping D of joints and servos implicitly, with the inertia M + h D, but
/// it computes constraint forces with M. On light links with h D ≫ M, friction then stops only the
/// share M / (M + h D) of a sliding velocity, and fingertips that roll slip by a distance
/// proportional to h. Here constraint forces and velocities both follow from M + h D:
///
///     (M + h D) (v' − v) / h = f(q, v) + Jᵀλ,    q' = q + h v'
///
/// f includes the damping forces at v. D has the damping of joints and the velocity gains of
/// actuators with affine bias. A model whose actuators have states keeps MuJoCo's step.
///
/// Law: without damping, the result is that of mj_step with the Euler integrator.
/// @param add_contacts  adds contacts after collision detection; may be empty.
void DampedStep(const mjModel_& model, mjData_& data, const std::function<void()>& add_contacts);

}  // namespace regrasp::sim
