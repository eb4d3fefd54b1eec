#include "planner/sampling/surface_sampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sampling {

using Eigen::Vector3d;

namespace {

/// Distance over the diameter within which points are on a face; it covers rounding errors.
constexpr double kOffFace = 1e-9;

/// Initial search radius for the nearest face, relative to the reach.
constexpr double kFirstRadius = 1.0 / 64;

double AreaOverPerimeter(const object::Object& object, FaceIndex face) {
  double perimeter = 0;
  for (const object::FaceBorder& border : object.BordersOf(face)) {
    perimeter += (border.b - border.a).norm();
  }
  return perimeter > 0 ? object.face_measure(face) / perimeter : 0;
}

/// Return the distance to the nearest sharp edge of a contact's face.
double DistanceToSharpEdge(const object::Object& object, const grasp::Contact& contact) {
  static const double least_cosine = std::cos(SurfaceSampler::kNearlyFlatAngle);
  const Vector3d n = object.inward_normal(contact.face);
  double nearest = std::numeric_limits<double>::infinity();
  for (const object::FaceBorder& border : object.BordersOf(contact.face)) {
    if (n.dot(object.inward_normal(border.beyond)) >= least_cosine) continue;
    const Vector3d along = border.b - border.a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? (contact.p - border.a).dot(along) / length2 : 0;
    const Vector3d closest = border.a + std::clamp(t, 0.0, 1.0) * along;
    nearest = std::min(nearest, (contact.p - closest).norm());
  }
  return nearest;
}

}  // namespace

double TriangleArea(const object::Polyhedron& solid, object::TriangleIndex triangle) {
  const auto& [a, b, c] = solid.triangles()[triangle];
  const Vector3d ab = solid.vertices()[b] - solid.vertices()[a];
  const Vector3d ac = solid.vertices()[c] - solid.vertices()[a];
  return ab.cross(ac).norm() / 2;
}

grasp::Contact ContactOnTriangle(const object::Polyhedron& solid, object::TriangleIndex triangle,
                                 const Vector3d& p) {
  const FaceIndex face = solid.face_of_triangle(triangle);
  return {solid.ClosestPoint(face, p), solid.inward_normal(face), face};
}

SurfaceSampler::SurfaceSampler(const object::Object& object, double finger_radius, double clearance)
    : object_(object),
      finger_radius_(finger_radius),
      clearance_(clearance * object.diameter()),
      solid_(dynamic_cast<const object::Polyhedron*>(&object)),
      polygon_(dynamic_cast<const object::Polygon*>(&object)) {
  for (FaceIndex face{0}; face < object.face_count(); ++face) {
    first_facet_.push_back(static_cast<int>(facets_.size()));
    if (!object.TakesFingers(face)) continue;
    if (solid_ == nullptr) {
      facets_.push_back(face);
    } else {
      const auto& triangles = solid_->TrianglesOf(face);
      facets_.insert(facets_.end(), triangles.begin(), triangles.end());
    }
  }
  first_facet_.push_back(static_cast<int>(facets_.size()));
  double sum = 0;
  for (const int facet : facets_) up_to_.push_back(sum += MeasureOf(facet));
}

double SurfaceSampler::MeasureOf(int facet) const {
  return solid_ == nullptr ? polygon_->face_measure(FaceIndex(facet))
                           : TriangleArea(*solid_, object::TriangleIndex(facet));
}

bool SurfaceSampler::IsOffBorder(const grasp::Contact& contact) const {
  const double distance = object_.DistanceToBorder(contact.face, contact.p);
  if (distance >= clearance_) return true;
  if (solid_ == nullptr || distance < kFromBorder * object_.diameter()) return false;
  const double sharp =
      std::min(clearance_, kSmallFaceClearance * AreaOverPerimeter(object_, contact.face));
  return distance >= sharp || DistanceToSharpEdge(object_, contact) >= sharp;
}

bool SurfaceSampler::IsValid(const grasp::Contact& contact) const {
  return IsOffBorder(contact) && criteria::CanRest(object_, contact) &&
         criteria::CanReach(object_, contact, finger_radius_);
}

SurfaceSampler::Range SurfaceSampler::RangeOf(FaceIndex face) const {
  const int first = first_facet_[face];
  return {first == 0 ? 0 : up_to_[first - 1], up_to_[first_facet_[face + 1] - 1]};
}

double SurfaceSampler::DrawSum(const Range& range, RandomStream& random) const {
  return range.from + random.Uniform() * (range.to - range.from);
}

std::size_t SurfaceSampler::PlaceAt(double sum) const {
  const auto above = std::upper_bound(up_to_.begin(), up_to_.end(), sum);
  return std::min<std::size_t>(above - up_to_.begin(), up_to_.size() - 1);
}

object::TriangleIndex SurfaceSampler::DrawTriangle(RandomStream& random) const {
  return object::TriangleIndex(facets_[PlaceAt(DrawSum(Everywhere(), random))]);
}

grasp::Contact SurfaceSampler::DrawIn(const Range& range, RandomStream& random) const {
  const double sum = DrawSum(range, random);
  const std::size_t place = PlaceAt(sum);
  const int facet = facets_[place];
  if (solid_ == nullptr) {
    const double along = sum - (place == 0 ? 0 : up_to_[place - 1]);
    return grasp::ContactAt(*polygon_, FaceIndex(facet), std::min(along / MeasureOf(facet), 1.0));
  }
  const auto& [a, b, c] = solid_->triangles()[facet];
  const auto& v = solid_->vertices();
  const double root = std::sqrt(random.Uniform());
  const double along = random.Uniform();
  const Vector3d p = (1 - root) * v[a] + root * (1 - along) * v[b] + root * along * v[c];
  return ContactOnTriangle(*solid_, object::TriangleIndex(facet), p);
}

grasp::Contact SurfaceSampler::DrawAnywhere(RandomStream& random) const {
  return DrawIn(Everywhere(), random);
}

std::optional<grasp::Contact> SurfaceSampler::DrawValid(const Range& range,
                                                        RandomStream& random) const {
  for (int draw = 0; draw < kMostDraws; ++draw) {
    const grasp::Contact contact = DrawIn(range, random);
    if (IsValid(contact)) return contact;
  }
  return std::nullopt;
}

std::optional<grasp::Contact> SurfaceSampler::TryDraw(RandomStream& random) const {
  return DrawValid(Everywhere(), random);
}

grasp::Contact SurfaceSampler::Draw(RandomStream& random) const {
  const auto valid = DrawValid(Everywhere(), random);
  return valid ? *valid : DrawAnywhere(random);
}

grasp::Contact SurfaceSampler::DrawOn(FaceIndex face, RandomStream& random) const {
  const auto valid = DrawValid(RangeOf(face), random);
  return valid ? *valid : DrawIn(RangeOf(face), random);
}

Vector3d SurfaceSampler::DrawBeside(const grasp::Contact& contact, double reach,
                                    RandomStream& random) const {
  const bool space = object_.dimension() == 3;
  const Vector3d across = space ? contact.n.unitOrthogonal() : Vector3d::UnitZ();
  const Vector3d along = contact.n.cross(across);
  const double u = (2 * random.Uniform() - 1) * reach;
  const double v = space ? (2 * random.Uniform() - 1) * reach : 0;
  return contact.p + u * along + v * across;
}

grasp::Contact SurfaceSampler::DrawNear(const grasp::Contact& contact, double reach,
                                        RandomStream& random) const {
  const Vector3d beside = DrawBeside(contact, reach, random);
  const Vector3d on_face = object_.ClosestPoint(contact.face, beside);
  const bool is_inside = (on_face - beside).norm() <= kOffFace * object_.diameter();
  return {is_inside ? beside : DrawInwards(contact.face, on_face, reach, random), contact.n,
          contact.face};
}

grasp::Contact SurfaceSampler::DrawAround(const grasp::Contact& contact, double reach,
                                          RandomStream& random) const {
  const Vector3d p = DrawBeside(contact, reach, random);
  // A search for faces in a large radius is expensive, and most faces are near.
  for (double radius = kFirstRadius * reach; radius <= reach; radius *= 2) {
    std::vector<FaceIndex> faces = object_.FacesNear(p, radius);
    std::erase_if(faces, [&](FaceIndex face) { return !object_.TakesFingers(face); });
    if (faces.empty()) continue;
    // If an edge is nearest, both of its faces are equally near.
    const auto distance = [&](FaceIndex face) {
      return (object_.ClosestPoint(face, p) - p).norm();
    };
    const double nearest = distance(faces.front()) + kOffFace * object_.diameter();
    const auto farther =
        std::ranges::find_if(faces, [&](FaceIndex f) { return distance(f) > nearest; });
    const FaceIndex face = faces[random.Index(static_cast<std::uint64_t>(farther - faces.begin()))];
    const Vector3d n = object_.inward_normal(face);
    const Vector3d on_face = object_.ClosestPoint(face, p);
    const bool is_inside = (on_face - p).cross(n).norm() <= kOffFace * object_.diameter();
    return {is_inside ? on_face : DrawInwards(face, on_face, reach, random), n, face};
  }
  return contact;
}

Vector3d SurfaceSampler::DrawInwards(FaceIndex face, const Vector3d& border, double reach,
                                     RandomStream& random) const {
  const Vector3d inside = DrawIn(RangeOf(face), random).p - border;
  // The widest grasps are the best: most draws stay as near to the border as allowed.
  const double u = random.Uniform();
  const double inwards = 5 * kFromBorder * object_.diameter() + u * u * u * u * reach;
  return object_.ClosestPoint(face, border + std::min(1.0, inwards / inside.norm()) * inside);
}

namespace {

struct Direction {
  double angle;  ///< angle in (−π, π]
  Eigen::Vector3d normal;
};

std::vector<Direction> SortedNormals(const object::Object& polygon) {
  std::vector<Direction> sorted;
  for (FaceIndex e{0}; e < polygon.face_count(); ++e) {
    const Eigen::Vector3d normal = polygon.inward_normal(e);
    sorted.push_back({std::atan2(normal.y(), normal.x()), normal});
  }
  std::ranges::sort(sorted, {}, &Direction::angle);
  return sorted;
}

/// Return whether a polygon has two edges for a force-closure grasp with two contacts.
/// Each contact must be in the other contact's cone. The normals are therefore opposed up to twice
/// the friction angle. For each normal only the neighbours of its opposite in angular order are
/// tested.
bool HasOpposedEdges(const object::Object& polygon, double friction_angle) {
  const double least = std::cos(2 * friction_angle);
  const std::vector<Direction> sorted = SortedNormals(polygon);
  const std::size_t n = sorted.size();
  return std::ranges::any_of(sorted, [&](const Direction& one) {
    const double opposite = one.angle + (one.angle > 0 ? -std::numbers::pi : std::numbers::pi);
    const auto after = static_cast<std::size_t>(
        std::ranges::lower_bound(sorted, opposite, {}, &Direction::angle) - sorted.begin());
    const auto is_opposed = [&](std::size_t i) {
      return -one.normal.dot(sorted[i % n].normal) > least;
    };
    return is_opposed(after) || is_opposed(after + n - 1);
  });
}

/// Return the numbers of contacts to try, in order.
std::vector<int> DrawOrder(const object::Object& object, const grasp::ContactLimits& contacts,
                           RandomStream& random) {
  if (object.dimension() == 3) return {contacts.least};
  std::vector<int> order(contacts.most - contacts.least + 1);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = contacts.least + static_cast<int>(i);
  const auto first = static_cast<std::ptrdiff_t>(random.Index(order.size()));
  std::rotate(order.begin(), order.begin() + first, order.end());
  return order;
}

grasp::Grasp DrawContacts(const SurfaceSampler& sampler, int contacts, RandomStream& random,
                          const std::string& nothing_reached) {
  grasp::Grasp drawn;
  while (static_cast<int>(drawn.size()) < contacts) {
    const auto contact = sampler.TryDraw(random);
    if (!contact) throw NoGrasp{nothing_reached};
    drawn.push_back(*contact);
  }
  return drawn;
}

/// Format a radius: " of radius 0.1"; empty for points.
std::string OfRadius(double finger_radius) {
  return finger_radius > 0 ? " of radius " + FormatShort(finger_radius) : "";
}

std::string Range(const grasp::ContactLimits& contacts) {
  const std::string least = std::to_string(contacts.least);
  return contacts.most > contacts.least ? least + " and as many of " + std::to_string(contacts.most)
                                        : least;
}

}  // namespace

std::optional<grasp::Grasp> DrawGoodGrasp(const std::function<grasp::Grasp()>& draw,
                                          const criteria::GraspEvaluator& evaluator) {
  for (int i = 0; i < kMaxSurfaceDraws; ++i) {
    grasp::Grasp grasp = draw();
    if (evaluator.IsGood(grasp)) return grasp;
  }
  return std::nullopt;
}

grasp::Grasp DrawOnSurface(const object::Object& object, const grasp::ContactLimits& contacts,
                           const criteria::GraspEvaluator& evaluator, RandomStream& random,
                           const std::string& name, const std::function<void()>& before_draw) {
  const double radius = evaluator.finger_radius();
  // Contacts of start and goal may be anywhere on their faces.
  const SurfaceSampler sampler(object, radius, 0);
  const std::string nothing_reached = name + ": a finger" + OfRadius(radius) + " reaches none of " +
                                      std::to_string(SurfaceSampler::kMostDraws) +
                                      " points drawn on the surface";
  for (const int count : DrawOrder(object, contacts, random)) {
    if (count == 2 && !HasOpposedEdges(object, evaluator.friction_angle())) continue;
    const auto draw = [&] {
      before_draw();
      return DrawContacts(sampler, count, random, nothing_reached);
    };
    if (auto grasp = DrawGoodGrasp(draw, evaluator)) return *std::move(grasp);
  }
  throw NoGrasp{name + ": none of " + std::to_string(kMaxSurfaceDraws) + " grasps of " +
                Range(contacts) + " contacts drawn on the surface is force closure" +
                criteria::WithWhatIsAsked(evaluator.criteria()) +
                (radius > 0 ? ", its fingers" + OfRadius(radius) + " apart" : "")};
}

}  // namespace regrasp::sampling
