#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "planner/grasp/quality.h"
#include "sim/measure/disturbance.h"
#include "tests/sim/planar_cases.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace resisted_wrench_test {

/// Tolerance between the two methods, over the limit.
/// It is 1 % for the bisection, and the rest for a replay that ends before the object has moved
/// far.
constexpr double kAgree = 0.03;

constexpr double kFrictionAngleDeg = 25;

std::vector<ResistedWrench> ResistedWrenchesOf(const object::Object& object,
                                               const plan::Plan& plan) {
  ReplayOptions options;
  options.resisted_wrench = true;
  return ReplayPlan(object, plan, options).steps.at(0).resisted_wrench;
}

const ResistedWrench& Of(const std::vector<ResistedWrench>& resisted_wrench,
                         const std::string& name) {
  return *std::ranges::find(resisted_wrench, name,
                            [](const ResistedWrench& s) { return DisturbanceName(s.disturbance); });
}

/// Return a grasp of the cube of side 6 cm at the middle of four faces.
plan::FingerGrasp MiddleOfFourFaces(const CubeCase& cube) {
  return {cube.At(0, 0.03, 0, 0), cube.At(1, -0.03, 0, 0), cube.At(2, 0, 0.03, 0),
          cube.At(3, 0, -0.03, 0)};
}

TEST(ResistedWrenchTest, BothRoutesGiveWhatTheFrictionOfFourFingersOnACubeBears) {
  const CubeCase cube;
  const auto resisted_wrench =
      ResistedWrenchesOf(cube.object, MakePlan(MiddleOfFourFaces(cube), kFrictionAngleDeg));
  ASSERT_EQ(resisted_wrench.size(), 12u);
  const double mu = std::tan(Radians(kFrictionAngleDeg));
  // The weight is a tenth of the disturbance, which is a hundredth of the grasp force.
  const double weight = 1e-3;
  const double lever = 0.03 / (cube.object.diameter() / 2);
  for (const auto& [name, limit] : {std::pair{"force -z", mu - weight},
                                    {"force +z", mu + weight},
                                    {"torque +z", mu * lever},
                                    {"torque -z", mu * lever}}) {
    EXPECT_NEAR(Of(resisted_wrench, name).analysis, limit, 2e-3 * limit) << name;
    EXPECT_NEAR(Of(resisted_wrench, name).replay, limit, kAgree * limit) << name;
  }
}

TEST(ResistedWrenchTest, BothRoutesGiveWhatAPairInThePlaneBears) {
  const object::Polygon square = MakeSquare(0.03);
  const plan::FingerGrasp pair = {OnEdge(square, 0, 1, 0.5), OnEdge(square, 1, 3, 0.5)};
  const auto resisted_wrench = ResistedWrenchesOf(square, MakePlanarPlan(pair, kFrictionAngleDeg));
  ASSERT_EQ(resisted_wrench.size(), 6u);
  const double mu = std::tan(Radians(kFrictionAngleDeg));
  for (const auto& [name, limit] :
       {std::pair{"force +y", mu}, {"force -y", mu}, {"torque +z", mu / std::sqrt(2)}}) {
    EXPECT_NEAR(Of(resisted_wrench, name).analysis, limit, 1e-6) << name;
    EXPECT_NEAR(Of(resisted_wrench, name).replay, limit, kAgree * limit) << name;
  }
}

/// Return the number of directions in which both methods agree for random grasps of an object, and
/// the total number.
std::pair<int, int> CountAgreeing(const std::string& model, int grasps) {
  const object::ObjectFile file = ReadModel(model);
  const auto& body = dynamic_cast<const object::Polyhedron&>(*file.object);
  std::mt19937 random(20241121);
  int agreeing = 0, all = 0;
  for (int found = 0; found < grasps;) {
    plan::FingerGrasp grasp;
    for (FingerIndex f{0}; f < 4; ++f) grasp.push_back({f, DrawContact(body, random)});
    if (!grasp::QualityAtLeast(plan::ContactsOf(grasp), body.wrench_frame(),
                               Radians(kFrictionAngleDeg), 0.02)) {
      continue;
    }
    ++found;
    for (const ResistedWrench& s : ResistedWrenchesOf(body, MakePlan(grasp, kFrictionAngleDeg))) {
      ++all;
      const bool agrees = std::abs(s.replay - s.analysis) <= kAgree * s.analysis;
      agreeing += agrees;
      EXPECT_TRUE(agrees) << model << ", grasp " << found << ", " << DisturbanceName(s.disturbance)
                          << ": replay " << s.replay << ", analysis " << s.analysis;
    }
  }
  return {agreeing, all};
}

TEST(ResistedWrenchTest, BothRoutesAgreeOnRandomGraspsInEveryDirection) {
  int agreeing = 0, all = 0;
  for (const char* model : {"cube.obj", "l_block.obj", "stone.obj"}) {
    const auto [good, checked] = CountAgreeing(model, 8);
    agreeing += good;
    all += checked;
  }
  std::cout << agreeing << " of " << all << " directions agree within " << kAgree << "\n";
  EXPECT_EQ(all, 3 * 8 * 12);
}

TEST(ResistedWrenchTest, AStepPassesTheShakeWhereEveryDirectionResistsIt) {
  const CubeCase cube;
  int passed = 0, failed = 0;
  // The grasp requires 5.3 degrees.
  for (const double friction_angle : {5.0, 5.5, 5.8, 6.2, 8.0, 12.0}) {
    ReplayOptions options;
    options.resisted_wrench = true;
    const StepReplay hold =
        ReplayPlan(cube.object, MakePlan(cube.Start(), friction_angle), options).steps.at(0);
    if (hold.resisted_wrench.empty()) {
      EXPECT_NE(hold.reason, plan::Reason::kNone);
      continue;
    }
    const double least = std::ranges::min(hold.resisted_wrench, {}, &ResistedWrench::replay).replay;
    const bool passes = hold.reason == plan::Reason::kNone;
    EXPECT_EQ(passes, least >= options.disturbance_ratio)
        << friction_angle << " degrees, least " << least;
    ++(passes ? passed : failed);
  }
  EXPECT_GT(passed, 0);
  EXPECT_GT(failed, 0);
}

TEST(ResistedWrenchTest, LessFrictionBearsLess) {
  const CubeCase cube;
  const auto more = ResistedWrenchesOf(cube.object, MakePlan(cube.Start(), 25));
  const auto less = ResistedWrenchesOf(cube.object, MakePlan(cube.Start(), 12));
  ASSERT_EQ(more.size(), less.size());
  for (std::size_t i = 0; i < more.size(); ++i) {
    EXPECT_LT(less[i].replay, more[i].replay) << DisturbanceName(more[i].disturbance);
    EXPECT_LT(less[i].analysis, more[i].analysis) << DisturbanceName(more[i].disturbance);
  }
}

TEST(ResistedWrenchTest, TheSearchLeavesNoTraceInTheReplay) {
  const CubeCase cube;
  plan::Plan plan = MakePlan(cube.Start(), 25);
  plan.steps = {plan::Switch{{cube.At(4, 0, 0.001, 0.03)}, {FingerIndex(2)}}};
  ReplayOptions options;
  const ReplayResult plain = ReplayPlan(cube.object, plan, options);
  options.resisted_wrench = true;
  options.protocol = Protocol::kBoth;
  const ReplayResult searched = ReplayPlan(cube.object, plan, options);
  ASSERT_EQ(plain.steps.size(), 2u);
  ASSERT_EQ(searched.steps.size(), 2u);
  for (int i : {0, 1}) {
    EXPECT_TRUE(plain.steps[i].resisted_wrench.empty());
    EXPECT_EQ(searched.steps[i].resisted_wrench.size(), 12u);
    EXPECT_EQ(plain.steps[i].moved_m, searched.steps[i].moved_m);
    EXPECT_EQ(plain.steps[i].slip_m, searched.steps[i].slip_m);
    EXPECT_EQ(plain.steps[i].drift_m, searched.steps[i].drift_m);
    EXPECT_EQ(plain.steps[i].static_margins, searched.steps[i].static_margins);
  }
}

}  // namespace resisted_wrench_test
}  // namespace regrasp::sim
