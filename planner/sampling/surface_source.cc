#include "planner/sampling/surface_source.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/criteria/clearance.h"
#include "planner/criteria/reach.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

using Eigen::Vector3d;

namespace {

/// Contacts drawn before room is no longer asked for: on nearly all of a surface fingers have it.
constexpr int kMostDraws = 1000;

/// Points this near a face, over the diameter, are on it: what rounding makes of them.
constexpr double kOffFace = 1e-9;

/// Fingers stand at least this far from the border of their face, over the diameter: on it the
/// least slip takes them to the next face. Far more than a good grasp slips.
constexpr double kFromBorder = 2e-4;

/// The nearest face is looked for within this share of the reach first.
constexpr double kFirstLook = 1.0 / 64;

}  // namespace

SurfaceSource::SurfaceSource(const Object& object, double finger_radius)
    : object_(object), finger_radius_(finger_radius) {
  const auto* solid = dynamic_cast<const Polyhedron*>(&object);
  for (int face = 0; face < object.face_count(); ++face) {
    first_piece_.push_back(static_cast<int>(pieces_.size()));
    if (object.IsEnclosed(face)) continue;
    if (solid == nullptr) {
      const auto [a, b] = dynamic_cast<const Polygon&>(object).edge(face);
      AddPiece({a, b, b, face}, (b - a).norm());
      continue;
    }
    for (const int triangle : solid->faces()[face].triangles) {
      const auto& [i, j, k] = solid->triangles()[triangle];
      const Piece piece{solid->vertices()[i], solid->vertices()[j], solid->vertices()[k], face};
      AddPiece(piece, (piece.b - piece.a).cross(piece.c - piece.a).norm() / 2);
    }
  }
  first_piece_.push_back(static_cast<int>(pieces_.size()));
}

bool SurfaceSource::Serves(const Contact& contact) const {
  return object_.DistanceToBorder(contact.face, contact.p) >= kFromBorder * object_.diameter() &&
         HasClearance(object_, contact) && CanReach(object_, contact, finger_radius_);
}

void SurfaceSource::AddPiece(const Piece& piece, double measure) {
  pieces_.push_back(piece);
  up_to_.push_back(measure + (up_to_.empty() ? 0 : up_to_.back()));
}

Contact SurfaceSource::DrawIn(const Piece& piece, RandomStream& random) const {
  const double root = object_.dimension() == 3 ? std::sqrt(random.Uniform()) : 1;
  const double along = random.Uniform();
  const Vector3d p = (1 - root) * piece.a + root * (1 - along) * piece.b + root * along * piece.c;
  const Vector3d q = object_.dimension() == 3 ? p : piece.a + along * (piece.b - piece.a);
  return {object_.ClosestPoint(piece.face, q), object_.inward_normal(piece.face), piece.face};
}

Contact SurfaceSource::DrawOnce(const Range& range, RandomStream& random) const {
  const double at = range.from + random.Uniform() * (range.to - range.from);
  const auto above = std::upper_bound(up_to_.begin(), up_to_.end(), at);
  const auto last = static_cast<std::ptrdiff_t>(up_to_.size()) - 1;
  return DrawIn(pieces_[std::min(above - up_to_.begin(), last)], random);
}

Contact SurfaceSource::DrawServing(const Range& range, RandomStream& random) const {
  Contact contact;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    contact = DrawOnce(range, random);
    if (Serves(contact)) break;
  }
  return contact;
}

SurfaceSource::Range SurfaceSource::RangeOf(int face) const {
  const int first = first_piece_[face];
  return {first == 0 ? 0 : up_to_[first - 1], up_to_[first_piece_[face + 1] - 1]};
}

Contact SurfaceSource::Draw(RandomStream& random) const {
  return DrawServing({0, up_to_.back()}, random);
}

Contact SurfaceSource::DrawOn(int face, RandomStream& random) const {
  return DrawServing(RangeOf(face), random);
}

Vector3d SurfaceSource::DrawBeside(const Contact& contact, double reach,
                                   RandomStream& random) const {
  const bool space = object_.dimension() == 3;
  const Vector3d across = space ? contact.n.unitOrthogonal() : Vector3d::UnitZ();
  const Vector3d along = contact.n.cross(across);
  const double u = (2 * random.Uniform() - 1) * reach;
  const double v = space ? (2 * random.Uniform() - 1) * reach : 0;
  return contact.p + u * along + v * across;
}

Contact SurfaceSource::DrawNear(const Contact& contact, double reach, RandomStream& random) const {
  const Vector3d beside = DrawBeside(contact, reach, random);
  const Vector3d on_face = object_.ClosestPoint(contact.face, beside);
  const bool is_inside = (on_face - beside).norm() <= kOffFace * object_.diameter();
  return {is_inside ? beside : DrawInwards(contact.face, on_face, reach, random), contact.n,
          contact.face};
}

Contact SurfaceSource::DrawAround(const Contact& contact, double reach,
                                  RandomStream& random) const {
  const Vector3d p = DrawBeside(contact, reach, random);
  // Looking for the nearest face far away is dear, and most are near.
  for (double radius = kFirstLook * reach; radius <= reach; radius *= 2) {
    std::vector<int> faces = object_.FacesNear(p, radius);
    std::erase_if(faces, [&](int face) { return object_.IsEnclosed(face); });
    if (faces.empty()) continue;
    // Where an edge is nearest, so are both of its faces.
    const auto distance = [&](int face) { return (object_.ClosestPoint(face, p) - p).norm(); };
    const double nearest = distance(faces.front()) + kOffFace * object_.diameter();
    const auto farther = std::ranges::find_if(faces, [&](int f) { return distance(f) > nearest; });
    const int face = faces[random.Index(static_cast<std::uint64_t>(farther - faces.begin()))];
    const Vector3d n = object_.inward_normal(face);
    const Vector3d on_face = object_.ClosestPoint(face, p);
    const bool is_inside = (on_face - p).cross(n).norm() <= kOffFace * object_.diameter();
    return {is_inside ? on_face : DrawInwards(face, on_face, reach, random), n, face};
  }
  return contact;
}

Vector3d SurfaceSource::DrawInwards(int face, const Vector3d& border, double reach,
                                    RandomStream& random) const {
  const Vector3d way = DrawOnce(RangeOf(face), random).p - border;
  // The best grasps are the widest ones: most of the draws stay as near to the border as they may.
  const double u = random.Uniform();
  const double inwards = 5 * kFromBorder * object_.diameter() + u * u * u * u * reach;
  return object_.ClosestPoint(face, border + std::min(1.0, inwards / way.norm()) * way);
}

}  // namespace regrasp
