#pragma once

#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Friction cones replaced by pyramids and solved by GLPK.
/// This is an independent method for the results of the library with true cones. For a soft finger
/// the ball of tangential forces and torques is replaced by a polyhedron, with as many meridians as
/// sides and half as many bands.
struct Pyramid {
  int sides;
  bool circumscribed;  ///< true: contains the cone; false: inscribed
};

/// Return the largest m for which forces with Σ n·f = 1 balance `load`.
/// Every f_i − (m/k) n_i must lie in its pyramid. m may be negative; nullopt if no forces balance.
[[nodiscard]] std::optional<double> PyramidMargin(std::span<const Contact> contacts,
                                                  const object::WrenchFrame& frame,
                                                  double friction_angle, const Pyramid& pyramid,
                                                  const Wrench& load);

}  // namespace regrasp::grasp
