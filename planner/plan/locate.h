#pragma once

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

}  // namespace regrasp::plan
