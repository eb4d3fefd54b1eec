#include "tests/planner/registry/planner_laws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "planner/base/number.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "planner/sets/set_parameters.h"
#include "tests/fixtures/counted_deadline.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/moved.h"
#include "tests/fixtures/plan_with.h"

namespace regrasp::registry {
namespace {

using planning::GraspChoice;
using planning::Planner;
using planning::PlanRequest;
using planning::PlanResult;
using Status = PlanResult::Status;

constexpr double kDegrees = 15;
constexpr std::uint64_t kSeeds = 3;

/// Quality that no grasp has at this friction.
constexpr double kNoGraspsQuality = 0.9;

/// Accuracy of margins, radians.
constexpr double kMarginTolerance = 1e-6;

/// Return a request for a planner, with a small roadmap.
PlanRequest Ask(const Planner& planner, std::uint64_t seed = 0, double degrees = kDegrees) {
  PlanRequest request = RequestAt(degrees, seed);
  if (std::ranges::count(planner.traits().options, roadmap::kContactsOption) > 0) {
    request.parameters = roadmap::RoadmapParameters{.contact_points = 24};
  }
  return request;
}

/// Start and goal of a plan between random grasps of the planner.
struct Ends {
  grasp::Grasp start;
  grasp::Grasp goal;
};

std::optional<Ends> DrawEnds(const Planner& planner, const object::Object& object,
                             std::uint64_t seed) {
  const PlanResult result = PlanWith(planner, object, Random(), Random(), Ask(planner, seed));
  if (!result.plan) return std::nullopt;
  return Ends{plan::ContactsOf(result.plan->initial), result.plan->goal};
}

/// Return why the checker rejects a plan; empty if it accepts it.
std::string CheckersReason(const object::Object& object, const plan::Plan& plan,
                           const Ends* ends = nullptr) {
  plan::CheckOptions options;
  if (ends != nullptr) {
    options.start = &ends->start;
    options.goal = &ends->goal;
  }
  const plan::PlanCheck check = plan::CheckPlan(object, plan, options);
  for (const plan::StepCheck& step : check.steps) {
    if (step.reason == plan::Reason::kNone) continue;
    return "step " + std::to_string(step.index) + ": " +
           std::string(plan::ReasonName(step.reason)) + ": " + step.detail;
  }
  return check.passed() ? "" : "not passed";
}

/// Return why a result is not a plan that the checker accepts; empty if it is one.
std::string WhyNoGoodPlan(const object::Object& object, const PlanResult& result,
                          const Ends* ends = nullptr) {
  if (result.status != Status::kFound || !result.plan) return "no plan: " + result.message;
  return CheckersReason(object, *result.plan, ends);
}

/// Return why the signature of a plan is wrong: its planner and object; empty if it is correct.
std::string SignatureBreach(const Planner& planner, const object::Object& object,
                            const plan::Plan& plan) {
  if (plan.planner != planner.name()) return "made by " + plan.planner;
  if (plan.dimension != object.dimension()) return "of another dimension";
  if (plan.fingers != planner.ScopeIn(object.dimension())->fingers) return "for another hand";
  return plan.friction_angle == Radians(kDegrees) ? "" : "for another friction";
}

/// Return the first breach that `breach(seed)` finds.
template <class Breach>
std::string ForSeeds(const Breach& breach) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    if (const std::string found = breach(seed); !found.empty()) {
      return "seed " + std::to_string(seed) + ": " + found;
    }
  }
  return "";
}

/// Return the first breach that `breach(ends)` finds for the ends of several seeds.
template <class Breach>
std::string ForEnds(const Planner& planner, const object::Object& object, const Breach& breach) {
  return ForSeeds([&](std::uint64_t seed) -> std::string {
    const auto ends = DrawEnds(planner, object, seed);
    return ends ? breach(*ends) : "no start and goal could be drawn";
  });
}

std::string PlansPassTheChecker(const Planner& planner, const object::Object& object) {
  return ForSeeds([&](std::uint64_t seed) {
    const PlanRequest request = Ask(planner, seed);
    const PlanResult result = PlanWith(planner, object, Random(), Random(), request);
    if (const std::string why = WhyNoGoodPlan(object, result); !why.empty()) return why;
    const PlanResult any = PlanWith(planner, object, RandomAny(), RandomAny(), request);
    if (any.plan) {
      if (const std::string why = CheckersReason(object, *any.plan); !why.empty()) return why;
    }
    return SignatureBreach(planner, object, *result.plan);
  });
}

std::string GivenGraspsAreTheEnds(const Planner& planner, const object::Object& object) {
  return ForEnds(planner, object, [&](const Ends& ends) -> std::string {
    const PlanResult result =
        PlanWith(planner, object, Given(ends.start), Given(ends.goal), Ask(planner));
    if (const std::string why = WhyNoGoodPlan(object, result, &ends); !why.empty()) return why;
    for (std::size_t i = 0; i < ends.start.size(); ++i) {
      const plan::FingerContact& held = result.plan->initial.at(i);
      if (held.finger != static_cast<int>(i)) return "fingers are not numbered in order";
      if (held.contact.p != ends.start[i].p) return "another contact than the start's";
    }
    return "";
  });
}

std::string TheSameRequestGivesTheSameBytes(const Planner& planner, const object::Object& object) {
  const auto plan = [&](std::uint64_t seed) {
    return plan::FormatPlan(
        PlanWith(planner, object, Random(), Random(), Ask(planner, seed)).plan.value());
  };
  if (plan(3) != plan(3)) return "two plans of one seed";
  return plan(3) == plan(4) ? "one plan of two seeds" : "";
}

std::string AGoalThatIsTheStartTakesNoSteps(const Planner& planner, const object::Object& object) {
  return ForEnds(planner, object, [&](Ends ends) -> std::string {
    ends.goal = {ends.start.rbegin(), ends.start.rend()};
    const PlanResult result =
        PlanWith(planner, object, Given(ends.start), Given(ends.goal), Ask(planner));
    if (const std::string why = WhyNoGoodPlan(object, result, &ends); !why.empty()) return why;
    return result.plan->steps.empty() ? "" : std::to_string(result.plan->steps.size()) + " steps";
  });
}

std::string TheMarginIsTheSmallestAtRest(const Planner& planner, const object::Object& object) {
  return ForSeeds([&](std::uint64_t seed) -> std::string {
    const PlanResult result = PlanWith(planner, object, Random(), Random(), Ask(planner, seed));
    if (!result.plan) return "no plan";
    double smallest = std::numeric_limits<double>::infinity();
    for (const grasp::Grasp& grasp : RestsOf(*result.plan)) {
      const auto required = grasp::ComputeRequiredFrictionAngle(grasp, object.wrench_frame());
      smallest = std::min(smallest, Radians(kDegrees) - required.value().upper);
    }
    if (std::abs(result.margin - smallest) <= kMarginTolerance) return "";
    return "margin " + std::to_string(result.margin) + ", found " + std::to_string(smallest);
  });
}

/// Check that a plan has warnings if and only if a grasp is below the quality.
std::string WarningsBreach(const object::Object& object, const PlanResult& result, double quality) {
  if (!result.plan) return "no plan: " + result.message;
  const bool good = std::ranges::all_of(RestsOf(*result.plan), [&](const grasp::Grasp& grasp) {
    return grasp::QualityAtLeast(grasp, object.wrench_frame(), Radians(kDegrees), quality);
  });
  if (good == result.warnings.empty()) return "";
  return good ? "a warning, and all grasps are good" : "no warning of a weak grasp";
}

std::string WarnsOfGraspsBelowTheQuality(const Planner& planner, const object::Object& object) {
  PlanRequest request = Ask(planner);
  const std::string breach = ForSeeds([&](std::uint64_t seed) {
    request.seed = seed;
    return WarningsBreach(object, PlanWith(planner, object, Random(), Random(), request),
                          request.criteria.min_quality);
  });
  if (!breach.empty()) return breach;
  const auto ends = DrawEnds(planner, object, 0);
  request.criteria.min_quality = kNoGraspsQuality;
  return WarningsBreach(object,
                        PlanWith(planner, object, Given(ends->start), Given(ends->goal), request),
                        kNoGraspsQuality);
}

/// Check that the random start and goal of a plan have a quality.
std::string DrawnQualityBreach(const object::Object& object, const PlanResult& result,
                               double quality) {
  if (!result.plan) return "no plan: " + result.message;
  for (const grasp::Grasp& grasp : {plan::ContactsOf(result.plan->initial), result.plan->goal}) {
    if (!grasp::QualityAtLeast(grasp, object.wrench_frame(), Radians(kDegrees), quality)) {
      return "drew a grasp below " + std::to_string(quality);
    }
  }
  return "";
}

std::string DrawsNoGraspBelowTheQuality(const Planner& planner, const object::Object& object) {
  constexpr double kSomeGraspsQuality = 0.05;
  for (const GraspChoice& choice : {Random(), RandomAny()}) {
    PlanRequest request = Ask(planner, 9);
    request.criteria.min_quality = kSomeGraspsQuality;
    const PlanResult some = PlanWith(planner, object, choice, choice, request);
    // Grasps drawn over the whole surface may be in no set of the planner, or not be connected.
    if (some.plan || choice.kind == GraspChoice::Kind::kRandom) {
      const std::string breach = DrawnQualityBreach(object, some, kSomeGraspsQuality);
      if (!breach.empty()) return choice.name + ": " + breach;
    }
    request.criteria.min_quality = kNoGraspsQuality;
    const PlanResult none = PlanWith(planner, object, choice, choice, request);
    if (none.status != Status::kNoGrasp || none.plan) return "found a grasp";
    if (!none.message.starts_with(choice.name)) return "the message is: " + none.message;
  }
  return "";
}

std::string MovesWithTheObjectAtEveryScale(const Planner& planner, const object::Object& object) {
  return ForEnds(planner, object, [&](const Ends& ends) -> std::string {
    for (const double unit : {1.0, 1000.0}) {
      const Eigen::Affine3d motion = MotionAndUnit(unit, object.dimension());
      const auto moved = Moved(object, motion);
      const Ends there = {Moved(ends.start, motion), Moved(ends.goal, motion)};
      const std::string why = WhyNoGoodPlan(
          *moved, PlanWith(planner, *moved, Given(there.start), Given(there.goal), Ask(planner)),
          &there);
      if (!why.empty()) return "unit " + std::to_string(unit) + ": " + why;
    }
    return "";
  });
}

std::string TheOrderOfContactsDoesNotMatter(const Planner& planner, const object::Object& object) {
  return ForEnds(planner, object, [&](Ends ends) {
    std::ranges::reverse(ends.start);
    std::ranges::rotate(ends.goal, ends.goal.begin() + 1);
    return WhyNoGoodPlan(
        object, PlanWith(planner, object, Given(ends.start), Given(ends.goal), Ask(planner)),
        &ends);
  });
}

std::string MoreFrictionLosesNoPlan(const Planner& planner, const object::Object& object) {
  return ForEnds(planner, object, [&](const Ends& ends) -> std::string {
    for (const double more : {1.0, 5.0, 15.0, 30.0}) {
      const std::string why =
          WhyNoGoodPlan(object,
                        PlanWith(planner, object, Given(ends.start), Given(ends.goal),
                                 Ask(planner, 0, kDegrees + more)),
                        &ends);
      if (!why.empty()) return std::to_string(kDegrees + more) + " degrees: " + why;
    }
    return "";
  });
}

/// Check that whenever the deadline passes, the planner reports it. The exception is a planner that
/// already has a plan and is improving it.
std::string EndsAtItsDeadline(const Planner& planner, const object::Object& object) {
  PlanRequest request = Ask(planner, 1);
  const CountedDeadline never;
  request.deadline = never.deadline();
  if (!PlanWith(planner, object, Random(), Random(), request).plan) return "no plan";
  if (never.looks() < 2) return "never looks at it";
  for (int look = 1; look <= never.looks(); look += 1 + look / 2) {
    const CountedDeadline counted(look);
    request.deadline = counted.deadline();
    const PlanResult result = PlanWith(planner, object, Random(), Random(), request);
    if (look == 1 && result.plan) return "a plan, and there was no time";
    if (counted.looks() < look) return "came to another end";
    const std::string up = "planner " + planner.name() + ": time limit reached";
    if (!result.plan && result.message.find(up) == std::string::npos) {
      return "at look " + std::to_string(look) + ": " + result.message;
    }
    if (result.plan) {
      if (const std::string why = CheckersReason(object, *result.plan); !why.empty()) return why;
    }
  }
  return "";
}

/// @param object  that is planned for.
PlanRequest Asking(const std::string& option, const object::Object& object, PlanRequest request) {
  using roadmap::RoadmapParameters;
  // A request for each option. Others do not change plans: --hand (gait/gait_planner_test.cc),
  // --contacts given, and options of graphs.
  const std::map<std::string, std::function<void()>> changes = {
      {planning::kMarginOption, [&] { request.objective = planning::Objective::kMargin; }},
      {planning::kTravelOption, [&] { request.objective = planning::Objective::kTravel; }},
      {planning::kRegionsOption, [&] { request.objective = planning::Objective::kRegions; }},
      {sets::kUniformSpanningOption,
       [&] { request.parameters = sets::SetParameters{planning::Spanning::kUniform}; }},
      {roadmap::kContactsOption,
       [&] { request.parameters = RoadmapParameters{.contact_points = 30}; }},
      {roadmap::kClustersOption,
       [&] { request.parameters = RoadmapParameters{.contact_points = 200, .clusters = 20}; }},
      {roadmap::kNoLastResortOption,
       [&] {
         request.parameters =
             RoadmapParameters{.contact_points = 200, .clusters = 20, .last_resort = false};
       }},
      {planning::kBudgetOption,
       [&] { request.parameters.Edit<planning::SearchParameters>().budget = 100'000; }},
      {planning::kExplainOption,
       [&] { request.parameters.Edit<planning::SearchParameters>().explain = true; }},
      {planning::kSoftFingersOption, [&] {
         // Contacts in the plane have none.
         if (object.dimension() == 3) request.hand.torsion = 0.05 * object.diameter();
       }}};
  const auto change = changes.find(option);
  if (change != changes.end()) change->second();
  return request;
}

std::string PlansOfEveryOptionPassTheChecker(const Planner& planner, const object::Object& object) {
  for (const std::string& option : planner.traits().options) {
    int plans = 0;
    const std::string breach = ForSeeds([&](std::uint64_t seed) -> std::string {
      const PlanResult result =
          PlanWith(planner, object, Random(), Random(), Asking(option, object, Ask(planner, seed)));
      if (!result.plan) return "";
      ++plans;
      return CheckersReason(object, *result.plan);
    });
    if (!breach.empty()) return option + ", " + breach;
    if (plans == 0) return option + ": no plan";
  }
  return "";
}

std::string PlansAreForTheHand(const Planner& planner, const object::Object& object) {
  int plans = 0;
  const std::string breach = ForSeeds([&](std::uint64_t seed) -> std::string {
    PlanRequest request = Ask(planner, seed);
    request.hand.fingers = planner.ScopeIn(object.dimension())->fingers + 1;
    request.hand.fingertip_radius = 0.04 * object.diameter();
    const PlanResult result = PlanWith(planner, object, Random(), Random(), request);
    if (!result.plan) return "";  // thick fingers reach less
    ++plans;
    if (result.plan->fingers != request.hand.fingers) return "another number of fingers";
    if (result.plan->finger_radius != request.hand.fingertip_radius) return "another radius";
    return CheckersReason(object, *result.plan);
  });
  return breach.empty() && plans == 0 ? "no plan" : breach;
}

}  // namespace

const std::vector<PlannerLaw>& PlannerLaws() {
  static const std::vector<PlannerLaw> laws = {
      {"PlansPassTheChecker", PlansPassTheChecker},
      {"GivenGraspsAreTheEnds", GivenGraspsAreTheEnds},
      {"TheSameRequestGivesTheSameBytes", TheSameRequestGivesTheSameBytes},
      {"AGoalThatIsTheStartTakesNoSteps", AGoalThatIsTheStartTakesNoSteps},
      {"TheMarginIsTheSmallestAtRest", TheMarginIsTheSmallestAtRest},
      {"WarnsOfGraspsBelowTheQuality", WarnsOfGraspsBelowTheQuality},
      {"DrawsNoGraspBelowTheQuality", DrawsNoGraspBelowTheQuality},
      {"MovesWithTheObjectAtEveryScale", MovesWithTheObjectAtEveryScale},
      {"TheOrderOfContactsDoesNotMatter", TheOrderOfContactsDoesNotMatter},
      {"MoreFrictionLosesNoPlan", MoreFrictionLosesNoPlan},
      {"EndsAtItsDeadline", EndsAtItsDeadline},
      {"PlansOfEveryOptionPassTheChecker", PlansOfEveryOptionPassTheChecker},
      {"PlansAreForTheHand", PlansAreForTheHand}};
  return laws;
}

}  // namespace regrasp::registry
