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
  TightDraw(const object::Object& object, double half_angle, std::uint64_t seed)
      : object_(object),
        half_angle_(half_angle),
        random_(seed, RandomUse::kStart),
        source_(object) {}

  [[nodiscard]] plan::Plan Draw() {
    for (;;) {
      const grasp::Grasp from = DrawGrasp();
      if (!IsTight(from)) continue;
      const grasp::Grasp to = Moved(from);
      if (!IsTight(to)) continue;
      plan::Plan plan = PlanOf(from, to);
      if (plan::CheckPlan(object_, plan).passed()) return plan;
    }
  }

 private:
  [[nodiscard]] grasp::Grasp DrawGrasp() {
    grasp::Grasp grasp;
    for (int i = 0; i < (object_.dimension() == 3 ? 5 : 3); ++i) {
      grasp.push_back(source_.Draw(random_));
    }
    return grasp;
  }

  [[nodiscard]] bool IsTight(const grasp::Grasp& grasp) const {
    const object::WrenchFrame frame = object_.wrench_frame();
    if (!grasp::QualityAtLeast(grasp, frame, half_angle_, kTightQuality)) return false;
    for (std::size_t k = 0; k < grasp.size(); ++k) {
      grasp::Grasp others = grasp;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      if (grasp::IsForceClosure(others, frame, half_angle_)) return false;
    }
    return true;
  }

  [[nodiscard]] grasp::Grasp Moved(const grasp::Grasp& grasp) {
    grasp::Grasp moved = grasp;
    for (grasp::Contact& contact : moved) {
      const auto number = [&] { return 2 * random_.Uniform() - 1; };
      Vector3d way(number(), number(), object_.dimension() == 3 ? number() : 0);
      way -= way.dot(contact.n) * contact.n;
      contact.p =
          object_.ClosestPoint(contact.face, contact.p + kTightMove * object_.diameter() * way);
    }
    return moved;
  }

  [[nodiscard]] plan::Plan PlanOf(const grasp::Grasp& from, const grasp::Grasp& to) const {
    plan::Plan plan;
    plan.dimension = object_.dimension();
    plan.half_angle = half_angle_;
    plan.fingers = static_cast<int>(from.size());
    plan.initial = plan::FingersInOrder(from);
    plan.steps.emplace_back(plan::Align{{plan.initial, plan::FingersInOrder(to)}});
    plan.goal = to;
    return plan;
  }

  const object::Object& object_;
  double half_angle_;
  RandomStream random_;
  sampling::SurfaceSampler source_;
};

}  // namespace

std::vector<plan::Plan> DrawTightAligns(const object::Object& object, double half_angle, int count,
                                        std::uint64_t seed) {
  TightDraw draw(object, half_angle, seed);
  std::vector<plan::Plan> plans;
  while (static_cast<int>(plans.size()) < count) plans.push_back(draw.Draw());
  return plans;
}

}  // namespace regrasp
