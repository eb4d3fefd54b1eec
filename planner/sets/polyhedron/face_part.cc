#include "planner/sets/polyhedron/face_part.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "planner/sets/polyhedron/focus_cells.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

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
