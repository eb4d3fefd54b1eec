#include "planner/sets/contour/contour_switch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/grasp/force_closure.h"
#include "planner/sets/contour/set_geometry.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace contour_switch_test {

using Eigen::Vector2d;

/// Return the largest half-width of a square in a set with a contact fixed at a place of an edge,
/// by sampling the other contact.
double LargestAt(SetGeometry& geometry, sets::SetIndex set, FaceIndex edge, double place) {
  constexpr int kTries = 200;
  double largest = 0;
  for (const PieceIndex piece : geometry.graph().pieces_of(set)) {
    const auto& edges = geometry.graph().pieces()[piece].edges;
    for (int k = 0; k < 2; ++k) {
      if (edges[k] != edge) continue;
      const auto slice = geometry.SliceOf(piece, k, place);
      if (!slice) continue;
      for (int i = 0; i <= kTries; ++i) {
        PlacedGrasp grasp = {piece, {}};
        grasp.places[k] = place;
        grasp.places[1 - k] = slice->low + (slice->high - slice->low) * i / kTries;
        largest = std::max(largest, geometry.SizeAt(grasp));
      }
    }
  }
  return largest;
}

/// Return the largest smaller half-width of all switches, by sampling the common contact.
double LargestSwitchByTrying(SetGeometry& geometry, sets::SetIndex from, sets::SetIndex to) {
  constexpr int kTries = 60;
  const Boundary& boundary = geometry.graph().boundary();
  double largest = 0;
  for (FaceIndex edge{0}; edge < boundary.edge_count(); ++edge) {
    for (int i = 0; i <= kTries; ++i) {
      const double place =
          boundary.begin(edge) + (boundary.end(edge) - boundary.begin(edge)) * i / kTries;
      const double before = LargestAt(geometry, from, edge, place);
      if (before <= largest) continue;
      largest = std::max(largest, std::min(before, LargestAt(geometry, to, edge, place)));
    }
  }
  return largest;
}

void ExpectCommonContact(SetGeometry& geometry, const ContourSwitch& found, sets::SetIndex from,
                         sets::SetIndex to) {
  const ContourGraph& graph = geometry.graph();
  EXPECT_EQ(graph.set_of(found.before.piece), from);
  EXPECT_EQ(graph.set_of(found.after.piece), to);
  int common = 0;
  for (const grasp::Contact& a : geometry.GraspOf(found.before)) {
    for (const grasp::Contact& b : geometry.GraspOf(found.after)) {
      if (a.p != b.p || a.n != b.n) continue;
      if (a.face == b.face) ++common;
    }
  }
  EXPECT_EQ(common, 1);
}

TEST(ContourSwitch, TheLargestOneIsThatOfAGridSearch) {
  int pairs = 0;
  for (const auto& [name, polygon] : TwelveEdgePolygons()) {
    const ContourGraph graph(polygon, Radians(20));
    SetGeometry geometry(graph);
    double resolution = 0;
    for (FaceIndex e{0}; e < polygon.face_count(); ++e) {
      resolution = std::max(resolution, polygon.face_measure(FaceIndex(e)) / 60);
    }
    for (const auto& [a, b] : graph.switches()) {
      if (++pairs % 5 != 0) continue;
      SCOPED_TRACE(name + ", sets " + std::to_string(a) + " and " + std::to_string(b));
      const auto found = FindLargestSwitch(geometry, a, b);
      ASSERT_TRUE(found);
      ExpectCommonContact(geometry, *found, a, b);
      const double size = std::min(geometry.SizeAt(found->before), geometry.SizeAt(found->after));
      const double tried = LargestSwitchByTrying(geometry, a, b);
      EXPECT_GE(size, tried - 1e-9);
      EXPECT_LE(size, tried + resolution);
      const auto back = FindLargestSwitch(geometry, b, a);
      ASSERT_TRUE(back);
      EXPECT_NEAR(std::min(geometry.SizeAt(back->before), geometry.SizeAt(back->after)), size,
                  1e-9);
    }
  }
  EXPECT_GT(pairs, 60);
}

TEST(ContourSwitch, AWideOneIsFoundForEverySwitchOfTheGraphAndForNoOther) {
  int joined = 0;
  int apart = 0;
  for (const auto& [name, polygon] : TwelveEdgePolygons()) {
    const ContourGraph graph(polygon, Radians(15));
    SetGeometry geometry(graph);
    const PlacedScore size = [&](const PlacedGrasp& grasp) { return geometry.SizeAt(grasp); };
    for (sets::SetIndex a{0}; a < graph.vertex_count(); ++a) {
      for (sets::SetIndex b(a + 1); b < graph.vertex_count(); ++b) {
        SCOPED_TRACE(name + ", sets " + std::to_string(a) + " and " + std::to_string(b));
        const bool is_joined = std::ranges::binary_search(graph.switches(), std::array{a, b});
        const auto found = FindMaxMarginSwitch(geometry, a, b, size);
        EXPECT_EQ(found.has_value(), is_joined);
        EXPECT_EQ(FindLargestSwitch(geometry, a, b).has_value(), is_joined);
        (is_joined ? joined : apart) += 1;
        if (!found) continue;
        ExpectCommonContact(geometry, *found, a, b);
        for (const PlacedGrasp& grasp : {found->before, found->after}) {
          EXPECT_TRUE(
              grasp::IsForceClosure(geometry.GraspOf(grasp), polygon.wrench_frame(), Radians(15)));
        }
        const auto after = FindGraspKeeping(geometry, found->before, b, size);
        ASSERT_TRUE(after);
        ExpectCommonContact(geometry, {found->before, *after}, a, b);
        const auto before = FindGraspKeeping(geometry, found->after, a, size);
        ASSERT_TRUE(before);
        ExpectCommonContact(geometry, {*before, found->after}, a, b);
        EXPECT_TRUE(HaveCommonContact(graph, found->before, found->after));
      }
    }
  }
  EXPECT_GT(joined, 40);
  EXPECT_GT(apart, 60);
}

/// Check that every grasp of a route is in the set, and that between two of them contacts move on
/// their edges or one passes a vertex.
void ExpectRoute(SetGeometry& geometry, const std::vector<PlacedGrasp>& route) {
  const ContourGraph& graph = geometry.graph();
  const object::Polygon& polygon = graph.boundary().polygon();
  const double friction_angle = std::atan(graph.tangent());
  for (std::size_t i = 0; i + 1 < route.size(); ++i) {
    const PlacedGrasp& a = route[i];
    const PlacedGrasp& b = route[i + 1];
    EXPECT_EQ(graph.set_of(a.piece), graph.set_of(b.piece));
    if (a.piece == b.piece) {
      for (const double share : {0.25, 0.5, 0.75}) {
        const PlacedGrasp between = {a.piece, a.places + share * (b.places - a.places)};
        EXPECT_TRUE(grasp::IsForceClosure(geometry.GraspOf(between), polygon.wrench_frame(),
                                          friction_angle));
      }
      continue;
    }
    int same_contacts = 0;
    int same_points = 0;
    for (const grasp::Contact& before : geometry.GraspOf(a)) {
      for (const grasp::Contact& after : geometry.GraspOf(b)) {
        if (before.p != after.p) continue;
        ++same_points;
        if (before.face == after.face) ++same_contacts;
      }
    }
    EXPECT_EQ(same_points, 2);
    EXPECT_EQ(same_contacts, 1);
  }
}

TEST(AlignRoute, StaysInTheSetAndTurnsOneCornerAtATime) {
  int corners = 0;
  std::vector<NamedPolygon> polygons = TwelveEdgePolygons();
  polygons.push_back({"disc", RegularPolygon(40)});
  polygons.push_back({"irregular", IrregularOutline(60, 0.9, 5)});
  for (const auto& [name, polygon] : polygons) {
    SCOPED_TRACE(name);
    const ContourGraph graph(polygon, Radians(20));
    SetGeometry geometry(graph);
    RandomStream random(11, RandomUse::kStart);
    for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
      for (int i = 0; i < 3; ++i) {
        const auto from = geometry.Draw(set, random);
        const auto to = geometry.Draw(set, random);
        if (!from || !to) continue;
        const auto route = FindAlignRoute(geometry, *from, *to);
        ASSERT_GE(route.size(), 2U);
        EXPECT_EQ(route.front(), *from);
        EXPECT_EQ(route.back(), *to);
        ExpectRoute(geometry, route);
        corners += static_cast<int>(route.size()) / 2 - 1;
      }
      const auto grasp = geometry.Draw(set, random);
      if (grasp) {
        EXPECT_EQ(FindAlignRoute(geometry, *grasp, *grasp), std::vector{*grasp});
      }
    }
  }
  EXPECT_GT(corners, 100);
}

TEST(AlignRoute, TakesTheShortPathAroundADisc) {
  const object::Polygon disc = RegularPolygon(24);
  const ContourGraph graph(disc, Radians(15));
  SetGeometry geometry(graph);
  const Boundary& boundary = graph.boundary();
  const auto middle = [&](FaceIndex edge) {
    return boundary.ContactAt(edge, (boundary.begin(edge) + boundary.end(edge)) / 2);
  };
  const auto opposite = [&](int edge) {
    return *geometry.Locate({middle(FaceIndex(edge)), middle(FaceIndex((edge + 12) % 24))});
  };
  // Both fingers move by two edges. With exchanged fingers, they would move by ten edges.
  const auto route = FindAlignRoute(geometry, opposite(11), opposite(1));
  EXPECT_EQ(route.size(), 2U + 2 * 4);
}

}  // namespace contour_switch_test
}  // namespace regrasp::contour
