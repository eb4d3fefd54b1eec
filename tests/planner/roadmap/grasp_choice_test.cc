#include "planner/planning/grasp_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "tests/fixtures/solids.h"

namespace regrasp {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kApart = 1e-7;
constexpr double kHalf = 0.03;

/// Two fingers on each of two opposite faces of the cube, `lean` apart along z at the second pair,
/// so that the grasp needs some friction.
GraspChoice OppositePairs(double lean) {
  const Grasp grasp = {{{-kHalf, 0.01, 0}, {1, 0, 0}, 0},
                       {{-kHalf, -0.01, 0}, {1, 0, 0}, 0},
                       {{kHalf, 0.01, lean}, {-1, 0, 0}, 1},
                       {{kHalf, -0.01, lean}, {-1, 0, 0}, 1}};
  return {GraspChoice::Kind::kGiven, grasp, "given.json"};
}

void Check(const GraspChoice& choice, double degrees) {
  CheckGivenGrasp(choice, {"roadmap", 4, 4}, MakeBox({0.06, 0.06, 0.06}).wrench_frame(),
                  Radians(degrees), kApart);
}

TEST(CheckGivenGrasp, AcceptsAForceClosureGraspOfFour) {
  EXPECT_NO_THROW(Check(OppositePairs(0), 10));
}

TEST(CheckGivenGrasp, NamesTheHalfAngleThatIsNeeded) {
  // The pairs' lines lean by atan(0.02 / 0.06) = 18.43°, and nothing holds with less.
  EXPECT_THAT([] { Check(OppositePairs(0.02), 15); },
              ThrowsMessage<InputError>(
                  "given.json: /contacts: not force closure: needs a friction half-angle of "
                  "18.44°, given 15°"));
  EXPECT_NO_THROW(Check(OppositePairs(0.02), 18.45));
}

TEST(CheckGivenGrasp, SaysWhereNoFrictionServes) {
  GraspChoice choice = OppositePairs(0);
  for (std::size_t i = 0; i < 4; ++i) choice.grasp[i].p = {-kHalf, 0.005 * double(i), 0};
  EXPECT_THAT([&] { Check(choice, 30); },
              ThrowsMessage<InputError>(HasSubstr("no friction half-angle below 90° serves")));
}

TEST(CheckGivenGrasp, RefusesThreeAndFiveContacts) {
  GraspChoice choice = OppositePairs(0);
  choice.grasp.pop_back();
  EXPECT_THAT([&] { Check(choice, 20); },
              ThrowsMessage<InputError>(HasSubstr("needs 4 contacts, found 3")));
  choice = OppositePairs(0);
  choice.grasp.push_back(choice.grasp[0]);
  choice.grasp.back().p.z() += 0.01;
  EXPECT_THAT([&] { Check(choice, 20); },
              ThrowsMessage<InputError>(HasSubstr("needs 4 contacts, found 5")));
}

TEST(CheckGivenGrasp, NamesTheRangeOfContactsThatAPlannerTakes) {
  GraspChoice choice = OppositePairs(0);
  choice.grasp.resize(1);
  EXPECT_THAT(
      [&] {
        CheckGivenGrasp(choice, {"polygon", 2, 4}, MakeBox({0.06, 0.06, 0.06}).wrench_frame(),
                        Radians(20), kApart);
      },
      ThrowsMessage<InputError>(HasSubstr("the planner polygon needs 2 to 4 contacts, found 1")));
}

TEST(CheckGivenGrasp, RefusesTwoContactsAtOnePoint) {
  GraspChoice choice = OppositePairs(0);
  choice.grasp[3] = choice.grasp[2];
  EXPECT_THAT([&] { Check(choice, 20); },
              ThrowsMessage<InputError>(HasSubstr("contacts 2 and 3 are at the same point")));
}

}  // namespace
}  // namespace regrasp
