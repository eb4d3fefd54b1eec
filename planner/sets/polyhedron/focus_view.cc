#include "planner/sets/polyhedron/focus_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/sets/polyhedron/focus_cells.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kCircleCorners = 72;
constexpr int kContacts = 4;

/// The part of a convex outline on the inner side of a part's side.
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

/// The points of a part that a focus point sees inside its cone.
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
                                       double half_angle) {
  if (grasp.size() != kContacts) return std::nullopt;
  std::vector<Vector3d> normals;
  for (const grasp::Contact& contact : grasp) normals.push_back(solid.inward_normal(contact.face));
  const auto candidates =
      FindQuadrupleCandidates(normals, std::tan(half_angle), planning::Spanning::kAdaptive);
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
