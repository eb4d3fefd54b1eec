#include <gmock/gmock.h>

#include <numeric>

#include "planner/base/number.h"
#include "render/figures/contact_space_track.h"
#include "tests/render/figures/contact_space_scenes.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace contact_space_unfolding_test {

using Eigen::Vector2d;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// A small offset relative to lengths of about 1.
constexpr double kAside = 1e-7;

struct Case {
  std::string name;
  object::Polygon polygon;
};

std::vector<Case> Cases() {
  return {{"square", MakeSquare()},
          {"fork", MakeFork()},
          {"disc", MakeDisc(24)},
          {"odd disc", MakeDisc(15)},
          {"ring", MakeRing(16)}};
}

/// Return a set unfolded from one of its grasps.
UnfoldedSet Unfold(contour::SetGeometry& geometry, sets::SetIndex set, int upright) {
  const contour::PieceIndex piece = geometry.graph().pieces_of(set).front();
  const std::vector<Vector2d>& outline = geometry.OutlineOf(piece);
  const Vector2d sum = std::accumulate(outline.begin(), outline.end(), Vector2d(0, 0));
  const Vector2d middle = sum / static_cast<double>(outline.size());
  return UnfoldSet(geometry, {piece, middle}, upright);
}

bool IsOn(const Vector2d& p, const std::vector<Segment>& segments) {
  return std::ranges::any_of(segments, [&](const Segment& segment) {
    const Vector2d side = segment[1] - segment[0];
    const double t = std::clamp((p - segment[0]).dot(side) / side.squaredNorm(), 0.0, 1.0);
    return (p - segment[0] - t * side).norm() < kAside / 100;
  });
}

struct Sides {
  int checked = 0;
  int open = 0;  ///< sides without neighbour and without border
};

/// Count the points along the sides of all pieces that have neither a neighbouring piece nor a line
/// beyond them.
Sides CountOpenSides(const UnfoldedSet& set) {
  constexpr int kSteps = 7;
  Sides sides;
  for (const Outline& outline : set.pieces) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2d& a = outline[i];
      const Vector2d& b = outline[(i + 1) % outline.size()];
      const Vector2d outward = Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
      if ((b - a).norm() < 100 * kAside) continue;
      for (int k = 0; k < kSteps; ++k) {
        const Vector2d p = a + (k + 0.5) / kSteps * (b - a);
        ++sides.checked;
        const bool goes_on = CountContaining(set.pieces, p + kAside * outward) > 0;
        if (!goes_on && !IsOn(p, set.border) && !IsOn(p, set.cuts)) ++sides.open;
      }
    }
  }
  return sides;
}

TEST(ContactSpaceUnfoldingTest, ASideOfAPieceIsBorderOrAnotherPieceFollows) {
  int checked = 0;
  for (const Case& c : Cases()) {
    for (const double degrees : {12.0, 31.0}) {
      const contour::ContourGraph graph(c.polygon, Radians(degrees));
      contour::SetGeometry geometry(graph);
      for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
        const Sides sides = CountOpenSides(Unfold(geometry, set, set % 2));
        EXPECT_EQ(sides.open, 0) << c.name << " " << degrees << "°, set " << set;
        checked += sides.checked;
      }
    }
  }
  EXPECT_GT(checked, 5000);
}

TEST(ContactSpaceUnfoldingTest, WithoutUnfoldingASetEndsAtTheFrameWithoutABorder) {
  const object::Polygon disc = MakeDisc(24);
  const contour::ContourGraph graph(disc, Radians(20));
  contour::SetGeometry geometry(graph);
  ASSERT_EQ(graph.vertex_count(), 1);
  UnfoldedSet raw;
  for (const contour::PieceIndex piece : graph.pieces_of(sets::SetIndex(0)))
    raw.pieces.push_back(geometry.OutlineOf(piece));
  for (const contour::BorderSegment& part : contour::SetBorder(graph, sets::SetIndex(0)))
    raw.border.push_back({part.from, part.to});
  EXPECT_GT(CountOpenSides(raw).open, 0);
}

TEST(ContactSpaceUnfoldingTest, BorderHasTheSetOnOneSideOnly) {
  int checked = 0;
  for (const Case& c : Cases()) {
    const contour::ContourGraph graph(c.polygon, Radians(20));
    contour::SetGeometry geometry(graph);
    for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
      const UnfoldedSet unfolded = Unfold(geometry, set, 1);
      for (const Segment& segment : unfolded.border) {
        const Vector2d side = segment[1] - segment[0];
        if (side.norm() < 100 * kAside) continue;
        const Vector2d across = kAside * Vector2d(side.y(), -side.x()).normalized();
        const Vector2d p = segment[0] + 0.37 * side;
        EXPECT_EQ(CountContaining(unfolded.pieces, p + across) +
                      CountContaining(unfolded.pieces, p - across),
                  1)
            << c.name << ", set " << set << ": " << p.transpose();
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 200);
}

TEST(ContactSpaceUnfoldingTest, PiecesKeepTheirAreaAndDoNotOverlap) {
  int checked = 0;
  for (const Case& c : Cases()) {
    const contour::ContourGraph graph(c.polygon, Radians(25));
    contour::SetGeometry geometry(graph);
    for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
      const UnfoldedSet unfolded = Unfold(geometry, set, 0);
      std::vector<Outline> listed;
      for (const contour::PieceIndex piece : graph.pieces_of(set))
        listed.push_back(geometry.OutlineOf(piece));
      EXPECT_NEAR(AreaOf(unfolded.pieces), AreaOf(listed), 1e-9 * AreaOf(listed)) << c.name;
      for (const Outline& outline : unfolded.pieces) {
        const Vector2d sum = std::accumulate(outline.begin(), outline.end(), Vector2d(0, 0));
        const Vector2d middle = sum / static_cast<double>(outline.size());
        EXPECT_EQ(CountContaining(unfolded.pieces, middle), 1) << c.name << ", set " << set;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(ContactSpaceUnfoldingTest, TheFirstGraspIsNotMoved) {
  const object::Polygon disc = MakeDisc(24);
  const contour::ContourGraph graph(disc, Radians(20));
  contour::SetGeometry geometry(graph);
  const contour::PieceIndex piece = graph.PiecesOn(FaceIndex(3), FaceIndex(15)).front();
  const double edge = graph.boundary().end(FaceIndex(0));
  const contour::PlacedGrasp grasp = {piece, {3.5 * edge, 15.5 * edge}};
  EXPECT_EQ(CountContaining(UnfoldSet(geometry, grasp, 1).pieces, grasp.places), 1);
  const Vector2d swapped(grasp.places.y(), grasp.places.x());
  EXPECT_EQ(CountContaining(UnfoldSet(geometry, grasp, 0).pieces, swapped), 1);
  EXPECT_EQ(CountContaining(UnfoldSet(geometry, grasp, 1).pieces, swapped), 0);
}

TEST(ContactSpaceUnfoldingTest, OnlyASetAroundTheObjectIsCut) {
  const object::Polygon square = MakeSquare();
  const contour::ContourGraph simple(square, Radians(20));
  contour::SetGeometry simple_geometry(simple);
  ASSERT_EQ(simple.vertex_count(), 2);
  for (const sets::SetIndex set : {sets::SetIndex(0), sets::SetIndex(1)}) {
    const UnfoldedSet unfolded = Unfold(simple_geometry, set, 1);
    EXPECT_THAT(unfolded.cuts, IsEmpty());
    EXPECT_THAT(unfolded.pieces, SizeIs(1));
  }
  const object::Polygon disc = MakeDisc(24);
  const contour::ContourGraph round(disc, Radians(20));
  contour::SetGeometry round_geometry(round);
  const UnfoldedSet unfolded = Unfold(round_geometry, sets::SetIndex(0), 1);
  EXPECT_THAT(unfolded.cuts, Not(IsEmpty()));
  for (const Segment& cut : unfolded.cuts) {
    const Vector2d side = cut[1] - cut[0];
    if (side.norm() < 100 * kAside) continue;
    const Vector2d across = kAside * Vector2d(side.y(), -side.x()).normalized();
    const Vector2d p = cut[0] + 0.37 * side;
    EXPECT_EQ(
        CountContaining(unfolded.pieces, p + across) + CountContaining(unfolded.pieces, p - across),
        1);
  }
}

TEST(ContactSpaceUnfoldingTest, TheDiagramIsInsideTheSet) {
  const object::Polygon fork = MakeFork();
  const contour::ContourGraph graph(fork, Radians(20));
  contour::SetGeometry geometry(graph);
  int checked = 0;
  for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
    const UnfoldedSet unfolded = Unfold(geometry, set, 1);
    for (const Segment& edge : unfolded.diagram) {
      const Vector2d middle = (edge[0] + edge[1]) / 2;
      EXPECT_TRUE(std::ranges::any_of(
          unfolded.pieces, [&](const Outline& outline) { return Contains(outline, middle, 1e-9); }))
          << set << ": " << middle.transpose();
      ++checked;
    }
  }
  EXPECT_GT(checked, 20);
}

}  // namespace contact_space_unfolding_test
}  // namespace regrasp::render
