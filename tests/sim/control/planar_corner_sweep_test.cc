#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/plan/check.h"
#include "tests/sim/control/boundary_walk.h"

namespace regrasp::sim {
namespace planar_corner_sweep_test {

constexpr unsigned kSeed = 4;
/// Quality slightly above the disturbance: plans with it must pass.
constexpr double kLeastQuality = 0.011;
/// Number of draws of a grasp, and of bisections of a walk. Failed draws are omitted; the tests
/// count the rest.
constexpr int kMostDraws = 20000, kHalvings = 6;
/// Share of the required friction at which every plan must fail.
constexpr double kTooLittle = 0.9;

/// Sampler of plans with two-finger grasps of an outline, for a hand of three fingers.
class Dice {
 public:
  Dice(const object::Polygon& polygon, double friction_angle_deg, std::mt19937& random)
      : polygon_(polygon), friction_angle_deg_(friction_angle_deg), random_(random) {}

  [[nodiscard]] double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  [[nodiscard]] grasp::Contact DrawContact() {
    const int edge = std::uniform_int_distribution<int>(0, polygon_.face_count() - 1)(random_);
    return OnEdge(polygon_, edge, Between(0, 1));
  }

  [[nodiscard]] bool IsGood(const grasp::Grasp& grasp) const {
    const double friction_angle = Radians(friction_angle_deg_);
    return grasp::IsForceClosure(grasp, polygon_.wrench_frame(), friction_angle) &&
           grasp::QualityAtLeast(grasp, polygon_.wrench_frame(), friction_angle, kLeastQuality);
  }

  /// Draw a walk of both fingers, bisected until it is force closure throughout and ends in a good
  /// grasp.
  [[nodiscard]] std::optional<plan::Plan> DrawWalk() {
    const std::optional<grasp::Grasp> start = DrawGrasp();
    if (!start) return std::nullopt;
    double length = Between(-0.5, 0.5) * polygon_.diameter();
    const double other = Between(0.7, 1.4);
    for (int i = 0; i < kHalvings; ++i, length /= 2) {
      const plan::Plan plan = MakeWalkPlan(
          polygon_, {WalkOf(0, (*start)[0], length), WalkOf(1, (*start)[1], other * length)},
          friction_angle_deg_);
      if (IsGood(plan.goal) && plan::CheckPlan(polygon_, plan).passed()) return plan;
    }
    return std::nullopt;
  }

  /// Draw switches of one finger for another between good grasps.
  [[nodiscard]] std::optional<plan::Plan> DrawSwitches(int switches) {
    const std::optional<grasp::Grasp> start = DrawGrasp();
    if (!start) return std::nullopt;
    plan::Plan plan = MakePlanarPlan(plan::FingersInOrder(*start), friction_angle_deg_, 3);
    plan::FingerGrasp held = plan.initial;
    for (int i = 0; i < switches; ++i) {
      const FingerIndex free(3 - held[0].finger - held[1].finger);
      const std::optional<plan::Switch> found = DrawSwitch(held, free);
      if (!found) return std::nullopt;
      plan.steps.emplace_back(*found);
      held = plan::GraspAfter(held, plan.steps.back());
    }
    plan.goal = plan::ContactsOf(held);
    return plan;
  }

 private:
  [[nodiscard]] std::optional<grasp::Grasp> DrawGrasp() {
    for (int i = 0; i < kMostDraws; ++i) {
      const grasp::Grasp grasp = {DrawContact(), DrawContact()};
      if (IsGood(grasp)) return grasp;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<plan::Switch> DrawSwitch(const plan::FingerGrasp& held,
                                                       FingerIndex free) {
    for (int i = 0; i < kMostDraws; ++i) {
      const plan::Switch change{{{free, DrawContact()}}, {held[i % 2].finger}};
      if (IsGood(plan::ContactsOf(plan::GraspAfter(held, change)))) return change;
    }
    return std::nullopt;
  }

  [[nodiscard]] Walk WalkOf(int finger, const grasp::Contact& contact, double length) const {
    const double at = (contact.p - polygon_.edge(contact.face).first).norm();
    return {finger, contact.face, at / polygon_.face_measure(contact.face), length};
  }

  const object::Polygon& polygon_;
  double friction_angle_deg_;
  std::mt19937& random_;
};

/// Counts of a sweep of plans.
struct Tally {
  int plans = 0, steps = 0, turns = 0, refuted = 0;
  double drift = 0;
};

/// Expect that the plan passes the replay, and count whether it fails with less than its required
/// friction.
void MotionMonitor(const object::Polygon& polygon, const plan::Plan& plan, Tally& tally) {
  const plan::PlanCheck check = plan::CheckPlan(polygon, plan);
  ASSERT_TRUE(check.passed());
  const ReplayResult result = ReplayPlan(polygon, check.projected, {});
  for (const StepReplay& step : result.steps) {
    ASSERT_EQ(step.reason, plan::Reason::kNone) << "step " << step.index << ": " << step.detail;
    EXPECT_NE(step.align_mode, AlignMode::kSlid);
  }
  tally.drift = std::max(tally.drift, result.steps.back().drift_m / polygon.diameter());
  double critical = 0;
  for (const plan::StepCheck& step : check.steps)
    critical = std::max(critical, step.required->lower);
  plan::Plan weak = check.projected;
  weak.friction_angle = std::atan(kTooLittle * std::tan(critical));
  tally.refuted += ReplayPlan(polygon, weak, {}).steps.back().reason != plan::Reason::kNone;
  for (const plan::Step& step : plan.steps) {
    if (const auto* align = std::get_if<plan::Align>(&step)) tally.turns += CountTurns(*align);
  }
  tally.steps += static_cast<int>(plan.steps.size());
  ++tally.plans;
}

constexpr int kEdges[] = {60, 128, 300};
constexpr double kFrictionAngles[] = {10, 15, 20};

TEST(PlanarCornerSweep, RandomWalksPassAndFailBelowTheirCriticalFriction) {
  std::mt19937 random(kSeed);
  Tally tally;
  for (const int edges : kEdges) {
    for (const double friction_angle_deg : kFrictionAngles) {
      const object::Polygon outline = DrawOutline(edges, random);
      Dice dice(outline, friction_angle_deg, random);
      for (int i = 0; i < 5; ++i) {
        SCOPED_TRACE(testing::Message()
                     << edges << " edges, " << friction_angle_deg << " deg, " << i);
        const std::optional<plan::Plan> plan = dice.DrawWalk();
        if (plan) MotionMonitor(outline, *plan, tally);
      }
    }
  }
  std::cout << tally.plans << " walks past " << tally.turns << " corners pass, " << tally.refuted
            << " fail at 0.9 of their required friction; largest drift over D: " << tally.drift
            << "\n";
  EXPECT_GE(tally.plans, 30);
  EXPECT_GE(tally.turns, 500);
  EXPECT_EQ(tally.refuted, tally.plans);
}

TEST(PlanarCornerSweep, RandomSwitchesPassAndFailBelowTheirCriticalFriction) {
  constexpr int kSwitches = 6;
  std::mt19937 random(kSeed);
  Tally tally;
  for (const int edges : kEdges) {
    for (const double friction_angle_deg : kFrictionAngles) {
      const object::Polygon outline = DrawOutline(edges, random);
      Dice dice(outline, friction_angle_deg, random);
      for (int i = 0; i < 3; ++i) {
        SCOPED_TRACE(testing::Message()
                     << edges << " edges, " << friction_angle_deg << " deg, " << i);
        const std::optional<plan::Plan> plan = dice.DrawSwitches(kSwitches);
        if (plan) MotionMonitor(outline, *plan, tally);
      }
    }
  }
  std::cout << tally.steps << " switches pass, " << tally.refuted << " of " << tally.plans
            << " plans fail at 0.9 of their required friction; largest drift over D: "
            << tally.drift << "\n";
  EXPECT_GE(tally.plans, 20);
  EXPECT_EQ(tally.refuted, tally.plans);
}

}  // namespace planar_corner_sweep_test
}  // namespace regrasp::sim
