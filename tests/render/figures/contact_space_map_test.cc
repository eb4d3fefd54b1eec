#include "render/figures/contact_space_map.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/render/figures/contact_space_scenes.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace contact_space_map_test {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::SizeIs;

/// The contact space of a polygon and a plan.
struct Scene {
  Scene(object::Polygon object, const plan::Plan& plan)
      : polygon(std::move(object)),
        graph(polygon, plan.friction_angle),
        geometry(graph),
        track(TrackPlan(plan)),
        map(MapContactSpace(geometry, track)) {}

  [[nodiscard]] const MapSet& SetNamed(int name) const {
    return *std::ranges::find_if(map.sets, [&](const MapSet& set) { return set.name == name; });
  }

  object::Polygon polygon;
  contour::ContourGraph graph;
  contour::SetGeometry geometry;
  std::vector<TrackEntry> track;
  ContactSpaceMap map;
};

bool IsInside(const MapSet& set, const SpacePoint& point) {
  return std::ranges::any_of(set.pieces, [&](const SpaceShape& piece) {
    Outline outline = piece.points;
    if (AreaOf({outline}) < 0) std::ranges::reverse(outline);
    return piece.rings == point.rings && Contains(outline, point.places);
  });
}

TEST(ContactSpaceMapTest, ASwitchThatKeepsAContactMovesAlongOneAxis) {
  const Scene fork(MakeFork(), MakeForkPlan());
  ASSERT_THAT(fork.map.switches, SizeIs(2));
  for (const MapSwitch& step : fork.map.switches) {
    ASSERT_TRUE(step.shared_axis.has_value());
    const int axis = *step.shared_axis;
    EXPECT_EQ(step.from.places[axis], step.to.places[axis]);
    EXPECT_NE(step.from.places[1 - axis], step.to.places[1 - axis]);
  }
  const Scene exchange(MakeSquare(), MakeExchangePlan());
  ASSERT_THAT(exchange.map.switches, SizeIs(1));
  const MapSwitch& step = exchange.map.switches.front();
  EXPECT_EQ(step.shared_axis, std::nullopt);
  EXPECT_NE(step.from.places.x(), step.to.places.x());
  EXPECT_NE(step.from.places.y(), step.to.places.y());
}

TEST(ContactSpaceMapTest, StaticGraspsAreInTheSetsNamedAfterThem) {
  const Scene fork(MakeFork(), MakeForkPlan());
  ASSERT_THAT(fork.map.grasps, SizeIs(3));
  for (int i = 0; i < 3; ++i) {
    for (int name = 0; name < 3; ++name) {
      EXPECT_EQ(IsInside(fork.SetNamed(name), fork.map.grasps[i]), i == name) << i << " " << name;
    }
  }
}

TEST(ContactSpaceMapTest, SetsAreNamedInThePlansOrder) {
  const Scene fork(MakeFork(), MakeForkPlan());
  std::vector<int> names;
  for (const TrackEntry& entry : fork.track) {
    const auto at = fork.geometry.Locate({entry.grasp[0].contact, entry.grasp[1].contact});
    names.push_back(NameSets(fork.geometry, fork.track).at(fork.graph.set_of(at->piece)));
  }
  EXPECT_THAT(names, ElementsAre(0, 1, 2));
  EXPECT_EQ(SetName(0), "A");
  EXPECT_EQ(SetName(25), "Z");
  EXPECT_EQ(SetName(26), "AA");
}

TEST(ContactSpaceMapTest, OnlyTheSetInTheSlotStretches) {
  const Scene fork(MakeFork(), MakeForkPlan());
  EXPECT_FALSE(fork.SetNamed(0).stretching);
  EXPECT_FALSE(fork.SetNamed(1).stretching);
  EXPECT_TRUE(fork.SetNamed(2).stretching);
}

TEST(ContactSpaceMapTest, BothHalvesAreDrawn) {
  const Scene fork(MakeFork(), MakeForkPlan());
  EXPECT_EQ(static_cast<int>(fork.map.sets.size()), fork.graph.vertex_count());
  int checked = 0;
  for (const MapSet& set : fork.map.sets) {
    for (const SpaceShape& piece : set.pieces) {
      SpacePoint middle = {piece.rings, Vector2d::Zero()};
      for (const Vector2d& p : piece.points) middle.places += p;
      middle.places /= static_cast<double>(piece.points.size());
      EXPECT_TRUE(IsInside(set, middle));
      std::swap(middle.places.x(), middle.places.y());
      EXPECT_TRUE(IsInside(set, middle));
      ++checked;
    }
    EXPECT_EQ(set.border.size() % 2, 0u);
  }
  EXPECT_GE(checked, 6);
}

TEST(ContactSpaceMapTest, TheNameIsAtTheCentreOfTheLargestSquare) {
  Scene fork(MakeFork(), MakeForkPlan());
  std::mt19937_64 engine(11);
  int checked = 0;
  for (int name = 0; name < 3; ++name) {
    const MapSet& set = fork.SetNamed(name);
    ASSERT_THAT(set.label_places, SizeIs(2));
    const contour::RegionMetric& metric = fork.geometry.MetricOf(set.set);
    const double best = metric.SizeAt(set.label_places[0].places);
    std::uniform_real_distribution<double> place(
        0, fork.graph.boundary().perimeter(contour::RingIndex(0)));
    for (int i = 0; i < 20000; ++i) {
      const SpacePoint p = {{contour::RingIndex(0), contour::RingIndex(0)},
                            {place(engine), place(engine)}};
      if (p.places.x() > p.places.y() || !IsInside(set, p)) continue;
      EXPECT_LE(metric.SizeAt(p.places), best + 1e-9);
      ++checked;
    }
  }
  EXPECT_GT(checked, 100);
  for (const MapSet& set : fork.map.sets) {
    EXPECT_EQ(set.label_places.empty(), !set.name.has_value());
  }
}

TEST(ContactSpaceMapTest, APathIsSplitAtTheEndOfTheRing) {
  const object::Polygon disc = MakeDisc(12);
  const Scene scene(disc, MakeDiscPlan(disc));
  const double perimeter = scene.graph.boundary().perimeter(contour::RingIndex(0));
  ASSERT_THAT(scene.map.paths, SizeIs(2));
  // The contact on the edge with the lower index is on the horizontal axis. Here it is the second
  // contact.
  EXPECT_NEAR(scene.map.paths[0].points.back().y(), perimeter, 1e-12);
  EXPECT_NEAR(scene.map.paths[1].points.front().y(), 0, 1e-12);
  EXPECT_NEAR(scene.map.paths[1].points.front().x(), perimeter / 2, 1e-12);
}

TEST(ContactSpaceMapTest, APathWithOtherTurnsIsNotSplit) {
  const object::Polygon disc = MakeDisc(12);
  plan::Plan plan = MakeDiscPlan(disc);
  const auto at = [&](int edge, double u) {
    return plan::FingerGrasp{FingerAt(disc, 0, edge, u), FingerAt(disc, 1, edge + 6, u)};
  };
  plan.initial = at(2, 0.5);
  plan.steps = {plan::Align{{at(2, 0.5), at(2, 1), at(3, 0), at(3, 0.5)}}};
  EXPECT_THAT(Scene(disc, plan).map.paths, SizeIs(1));
}

TEST(ContactSpaceMapTest, OnlyRingsThatThePlanUsesAreShown) {
  const object::Polygon ring = MakeRing(12);
  plan::Plan plan = MakeForkPlan();
  plan.steps.clear();
  // The wall between the outer ring and the hole, near the first vertex. Holes are clockwise.
  plan.initial = {FingerAt(ring, 0, 0, 0.5), FingerAt(ring, 1, 23, 0.5)};
  const auto projected = [&](const plan::Plan& p) { return Scene(ring, p); };
  EXPECT_THAT(projected(plan).map.rings, ElementsAre(contour::RingIndex(0), contour::RingIndex(1)));
  plan.initial = {FingerAt(ring, 0, 0, 0.5), FingerAt(ring, 1, 6, 0.5)};
  const Scene outer = projected(plan);
  EXPECT_THAT(outer.map.rings, ElementsAre(contour::RingIndex(0)));
  EXPECT_LT(static_cast<int>(outer.map.sets.size()), outer.map.set_count);
}

}  // namespace contact_space_map_test
}  // namespace regrasp::render
