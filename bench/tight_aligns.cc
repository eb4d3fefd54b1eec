#include "bench/tight_aligns.h"

#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/plan/check.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp {

namespace {

using Eigen::Vector3d;

class TightDraw {
 public:
  TightDraw(const Object& object, double half_angle, std::uint64_t seed)
      : object_(object),
        half_angle_(half_angle),
        random_(seed, RandomUse::kStart),
        source_(object) {}

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
  [[nodiscard]] Grasp DrawGrasp() {
    Grasp grasp;
    for (int i = 0; i < (object_.dimension() == 3 ? 5 : 3); ++i) {
      grasp.push_back(source_.Draw(random_));
    }
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
  SurfaceSampler source_;
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
