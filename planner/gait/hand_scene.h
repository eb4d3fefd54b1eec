#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/base/random.h"
#include "planner/collision/ball_contact.h"
#include "planner/collision/convex_shape.h"
#include "planner/collision/surface_tree.h"
#include "planner/gait/pose_grid.h"
#include "planner/grasp/contact.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_model.h"
#include "planner/kinematics/inverse_kinematics.h"

namespace regrasp::gait {

using kinematics::Posture;

/// How near a fingertip may be to the object.
enum class TipContact {
  kFree,      ///< as far off as any other link
  kTouching,  ///< it touches: its ball and the link behind it may be in the surface by kTipDepth
};

/// What a touching fingertip is allowed to overlap with the object, metres: a contact is exact, and
/// what is certified between samples is not.
inline constexpr double kTipDepth = 2e-4;

/// The shapes of a finger in some posture, in the palm's frame.
struct PlacedFinger {
  FingerIndex finger;
  std::vector<collision::ConvexShape> shapes;  ///< as Finger::shapes
  std::vector<collision::Ball> balls;          ///< around them
};

/// What postures keep beside the margin, metres.
inline constexpr double kPostureMargin = 5e-4;

/// A hand and an object that run into each other or do not. Lengths in metres; poses of the object
/// are from its own frame (the file's axes and origin, scaled) to the palm's.
class HandScene {
 public:
  using Motion = std::optional<double>;

  /// @param hand, surface  outlive this object.
  /// @param margin  that links keep from each other, from the palm and from the object. Postures
  ///                keep kSpare more, so that paths between them can be certified.
  HandScene(const kinematics::HandModel& hand, const collision::SurfaceTree& surface,
            double margin);

  [[nodiscard]] const kinematics::HandModel& hand() const { return hand_; }
  [[nodiscard]] const kinematics::Finger& finger(FingerIndex finger) const {
    return hand_.fingers[finger];
  }
  [[nodiscard]] int finger_count() const { return static_cast<int>(hand_.fingers.size()); }
  [[nodiscard]] double margin() const { return margin_; }

  /// Each drive anywhere in its range, but for the last bit at both ends.
  [[nodiscard]] Posture DrawPosture(FingerIndex finger, RandomStream& random) const;
  [[nodiscard]] PlacedFinger Place(FingerIndex finger, const Posture& posture) const;

  // Of a posture on a path, `motion` says how far the shapes may come nearer than they are in it,
  // metres: where the answer is yes, everything within that keeps the margin.

  /// Whether a finger keeps off the palm and off itself.
  [[nodiscard]] bool KeepsOffHand(const PlacedFinger& placed, Motion motion = {}) const;
  /// Of a finger.
  enum class Links { kAll, kTip, kBehindTip };
  /// Whether it keeps off the object.
  [[nodiscard]] bool KeepsOffObject(const PlacedFinger& placed, const Eigen::Isometry3d& pose,
                                    TipContact tip, Motion motion = {},
                                    Links links = Links::kAll) const;
  /// How far a finger is from the object, no more than `limit`.
  [[nodiscard]] double DistanceFromObject(const PlacedFinger& placed, const Eigen::Isometry3d& pose,
                                          double limit) const;
  [[nodiscard]] bool KeepApart(const PlacedFinger& a, const PlacedFinger& b,
                               Motion motion = {}) const;
  /// Whether the object keeps off the palm.
  [[nodiscard]] bool KeepsOffPalm(const Eigen::Isometry3d& pose, Motion motion = {}) const;

  /// A bound on how far any point of the finger's links moves between two postures, metres.
  [[nodiscard]] double MotionBound(FingerIndex finger, const Posture& from,
                                   const Posture& to) const;
  /// The same of the object between two poses, the shorter screwless way: its origin straight, its
  /// orientation about one axis.
  [[nodiscard]] double MotionBound(const Eigen::Isometry3d& from,
                                   const Eigen::Isometry3d& to) const;

 private:
  using Part = kinematics::HandModel::Part;
  [[nodiscard]] double Needed(Motion motion) const {
    return margin_ + motion.value_or(kPostureMargin);
  }
  /// Of shapes that may run into each other; those that never can are not looked at: they are
  /// many, and touch, for which GJK takes longest.
  struct ShapePair {
    int a;
    int b;
  };
  /// All pairs that the hand does not ignore. @param a, b  fingers, the same for one with itself;
  /// not valid: the palm.
  [[nodiscard]] std::vector<ShapePair> CheckedPairs(FingerIndex a, FingerIndex b) const;

  const kinematics::HandModel& hand_;
  const collision::SurfaceTree& surface_;
  double margin_;
  double object_reach_;  ///< of its points from its origin
  std::vector<collision::Ball> palm_balls_;
  std::vector<std::vector<collision::Ball>> balls_;  ///< by finger and shape, in the link's frame
  std::vector<std::vector<ShapePair>> with_palm_;    ///< by finger
  std::vector<std::vector<std::vector<ShapePair>>> with_fingers_;  ///< by both fingers
  std::vector<std::vector<std::vector<double>>> reach_;  ///< LinkReach by finger and shape
};

/// A contact of the object in its own frame, metres.
struct SurfacePoint {
  Eigen::Vector3d p;
  Eigen::Vector3d n;  ///< inward, of length 1
};

/// What a finger is asked for at a contact: the centre of its ball is one radius outside.
/// @param pose  of the object in the palm's frame.
[[nodiscard]] kinematics::TipTarget TargetAt(const kinematics::Finger& finger,
                                             const SurfacePoint& contact,
                                             const Eigen::Isometry3d& pose);

/// Which fingers can be at which contacts, and how they stand there, for the poses of a grid: the
/// finger alone, whatever the others do. Worked out when first asked for.
class ReachMap {
 public:
  /// @param scene, inverse, points, grid  outlive this object; `inverse` has one for each finger.
  ReachMap(const HandScene& scene, const std::vector<kinematics::InverseKinematics>& inverse,
           const std::vector<SurfacePoint>& points, const PoseGrid& grid)
      : scene_(scene), inverse_(inverse), points_(points), grid_(grid) {}

  /// How the finger stands at a contact at a node of the grid, keeping off the palm, itself and
  /// the object; null where it does not reach it. Stays where it is.
  [[nodiscard]] const Posture* Find(FingerIndex finger, int point, int node);

  /// Whether the finger can keep the contact from a node to a neighbour, without a jump in its
  /// posture. @param node  where it reaches the contact.
  [[nodiscard]] bool CanFollow(FingerIndex finger, int point, int node, int neighbour);

  /// The last step to which the finger can keep the contact from a node on, with the node's offset:
  /// an estimate, as not every pose on the way is looked at.
  /// @param node  where it reaches the contact.
  [[nodiscard]] int RunEnd(FingerIndex finger, int point, int node);

 private:
  struct Known {
    std::optional<Posture> posture;
    int run_end = -1;  ///< a step; -1: not asked for yet
  };
  [[nodiscard]] Known& KnownAt(FingerIndex finger, int point, int node);
  [[nodiscard]] std::optional<Posture> WorkOut(FingerIndex finger, int point, int node) const;
  [[nodiscard]] int WorkOutRunEnd(FingerIndex finger, int point, int node);

  const HandScene& scene_;
  const std::vector<kinematics::InverseKinematics>& inverse_;
  const std::vector<SurfacePoint>& points_;
  const PoseGrid& grid_;
  std::unordered_map<std::size_t, Known> known_;
};

/// A hand ready to work with an object: its inverse kinematics, and points of the surface.
struct HandSetup {
  const HandScene& scene;
  const std::vector<kinematics::InverseKinematics>& inverse;  ///< by finger
  const std::vector<SurfacePoint>& points;
  double scale = 1;  ///< metres per unit of the object's file
  /// For gaits with reserve: grasps hold where their contacts have rolled to on this surface. Null:
  /// contacts count as they are planned.
  const collision::BallContact* rolled_on = nullptr;
  /// Where contacts roll: what forces that hold the object's weight have to spare (RollingTips).
  double force_margin = 0;
  bool may_slide = true;          ///< fingers that hold
  int fewest_beside_sliding = 0;  ///< that hold and stay, while others slide
};

/// By finger: postures in which it may wait while it holds nothing, the best first.
using IdlePostures = std::vector<std::vector<Posture>>;

}  // namespace regrasp::gait
