#include "planner/plan/locate_grasps.h"

#include <stdexcept>
#include <string>

#include "planner/base/in_blocks.h"
#include "planner/plan/locate.h"
#include "planner/plan/surface_tolerance.h"

namespace regrasp::plan {
namespace {

constexpr std::size_t kBlock = 256;  // grasps that a thread takes at a time

using Vector = Eigen::Map<Eigen::Vector3d>;

/// The contact of a point alone; nullopt off the surface and on borders.
LocatedContact LocatePoint(const object::Object& object, const Eigen::Vector3d& point) {
  const double tolerance = SurfaceTolerance(object);
  const std::vector<FaceIndex> faces = object.FacesNear(point, tolerance);
  if (faces.empty()) return {{point, {}}, Reason::kOffSurface, ""};
  const FaceIndex face = faces.front();
  if (faces.size() > 1 || object.DistanceToBorder(face, point) <= tolerance) {
    return {{point, {}}, Reason::kWrongNormal, ""};
  }
  return {{object.ClosestPoint(face, point), object.inward_normal(face), face}, Reason::kNone, ""};
}

bool Coincide(std::span<const double> points, double tolerance) {
  for (std::size_t i = 0; i < points.size(); i += 3) {
    for (std::size_t j = 0; j < i; j += 3) {
      const auto apart = Eigen::Vector3d::Map(&points[i]) - Eigen::Vector3d::Map(&points[j]);
      if (apart.norm() <= tolerance) return true;
    }
  }
  return false;
}

}  // namespace

LocatedGrasps LocateGrasps(const object::Object& object, std::span<const double> points,
                           std::span<const double> normals, int contacts, int threads) {
  const bool has_normals = !normals.empty();
  if (contacts < 1 || points.size() % (3 * static_cast<std::size_t>(contacts)) != 0 ||
      (has_normals && normals.size() != points.size())) {
    throw std::invalid_argument(std::to_string(points.size()) + " and " +
                                std::to_string(normals.size()) + " values for grasps of " +
                                std::to_string(contacts) + " contacts");
  }
  const auto k = static_cast<std::size_t>(contacts);
  const double tolerance = object::kPointTolerance * object.diameter();
  LocatedGrasps located;
  located.points.assign(points.begin(), points.end());
  located.normals.assign(normals.begin(), normals.end());
  located.normals.resize(points.size());
  located.reasons.resize(points.size() / (3 * k));
  located.contacts.resize(located.reasons.size(), -1);
  InBlocks(located.reasons.size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t grasp = begin; grasp < end; ++grasp) {
      for (std::size_t c = 0; c < k && located.reasons[grasp] == Reason::kNone; ++c) {
        const std::size_t at = 3 * (grasp * k + c);
        Vector p(&located.points[at]), n(&located.normals[at]);
        const LocatedContact found =
            has_normals ? LocateContact(object, {p, n}) : LocatePoint(object, p);
        located.reasons[grasp] = found.reason;
        p = found.contact.p;
        n = found.contact.n;
        if (found.reason == Reason::kNone && object.IsEnclosed(found.contact.face)) {
          located.reasons[grasp] = Reason::kUnreachable;
        }
        if (located.reasons[grasp] != Reason::kNone) located.contacts[grasp] = static_cast<int>(c);
      }
      const auto own = std::span(located.points).subspan(3 * grasp * k, 3 * k);
      if (located.reasons[grasp] == Reason::kNone && Coincide(own, tolerance)) {
        located.reasons[grasp] = Reason::kCoincidentFingers;
      }
    }
  });
  return located;
}

}  // namespace regrasp::plan
