#include "planner/sets/polyhedron/face_part.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <map>

namespace regrasp::polyhedron {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

namespace {

/// Sine below which a concave corner counts as straight. It covers rounding of the face's plane and
/// is far below kCoplanarAngle.
constexpr double kStraight = 1e-9;

/// Divides one face into parts, represented as rings of vertices.
class FaceSplitter {
 public:
  FaceSplitter(const object::Polyhedron& solid, FaceIndex face) : solid_(solid) {
    frame_.face = face;
    frame_.origin = solid.CentroidOf(face);
    frame_.normal = solid.inward_normal(face);
    frame_.u = frame_.normal.unitOrthogonal();
    frame_.v = frame_.u.cross(frame_.normal);
    for (const object::TriangleIndex triangle : solid.TrianglesOf(face)) {
      const auto& t = solid.triangles()[triangle];
      rings_.push_back({t[0], t[1], t[2]});
    }
  }

  void Split(FaceParts& parts) {
    JoinConvex();
    const int first = static_cast<int>(parts.parts.size());
    for (const Ring& ring : rings_) parts.parts.push_back(MakePart(ring));
    const std::map<Side, int> sides = Sides();
    for (const auto& [side, owner] : sides) {
      const auto other = sides.find({side[1], side[0]});
      if (side[0] > side[1] || other == sides.end()) continue;
      parts.joints.push_back({{PartIndex(first + owner), PartIndex(first + other->second)},
                              MakePart({side[0], side[1]})});
    }
    parts.hulls.push_back(rings_.size() == 1 ? parts.parts[first] : MakeHull());
  }

 private:
  using Ring = std::vector<int>;
  using Side = std::array<int, 2>;

  [[nodiscard]] Vector2d Flat(int vertex) const { return frame_.FootOf(solid_.vertices()[vertex]); }

  [[nodiscard]] FacePart MakePart(const Ring& ring) const {
    FacePart part = frame_;
    std::vector<Vector2d> outline;
    for (const int vertex : ring) outline.push_back(Flat(vertex));
    part.SetOutline(outline);
    part.corners = ring;
    return part;
  }

  [[nodiscard]] FacePart MakeHull() const {
    FacePart hull = frame_;
    for (const Ring& ring : rings_)
      hull.corners.insert(hull.corners.end(), ring.begin(), ring.end());
    std::ranges::sort(hull.corners);
    const auto repeated = std::ranges::unique(hull.corners);
    hull.corners.erase(repeated.begin(), repeated.end());
    std::vector<Kernel::Point_2> points;
    for (const int vertex : hull.corners) {
      const Vector2d flat = Flat(vertex);
      points.emplace_back(flat.x(), flat.y());
    }
    std::vector<Kernel::Point_2> around;
    CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(around));
    std::vector<Vector2d> outline;
    for (const Kernel::Point_2& point : around) outline.emplace_back(point.x(), point.y());
    hull.SetOutline(outline);
    return hull;
  }

  /// Return the directed sides of all rings, with their rings.
  [[nodiscard]] std::map<Side, int> Sides() const {
    std::map<Side, int> sides;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const Ring& ring = rings_[r];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        sides[{ring[i], ring[(i + 1) % ring.size()]}] = static_cast<int>(r);
      }
    }
    return sides;
  }

  void JoinConvex() {
    for (bool joined = true; joined;) {
      joined = false;
      const std::map<Side, int> sides = Sides();
      for (const auto& [side, owner] : sides) {
        const auto other = sides.find({side[1], side[0]});
        if (other == sides.end() || other->second == owner) continue;
        Ring ring = Join(rings_[owner], rings_[other->second], side);
        if (!IsConvex(ring)) continue;
        rings_[owner] = std::move(ring);
        rings_.erase(rings_.begin() + other->second);
        joined = true;
        break;
      }
    }
  }

  /// Join two rings with a common side; sides that the union contains twice are dropped.
  static Ring Join(const Ring& a, const Ring& b, const Side& side) {
    const auto from = [](const Ring& ring, int vertex) {
      Ring turned = ring;
      std::rotate(turned.begin(), std::ranges::find(turned, vertex), turned.end());
      return turned;
    };
    // side[1] … side[0] of a, then side[0] … side[1] of b without its ends.
    Ring ring = from(a, side[1]);
    const Ring rest = from(b, side[0]);
    ring.insert(ring.end(), rest.begin() + 1, rest.end() - 1);
    // If the rings share more than one side, the joined ring visits the vertices between twice.
    for (bool spike = true; spike && ring.size() > 3;) {
      spike = false;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t n = ring.size();
        if (ring[i] != ring[(i + 2) % n]) continue;
        const int gone = ring[(i + 1) % n];
        const int twice = ring[i];
        std::erase(ring, gone);
        ring.erase(std::ranges::find(ring, twice));
        spike = true;
        break;
      }
    }
    return ring;
  }

  [[nodiscard]] bool IsConvex(const Ring& ring) const {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vector2d a = Flat(ring[i]);
      const Vector2d b = Flat(ring[(i + 1) % n]);
      const Vector2d c = Flat(ring[(i + 2) % n]);
      const Vector2d ab = b - a;
      const Vector2d bc = c - b;
      const double cross = ab.x() * bc.y() - ab.y() * bc.x();
      if (cross < -kStraight * ab.norm() * bc.norm()) return false;
    }
    return true;
  }

  const object::Polyhedron& solid_;
  FacePart frame_;
  std::vector<Ring> rings_;
};

}  // namespace

void FacePart::SetOutline(const std::vector<Vector2d>& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d to_next = outline[(i + 1) % outline.size()] - outline[i];
    const double length = to_next.norm();
    const Vector2d along = to_next / length;
    sides.push_back({outline[i], along, {along.y(), -along.x()}, length});
  }
}

std::vector<Vector2d> FacePart::outline() const {
  std::vector<Vector2d> points;
  for (const Side& side : sides) points.push_back(side.from);
  return points;
}

FacePart PointPart(const FacePart& part, const Vector3d& contact) {
  return {part.face, contact, part.normal, part.u, part.v, {}, {}};
}

FaceParts SplitFaces(const object::Polyhedron& solid) {
  FaceParts parts;
  for (FaceIndex face{0}; face < solid.face_count(); ++face) {
    parts.first.emplace_back(static_cast<int>(parts.parts.size()));
    FaceSplitter(solid, face).Split(parts);
  }
  parts.first.emplace_back(static_cast<int>(parts.parts.size()));
  return parts;
}

}  // namespace regrasp::polyhedron
