// Comparison of the switch with the largest contact regions with a search along the boundary that
// computes sizes from the corners of squares.

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/sets/contour/contour_switch.h"
#include "tests/planner/sets/contour/held_contact.h"
#include "tests/planner/sets/contour/region_cases.h"
#include "tests/planner/sets/contour/square_oracle.h"

namespace regrasp::contour {
namespace largest_switch_test {

/// Return the largest smaller size of a switch between two sets, by samples along all edges.
double SampledSwitchSize(SetGeometry& geometry, sets::SetIndex v, sets::SetIndex w,
                         int samples_of_edge, int samples_of_section) {
  const Boundary& boundary = geometry.graph().boundary();
  double best = 0;
  for (FaceIndex edge{0}; edge < boundary.edge_count(); ++edge) {
    for (int i = 0; i < samples_of_edge; ++i) {
      const double share = (i + 0.5) / samples_of_edge;
      const double at = (1 - share) * boundary.begin(edge) + share * boundary.end(edge);
      const double of_v = HeldContact(geometry, v, edge, at).Sample(samples_of_section).best;
      if (of_v <= best) continue;
      const double of_w = HeldContact(geometry, w, edge, at).Sample(samples_of_section).best;
      best = std::max(best, std::min(of_v, of_w));
    }
  }
  return best;
}

TEST(LargestSwitch, IsAsLargeAsAnyThatASearchFindsAndAsItSays) {
  constexpr int kOfEdge = 10;
  constexpr int kOfSection = 16;
  int switches = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph& graph,
                         double friction_angle) {
    SetGeometry geometry(graph);
    const SquareOracle oracle(polygon, friction_angle);
    const double tolerance = SizeToleranceOf(polygon);
    for (const auto& [v, w] : graph.switches()) {
      const auto found = FindLargestSwitch(geometry, v, w);
      ASSERT_TRUE(found) << v << ' ' << w;
      ++switches;
      EXPECT_EQ(graph.set_of(found->before.piece), v);
      EXPECT_EQ(graph.set_of(found->after.piece), w);
      const double size = std::min(oracle.SizeAt(graph, found->before.piece, found->before.places),
                                   oracle.SizeAt(graph, found->after.piece, found->after.places));
      EXPECT_NEAR(size, std::min(geometry.SizeAt(found->before), geometry.SizeAt(found->after)),
                  tolerance);
      EXPECT_GE(size, SampledSwitchSize(geometry, v, w, kOfEdge, kOfSection) - tolerance)
          << "sets " << v << ' ' << w;
    }
  });
  EXPECT_GT(switches, 200);
}

TEST(LargestSwitch, KeepsOneContact) {
  int switches = 0;
  ForEachRegionGraph([&](const object::Polygon&, const ContourGraph& graph, double) {
    SetGeometry geometry(graph);
    for (const auto& [v, w] : graph.switches()) {
      const auto found = FindLargestSwitch(geometry, v, w);
      ASSERT_TRUE(found);
      EXPECT_TRUE(HaveCommonContact(graph, found->before, found->after));
      ++switches;
    }
  });
  EXPECT_GT(switches, 200);
}

double SmallerSize(SetGeometry& geometry, const ContourSwitch& found) {
  return std::min(geometry.SizeAt(found.before), geometry.SizeAt(found.after));
}

TEST(LargestSwitch, IsNeverSmallerThanOneOfMaximumMarginAndOftenLarger) {
  int switches = 0;
  int larger = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph& graph, double) {
    SetGeometry geometry(graph);
    const double tolerance = SizeToleranceOf(polygon);
    const PlacedScore size = [&](const PlacedGrasp& grasp) { return geometry.SizeAt(grasp); };
    for (const auto& [v, w] : graph.switches()) {
      const auto largest = FindLargestSwitch(geometry, v, w);
      const auto widest = FindMaxMarginSwitch(geometry, v, w, size);
      ASSERT_TRUE(largest && widest);
      const double gain = SmallerSize(geometry, *largest) - SmallerSize(geometry, *widest);
      EXPECT_GE(gain, -tolerance) << v << ' ' << w;
      ++switches;
      if (gain > tolerance) ++larger;
    }
  });
  EXPECT_GT(switches, 200);
  EXPECT_GT(larger, switches / 4);
}

TEST(LargestSwitch, IsTheSameBothWays) {
  int switches = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph& graph, double) {
    SetGeometry geometry(graph);
    for (const auto& [v, w] : graph.switches()) {
      const auto there = FindLargestSwitch(geometry, v, w);
      const auto back = FindLargestSwitch(geometry, w, v);
      ASSERT_TRUE(there && back);
      EXPECT_NEAR(SmallerSize(geometry, *there), SmallerSize(geometry, *back),
                  SizeToleranceOf(polygon));
      ++switches;
    }
  });
  EXPECT_GT(switches, 200);
}

}  // namespace largest_switch_test
}  // namespace regrasp::contour
