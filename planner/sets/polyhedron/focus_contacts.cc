#include "planner/sets/polyhedron/focus_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/sets/polyhedron/focus_cells.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Number of candidate contacts on a path inside the cone: from the part's point nearest to the
/// foot of the focus point towards the middle of the part.
constexpr int kContactSteps = 16;

/// Number of random contacts on a face before the best one for the focus point is returned.
constexpr int kContactDraws = 20;

Vector2d MiddleOf(const FacePart& part) {
  Vector2d sum = Vector2d::Zero();
  for (const FacePart::Side& side : part.sides) sum += side.from;
  return sum / static_cast<double>(part.sides.size());
}

/// Return the point of a part nearest to a point of its plane.
Vector2d NearestOn(const FacePart& part, const Vector2d& y) {
  if (DepthIn(part, y) >= 0) return y;
  Vector2d nearest = y;
  double least = std::numeric_limits<double>::infinity();
  for (const FacePart::Side& side : part.sides) {
    const double along = std::clamp(side.along.dot(y - side.from), 0.0, side.length);
    const Vector2d candidate = side.from + along * side.along;
    const double distance = (y - candidate).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

/// Return the fraction of a path at which it leaves the circle about `centre`: at most 1, and 0 if
/// it starts outside.
double ShareInside(const Vector2d& from, const Vector2d& to, const Vector2d& centre,
                   double radius) {
  const double a = (to - from).squaredNorm();
  const double b = (to - from).dot(from - centre);
  const double c = (from - centre).squaredNorm() - radius * radius;
  if (c >= 0) return 0;
  const double root = std::sqrt(b * b - a * c);
  if (root - b >= a) return 1;
  // One of the two forms of the larger root has no cancellation.
  return b > 0 ? -c / (b + root) : (root - b) / a;
}

/// Return the radius of the circle that a focus point sees on a part's plane.
double RadiusOf(const FacePart& part, double tangent, const Vector3d& focus) {
  return std::abs(part.HeightOf(focus)) * tangent;
}

}  // namespace

double DepthIn(const FacePart& part, const Vector2d& y) {
  double depth = std::numeric_limits<double>::infinity();
  for (const FacePart::Side& side : part.sides) {
    depth = std::min(depth, -side.outward.dot(y - side.from));
  }
  return depth;
}

Vector3d ContactFor(const FacePart& part, double tangent, const Vector3d& focus) {
  const Vector2d foot = part.FootOf(focus);
  const double radius = RadiusOf(part, tangent, focus);
  const Vector2d nearest = NearestOn(part, foot);
  const Vector2d middle = MiddleOf(part);
  const Vector2d path = ShareInside(nearest, middle, foot, radius) * (middle - nearest);
  Vector2d best = nearest;
  double most = -std::numeric_limits<double>::infinity();
  for (int step = 0; step <= kContactSteps; ++step) {
    const Vector2d y = nearest + static_cast<double>(step) / kContactSteps * path;
    const double margin = std::min(radius - (y - foot).norm(), DepthIn(part, y));
    if (margin <= most) continue;
    most = margin;
    best = y;
  }
  return part.PointAt(best);
}

Vector3d DrawContact(const FacePart& part, double tangent, const Vector3d& focus,
                     RandomStream& random) {
  const Vector2d foot = part.FootOf(focus);
  const double radius = RadiusOf(part, tangent, focus);
  for (int draw = 0; draw < kContactDraws; ++draw) {
    const double r = radius * std::sqrt(random.Uniform());
    const double angle = 2 * std::numbers::pi * random.Uniform();
    const Vector2d y = foot + r * Vector2d(std::cos(angle), std::sin(angle));
    if (DepthIn(part, y) > 0) return part.PointAt(y);
  }
  return ContactFor(part, tangent, focus);
}

namespace {

constexpr int kCircleCorners = 72;
constexpr int kContacts = 4;

/// Clip a convex outline at a side of a part.
std::vector<Vector2d> Clip(const std::vector<Vector2d>& outline, const FacePart::Side& side) {
  std::vector<Vector2d> clipped;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[(i + 1) % outline.size()];
    const double of_a = -side.outward.dot(a - side.from);
    const double of_b = -side.outward.dot(b - side.from);
    if (of_a >= 0) clipped.push_back(a);
    if ((of_a >= 0) != (of_b >= 0)) clipped.push_back(a + of_a / (of_a - of_b) * (b - a));
  }
  return clipped;
}

/// Return the points of a part that a focus point sees inside its cone.
std::vector<Vector3d> ContactRegion(const FacePart& part, const Vector3d& focus, double tangent) {
  const Vector2d foot = part.FootOf(focus);
  const double radius = std::abs(part.HeightOf(focus)) * tangent;
  std::vector<Vector2d> outline;
  for (int i = 0; i < kCircleCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCircleCorners;
    outline.push_back(foot + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  for (const FacePart::Side& side : part.sides) outline = Clip(outline, side);
  std::vector<Vector3d> region;
  for (const Vector2d& y : outline) region.push_back(part.PointAt(y));
  return region;
}

}  // namespace

std::optional<FocusView> DescribeFocus(const object::Polyhedron& solid, const grasp::Grasp& grasp,
                                       double friction_angle) {
  if (grasp.size() != kContacts) return std::nullopt;
  std::vector<Vector3d> normals;
  for (const grasp::Contact& contact : grasp) normals.push_back(solid.inward_normal(contact.face));
  const auto candidates =
      FindQuadrupleCandidates(normals, std::tan(friction_angle), planning::Spanning::kAdaptive);
  if (candidates.empty()) return std::nullopt;
  const double tangent = candidates.front().tangent;
  FocusCellFinder finder(solid, tangent);
  std::vector<FacePart> contacts;
  for (const grasp::Contact& contact : grasp) {
    contacts.push_back(
        PointPart(finder.parts().parts[finder.parts().first[contact.face]], contact.p));
  }
  std::optional<FocusView> view;
  double least = 0;
  for (int sides = 0; sides < 1 << kContacts; ++sides) {
    std::vector<UnionVolume> cones;
    for (int k = 0; k < kContacts; ++k) {
      cones.emplace_back(contacts[k], (sides >> k & 1) == 0, tangent);
    }
    const auto deepest = finder.FindDeepest(cones);
    if (!deepest || deepest->value >= least) continue;
    least = deepest->value;
    view = FocusView{deepest->point, {}};
  }
  if (!view) return std::nullopt;
  for (const grasp::Contact& contact : grasp) {
    const auto& first = finder.parts().first;
    for (PartIndex part = first[contact.face]; part < first[contact.face + 1]; ++part) {
      auto region = ContactRegion(finder.parts().parts[part], view->focus, tangent);
      if (!region.empty()) view->regions.push_back(std::move(region));
    }
  }
  return view;
}

}  // namespace regrasp::polyhedron
