#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// Format a normal for messages: "(0, 0.6, -0.8)"; two numbers for a planar object.
[[nodiscard]] std::string VectorText(const Eigen::Vector3d& v, int dimension);

/// Contact of a file, placed on the object.
struct ProjectedContact {
  /// Point projected onto its face, the face's normal, and the face. As given and with face −1 if
  /// there is no face.
  grasp::Contact contact;
  Reason reason = Reason::kNone;  ///< kOffSurface or kWrongNormal if there is no face
  std::string detail;             ///< deviation of a wrong normal, for messages
};

/// Find the face of a contact.
/// Among the faces within SurfaceTolerance of the point, it is the one whose inward normal is
/// nearest to the contact's. That normal must be within kNormalTolerance of the contact's, whose
/// length must be 1 within kNormalLengthTolerance. If faces meet at the point, the normal thus
/// selects the face.
[[nodiscard]] ProjectedContact ProjectContact(const object::Object& object,
                                              const grasp::Contact& contact);

/// Return the point on the surface nearest to a contact's point, with the normal there.
/// If faces are equally near, it is on the one whose normal is nearest to the contact's.
[[nodiscard]] grasp::Contact NearestContact(const object::Object& object,
                                            const grasp::Contact& contact);

/// Return all placements of a contact within the tolerances.
/// They are ordered by the distance of the normals, ties by distance and index; the first is that
/// of ProjectContact. Empty if ProjectContact finds no face.
[[nodiscard]] std::vector<grasp::Contact> ProjectOnAllFaces(const object::Object& object,
                                                            const grasp::Contact& contact);

/// Place every contact of a plan on the object without checks (see PlanCheck::projected).
[[nodiscard]] Plan ProjectPlan(const object::Object& object, const Plan& plan);

/// Place the contacts of a sliding step on the object, as ProjectContact does.
/// A contact may be on several faces with the same normal, for example at a vertex between
/// collinear edges. Each finger's faces are then chosen so that its motion between waypoints has
/// the fewest faults (FindMotionFault), then by the nearest normals.
void ProjectAlign(const object::Object& object, Align& align);

/// Many located grasps of k contacts each, in the layout of grasp::GraspArrays.
struct ProjectedGrasps {
  std::vector<double> points;   ///< points projected onto the surface
  std::vector<double> normals;  ///< unit vectors into the object: the faces' normals
  /// Reason per grasp why it is invalid, or kNone. kOffSurface and kWrongNormal refer to the first
  /// contact without a face; kWrongNormal includes a point on a border without a normal. That
  /// contact and the following ones stay as given. kUnreachable refers to a contact in a sealed
  /// cavity. kCoincidentFingers refers to the whole grasp.
  std::vector<Reason> reasons;
  /// Index of the contact of the reason, per grasp; −1 for kNone and kCoincidentFingers.
  std::vector<int> contacts;
};

/// Place every contact as those of a grasp file (ProjectContact).
/// @param points   N x k x 3 finite values.
/// @param normals  N x k x 3 values, or none: each contact is then on the only face at its point.
/// @param threads  number of threads; 0: one per core of the machine.
/// @throws std::invalid_argument  if the numbers of values do not match, or the number of threads
///     is negative.
[[nodiscard]] ProjectedGrasps ProjectGrasps(const object::Object& object,
                                            std::span<const double> points,
                                            std::span<const double> normals, int contacts,
                                            int threads = 0);

/// Number of single-precision units in the last place by which contacts may be off the surface. A
/// computed point, such as one between the corners of a triangle, is rounded a few times.
inline constexpr double kSinglePrecisionSteps = 4;

/// Largest tolerance for points, over the object's diameter, at any distance of the object from the
/// origin.
inline constexpr double kLargestPointTolerance = 1e-3;

/// Return how far a given point may be from the object's surface and still count as on it.
///
/// This is kPointTolerance · D, or the rounding of coordinates in single precision if that is
/// larger: kSinglePrecisionSteps · 2⁻²³ · (c + D), c the largest coordinate of the centroid, at
/// most kLargestPointTolerance · D. The second is larger for objects more than 1.1 D from the
/// origin.
/// @returns a length in the object's unit.
[[nodiscard]] double SurfaceTolerance(const object::Object& object);

/// Describe how far a point is off the surface, with the tolerance.
/// Example: "off the surface, expected at most 1e-06 of the object's diameter, found 0.0002887
/// (0.001 in the object file's unit)".
/// @param point  point in the object's frame and unit.
[[nodiscard]] std::string OffSurfaceText(const object::Object& object,
                                         const Eigen::Vector3d& point);

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
