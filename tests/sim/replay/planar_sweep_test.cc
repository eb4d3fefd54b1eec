#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/plan/check.h"
#include "tests/sim/planar_cases.h"

namespace regrasp::sim {
namespace planar_sweep_test {

constexpr unsigned kSeed = 31;
constexpr double kFrictionAngle = Radians(20);
/// Number of draws of a grasp and of a sliding step. Polygons without a result are omitted; the
/// tests count the rest.
constexpr int kMostDraws = 20000, kMostAligns = 300;
/// Quality slightly above the disturbance: plans with it must pass.
constexpr double kLeastQuality = 0.011;

/// Return a star with `edges` edges and random arms, which is usually concave.
object::Polygon MakeStar(int edges, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i < edges; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3 * unit(random)) / edges;
    const double radius = 0.02 + 0.03 * unit(random);
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return object::Polygon::FromRings({ring}, "star");
}

/// Sampler of contacts and grasps on a polygon.
class Dice {
 public:
  Dice(const object::Polygon& polygon, std::mt19937& random) : polygon_(polygon), random_(random) {}

  [[nodiscard]] double Share() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  [[nodiscard]] int Number(int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random_);
  }
  [[nodiscard]] grasp::Contact DrawContact() {
    const int edge = Number(polygon_.face_count());
    return OnEdge(polygon_, edge, Share());
  }
  /// Return a grasp; empty if kMostDraws draws find none.
  [[nodiscard]] plan::FingerGrasp DrawGrasp(int fingers) {
    for (int i = 0; i < kMostDraws; ++i) {
      plan::FingerGrasp grasp;
      for (FingerIndex f{0}; f < fingers; ++f) grasp.push_back({f, DrawContact()});
      if (IsGood(grasp)) return grasp;
    }
    return {};
  }
  [[nodiscard]] bool IsForceClosureNow(const plan::FingerGrasp& grasp) const {
    return grasp::IsForceClosure(plan::ContactsOf(grasp), polygon_.wrench_frame(), kFrictionAngle);
  }
  [[nodiscard]] bool IsGood(const plan::FingerGrasp& grasp) const {
    return IsForceClosureNow(grasp) &&
           grasp::ComputeQuality(plan::ContactsOf(grasp), polygon_.wrench_frame(), kFrictionAngle)
                   .lower >= kLeastQuality;
  }

 private:
  const object::Polygon& polygon_;
  std::mt19937& random_;
};

/// Draw a sliding step that is force closure throughout, inside the edges of a grasp or over a
/// corner.
std::optional<plan::Plan> DrawAlign(const object::Polygon& polygon, int fingers, bool corner,
                                    Dice& dice) {
  for (int i = 0; i < kMostAligns; ++i) {
    const plan::FingerGrasp from = dice.DrawGrasp(fingers);
    if (from.empty()) return std::nullopt;
    std::vector<plan::FingerGrasp> waypoints = {from, from};
    for (plan::FingerContact& held : waypoints.back()) {
      held = OnEdge(polygon, held.finger, held.contact.face, dice.Share());
    }
    if (corner) {
      // The end of the edge is the start of the next one, except for the last edge, which meets the
      // first.
      const int edge = from[0].contact.face, next = (edge + 1) % polygon.face_count();
      waypoints.back()[0] = OnEdge(polygon, from[0].finger, edge, 1);
      waypoints.push_back(waypoints.back());
      waypoints.back()[0] = OnEdge(polygon, from[0].finger, next, 0);
      waypoints.push_back(waypoints.back());
      waypoints.back()[0] = OnEdge(polygon, from[0].finger, next, dice.Share());
    }
    if (!std::ranges::all_of(waypoints, [&](const auto& grasp) { return dice.IsGood(grasp); })) {
      continue;
    }
    plan::Plan plan = MakePlanarPlan(from, Degrees(kFrictionAngle));
    plan.steps = {plan::Align{waypoints}};
    plan.goal = plan::ContactsOf(waypoints.back());
    if (plan::CheckPlan(polygon, plan).passed()) return plan;
  }
  return std::nullopt;
}

TEST(PlanarSweep, RandomAlignsThatAreForceClosureAllTheWayPass) {
  std::mt19937 random(kSeed);
  int checked = 0;
  double drift = 0;
  for (const int edges : {6, 12, 40}) {
    const object::Polygon star = MakeStar(edges, random);
    Dice dice(star, random);
    for (int i = 0; i < 24; ++i) {
      const std::optional<plan::Plan> plan = DrawAlign(star, 2 + i % 2, i % 6 == 5, dice);
      if (!plan) continue;
      const ReplayResult result = ReplayPlan(star, *plan, {});
      ASSERT_EQ(result.steps.size(), 2u) << edges << " edges, align " << i;
      EXPECT_EQ(result.steps[1].reason, plan::Reason::kNone)
          << edges << " edges, align " << i << ": " << result.steps[1].detail;
      EXPECT_EQ(result.steps[1].align_mode, AlignMode::kImitated);
      drift = std::max(drift, result.steps[1].drift_m / star.diameter());
      ++checked;
    }
  }
  std::cout << checked << " planar aligns, largest drift over D: " << drift << "\n";
  EXPECT_GE(checked, 50);
}

/// Draw a switch between the grasp and a random one, which is good, or is not force closure.
std::optional<plan::Switch> DrawSwitch(const plan::FingerGrasp& before, bool good, Dice& dice) {
  std::vector<FingerIndex> holding, free;
  for (FingerIndex f{0}; f < 4; ++f) {
    const bool holds = plan::FindFinger(before, f) != nullptr;
    (holds ? holding : free).push_back(f);
  }
  for (int i = 0; i < kMostDraws; ++i) {
    plan::Switch change;
    const int placed = 1 + dice.Number(static_cast<int>(free.size()));
    for (int k = 0; k < placed; ++k) change.place.push_back({free[k], dice.DrawContact()});
    const int first = dice.Number(static_cast<int>(holding.size()));
    const int released = dice.Number(static_cast<int>(holding.size()) + 1);
    for (int k = 0; k < released; ++k) {
      change.release.push_back(holding[(first + k) % holding.size()]);
    }
    const plan::FingerGrasp after = plan::GraspAfter(before, change);
    if (after.size() < 2 || after.size() > 3) continue;
    if (good ? dice.IsGood(after) : !dice.IsForceClosureNow(after)) return change;
  }
  return std::nullopt;
}

/// Draw `switches` switches between good grasps, then one to a bad grasp; fewer if a draw fails.
plan::Plan DrawWalk(int fingers, int switches, Dice& dice) {
  plan::FingerGrasp grasp = dice.DrawGrasp(fingers);
  plan::Plan plan = MakePlanarPlan(grasp, Degrees(kFrictionAngle));
  for (int i = 0; !grasp.empty() && i <= switches; ++i) {
    const std::optional<plan::Switch> change = DrawSwitch(grasp, i < switches, dice);
    if (!change) break;
    plan.steps.emplace_back(*change);
    grasp = plan::GraspAfter(grasp, plan.steps.back());
  }
  return plan;
}

TEST(PlanarSweep, RandomSwitchesBetweenGoodGraspsPassAndOneToABadGraspFails) {
  constexpr int kSwitches = 10;
  std::mt19937 random(kSeed);
  int walks = 0, failed = 0;
  for (const int edges : {6, 12, 40}) {
    const object::Polygon star = MakeStar(edges, random);
    Dice dice(star, random);
    for (int walk = 0; walk < 10; ++walk) {
      const plan::Plan plan = DrawWalk(2 + walk % 2, kSwitches, dice);
      if (plan.steps.size() != kSwitches + 1) continue;
      const ReplayResult result = ReplayPlan(star, plan, {});
      ASSERT_EQ(result.steps.size(), plan.steps.size() + 1)
          << edges << " edges, walk " << walk << ": " << result.steps.back().detail;
      failed += result.steps.back().reason != plan::Reason::kNone;
      ++walks;
    }
  }
  std::cout << walks * kSwitches << " planar switches pass, " << failed << " of " << walks
            << " to a bad grasp fail\n";
  EXPECT_GE(walks, 20);
  EXPECT_EQ(failed, walks);
}

}  // namespace planar_sweep_test
}  // namespace regrasp::sim
