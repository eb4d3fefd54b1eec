#include "planner/plan/locate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "planner/grasp/angle_between.h"
#include "planner/plan/locate_align.h"
#include "planner/plan/surface_tolerance.h"
#include "planner/plan/tolerance.h"

namespace regrasp::plan {

namespace {

/// Points may be given anywhere; in diameters.
constexpr double kFarthest = 1e6;

void LocateAll(const object::Object& object, FingerGrasp& grasp) {
  for (FingerContact& held : grasp) held.contact = LocateContact(object, held.contact).contact;
}

bool IsUnit(const Eigen::Vector3d& normal) {
  return std::abs(normal.norm() - 1) <= kNormalLengthTolerance;
}

/// Angles between the contact's normal and those of faces near it, nearest first.
std::vector<std::pair<double, FaceIndex>> RankFaces(const std::vector<FaceIndex>& faces,
                                                    const object::Object& object,
                                                    const grasp::Contact& contact) {
  std::vector<std::pair<double, FaceIndex>> ranked;
  for (const FaceIndex face : faces) {
    ranked.emplace_back(grasp::AngleBetween(contact.n, object.inward_normal(face)), face);
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<double, FaceIndex>::first);
  return ranked;
}

grasp::Contact Project(const object::Object& object, const grasp::Contact& contact,
                       FaceIndex face) {
  return {object.ClosestPoint(face, contact.p), object.inward_normal(face), face};
}

/// Most points that are asked for are near the surface; all faces are looked at only for others.
double DistanceToSurface(const object::Object& object, const Eigen::Vector3d& p) {
  constexpr double kNear = 0.05;
  for (double radius = 0.0125; radius <= kNear; radius *= 2) {
    const std::vector<FaceIndex> near = object.FacesNear(p, radius * object.diameter());
    if (!near.empty()) return (object.ClosestPoint(near.front(), p) - p).norm();
  }
  double least = std::numeric_limits<double>::infinity();
  for (FaceIndex face{0}; face < object.face_count(); ++face) {
    least = std::min(least, (object.ClosestPoint(face, p) - p).norm());
  }
  return least;
}

}  // namespace

std::string VectorText(const Eigen::Vector3d& v, int dimension) {
  std::string text = "(";
  for (int k = 0; k < dimension; ++k) text += (k == 0 ? "" : ", ") + FormatShort(v[k]);
  return text + ")";
}

LocatedContact LocateContact(const object::Object& object, const grasp::Contact& contact) {
  LocatedContact located{{contact.p, contact.n}, Reason::kNone, ""};
  const std::vector<FaceIndex> faces = object.FacesNear(contact.p, SurfaceTolerance(object));
  if (faces.empty()) {
    located.reason = Reason::kOffSurface;
    return located;
  }
  if (!IsUnit(contact.n)) {
    located.reason = Reason::kWrongNormal;
    located.detail = "the normal is " + FormatShort(contact.n.norm()) + " long, not 1";
    return located;
  }
  const auto [least, nearest] = RankFaces(faces, object, contact).front();
  if (!(least <= kNormalTolerance)) {
    located.reason = Reason::kWrongNormal;
    located.detail = "the normal differs by " + FormatDegrees(Degrees(least)) +
                     " from the inward normal of face " + std::to_string(nearest);
    return located;
  }
  located.contact = Project(object, contact, nearest);
  return located;
}

grasp::Contact NearestContact(const object::Object& object, const grasp::Contact& contact) {
  const Eigen::Vector3d& centre = object.mass_properties().centroid;
  const Eigen::Vector3d away = contact.p - centre;
  // From farther away the same point is nearest, and squares of distances stay finite.
  const double most = kFarthest * object.diameter();
  const double distance = away.stableNorm();
  const Eigen::Vector3d p = distance <= most ? contact.p : centre + away * (most / distance);
  const double least = DistanceToSurface(object, p);
  const grasp::Contact near = {p, contact.n.stableNormalized()};
  const double tolerance = object::kPointTolerance * object.diameter();
  return Project(object, near,
                 RankFaces(object.FacesNear(p, least + tolerance), object, near).front().second);
}

std::vector<grasp::Contact> LocateEverywhere(const object::Object& object,
                                             const grasp::Contact& contact) {
  std::vector<grasp::Contact> places;
  if (!IsUnit(contact.n)) return places;
  const std::vector<FaceIndex> faces = object.FacesNear(contact.p, SurfaceTolerance(object));
  for (const auto& [angle, face] : RankFaces(faces, object, contact)) {
    if (angle <= kNormalTolerance) places.push_back(Project(object, contact, face));
  }
  return places;
}

Plan LocatePlan(const object::Object& object, const Plan& plan) {
  Plan located = plan;
  LocateAll(object, located.initial);
  for (Step& step : located.steps) {
    if (auto* finger_switch = std::get_if<Switch>(&step)) {
      LocateAll(object, finger_switch->place);
    } else if (auto* align = std::get_if<Align>(&step)) {
      LocateAlign(object, *align);
    }
  }
  for (grasp::Contact& contact : located.goal) contact = LocateContact(object, contact).contact;
  SetTorsion(plan.torsion, located);
  return located;
}

}  // namespace regrasp::plan
