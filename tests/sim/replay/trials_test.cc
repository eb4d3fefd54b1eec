#include "sim/replay/trials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "tests/fixtures/soups.h"
#include "tests/sim/planar_cases.h"

namespace regrasp::sim {
namespace trials_test {

constexpr double kTip = 1e-3;  ///< m

TrialOptions Trials(int count, double position, double friction, double mass = 0) {
  TrialOptions trials;
  trials.count = count;
  trials.seed = 11;
  trials.position_noise = position;
  trials.friction_error = friction;
  trials.mass_error = mass;
  return trials;
}

/// Return the number of passed trials. The cube's grasp requires 5.3°.
int Passes(double friction_angle_deg, const TrialOptions& trials) {
  const CubeCase cube;
  return RunTrials(cube.object, MakePlan(cube.Start(), friction_angle_deg), {}, trials, kTip)
      .passed;
}

plan::Plan SwitchAndAlign(const CubeCase& cube) {
  plan::Plan plan = MakePlan(cube.Start(), 25);
  plan::FingerGrasp before = {cube.Start()[0], cube.Start()[1], cube.Start()[3],
                              cube.At(4, 0, 0.001, 0.03)};
  plan::FingerGrasp after = before;
  after[1] = cube.At(1, -0.03, 0.004, -0.001);
  plan.steps = {plan::Switch{{before[3]}, {FingerIndex(2)}}, plan::Align{{before, after}}};
  return plan;
}

TEST(ContactNoise, MovesEveryContactOnItsFaceAndAFingerThatStaysKeepsItsPlace) {
  const CubeCase cube;
  const plan::Plan plan = SwitchAndAlign(cube);
  RandomStream random(1, RandomUse::kTrialContacts, 0);
  const plan::Plan noisy = AddContactNoise(cube.object, plan, {2e-3, kTip}, random);
  int moved = 0;
  for (std::size_t i = 0; i < plan.initial.size(); ++i) {
    const grasp::Contact &meant = plan.initial[i].contact, &is = noisy.initial[i].contact;
    EXPECT_EQ(is.face, meant.face);
    EXPECT_NEAR((is.p - meant.p).dot(meant.n), 0, 1e-15);
    moved += is.p != meant.p;
  }
  EXPECT_EQ(moved, 4);
  const plan::FingerGrasp& begin = std::get<plan::Align>(noisy.steps[1]).waypoints[0];
  const plan::FingerGrasp& end = std::get<plan::Align>(noisy.steps[1]).waypoints[1];
  EXPECT_EQ(begin[0].contact.p, noisy.initial[0].contact.p);
  EXPECT_EQ(begin[1].contact.p, noisy.initial[1].contact.p);
  EXPECT_EQ(begin[3].contact.p, std::get<plan::Switch>(noisy.steps[0]).place[0].contact.p);
  for (const int stays : {0, 2, 3}) EXPECT_EQ(end[stays].contact.p, begin[stays].contact.p);
  EXPECT_NE(end[1].contact.p, begin[1].contact.p);
  EXPECT_NE(end[1].contact.p, std::get<plan::Align>(plan.steps[1]).waypoints[1][1].contact.p);
}

TEST(ContactNoise, HasTheStandardDeviationThatWasAskedFor) {
  const CubeCase cube;
  constexpr double kDeviation = 1e-3;
  constexpr int kDraws = 2000;
  const plan::Plan plan = MakePlan({cube.At(0, 0.03, 0, 0)}, 25);
  double squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(3, RandomUse::kTrialContacts, i);
    const plan::Plan noisy = AddContactNoise(cube.object, plan, {kDeviation, kTip}, random);
    squares += (noisy.initial[0].contact.p - plan.initial[0].contact.p).squaredNorm();
  }
  // Two directions. The tolerance is five standard deviations of the sum of squares.
  const double mean = squares / kDraws / (kDeviation * kDeviation);
  EXPECT_NEAR(mean, 2, 5 * 2 / std::sqrt(kDraws));
}

TEST(ContactNoise, WithoutDeviationChangesNothing) {
  const CubeCase cube;
  const plan::Plan plan = SwitchAndAlign(cube);
  RandomStream random(1, RandomUse::kTrialContacts, 0);
  const plan::Plan same = AddContactNoise(cube.object, plan, {0, kTip}, random);
  for (std::size_t i = 0; i < plan.initial.size(); ++i) {
    EXPECT_EQ(same.initial[i].contact.p, plan.initial[i].contact.p);
  }
  EXPECT_EQ(std::get<plan::Align>(same.steps[1]).waypoints.size(), 2U);
}

TEST(ContactNoise, GoesOverABorderOntoTheNextFace) {
  const CubeCase cube;
  // One millimetre from the edge, with a noise of 3 mm.
  const plan::Plan plan = MakePlan({cube.At(0, 0.03, 0.029, 0)}, 25);
  constexpr int kDraws = 400;
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(5, RandomUse::kTrialContacts, i);
    const plan::Plan noisy = AddContactNoise(cube.object, plan, {3e-3, kTip}, random);
    const grasp::Contact& is = noisy.initial[0].contact;
    EXPECT_EQ(is.n, cube.object.inward_normal(is.face));
    EXPECT_LT((cube.object.ClosestPoint(is.face, is.p) - is.p).norm(), 1e-9);
    if (is.n.y() > -0.5) continue;
    ++beyond;
    EXPECT_LT(is.p.x(), 0.03 + 1e-9);
  }
  // The normal deviate must exceed 1/3. The tolerance is five standard deviations of the count.
  const double share = std::erfc(1.0 / 3 / std::sqrt(2)) / 2;
  EXPECT_NEAR(beyond, share * kDraws, 5 * std::sqrt(kDraws * share * (1 - share)));
}

/// Return a contact on the top of GriddedBoxSoup(50, 1e-5), whose triangles have a fifth of the
/// size of the noise.
grasp::Contact OnTop(const object::Polyhedron& box, double x, double y) {
  const FaceIndex face = box.FacesNear({x, y, 0}, 1e-4).front();
  return {box.ClosestPoint(face, {x, y, 0}), box.inward_normal(face), face};
}

constexpr double kFacet = 0.02;
constexpr double kFarOff = 5 * kFacet;

TEST(ContactNoise, IsNotCutOffBySmallFacets) {
  const object::Polyhedron box =
      object::Polyhedron::FromSoup(soups::GriddedBoxSoup(50, 1e-5), "soup");
  ASSERT_GT(box.face_count(), 2000);
  constexpr int kDraws = 1000;
  const plan::Plan plan = MakePlan({{FingerIndex(0), OnTop(box, 0.503, 0.511)}}, 25);
  double squares = 0;
  int on_other_facets = 0;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(3, RandomUse::kTrialContacts, i);
    const plan::Plan noisy = AddContactNoise(box, plan, {kFarOff, 1e-6}, random);
    const grasp::Contact& is = noisy.initial[0].contact;
    squares += (is.p - plan.initial[0].contact.p).squaredNorm();
    on_other_facets += is.face != plan.initial[0].contact.face;
  }
  EXPECT_NEAR(squares / kDraws / (kFarOff * kFarOff), 2, 5 * 2 / std::sqrt(kDraws));
  EXPECT_GT(on_other_facets, kDraws * 9 / 10);
}

TEST(ContactNoise, OnFacetsOfOnePlaneIsThatOnTheOneFace) {
  const object::Polyhedron whole =
      object::Polyhedron::FromSoup(soups::GriddedBoxSoup(1, 0), "soup");
  const object::Polyhedron cut = object::Polyhedron::FromSoup(soups::GriddedBoxSoup(50, 0), "soup");
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector3d p[2];
    for (const object::Polyhedron* box : {&whole, &cut}) {
      const plan::Plan plan = MakePlan({{FingerIndex(0), OnTop(*box, 0.503, 0.511)}}, 25);
      RandomStream random(3, RandomUse::kTrialContacts, i);
      p[box == &cut] = AddContactNoise(*box, plan, {kFarOff, 1e-6}, random).initial[0].contact.p;
    }
    EXPECT_EQ(p[0], p[1]) << i;
  }
}

TEST(ContactNoise, LeavesAnAlignAWayAlongTheSurface) {
  const object::Polyhedron box =
      object::Polyhedron::FromSoup(soups::GriddedBoxSoup(50, 1e-5), "soup");
  const FingerIndex first(0), second(1);
  plan::FingerGrasp begin = {{first, OnTop(box, 0.303, 0.311)}, {second, OnTop(box, 0.703, 0.711)}};
  // The first finger moves inside a triangle, the other stays.
  plan::FingerGrasp end = begin;
  end[0].contact.p += Eigen::Vector3d(1e-3, 1e-3, 0);
  end[0].contact.p = box.ClosestPoint(begin[0].contact.face, end[0].contact.p);
  plan::Plan plan = MakePlan(begin, 25);
  plan.steps = {plan::Align{{begin, end}}};
  int more_waypoints = 0;
  for (int i = 0; i < 20; ++i) {
    RandomStream random(3, RandomUse::kTrialContacts, i);
    plan::Plan noisy = AddContactNoise(box, plan, {kFarOff, 1e-6}, random);
    const auto& waypoints = std::get<plan::Align>(noisy.steps[0]).waypoints;
    more_waypoints += waypoints.size() > 2;
    noisy.goal = plan::ContactsOf(waypoints.back());
    plan::CheckOptions all_but_forces;
    all_but_forces.judge_force_closure = false;
    const plan::PlanCheck check = plan::CheckPlan(box, noisy, all_but_forces);
    EXPECT_TRUE(check.passed()) << i << ": " << check.steps.back().detail;
    EXPECT_EQ(waypoints.back()[1].contact.p, noisy.initial[1].contact.p);
    EXPECT_NE(waypoints.back()[0].contact.p, noisy.initial[0].contact.p);
  }
  EXPECT_GT(more_waypoints, 10);
}

TEST(Trials, WithoutErrorsAllPassAsTheNominalReplayDoes) {
  EXPECT_EQ(Passes(25, Trials(5, 0, 0)), 5);
  // All trials fail if the plan itself fails.
  EXPECT_EQ(Passes(4, Trials(5, 0, 0)), 0);
}

TEST(Trials, LoseAPlanNearItsCriticalFrictionAndKeepOneWithFrictionToSpare) {
  constexpr int kCount = 30;
  const int spare = Passes(25, Trials(kCount, 0, 0.1));
  // With 0.96 of its friction the grasp resists less than the disturbance.
  const int little = Passes(7, Trials(kCount, 0, 0.01));
  const int more = Passes(7, Trials(kCount, 0, 0.1));
  const int most = Passes(7, Trials(kCount, 0, 0.5));
  EXPECT_EQ(spare, kCount);
  EXPECT_EQ(little, kCount);
  EXPECT_LT(more, little);
  EXPECT_LT(most, more);
}

TEST(Trials, LoseMoreTheFartherContactsAreOff) {
  constexpr int kCount = 30;
  const int little = Passes(10, Trials(kCount, 0.005, 0));
  const int more = Passes(10, Trials(kCount, 0.05, 0));
  const int most = Passes(10, Trials(kCount, 0.2, 0));
  EXPECT_GT(little, more);
  EXPECT_GT(more, most);
}

TEST(Trials, EachDependsOnTheSeedAndItsNumberAlone) {
  const TrialOptions trials = Trials(10, 0.03, 0.2, 0.1);
  int before = 0;
  int fewer = 0;
  for (int count = 1; count <= trials.count; ++count) {
    TrialOptions first = trials;
    first.count = count;
    const int passed = Passes(8, first);
    EXPECT_GE(passed, before);
    EXPECT_LE(passed, before + 1);
    fewer += passed == before;
    before = passed;
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(fewer, 0);
}

TEST(Trials, SayWhatFailedAndWhere) {
  const CubeCase cube;
  const TrialSummary summary =
      RunTrials(cube.object, SwitchAndAlign(cube), {}, Trials(12, 0.1, 0.5), kTip);
  int failed = 0;
  for (const auto& [reason, count] : summary.reasons) failed += count;
  int in_steps = 0;
  for (const auto& [index, count] : summary.steps) {
    EXPECT_GE(index, 0);
    EXPECT_LE(index, 2);
    in_steps += count;
  }
  EXPECT_GT(failed, 0);
  EXPECT_EQ(failed, in_steps);
  EXPECT_EQ(failed + summary.passed, 12);
}

TEST(Trials, ChangeTheWorldAndNotWhatTheHandBelieves) {
  const CubeCase cube;
  const plan::Plan plan = MakePlan(cube.Start(), 25);
  ReplayOptions options;
  options.mass_kg = 0.25;
  options.mass_factor = 1.5;
  options.friction_factor = 0.5;
  const std::string scene = SceneMjcf(cube.object, plan, options);
  EXPECT_NE(scene.find("mass=\"0.375\""), std::string::npos);
  EXPECT_NE(scene.find(FormatDouble(0.5 * std::tan(Radians(25)))), std::string::npos);
  const ReplaySettings settings = ReplayPlan(cube.object, plan, options).settings;
  EXPECT_EQ(settings.mass_kg, 0.25);
  EXPECT_EQ(settings.mu, std::tan(Radians(25)));
  ReplayOptions nominal;
  nominal.mass_kg = 0.25;
  EXPECT_EQ(settings.grasp_force_N, ReplayPlan(cube.object, plan, nominal).settings.grasp_force_N);
}

TEST(Trials, WorkInThePlane) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::Plan plan =
      MakePlanarPlan({OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)}, 20);
  const auto passes = [&](double noise) {
    return RunTrials(square, plan, {}, Trials(20, noise, 0), kTip).passed;
  };
  EXPECT_EQ(passes(0.005), 20);
  EXPECT_LT(passes(0.2), 20);
}

TEST(Trials, RefuseErrorsOutOfRange) {
  EXPECT_THROW((void)Passes(25, Trials(0, 0, 0)), std::invalid_argument);
  EXPECT_THROW((void)Passes(25, Trials(1, -0.1, 0)), std::invalid_argument);
  EXPECT_THROW((void)Passes(25, Trials(1, 0, 1.5)), std::invalid_argument);
  EXPECT_THROW((void)Passes(25, Trials(1, 0, 0, std::nan(""))), std::invalid_argument);
}

}  // namespace trials_test
}  // namespace regrasp::sim
