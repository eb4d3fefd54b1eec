#include "planner/planning/solve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/base/number.h"
#include "planner/sampling/surface_sampler.h"
#include "tests/fixtures/plan_with.h"
#include "tests/fixtures/solids.h"

namespace regrasp::planning {
namespace solve_test {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kHalf = 0.03;

/// Return two fingers on each of two opposite faces of the cube. The second pair is displaced by
/// `lean` along z, so that the grasp requires friction.
GraspChoice OppositePairs(double lean) {
  const grasp::Grasp grasp = {{{-kHalf, 0.01, 0}, {1, 0, 0}, FaceIndex(0)},
                              {{-kHalf, -0.01, 0}, {1, 0, 0}, FaceIndex(0)},
                              {{kHalf, 0.01, lean}, {-1, 0, 0}, FaceIndex(1)},
                              {{kHalf, -0.01, lean}, {-1, 0, 0}, FaceIndex(1)}};
  return {GraspChoice::Kind::kGiven, grasp, "given.json"};
}

/// Planner for grasps of some numbers of contacts that returns a prescribed result.
class StubPlanner final : public Planner {
 public:
  using Task = std::function<PlanResult(const PlanRequest&)>;
  explicit StubPlanner(grasp::ContactLimits contacts = {4, 4}, Task task = {})
      : Planner({.name = "stub", .in_space = PlannerScope{5, contacts, contacts}}),
        task_(std::move(task)) {}
  [[nodiscard]] std::optional<MemoryNeed> EstimateMemory(const PlanRequest&) const override {
    return MemoryNeed{"the stub", 10, "units", [](double n) { return 100 * n; }};
  }
  [[nodiscard]] PlanResult Plan(const PlanRequest& request) const override {
    return task_ ? task_(request) : PlanResult();
  }

 private:
  Task task_;
};

PlanResult SolveOnCube(const Planner& planner, const GraspChoice& choice, PlanRequest request) {
  static const object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06});
  return PlanWith(planner, cube, choice, choice, std::move(request));
}

void Check(const GraspChoice& choice, double degrees, grasp::ContactLimits contacts = {4, 4}) {
  (void)SolveOnCube(StubPlanner(contacts), choice, RequestAt(degrees));
}

TEST(Solve, GivesThePlannerAHandAndDrawnGraspsButLeavesItItsOwn) {
  int asked = 0;
  const StubPlanner planner({4, 4}, [&](const PlanRequest& request) {
    ++asked;
    EXPECT_EQ(request.hand.fingers, 5);
    const bool own = request.start.kind == GraspChoice::Kind::kRandom;
    EXPECT_EQ(request.start.grasp.size(), own ? 0 : 4);
    return PlanResult();
  });
  (void)SolveOnCube(planner, Random(), RequestAt(20));
  (void)SolveOnCube(planner, RandomAny(), RequestAt(20));
  EXPECT_EQ(asked, 2);
}

TEST(Solve, TurnsNoGraspAndTimeUpIntoAnswers) {
  const StubPlanner none({4, 4},
                         [](const PlanRequest&) -> PlanResult { throw sampling::NoGrasp{"none"}; });
  const PlanResult no_grasp = SolveOnCube(none, Random(), RequestAt(20));
  EXPECT_EQ(no_grasp.status, PlanResult::Status::kNoGrasp);
  EXPECT_EQ(no_grasp.message, "none");
  const StubPlanner late({4, 4}, [](const PlanRequest&) -> PlanResult { throw TimeUp(); });
  const PlanResult time_up = SolveOnCube(late, Random(), RequestAt(20));
  EXPECT_EQ(time_up.status, PlanResult::Status::kNoSequence);
  EXPECT_EQ(time_up.message, "planner stub: time limit reached");
}

TEST(Solve, AsksThePlannerForNothingThatDoesNotFit) {
  int asked = 0;
  const StubPlanner planner({4, 4}, [&](const PlanRequest&) {
    ++asked;
    return PlanResult();
  });
  PlanRequest request = RequestAt(20);
  request.memory = 999;
  EXPECT_THAT(SolveOnCube(planner, Random(), request).message,
              HasSubstr("the stub: 10 units require"));
  EXPECT_EQ(asked, 0);
  request.memory = 1000;
  (void)SolveOnCube(planner, Random(), request);
  EXPECT_EQ(asked, 1);
}

TEST(Solve, RefusesAnOptionThatThePlannerDoesNotHave) {
  PlanRequest request = RequestAt(20);
  request.objective = Objective::kTravel;
  EXPECT_THAT([&] { (void)SolveOnCube(StubPlanner(), Random(), request); },
              ThrowsMessage<InputError>("--optimize travel: not supported by planner stub"));
}

TEST(Solve, RefusesFrictionAndQualityOutOfRange) {
  for (const double degrees : {0.0, -1.0, 90.0, std::numeric_limits<double>::quiet_NaN()}) {
    for (const GraspChoice& choice : {OppositePairs(0), Random(), RandomAny()}) {
      EXPECT_THROW((void)SolveOnCube(StubPlanner(), choice, RequestAt(degrees)),
                   std::invalid_argument)
          << degrees;
    }
  }
  for (const double quality : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    PlanRequest request = RequestAt(20);
    request.criteria.min_quality = quality;
    EXPECT_THROW((void)SolveOnCube(StubPlanner(), Random(), request), std::invalid_argument);
  }
}

TEST(Solve, AcceptsAForceClosureGraspOfFour) { EXPECT_NO_THROW(Check(OppositePairs(0), 10)); }

TEST(Solve, NamesTheFrictionAngleThatIsNeeded) {
  // The lines of the pairs are inclined by atan(0.02 / 0.06) = 18.43°, which is the required
  // friction angle.
  EXPECT_THAT([] { Check(OppositePairs(0.02), 15); },
              ThrowsMessage<InputError>(
                  "given.json: /contacts: not force closure: requires a friction angle of "
                  "18.44°, found 15.00°"));
  EXPECT_NO_THROW(Check(OppositePairs(0.02), 18.45));
}

TEST(Solve, SaysWhereNoFrictionIsEnough) {
  GraspChoice choice = OppositePairs(0);
  for (std::size_t i = 0; i < 4; ++i) choice.grasp[i].p = {-kHalf, 0.005 * double(i), 0};
  EXPECT_THAT(
      [&] { Check(choice, 30); },
      ThrowsMessage<InputError>(HasSubstr("not force closure at any friction angle below 90°")));
}

TEST(Solve, RefusesThreeAndFiveContacts) {
  GraspChoice choice = OppositePairs(0);
  choice.grasp.pop_back();
  EXPECT_THAT([&] { Check(choice, 20); },
              ThrowsMessage<InputError>(HasSubstr("requires 4 contacts, found 3")));
  choice = OppositePairs(0);
  choice.grasp.push_back(choice.grasp[0]);
  choice.grasp.back().p.z() += 0.01;
  EXPECT_THAT([&] { Check(choice, 20); },
              ThrowsMessage<InputError>(HasSubstr("requires 4 contacts, found 5")));
}

TEST(Solve, NamesTheRangeOfContactsThatAPlannerTakes) {
  GraspChoice choice = OppositePairs(0);
  choice.grasp.resize(1);
  EXPECT_THAT(
      [&] {
        Check(choice, 20, {2, 4});
      },
      ThrowsMessage<InputError>(HasSubstr("planner stub requires 2 to 4 contacts, found 1")));
}

TEST(Solve, RefusesTwoContactsAtOnePoint) {
  GraspChoice choice = OppositePairs(0);
  choice.grasp[3] = choice.grasp[2];
  EXPECT_THAT([&] { Check(choice, 20); },
              ThrowsMessage<InputError>(HasSubstr("contacts 2 and 3 are at the same point")));
}

}  // namespace solve_test
}  // namespace regrasp::planning
