#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// A normal for people: "(0, 0.6, -0.8)"; of a planar object two numbers.
[[nodiscard]] std::string VectorText(const Eigen::Vector3d& v, int dimension);

/// A contact as a file gives it, placed on the object.
struct LocatedContact {
  /// The point projected onto its face, the face's own normal, and the face; as given and with face
  /// −1 where it has none.
  grasp::Contact contact;
  Reason reason = Reason::kNone;  ///< kOffSurface or kWrongNormal where it has no face
  std::string detail;             ///< of a wrong normal, how far off, for people
};

/// Finds the face of a contact: among the faces within SurfaceTolerance of the point, the one
/// whose inward normal is nearest to the contact's, which must be within kNormalTolerance and of
/// unit length within kNormalLengthTolerance. So the normal chooses where faces meet.
[[nodiscard]] LocatedContact LocateContact(const object::Object& object,
                                           const grasp::Contact& contact);

/// The place on the surface that is nearest to a contact's point, with the normal there; where
/// faces are equally near, on the one whose normal is nearest to the contact's.
[[nodiscard]] grasp::Contact NearestContact(const object::Object& object,
                                            const grasp::Contact& contact);

/// All places that a contact can have by the tolerances, nearest normal first, ties by distance and
/// index; the first is that of LocateContact. Empty where that has none.
[[nodiscard]] std::vector<grasp::Contact> LocateEverywhere(const object::Object& object,
                                                           const grasp::Contact& contact);

/// Places every contact of a plan on the object, without judging; docs at PlanCheck::located.
[[nodiscard]] Plan LocatePlan(const object::Object& object, const Plan& plan);

/// Places the contacts of an align on the object, as LocateContact does. Where a contact lies on
/// several faces that its normal cannot tell apart (at a vertex between collinear edges, for
/// instance) each finger's faces are chosen so that its motion from waypoint to waypoint has the
/// fewest faults (FindMotionFault), then by the nearest normals.
void LocateAlign(const object::Object& object, Align& align);

/// Many grasps of k contacts each on an object, in the layout of grasp::GraspArrays.
struct LocatedGrasps {
  std::vector<double> points;   ///< projected onto the surface
  std::vector<double> normals;  ///< unit, into the object: the faces' own
  /// Of each grasp kNone, or why it cannot be held: kOffSurface or kWrongNormal (also of a point on
  /// a border without a normal) of its first contact that has no place, which is left as it was
  /// given, as are those after it; kUnreachable of one in a sealed cavity; kCoincidentFingers.
  std::vector<Reason> reasons;
  /// Of each grasp the index of the contact that the reason is of; −1 with kNone and
  /// kCoincidentFingers.
  std::vector<int> contacts;
};

/// Places every contact as a grasp file's is (LocateContact); without normals on the only face at
/// its point.
/// @param points   N x k x 3 finite values.
/// @param normals  as many, or none.
/// @param threads  0: as many as the machine has cores.
/// @throws std::invalid_argument  another number of values, or fewer than 0 threads.
[[nodiscard]] LocatedGrasps LocateGrasps(const object::Object& object,
                                         std::span<const double> points,
                                         std::span<const double> normals, int contacts,
                                         int threads = 0);

}  // namespace regrasp::plan
