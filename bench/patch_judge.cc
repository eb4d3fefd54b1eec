#include "bench/patch_judge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>

#include "planner/object/closest_on_segment.h"

namespace regrasp {

namespace {

using Eigen::Vector3d;
using object::TriangleIndex;
using Triangle = std::array<Vector3d, 3>;

/// Pieces at the rim are no longer than this share of the radius: the mean is then right to about a
/// degree.
constexpr double kPiece = 0.05;

Vector3d DoubleArea(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

Vector3d ClosestIn(const Triangle& t, const Vector3d& p) {
  const Vector3d n = DoubleArea(t);
  const Vector3d on_plane = p - n * (n.dot(p - t[0]) / n.squaredNorm());
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &a = t[k], &b = t[(k + 1) % 3];
    inside = inside && n.dot((b - a).cross(on_plane - a)) >= 0;
  }
  if (inside) return on_plane;
  Vector3d closest = t[0];
  for (int k = 0; k < 3; ++k) {
    const Vector3d on_side = object::ClosestOnSegment(t[k], t[(k + 1) % 3], p);
    if ((on_side - p).norm() < (closest - p).norm()) closest = on_side;
  }
  return closest;
}

/// Adds the areas of a triangle's pieces in a ball, each as a vector along its outward normal.
void AddPieces(const Triangle& t, const Vector3d& centre, double radius, Vector3d& sum) {
  if ((ClosestIn(t, centre) - centre).norm() > radius) return;
  int longest = 0;
  std::array<double, 3> length;
  for (int k = 0; k < 3; ++k) {
    length[k] = (t[(k + 1) % 3] - t[k]).norm();
    if (length[k] > length[longest]) longest = k;
  }
  const double farthest =
      std::max({(t[0] - centre).norm(), (t[1] - centre).norm(), (t[2] - centre).norm()});
  if (farthest <= radius) {
    sum += DoubleArea(t) / 2;
    return;
  }
  if (length[longest] <= kPiece * radius) {
    if (((t[0] + t[1] + t[2]) / 3 - centre).norm() <= radius) sum += DoubleArea(t) / 2;
    return;
  }
  const Vector3d &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
  const Vector3d middle = (a + b) / 2;
  AddPieces({a, middle, c}, centre, radius, sum);
  AddPieces({middle, b, c}, centre, radius, sum);
}

Triangle CornersOf(const object::Polyhedron& solid, TriangleIndex t) {
  const auto& [a, b, c] = solid.triangles()[t];
  return {solid.vertices()[a], solid.vertices()[b], solid.vertices()[c]};
}

}  // namespace

PatchJudge::PatchJudge(const object::Polyhedron& solid, double radius)
    : solid_(solid), radius_(radius), triangles_of_vertex_(solid.vertices().size()) {
  for (TriangleIndex t{0}; t < std::ssize(solid.triangles()); ++t) {
    for (const int v : solid.triangles()[t]) triangles_of_vertex_[v].push_back(t);
  }
}

double PatchJudge::DistanceTo(TriangleIndex t, const Vector3d& p) const {
  return (ClosestIn(CornersOf(solid_, t), p) - p).norm();
}

TriangleIndex PatchJudge::TriangleUnder(const grasp::Contact& contact) const {
  return *std::ranges::min_element(solid_.TrianglesOf(contact.face), {},
                                   [&](TriangleIndex t) { return DistanceTo(t, contact.p); });
}

Vector3d PatchJudge::MeanNormal(const grasp::Contact& contact) const {
  std::vector<TriangleIndex> stack = {TriangleUnder(contact)};
  std::set<TriangleIndex> seen(stack.begin(), stack.end());
  Vector3d sum = Vector3d::Zero();
  while (!stack.empty()) {
    const TriangleIndex t = stack.back();
    stack.pop_back();
    AddPieces(CornersOf(solid_, t), contact.p, radius_, sum);
    const auto& corners = solid_.triangles()[t];
    for (int k = 0; k < 3; ++k) {
      const int from = corners[k], to = corners[(k + 1) % 3];
      const Vector3d at =
          object::ClosestOnSegment(solid_.vertices()[from], solid_.vertices()[to], contact.p);
      if ((at - contact.p).norm() > radius_) continue;  // the way across it leaves the ball
      for (const TriangleIndex next : triangles_of_vertex_[from]) {
        const bool is_across = std::ranges::count(solid_.triangles()[next], to) > 0;
        if (is_across && seen.insert(next).second) stack.push_back(next);
      }
    }
  }
  return -sum.normalized();
}

grasp::Grasp PatchJudge::WithMeanNormals(const grasp::Grasp& grasp) const {
  grasp::Grasp felt = grasp;
  for (grasp::Contact& contact : felt) contact.n = MeanNormal(contact);
  return felt;
}

}  // namespace regrasp
