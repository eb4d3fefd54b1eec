#pragma once

#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Friction cones replaced by pyramids, solved by GLPK: a second route to what the library computes
/// with true cones. Of a soft finger the pyramid is over a polyhedron of as many meridians and half
/// as many bands instead of the ball of tangential forces and torques.
struct Pyramid {
  int sides;
  bool circumscribed;  ///< contains the cone; otherwise inside it
};

/// The largest m such that forces with Σ n·f = 1 balance `load` and every f_i − (m/k) n_i lies in
/// its pyramid; m may be negative. nullopt where nothing balances.
[[nodiscard]] std::optional<double> PyramidMargin(std::span<const Contact> contacts,
                                                  const object::WrenchFrame& frame,
                                                  double half_angle, const Pyramid& pyramid,
                                                  const Wrench& load);

}  // namespace regrasp::grasp
