#include "render/figures/contact_space_switch.h"

#include <gmock/gmock.h>

#include "planner/sets/contour/contour_planner.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/figure_page.h"
#include "tests/fixtures/plan_with.h"
#include "tests/render/figures/contact_space_scenes.h"

namespace regrasp::render {
namespace contact_space_switch_test {

using Eigen::Vector2d;
using testing::SizeIs;

/// Return all switches of a plan.
std::vector<ContactSwitch> SwitchesOf(const object::Polygon& polygon, const plan::Plan& plan) {
  const contour::ContourGraph graph(polygon, plan.friction_angle);
  contour::SetGeometry geometry(graph);
  const std::vector<TrackEntry> track = TrackPlan(plan);
  std::vector<ContactSwitch> switches;
  for (plan::EntryIndex entry{1}; entry < std::ssize(track); ++entry) {
    auto found = DescribeContactSwitch(geometry, track, entry, NameSets(geometry, track));
    if (found) switches.push_back(std::move(*found));
  }
  return switches;
}

/// Return the switches of random plans on a fork and on a ring.
std::vector<ContactSwitch> ManySwitches() {
  std::vector<ContactSwitch> all;
  for (const object::Polygon& polygon : {MakeFork(), MakeRing(20)}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const planning::GraspChoice random = {planning::GraspChoice::Kind::kRandom, {}, "random"};
      planning::PlanRequest options;
      options.criteria.friction_angle = 0.45;
      options.seed = seed;
      if (seed % 2 == 0) options.objective = planning::Objective::kRegions;
      const planning::PlanResult result =
          PlanWith(contour::ContourPlanner(), polygon, random, random, options);
      if (!result.plan) continue;
      for (ContactSwitch& step : SwitchesOf(polygon, *result.plan)) all.push_back(std::move(step));
    }
  }
  return all;
}

/// Return whether a square around the grasp is inside the drawn set, at sampled points of its
/// border. The size is a share of the square in the figure.
bool SquareFits(const ContactSwitchSide& side, double share) {
  constexpr int kSteps = 200;
  const double half = share * side.size;
  for (int k = 0; k < kSteps; ++k) {
    const double t = 2 * half * (k + 0.5) / kSteps - half;
    for (const Vector2d& p :
         {Vector2d(t, half), Vector2d(t, -half), Vector2d(half, t), Vector2d(-half, t)}) {
      const bool inside = std::ranges::any_of(side.set.pieces, [&](const Outline& outline) {
        return Contains(outline, side.grasp + p, 1e-9);
      });
      if (!inside) return false;
    }
  }
  return true;
}

TEST(ContactSpaceSwitchTest, TheContactThatStaysIsInLine) {
  int checked = 0;
  for (const ContactSwitch& step : ManySwitches()) {
    EXPECT_NEAR(step.sides[0].grasp.y(), step.sides[1].grasp.y(), 1e-9);
    EXPECT_NE(step.sides[0].grasp.x(), step.sides[1].grasp.x());
    ++checked;
  }
  EXPECT_GT(checked, 10);
}

TEST(ContactSpaceSwitchTest, TheOverlapIsInBothProjectionsAndHasTheContactThatStays) {
  int checked = 0;
  for (const ContactSwitch& step : ManySwitches()) {
    const double place = step.sides[0].grasp.y();
    EXPECT_LE(step.overlap.low, place + 1e-9);
    EXPECT_GE(step.overlap.high, place - 1e-9);
    EXPECT_LT(step.overlap.low, step.overlap.high);
    for (const ContactSwitchSide& side : step.sides) {
      EXPECT_LE(side.projection.low, step.overlap.low);
      EXPECT_GE(side.projection.high, step.overlap.high);
      for (const double at : {0.1, 0.5, 0.9}) {
        const double y = step.overlap.low + at * (step.overlap.high - step.overlap.low);
        EXPECT_TRUE(std::ranges::any_of(side.set.pieces, [&](const Outline& outline) {
          const auto [low, high] =
              std::ranges::minmax(outline, {}, [](const Vector2d& p) { return p.y(); });
          return low.y() <= y && y <= high.y();
        }));
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 60);
}

TEST(ContactSpaceSwitchTest, SquaresFitTheSetAsDrawnAndLargerOnesDoNot) {
  int checked = 0;
  for (const ContactSwitch& step : ManySwitches()) {
    for (const ContactSwitchSide& side : step.sides) {
      if (side.size < 1e-3) continue;  // too small for the sampling distance
      // A set that continues around the object is cut, and a square can extend over the cut.
      if (!side.set.cuts.empty()) continue;
      EXPECT_TRUE(SquareFits(side, 0.999));
      EXPECT_FALSE(SquareFits(side, 1.02));
      ++checked;
    }
  }
  EXPECT_GT(checked, 10);
}

TEST(ContactSpaceSwitchTest, KnowsTheAnswerOnAFork) {
  const std::vector<ContactSwitch> switches = SwitchesOf(MakeFork(), MakeForkPlan());
  ASSERT_THAT(switches, SizeIs(2));
  const auto& [both_sides, prong] = switches[0].sides;
  EXPECT_NEAR(both_sides.grasp.x(), 46, 1e-12);
  EXPECT_NEAR(prong.grasp.x(), 25, 1e-12);
  EXPECT_NEAR(prong.grasp.y(), 18, 1e-12);
  // The prong is held where its inner side is opposite or offset by at most 3 tan 20°.
  EXPECT_NEAR(switches[0].sides[1].projection.low, 13 - 3 * std::tan(0.349065850398866), 1e-9);
  EXPECT_NEAR(switches[0].sides[1].projection.high, 20, 1e-12);
  EXPECT_NEAR(switches[0].overlap.high, 20, 1e-12);
  EXPECT_FALSE(switches[1].sides[0].stretching);
  EXPECT_TRUE(switches[1].sides[1].stretching);
  // Two below the ends, the nearest border of the prong's set involves both contacts: it consists
  // of heights h and h' with |h − h'| = 3 tan 20°. A square of half-width 3/2 tan 20° touches it.
  EXPECT_NEAR(prong.size, 1.5 * std::tan(0.349065850398866), 1e-9);
}

TEST(ContactSpaceSwitchTest, AnExchangeOfBothContactsHasNoFigure) {
  EXPECT_THAT(
      SwitchesOf(object::Polygon::FromRings({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, "square"),
                 MakeExchangePlan()),
      SizeIs(0));
}

TEST(ContactSpaceSwitchFigureTest, BothSetsHaveOneScaleAndOneAxisAndAreOnThePage) {
  int checked = 0;
  for (const ContactSwitch& step : ManySwitches()) {
    const SwitchLayout layout = LayOutSwitch(step);
    const auto& [left, right] = layout.windows;
    EXPECT_EQ(left.scale, right.scale);
    EXPECT_EQ(left.scale.x(), left.scale.y());
    EXPECT_EQ(left.ToPage({left.low.x(), step.overlap.low}).y(),
              right.ToPage({right.low.x(), step.overlap.low}).y());
    EXPECT_LT(left.corner.x() + left.size().x(), right.corner.x());
    EXPECT_LT(right.corner.x() + right.size().x(), kTwoColumnWidth);
    for (int k = 0; k < 2; ++k) {
      for (const Outline& outline : step.sides[k].set.pieces) {
        for (const Vector2d& p : outline) {
          EXPECT_TRUE((p.array() > layout.windows[k].low.array()).all());
          EXPECT_TRUE((p.array() < layout.windows[k].high.array()).all());
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 100);
}

}  // namespace contact_space_switch_test
}  // namespace regrasp::render
