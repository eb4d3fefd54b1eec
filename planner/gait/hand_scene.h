#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/base/random.h"
#include "planner/collision/convex_shape.h"
#include "planner/collision/shape_contact.h"
#include "planner/collision/surface_tree.h"
#include "planner/gait/pose_grid.h"
#include "planner/grasp/contact.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_model.h"
#include "planner/plan/gravity_support.h"

namespace regrasp::gait {

using kinematics::JointConfiguration;

/// Permitted proximity of a fingertip to the object.
enum class TipContact {
  kFree,      ///< keeps the same margin as every other link
  kTouching,  ///< may penetrate the surface by kTipDepth, with the link behind it
};

/// Permitted penetration of a touching fingertip, metres.
/// Contacts are exact, but joint configurations certified between two samples are not.
inline constexpr double kTipDepth = 2e-4;

/// Largest depth in the object of the geometry that a fingertip sphere replaces, as a fraction of
/// the sphere's radius. The replay permits 0.5; fingertips tilt a little during execution.
inline constexpr double kCoveredDepth = 0.4;

/// Collision shapes of a finger in one joint configuration, in the palm's frame.
struct PlacedFinger {
  FingerIndex finger;
  std::vector<collision::PosedShape> shapes;  ///< shapes in the order of Finger::shapes
};

/// Clearance of sampled joint configurations in addition to the margin, metres.
/// It leaves room to certify the paths between them.
inline constexpr double kConfigurationMargin = 5e-4;

/// Collision checks between the links of a hand, its palm and an object.
/// Lengths are in metres. Object poses map the object's frame (the file's axes and origin, scaled)
/// to the palm's frame.
class HandScene {
 public:
  using Motion = std::optional<double>;

  /// @param hand, surface  hand model and object surface; outlive this object.
  /// @param margin  minimum distance between links, palm and object, metres. Sampled joint
  ///     configurations keep kConfigurationMargin more.
  HandScene(const kinematics::HandModel& hand, const collision::SurfaceTree& surface,
            double margin);

  [[nodiscard]] const kinematics::HandModel& hand() const { return hand_; }
  [[nodiscard]] const kinematics::Finger& finger(FingerIndex finger) const {
    return hand_.fingers[finger];
  }
  [[nodiscard]] int finger_count() const { return static_cast<int>(hand_.fingers.size()); }
  [[nodiscard]] double margin() const { return margin_; }

  /// Draw a joint configuration uniformly from the joint ranges, without their outermost 2 %.
  [[nodiscard]] JointConfiguration DrawConfiguration(FingerIndex finger,
                                                     RandomStream& random) const;
  [[nodiscard]] PlacedFinger Place(FingerIndex finger,
                                   const JointConfiguration& configuration) const;

  // `motion` is a bound on the approach of two shapes within a path interval, metres. If the check
  // passes, the whole interval keeps the margin.

  /// Return whether a finger is clear of the palm and of its own links.
  [[nodiscard]] bool KeepsOffHand(const PlacedFinger& placed, Motion motion = {}) const;
  /// Subset of the links of a finger.
  enum class Links { kAll, kTip, kBehindTip };
  /// Return whether the selected links of a finger are clear of the object. The collision geometry
  /// that a fingertip sphere replaces does not count.
  [[nodiscard]] bool KeepsOffObject(const PlacedFinger& placed, const Eigen::Isometry3d& pose,
                                    TipContact tip, Motion motion = {},
                                    Links links = Links::kAll) const;
  /// Return whether the geometry that a fingertip sphere replaces is at most kCoveredDepth radii
  /// inside the object at a contact.
  /// @param inward  inward unit normal of the contact, in the palm's frame.
  [[nodiscard]] bool IsShallow(const PlacedFinger& placed, const Eigen::Isometry3d& pose,
                               const Eigen::Vector3d& inward) const;
  /// Return the distance between a finger and the object, clamped to `limit`, metres.
  [[nodiscard]] double DistanceFromObject(const PlacedFinger& placed, const Eigen::Isometry3d& pose,
                                          double limit) const;
  [[nodiscard]] bool KeepApart(const PlacedFinger& a, const PlacedFinger& b,
                               Motion motion = {}) const;
  /// Return whether the object is clear of the palm.
  [[nodiscard]] bool KeepsOffPalm(const Eigen::Isometry3d& pose, Motion motion = {}) const;

  /// Bound the motion of any point of a finger between two joint configurations.
  /// Length in metres.
  [[nodiscard]] double MotionBound(FingerIndex finger, const JointConfiguration& from,
                                   const JointConfiguration& to) const;
  /// Bound the motion of any point of the object between two poses.
  /// Length in metres. The origin moves linearly, and the object rotates about one axis.
  [[nodiscard]] double MotionBound(const Eigen::Isometry3d& from,
                                   const Eigen::Isometry3d& to) const;

 private:
  using Part = kinematics::HandModel::Part;
  [[nodiscard]] double Needed(Motion motion) const {
    return margin_ + motion.value_or(kConfigurationMargin);
  }
  /// Pair of shapes that may collide.
  /// Excluded are pairs that the hand model ignores: there are many, and they overlap, which is the
  /// slowest case of GJK.
  struct ShapePair {
    int a;
    int b;
  };
  /// Return all pairs that the hand model does not ignore, without redundant shapes.
  /// @param a, b  fingers; equal for self-collision, invalid for the palm.
  [[nodiscard]] std::vector<ShapePair> CheckedPairs(FingerIndex a, FingerIndex b) const;

  const kinematics::HandModel& hand_;
  const collision::SurfaceTree& surface_;
  double margin_;
  double object_reach_;  ///< radius of the object about its origin, metres
  /// Whether a fingertip shape contains a covered shape, which then adds nothing [finger][shape].
  std::vector<std::vector<bool>> redundant_;
  std::vector<collision::PosedShape> palm_;
  std::vector<std::vector<collision::BoundingSphere>>
      balls_;  ///< bounding spheres [finger][shape], in the link's frame
  std::vector<std::vector<ShapePair>> with_palm_;  ///< pairs with the palm, by finger
  std::vector<std::vector<std::vector<ShapePair>>>
      with_fingers_;                                     ///< pairs of links, by pair of fingers
  std::vector<std::vector<std::vector<double>>> reach_;  ///< LinkReach [finger][shape]
};

/// A contact in the object's frame, metres.
struct SurfacePoint {
  Eigen::Vector3d p;
  Eigen::Vector3d n;  ///< unit normal, inward
};

/// Return the fingertip target at a contact.
/// The centre of the fingertip sphere is one radius outside the surface.
/// @param pose  object pose in the palm's frame.
[[nodiscard]] kinematics::TipTarget TargetAt(const kinematics::Finger& finger,
                                             const SurfacePoint& contact,
                                             const Eigen::Isometry3d& pose);

/// Cache of the joint configurations of single fingers at contacts and grid nodes.
/// Each finger is checked alone, without the other fingers. Entries are computed on demand.
class ReachMap {
 public:
  /// @param inverse  inverse kinematics [finger].
  /// @param points  contacts by number. All references outlive this object.
  ReachMap(const HandScene& scene, const std::vector<kinematics::InverseKinematics>& inverse,
           const std::vector<SurfacePoint>& points, const PoseGrid& grid)
      : scene_(scene), inverse_(inverse), points_(points), grid_(grid) {}

  /// Return the joint configuration of a finger at a contact and a grid node.
  /// The configuration is clear of palm, object and the finger's own links.
  /// @returns pointer valid for the lifetime of this object; null if the finger does not reach the
  ///     contact.
  [[nodiscard]] const JointConfiguration* Find(FingerIndex finger, int point, int node);

  /// Set the joint configuration of a finger at a contact and a grid node.
  void Set(FingerIndex finger, int point, int node, const JointConfiguration& configuration);

  /// Return whether a finger keeps its contact between adjacent grid nodes.
  /// The joint configuration must be continuous.
  /// @param node  grid node at which the finger reaches the contact.
  [[nodiscard]] bool CanFollow(FingerIndex finger, int point, int node, int neighbour);

  /// Estimate the last track step up to which a finger keeps a contact.
  /// Moves along the track at the offset of the grid node; not every pose is checked.
  /// @param node  grid node at which the finger reaches the contact.
  [[nodiscard]] int RunEnd(FingerIndex finger, int point, int node);

 private:
  struct Cached {
    std::optional<JointConfiguration> configuration;
    int run_end = -1;  ///< track step; −1 if not computed yet
  };
  [[nodiscard]] Cached& CachedAt(FingerIndex finger, int point, int node);
  [[nodiscard]] std::optional<JointConfiguration> Compute(FingerIndex finger, int point,
                                                          int node) const;
  [[nodiscard]] int ComputeRunEnd(FingerIndex finger, int point, int node);

  const HandScene& scene_;
  const std::vector<kinematics::InverseKinematics>& inverse_;
  const std::vector<SurfacePoint>& points_;
  const PoseGrid& grid_;
  std::unordered_map<std::size_t, Cached> cache_;
};

/// Relative width below which an object is slender.
///
/// Fingers exert torques about the axis of a slender object at half its width, but the grasp
/// quality refers torques to its size. The quality margin of an object of relative width w is
/// therefore multiplied by w / kSlender.
inline constexpr double kSlender = 0.3;

/// A hand with an object: collision scene, inverse kinematics and candidate contacts.
struct HandSetup {
  const HandScene& scene;
  const std::vector<kinematics::InverseKinematics>& inverse;  ///< [finger]
  const std::vector<SurfacePoint>& points;
  double scale = 1;  ///< metres per unit of the object's file
  /// Surface on which fingertips roll. If set, grasps must be valid at the rolled contacts; null:
  /// contacts stay at the planned points.
  const collision::BallContact* rolled_on = nullptr;
  /// Required force margin under the object's weight at rolled contacts (RollingTips).
  double force_margin = 0;
  /// Decides whether grasps hold the object by its weight; null: they must be force closure.
  const plan::WeightCarrier* carrier = nullptr;
  bool may_slide = true;  ///< whether holding fingers may slide
  int fewest_beside_sliding =
      0;  ///< minimum number of stationary holding fingers during a sliding step
  double relative_width = 1;  ///< width of the object (object::MeasureWidth) divided by diameter
};

/// Candidate joint configurations of an idle finger [finger][candidate], best first.
using IdleConfigurations = std::vector<std::vector<JointConfiguration>>;

}  // namespace regrasp::gait
