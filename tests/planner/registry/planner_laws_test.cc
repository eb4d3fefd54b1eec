#include "tests/planner/registry/planner_laws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <ostream>
#include <set>
#include <utility>

#include "planner/registry/registry.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"

namespace regrasp::registry {
namespace planner_laws_test {

using planning::Planner;
using planning::PlanRequest;
using planning::PlanResult;

/// Return an object for the laws.
const object::Object& Read(const std::string& model) {
  static std::map<std::string, object::ObjectFile> files;
  if (!files.contains(model)) files.emplace(model, ReadModel(model));
  return *files.at(model).object;
}
constexpr const char* kModels[] = {"polygon15.wkt", "polygon_hole.wkt", "stone.obj",
                                   "tetrahedron.obj"};

struct Case {
  const Planner* planner;
  PlannerLaw law;
};

std::string Name(const Case& of) { return of.planner->name() + "_" + of.law.name; }

void PrintTo(const Case& of, std::ostream* out) { *out << Name(of); }

std::vector<Case> AllCases() {
  std::vector<Case> cases;
  for (const Planner* planner : AllPlanners()) {
    if (planner->traits().needs_hand) continue;  // see gait_planner_test.cc
    for (const PlannerLaw& law : PlannerLaws()) cases.push_back({planner, law});
  }
  return cases;
}

class EveryPlanner : public testing::TestWithParam<Case> {};

TEST_P(EveryPlanner, Obeys) {
  const auto& [planner, law] = GetParam();
  int objects = 0;
  for (const char* model : kModels) {
    const object::Object& object = Read(model);
    if (!planner->ScopeIn(object.dimension())) continue;
    EXPECT_EQ(law.breach(*planner, object), "") << "on " << model;
    ++objects;
  }
  EXPECT_GE(objects, 2);
}

INSTANTIATE_TEST_SUITE_P(AllLaws, EveryPlanner, testing::ValuesIn(AllCases()),
                         [](const auto& test) { return Name(test.param); });

/// Planner that passes requests to a correct planner, and falsifies the request or the result.
class BadPlanner final : public Planner {
 public:
  using Task = std::function<PlanResult(const Planner& good, PlanRequest request)>;
  BadPlanner(const Planner& good, Task task)
      : Planner(good.traits()), good_(good), task_(std::move(task)) {}
  [[nodiscard]] PlanResult Plan(const PlanRequest& request) const override {
    return task_(good_, request);
  }

 private:
  const Planner& good_;
  Task task_;
};

struct BadCase {
  const char* name;
  const char* law;      ///< law that it breaks
  const char* planner;  ///< planner that it uses
  const char* found;    ///< expected breach
  BadPlanner::Task task;
};

PlanResult NoSequence() {
  PlanResult result;
  result.status = PlanResult::Status::kNoSequence;
  result.message = "none";
  return result;
}

PlanResult WithoutLastStep(PlanResult result) {
  if (result.plan && !result.plan->steps.empty()) result.plan->steps.pop_back();
  return result;
}

const std::vector<BadCase>& BadCases() {
  static const double diameter = Read("polygon15.wkt").diameter();
  static int plans = 0;
  static const std::vector<BadCase> cases = {
      {"StopsBeforeTheGoal", "PlansPassTheChecker", "general", "goal-not-reached",
       [](const Planner& good, PlanRequest request) {
         return WithoutLastStep(good.Plan(request));
       }},
      {"TakesMoreFrictionThanThereIs", "PlansPassTheChecker", "polygon", "not-force-closure",
       [](const Planner& good, PlanRequest request) {
         request.criteria.friction_angle *= 2;
         PlanResult result = good.Plan(request);
         if (result.plan) result.plan->friction_angle /= 2;
         return result;
       }},
      {"TakesTheStartsContactsInAnotherOrder", "GivenGraspsAreTheEnds", "general",
       "another contact than the start's",
       [](const Planner& good, PlanRequest request) {
         std::ranges::reverse(request.start.grasp);
         return good.Plan(request);
       }},
      {"GoesToAnotherGoal", "GivenGraspsAreTheEnds", "polygon", "goal-not-reached",
       [](const Planner& good, PlanRequest request) {
         if (request.goal.kind == planning::GraspChoice::Kind::kGiven) request.goal = request.start;
         return good.Plan(request);
       }},
      {"CountsItsPlans", "TheSameRequestGivesTheSameBytes", "polygon", "two plans of one seed",
       [](const Planner& good, PlanRequest request) {
         request.seed += ++plans;
         return good.Plan(request);
       }},
      {"IgnoresTheSeed", "TheSameRequestGivesTheSameBytes", "polygon", "one plan of two seeds",
       [](const Planner& good, PlanRequest request) {
         request.seed = 0;
         return good.Plan(request);
       }},
      {"StaysInAlignsThatGoNowhere", "AGoalThatIsTheStartTakesNoSteps", "general", "1 steps",
       [](const Planner& good, PlanRequest request) {
         PlanResult result = good.Plan(request);
         if (result.plan) {
           const plan::FingerGrasp held = result.plan->initial;
           result.plan->steps.insert(result.plan->steps.begin(), plan::Align{{held, held}});
         }
         return result;
       }},
      {"PromisesMoreMargin", "TheMarginIsTheSmallestAtRest", "general", "margin ",
       [](const Planner& good, PlanRequest request) {
         PlanResult result = good.Plan(request);
         result.margin += 1e-4;
         return result;
       }},
      {"NeverWarns", "WarnsOfGraspsBelowTheQuality", "general", "no warning of a weak grasp",
       [](const Planner& good, PlanRequest request) {
         PlanResult result = good.Plan(request);
         result.warnings.clear();
         return result;
       }},
      {"AlwaysWarns", "WarnsOfGraspsBelowTheQuality", "general", "all grasps are good",
       [](const Planner& good, PlanRequest request) {
         PlanResult result = good.Plan(request);
         result.warnings.push_back("beware");
         return result;
       }},
      {"DrawsAnyGrasp", "DrawsNoGraspBelowTheQuality", "polygon", "drew a grasp below",
       [](const Planner& good, PlanRequest request) {
         request.criteria.min_quality = 0;
         return good.Plan(request);
       }},
      {"WorksOnSmallObjects", "MovesWithTheObjectAtEveryScale", "general", "unit 1000",
       [](const Planner& good, PlanRequest request) {
         return request.object->diameter() > 2 * diameter ? NoSequence() : good.Plan(request);
       }},
      {"WorksWhereTheObjectIs", "MovesWithTheObjectAtEveryScale", "general", "unit 1.0",
       [](const Planner& good, PlanRequest request) {
         const Eigen::Vector3d here = Read("polygon15.wkt").wrench_frame().origin;
         const double off = (request.object->wrench_frame().origin - here).norm();
         return off > 0.1 * diameter ? NoSequence() : good.Plan(request);
       }},
      {"LooksAtTheFirstContact", "TheOrderOfContactsDoesNotMatter", "general", "no plan: none",
       [](const Planner& good, PlanRequest request) {
         static std::set<double> seen;  // first contacts of random starts
         const double x = request.start.grasp.front().p.x();
         if (seen.empty()) seen.insert(x);
         return seen.contains(x) ? good.Plan(request) : NoSequence();
       }},
      {"SlipsOnMoreFriction", "MoreFrictionLosesNoPlan", "general", "45.0",
       [](const Planner& good, PlanRequest request) {
         return request.criteria.friction_angle > Radians(30) ? NoSequence() : good.Plan(request);
       }},
      {"NeverLooksAtItsDeadline", "EndsAtItsDeadline", "polygon", "never looks",
       [](const Planner& good, PlanRequest request) {
         request.deadline = {};
         return good.Plan(request);
       }},
      {"SaysNothingOfItsDeadline", "EndsAtItsDeadline", "polygon", "at look 1: none",
       [](const Planner& good, PlanRequest request) {
         try {
           return good.Plan(request);
         } catch (const TimeUp&) {
           return NoSequence();
         }
       }},
      {"LosesAStepForTravel", "PlansOfEveryOptionPassTheChecker", "general", "--optimize travel",
       [](const Planner& good, PlanRequest request) {
         PlanResult result = good.Plan(request);
         return request.objective == planning::Objective::kTravel
                    ? WithoutLastStep(std::move(result))
                    : result;
       }},
      {"HasAnotherHand", "PlansAreForTheHand", "general", "another number of fingers",
       [](const Planner& good, PlanRequest request) {
         request.hand.fingers = 0;
         return good.Plan(request);
       }},
      {"HasPointedFingers", "PlansAreForTheHand", "polygon", "unreachable",
       [](const Planner& good, PlanRequest request) {
         const double radius = std::exchange(request.hand.fingertip_radius, 0);
         PlanResult result = good.Plan(request);
         if (result.plan && radius > 0) result.plan->finger_radius = radius;
         return result;
       }},
  };
  return cases;
}

class ABadPlanner : public testing::TestWithParam<std::size_t> {};

TEST_P(ABadPlanner, IsFoundOut) {
  const BadCase& bad = BadCases()[GetParam()];
  const BadPlanner planner(*FindPlanner(bad.planner), bad.task);
  const auto law = std::ranges::find(PlannerLaws(), std::string_view(bad.law), &PlannerLaw::name);
  ASSERT_NE(law, PlannerLaws().end());
  EXPECT_THAT(law->breach(planner, Read("polygon15.wkt")), testing::HasSubstr(bad.found));
}

INSTANTIATE_TEST_SUITE_P(Controls, ABadPlanner, testing::Range(std::size_t{0}, BadCases().size()),
                         [](const auto& test) { return BadCases()[test.param].name; });

TEST(PlannerLaws, EachHasABadPlannerThatBreaksIt) {
  std::set<std::string> broken;
  for (const BadCase& bad : BadCases()) broken.insert(bad.law);
  for (const PlannerLaw& law : PlannerLaws()) EXPECT_TRUE(broken.contains(law.name)) << law.name;
}

}  // namespace planner_laws_test
}  // namespace regrasp::registry
