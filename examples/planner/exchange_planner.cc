// Planner template that exchanges the contacts of the start grasp for those of the goal one by one.
// exchange_planner OBJECT [SEED]
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/object/object.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"

using namespace regrasp;

/// Parameters of this planner alone, in PlanRequest::parameters. Other planners refuse "--orders".
struct ExchangeParameters {
  int most_orders = 120;  ///< number of orders that are tested
  [[nodiscard]] std::vector<std::string> Options() const {
    if (most_orders == ExchangeParameters().most_orders) return {};
    return {"--orders"};
  }
};

/// Tries all orders of exchanging contact k of the start for contact k of the goal. A placed finger
/// keeps force closure; the grasp after the release of another one is tested.
class ExchangePlanner final : public planning::Planner {
 public:
  ExchangePlanner()
      : Planner({.name = "exchange",
                 .what = "exchanges contacts one by one",
                 .in_space = planning::PlannerScope{5, {4, 4}, {4, 4}},
                 .options = {"--orders"},
                 .has_graph = false}) {}

  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override {
    std::vector<int> order(request.start.grasp.size());
    std::iota(order.begin(), order.end(), 0);
    planning::PlanResult result;
    int left = request.parameters.Get<ExchangeParameters>().most_orders;
    do {
      if (auto plan = Exchange(request, order)) {
        result.plan = std::move(plan);
        return result;
      }
    } while (--left > 0 && std::ranges::next_permutation(order).found);
    result.status = planning::PlanResult::Status::kNoSequence;
    result.message = "no order of exchanges keeps force closure";
    return result;
  }

 private:
  static std::optional<plan::Plan> Exchange(const planning::PlanRequest& request,
                                            const std::vector<int>& order) {
    plan::Plan plan;
    plan.friction_angle = request.criteria.friction_angle;
    plan.fingers = static_cast<int>(order.size()) + 1;
    plan.planner = "exchange";
    plan.initial = plan::FingersInOrder(request.start.grasp);
    plan.goal = request.goal.grasp;
    FingerIndex free(static_cast<int>(order.size()));
    plan::FingerGrasp held = plan.initial;
    for (const int k : order) {
      const plan::Switch exchange{{{free, request.goal.grasp[k]}}, {plan.initial[k].finger}};
      held = plan::GraspAfter(held, exchange);
      if (!grasp::IsForceClosure(plan::ContactsOf(held), request.object->wrench_frame(),
                                 plan.friction_angle)) {
        return std::nullopt;
      }
      free = plan.initial[k].finger;
      plan.steps.emplace_back(exchange);
    }
    return plan;
  }
};

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: exchange_planner OBJECT [SEED]\n";
    return 2;
  }
  try {
    registry::RegisterPlanner(std::make_unique<ExchangePlanner>());
    const object::ObjectFile file = object::ReadObject(argv[1]);
    planning::PlanRequest request;
    request.object = file.object.get();
    request.object_name = file.file;
    request.criteria.friction_angle = Radians(25);
    request.start.kind = request.goal.kind = planning::GraspChoice::Kind::kRandomAny;
    request.seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
    request.parameters = ExchangeParameters{.most_orders = 24};
    const planning::PlanResult result =
        planning::Solve(registry::PlannerFor("exchange", request), request);
    std::cout << (result.plan ? std::to_string(result.plan->steps.size()) + " steps"
                              : "no plan found: " + result.message)
              << '\n';
    return result.plan ? 0 : 1;
  } catch (const InputError& error) {
    std::cerr << "exchange_planner: error: " << error.what() << '\n';
    return 2;
  }
}
