#include "sim/actuation/tip_surface.h"

#include <algorithm>

namespace regrasp::sim {
namespace {

using collision::SurfaceContact;
using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A tip goes this far before the triangles near it are looked for anew, metres.
constexpr double kNeighbourhood = 3e-3;
/// Nothing bounds those of a ball, which on smooth bodies has one or two.
constexpr int kMostOfShape = 2 * collision::kMostContacts;

}  // namespace

TipSurface::TipSurface(const kinematics::HandFile& file, TipShape tip,
                       const object::Polyhedron& solid, double scale)
    : surface_(solid, scale), centroid_(scale * solid.mass_properties().centroid) {
  for (const Vector3d& vertex : solid.vertices()) {
    object_reach_ = std::max(object_reach_, (scale * vertex - centroid_).norm());
  }
  const std::vector<TipShapes> shapes = TipShapesOf(file, tip);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& ball = file.description.tips[i];
    Tip& made = tips_.emplace_back(Tip{shapes[i], ball.centre, ball.radius});
    for (const collision::ConvexShape& shape : made.shapes) {
      for (const Vector3d& point : shape.points) {
        made.reach = std::max(made.reach, (point - made.centre).norm() + shape.radius);
      }
    }
  }
}

int TipSurface::most_contacts() const {
  std::size_t shapes = 0;
  for (const Tip& tip : tips_) shapes += tip.shapes.size();
  return kMostOfShape * static_cast<int>(shapes);
}

void TipSurface::Forget() {
  for (Tip& tip : tips_) tip.triangles.reset();
}

std::vector<SurfaceContact> TipSurface::FindContacts(FingerIndex finger, const Isometry3d& link,
                                                     const Isometry3d& to_object) {
  Tip& tip = tips_[finger];
  const Vector3d centre = to_object * (link * tip.centre);
  tip.nearest.reset();
  const double reach = tip.reach + kNear;
  if ((centre - centroid_).norm() > object_reach_ + reach) return {};
  if (!tip.triangles || (centre - tip.around).norm() > kNeighbourhood) {
    tip.around = centre;
    tip.triangles = surface_.Around(centre, reach + kNeighbourhood);
  }
  TipShapes placed = tip.shapes;
  std::vector<SurfaceContact> contacts;
  for (collision::ConvexShape& shape : placed) {
    for (Vector3d& point : shape.points) point = to_object * (link * point);
    const auto found = collision::FindContacts(surface_, shape, *tip.triangles);
    contacts.insert(contacts.end(), found.begin(), found.end());
  }
  const auto deepest = std::ranges::min_element(contacts, {}, &SurfaceContact::gap);
  tip.nearest = deepest != contacts.end() ? std::optional(*deepest) : NearestTo(placed, tip);
  if (tip.nearest) return contacts;
  for (const collision::NearPoint& ball :
       surface_.Find(centre, tip.radius + kNear, *tip.triangles)) {
    tip.nearest = {ball.point, ball.outward, ball.distance - tip.radius};
    break;
  }
  return contacts;
}

std::optional<SurfaceContact> TipSurface::NearestTo(const TipShapes& placed, const Tip& tip) const {
  std::optional<SurfaceContact> best;
  for (const collision::ConvexShape& shape : placed) {
    const auto near = collision::FindNearest(surface_, shape, shape.radius + kNear, *tip.triangles);
    if (near && (!best || near->gap < best->gap)) best = near;
  }
  return best;
}

std::optional<collision::NearPoint> TipSurface::NearBall(FingerIndex finger,
                                                         const Vector3d& centre) const {
  const auto found = surface_.Find(centre, tips_[finger].radius + kNear);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

}  // namespace regrasp::sim
