#include "planner/sampling/draw_grasp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/base/number.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::sampling {

namespace {

struct Direction {
  double angle;  ///< in (−π, π]
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
