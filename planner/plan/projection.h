#pragma once

#include <span>
#include <string>
#include <vector>

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

}  // namespace regrasp::plan
