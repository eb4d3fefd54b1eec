#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "planner/plan/plan.h"
#include "sim/hand/gap.h"
#include "sim/hand/hand_body.h"
#include "sim/hand/hand_finding.h"

namespace regrasp::sim {

/// Limit of the distance by which a fingertip slips in an in-hand motion with rolling, metres.
inline constexpr double kMostRollingSlip = 1e-4;

/// Check of an in-hand motion with rolling fingertips (plan::Move::contacts), state by state.
///
/// - A rolled contact is the nearest point of the surface to the centre of the fingertip's sphere,
///   and its normal is the direction from there to the centre, to 10 µm. This test does not depend
///   on faces and edges.
/// - Fingertips do not slip. The slip is the integral of the velocity of the fingertip's material
///   point at the contact, relative to the object. For a sphere of radius r that rotates relative
///   to the object by Δθ and whose centre moves by Δc, it is Δc − Δθ × (r n), without its component
///   along the outward normal n (Montana 1988). Rotation about the normal does not count.
///   Kinematics are those of the engine, not of the planner.
class RollingCheck {
 public:
  /// @param surface  triangles of the object in its own frame, metres.
  /// @param scale  metres per unit of the object's file.
  /// @param move  motion whose contacts are those of the same fingers in each state, and which the
  ///     hand's joints fit. All references outlive this object.
  RollingCheck(HandBody& body, std::span<const ConvexBody> surface, double scale,
               const plan::Move& move)
      : body_(body), surface_(surface), scale_(scale), move_(move) {}

  /// Check a state, and the motion from the previous one. States are checked in order.
  /// @param in_state, after_state  the instants in messages: "in state 3 of path" and "after state
  ///     2 of path".
  /// @returns nullopt if nothing is wrong. The slip is that since the start of the motion, at most
  ///     kMostRollingSlip.
  [[nodiscard]] std::optional<HandFinding> Check(std::size_t state, const std::string& in_state,
                                                 const std::string& after_state);

 private:
  [[nodiscard]] std::optional<HandFinding> FindContactBeside(std::size_t state,
                                                             const std::string& when);
  [[nodiscard]] std::optional<HandFinding> FindSlip(std::size_t state, const std::string& when);

  HandBody& body_;
  std::span<const ConvexBody> surface_;
  double scale_;
  const plan::Move& move_;
  std::map<FingerIndex, Eigen::Vector3d> slip_O_;  ///< slip since the start of the motion, metres
};

}  // namespace regrasp::sim
