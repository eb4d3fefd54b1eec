#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// Role of a finger at one instant.
enum class FingerRole { kFree, kHolding, kPlaced, kReleased, kMoved };

/// State of one finger at one instant, in metres and newtons, world frame.
struct FingerState {
  FingerIndex finger = {};
  FingerRole role = FingerRole::kFree;
  Eigen::Vector3d tip_W = Eigen::Vector3d::Zero();      ///< centre of the fingertip
  Eigen::Vector3d contact_W = Eigen::Vector3d::Zero();  ///< contact point; planned if free
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();   ///< inward normal at the contact
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();    ///< force on the object; zero while free
  /// Path of a finger that moved, from its first point to contact_W; empty for others.
  std::vector<Eigen::Vector3d> path_W = {};
};

/// State of object and hand at one instant, measured in the replay or shown in a frame.
///
/// World frame W: at the start the object's own frame O, scaled to metres, coincides with W.
struct Snapshot {
  double time_s = 0;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  double fingertip_radius_m = 0;
  std::vector<FingerState> fingers;
  /// For a plan with a hand: pose of the palm, and of the links in their own order
  /// (kinematics/hand_visuals.h); otherwise empty.
  std::optional<Eigen::Isometry3d> X_WP = std::nullopt;
  std::vector<Eigen::Isometry3d> links_W = {};
  /// For an in-hand motion: the object pose before it.
  std::optional<Eigen::Isometry3d> X_WO_before = std::nullopt;
};

/// Make the snapshot of an entry that was not replayed.
/// The object does not move, and the fingers are at the plan's contacts, without forces. For a
/// sliding step it shows the instant of the fault, otherwise its end.
///
/// Contacts may be anywhere, and fingers outside the hand. At most kMostDrawnFingers are included,
/// those at fault first, because a malicious file may have any number.
/// @param located             plan on the object as far as it fits (PlanCheck::projected).
/// @param entry               0 the initial grasp, k the k-th step.
/// @param fingertip_radius_m  radius in metres.
[[nodiscard]] Snapshot MakePlannedSnapshot(const Plan& projected, int entry, const Fault& fault,
                                           double fingertip_radius_m);

inline constexpr int kMostDrawnFingers = 16;

}  // namespace regrasp::plan
