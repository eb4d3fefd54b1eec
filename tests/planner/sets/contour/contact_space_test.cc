// Places on the boundary, outlines of pieces, passages and borders of sets.

#include "planner/sets/contour/contact_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/planner/sets/contour/contact_grid.h"
#include "tests/planner/sets/contour/region_cases.h"

namespace regrasp::contour {
namespace contact_space_test {

using Eigen::Vector2d;

TEST(Boundary, PlacesRunAlongEveryRingAndComeBack) {
  int edges = 0;
  for (const auto& [name, polygon] : RegionPolygons()) {
    SCOPED_TRACE(name);
    const Boundary boundary(polygon);
    ASSERT_EQ(boundary.edge_count(), polygon.face_count());
    ASSERT_EQ(boundary.ring_count(), std::ssize(polygon.rings()));
    for (FaceIndex e{0}; e < polygon.face_count(); ++e, ++edges) {
      const RingIndex ring = boundary.ring_of(e);
      EXPECT_LE(boundary.first_edge(ring), e);
      EXPECT_LT(e, boundary.end_edge(ring));
      EXPECT_EQ(polygon.edge(e).second, polygon.edge(boundary.next(e)).first);
      const bool last = boundary.next(e) < e;
      EXPECT_EQ(boundary.end(e),
                last ? boundary.perimeter(ring) : boundary.begin(FaceIndex(e + 1)));
      for (const double share : {0.0, 0.3, 1.0}) {
        const double place = (1 - share) * boundary.begin(e) + share * boundary.end(e);
        const grasp::Contact contact = boundary.ContactAt(e, place);
        EXPECT_EQ(contact.face, e);
        EXPECT_EQ(contact.n, polygon.inward_normal(FaceIndex(e)));
        EXPECT_NEAR(boundary.PlaceOf(contact), place, SizeToleranceOf(polygon));
        EXPECT_LE(polygon.DistanceToBorder(FaceIndex(e), contact.p),
                  polygon.face_measure(FaceIndex(e)) / 2 + SizeToleranceOf(polygon));
      }
    }
  }
  EXPECT_GT(edges, 300);
}

double TwiceArea(const std::vector<Vector2d>& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& p = outline[i];
    const Vector2d& q = outline[(i + 1) % outline.size()];
    area += p.x() * q.y() - p.y() * q.x();
  }
  return area;
}

TEST(PieceOutline, IsConvexOfAtMostSixCornersInItsRectangleAndWholeWhereThePieceIsFull) {
  int pieces = 0;
  int full = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph& graph, double) {
    const double tolerance = SizeToleranceOf(polygon);
    const Boundary& boundary = graph.boundary();
    for (PieceIndex p{0}; p < std::ssize(graph.pieces()); ++p) {
      const GraspPiece& piece = graph.pieces()[p];
      const std::vector<Vector2d> outline = PieceOutline(graph, p);
      if (outline.empty()) continue;  // it is too thin for doubles
      ++pieces;
      constexpr std::size_t kMostCorners = 6;
      std::size_t corners = 0;  // the remaining ones are on the line of their neighbours
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2d& corner = outline[i];
        const Vector2d side = outline[(i + 1) % outline.size()] - corner;
        const Vector2d after = outline[(i + 2) % outline.size()] - corner;
        const double turn = side.x() * after.y() - side.y() * after.x();
        EXPECT_GE(turn, -tolerance * side.norm());
        if (turn > tolerance * side.norm()) ++corners;
        for (int k = 0; k < 2; ++k) {
          EXPECT_GE(corner[k], boundary.begin(piece.edges[k]) - tolerance);
          EXPECT_LE(corner[k], boundary.end(piece.edges[k]) + tolerance);
        }
      }
      EXPECT_LE(corners, kMostCorners);
      if (!piece.full) continue;
      ++full;
      const double whole = polygon.face_measure(FaceIndex(piece.edges[0])) *
                           polygon.face_measure(FaceIndex(piece.edges[1]));
      EXPECT_NEAR(TwiceArea(outline), 2 * whole, tolerance * polygon.diameter());
    }
  });
  EXPECT_GT(pieces, 1000);
  EXPECT_GT(full, 100);
}

/// Return whether a contact at a vertex and the other contact are a grasp of a sense, with either
/// normal at the vertex.
bool IsPassage(const object::Polygon& polygon, const Boundary& boundary, double friction_angle,
               const PiecePassage& passage, Sense sense, double place) {
  const FaceIndex next = boundary.next(passage.edge);
  const grasp::Contact other = boundary.ContactAt(passage.other, place);
  const grasp::Contact before = boundary.ContactAt(passage.edge, boundary.end(passage.edge));
  const grasp::Contact after = boundary.ContactAt(next, boundary.begin(next));
  return SenseOf(polygon, friction_angle, before, other) == sense &&
         SenseOf(polygon, friction_angle, after, other) == sense;
}

TEST(PassageRange, IsWhereBothNormalsOfTheVertexMakeAGraspAndNowhereElse) {
  int inside = 0;
  int outside = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph& graph,
                         double friction_angle) {
    const Boundary& boundary = graph.boundary();
    const double margin = SizeToleranceOf(polygon);
    for (const PiecePassage& passage : graph.passages()) {
      const PlaceRange range = PassageRange(graph, passage);
      if (range.high - range.low <= 2 * margin) continue;  // doubles cannot decide
      const bool stretching = graph.pieces()[passage.pieces[0]].stretching;
      const Sense sense = stretching ? Sense::kStretching : Sense::kSqueezing;
      const auto is_passage = [&](double place) {
        return IsPassage(polygon, boundary, friction_angle, passage, sense, place);
      };
      for (const double place :
           {range.low + margin, (range.low + range.high) / 2, range.high - margin}) {
        EXPECT_TRUE(is_passage(place)) << passage.edge << ' ' << passage.other << " at " << place;
        ++inside;
      }
      if (range.low - margin > boundary.begin(passage.other)) {
        EXPECT_FALSE(is_passage(range.low - margin)) << passage.edge << ' ' << passage.other;
        ++outside;
      }
      if (range.high + margin < boundary.end(passage.other)) {
        EXPECT_FALSE(is_passage(range.high + margin)) << passage.edge << ' ' << passage.other;
        ++outside;
      }
    }
  });
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 300);
}

TEST(SetBorder, SegmentsFallOrLieOnVerticesAndOneOfTheirSidesIsNotInTheSet) {
  int falling = 0;
  int straight = 0;
  ForEachRegionGraph(
      [&](const object::Polygon& polygon, const ContourGraph& graph, double friction_angle) {
        const Boundary& boundary = graph.boundary();
        const double step = SizeToleranceOf(polygon);
        for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
          for (const BorderSegment& segment : SetBorder(graph, set)) {
            EXPECT_EQ(graph.set_of(segment.piece), set);
            const Vector2d along = segment.to - segment.from;
            if (along.x() == 0 || along.y() == 0) {
              ++straight;
              continue;
            }
            EXPECT_LT(along.x() * along.y(), 0);
            ++falling;
            // On a cone's border: a grasp slightly to one side, not a grasp slightly to the other
            // side.
            if (along.lpNorm<Eigen::Infinity>() < step * 1e3) continue;
            const GraspPiece& piece = graph.pieces()[segment.piece];
            const Vector2d across = step * Vector2d(along.y(), -along.x()).normalized();
            int grasps = 0;
            for (const double side : {-1.0, 1.0}) {
              const Vector2d p = (segment.from + segment.to) / 2 + side * across;
              const Sense sense =
                  SenseOf(polygon, friction_angle, boundary.ContactAt(piece.edges[0], p.x()),
                          boundary.ContactAt(piece.edges[1], p.y()));
              if (sense == Sense::kSqueezing || sense == Sense::kStretching) ++grasps;
            }
            EXPECT_EQ(grasps, 1) << piece.edges[0] << ' ' << piece.edges[1];
          }
        }
      });
  EXPECT_GT(falling, 500);
  EXPECT_GT(straight, 500);
}

}  // namespace contact_space_test
}  // namespace regrasp::contour
