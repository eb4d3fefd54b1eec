#include "planner/plan/locate.h"

#include <cmath>
#include <limits>

#include "planner/base/number.h"
#include "planner/plan/tolerance.h"

namespace regrasp {

namespace {

void LocateAll(const Object& object, FingerGrasp& grasp) {
  for (FingerContact& held : grasp) held.contact = LocateContact(object, held.contact).contact;
}

}  // namespace

LocatedContact LocateContact(const Object& object, const Contact& contact) {
  LocatedContact located{{contact.p, contact.n, -1}, Reason::kNone, ""};
  const double tolerance = kPointTolerance * object.diameter();
  const std::vector<int> faces = object.FacesNear(contact.p, tolerance);
  if (faces.empty()) {
    located.reason = Reason::kOffSurface;
    located.detail = "farther than " + FormatShort(tolerance) + " from the surface";
    return located;
  }
  const double length = contact.n.norm();
  if (!(std::abs(length - 1) <= kNormalLengthTolerance)) {
    located.reason = Reason::kWrongNormal;
    located.detail = "the normal is " + FormatShort(length) + " long, not 1";
    return located;
  }
  double least = std::numeric_limits<double>::infinity();
  int nearest = -1;
  for (const int face : faces) {
    const double angle = AngleBetween(contact.n, object.inward_normal(face));
    if (angle < least) {
      least = angle;
      nearest = face;
    }
  }
  if (!(least <= kNormalTolerance)) {
    located.reason = Reason::kWrongNormal;
    located.detail = "the normal differs by " + FormatShort(Degrees(least)) +
                     " degrees from the inward normal of face " + std::to_string(nearest);
    return located;
  }
  located.contact = {object.ClosestPoint(nearest, contact.p), object.inward_normal(nearest),
                     nearest};
  return located;
}

Plan LocatePlan(const Object& object, const Plan& plan) {
  Plan located = plan;
  LocateAll(object, located.initial);
  for (Step& step : located.steps) {
    if (auto* finger_switch = std::get_if<Switch>(&step)) {
      LocateAll(object, finger_switch->place);
    } else {
      for (FingerGrasp& waypoint : std::get<Align>(step).waypoints) LocateAll(object, waypoint);
    }
  }
  for (Contact& contact : located.goal) contact = LocateContact(object, contact).contact;
  return located;
}

}  // namespace regrasp
