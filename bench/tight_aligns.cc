#include "bench/tight_aligns.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/plan/clearance.h"
#include "planner/roadmap/surface_sample.h"

namespace regrasp {

namespace {

using Eigen::Vector3d;

Contact DrawOnEdges(const Polygon& polygon, RandomStream& random) {
  double length = 0;
  for (int edge = 0; edge < polygon.face_count(); ++edge) length += polygon.face_measure(edge);
  double left = random.Uniform() * length;
  int edge = 0;
  while (edge + 1 < polygon.face_count() && left > polygon.face_measure(edge)) {
    left -= polygon.face_measure(edge++);
  }
  const auto [from, to] = polygon.edge(edge);
  const double share = random.Uniform();
  return {(1 - share) * from + share * to, polygon.inward_normal(edge), edge};
}

class TightDraw {
 public:
  TightDraw(const Object& object, double half_angle, std::uint64_t seed)
      : object_(object), half_angle_(half_angle), random_(seed, RandomUse::kStart) {
    if (const auto* solid = dynamic_cast<const Polyhedron*>(&object)) {
      sampler_ = std::make_unique<SurfaceSampler>(*solid);
    }
  }

  [[nodiscard]] Plan Draw() {
    for (;;) {
      const Grasp from = DrawGrasp();
      if (!IsTight(from)) continue;
      const Grasp to = Moved(from);
      if (!IsTight(to)) continue;
      Plan plan = PlanOf(from, to);
      if (CheckPlan(object_, plan).passed()) return plan;
    }
  }

 private:
  [[nodiscard]] Contact DrawContact() {
    for (;;) {
      const Contact contact = sampler_
                                  ? sampler_->Draw(random_)
                                  : DrawOnEdges(dynamic_cast<const Polygon&>(object_), random_);
      if (HasStandingRoom(object_, contact)) return contact;
    }
  }

  [[nodiscard]] Grasp DrawGrasp() {
    Grasp grasp;
    for (int i = 0; i < (object_.dimension() == 3 ? 5 : 3); ++i) grasp.push_back(DrawContact());
    return grasp;
  }

  [[nodiscard]] bool IsTight(const Grasp& grasp) const {
    const WrenchFrame frame = object_.wrench_frame();
    if (!QualityAtLeast(grasp, frame, half_angle_, kTightQuality)) return false;
    for (std::size_t k = 0; k < grasp.size(); ++k) {
      Grasp others = grasp;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      if (IsForceClosure(others, frame, half_angle_)) return false;
    }
    return true;
  }

  [[nodiscard]] Grasp Moved(const Grasp& grasp) {
    Grasp moved = grasp;
    for (Contact& contact : moved) {
      const auto number = [&] { return 2 * random_.Uniform() - 1; };
      Vector3d way(number(), number(), object_.dimension() == 3 ? number() : 0);
      way -= way.dot(contact.n) * contact.n;
      contact.p =
          object_.ClosestPoint(contact.face, contact.p + kTightMove * object_.diameter() * way);
    }
    return moved;
  }

  [[nodiscard]] Plan PlanOf(const Grasp& from, const Grasp& to) const {
    Plan plan;
    plan.dimension = object_.dimension();
    plan.half_angle = half_angle_;
    plan.fingers = static_cast<int>(from.size());
    FingerGrasp target;
    for (int finger = 0; finger < plan.fingers; ++finger) {
      plan.initial.push_back({finger, from[finger]});
      target.push_back({finger, to[finger]});
    }
    plan.steps.emplace_back(Align{{plan.initial, target}});
    plan.goal = to;
    return plan;
  }

  const Object& object_;
  double half_angle_;
  RandomStream random_;
  std::unique_ptr<SurfaceSampler> sampler_;
};

}  // namespace

std::vector<Plan> DrawTightAligns(const Object& object, double half_angle, int count,
                                  std::uint64_t seed) {
  TightDraw draw(object, half_angle, seed);
  std::vector<Plan> plans;
  while (static_cast<int>(plans.size()) < count) plans.push_back(draw.Draw());
  return plans;
}

}  // namespace regrasp
