#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// What a finger is doing at one instant.
enum class FingerRole { kFree, kHolding, kPlaced, kReleased, kMoved };

/// One finger at one instant, in metres and newtons, world frame.
struct FingerState {
  FingerIndex finger = {};
  FingerRole role = FingerRole::kFree;
  Eigen::Vector3d tip_W = Eigen::Vector3d::Zero();      ///< centre of the fingertip
  Eigen::Vector3d contact_W = Eigen::Vector3d::Zero();  ///< point of contact (planned, if free)
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();   ///< inward normal at the contact
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();    ///< on the object; zero while free
  /// Points along which a finger that moved came, from the first to contact_W; empty for others.
  std::vector<Eigen::Vector3d> path_W = {};
};

/// The object and the hand at one instant: what the replay measured and a frame shows.
///
/// World frame W: at the start the object's own frame O, scaled to metres, coincides with W.
struct Snapshot {
  double time_s = 0;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  double fingertip_radius_m = 0;
  std::vector<FingerState> fingers;
  /// Of a plan for a hand: where its palm is, and its links by their own order
  /// (kinematics/hand_visuals.h); none otherwise.
  std::optional<Eigen::Isometry3d> X_WP = std::nullopt;
  std::vector<Eigen::Isometry3d> links_W = {};
  /// Of a move of the object in the hand: where it was before.
  std::optional<Eigen::Isometry3d> X_WO_before = std::nullopt;
};

/// What a frame can show of an entry that was not replayed: the object at rest, and the fingers
/// where the plan has them, contacts as they are given, without forces. Of an align it is the
/// instant of the fault, or else its end.
///
/// Contacts may be anywhere, and fingers outside the hand; of a hostile file no more than
/// kMostDrawnFingers are told, those at fault first.
/// @param located             on the object as far as it fits (PlanCheck::located).
/// @param entry               0 the hold, k the k-th step.
/// @param fingertip_radius_m  metres.
[[nodiscard]] Snapshot MakePlannedSnapshot(const Plan& located, int entry, const Fault& fault,
                                           double fingertip_radius_m);

inline constexpr int kMostDrawnFingers = 16;

}  // namespace regrasp::plan
