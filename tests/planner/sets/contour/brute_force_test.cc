// Comparison of sets and switches with grids of independently classified grasps. Every set and
// switch of the graph must have a witness, which is classified by the same function.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/sets/contour/contact_space.h"
#include "tests/planner/sets/contour/contact_grid.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace brute_force_test {

using Eigen::Vector2d;

constexpr int kLines = 300;
constexpr std::uint64_t kSeed = 2;
constexpr double kAngles[] = {10, 15, 20, 35, 50};

/// Fraction of all sets, or of all switches, that a grid of kLines may miss.
constexpr double kMissedPart = 0.03;

TEST(ContourBruteForce, EveryGraspOfAGridIsInOnePieceAndItsComponentsAreTheSets) {
  GridComparison total;
  for (const auto& [name, polygon] : TwelveEdgePolygons()) {
    for (const double degrees : kAngles) {
      SCOPED_TRACE(name + " " + std::to_string(degrees));
      const ContourGraph graph(polygon, Radians(degrees));
      const ContactGrid grid(polygon, Radians(degrees), kLines, kSeed);
      const GridComparison result = CompareWithGrid(polygon, graph, grid);
      for (const std::string& failure : result.failures) ADD_FAILURE() << failure;
      total.pairs += result.pairs;
      total.grasps += result.grasps;
      total.too_close += result.too_close;
      total.sets += result.sets;
      total.split_sets += result.split_sets;
      total.missed_sets += result.missed_sets;
      total.switches += result.switches;
      total.missed_switches += result.missed_switches;
    }
  }
  EXPECT_GT(total.pairs, 2'000'000);
  EXPECT_GT(total.grasps, 200'000);
  EXPECT_LT(total.too_close, total.pairs / 100'000);
  EXPECT_GT(total.sets, 300);
  EXPECT_LT(total.split_sets, kMissedPart * total.sets);
  EXPECT_LT(total.missed_sets, kMissedPart * total.sets);
  EXPECT_GT(total.switches, 300);
  EXPECT_LT(total.missed_switches, kMissedPart * total.switches);
}

TEST(ContourBruteForce, NoticesAGraphOfOtherFrictionAndOfAnotherPolygon) {
  const object::Polygon& blob = TwelveEdgePolygons()[4].polygon;
  const ContactGrid grid(blob, Radians(20), kLines, kSeed);
  const auto fails = [&](const object::Polygon& polygon, double degrees) {
    const ContourGraph graph(polygon, Radians(degrees));
    return !CompareWithGrid(polygon, graph, grid).failures.empty();
  };
  EXPECT_FALSE(fails(blob, 20));
  EXPECT_TRUE(fails(blob, 19));
  EXPECT_TRUE(fails(blob, 21));
  const object::Polygon other =
      Mapped(blob, [](const Vector2d& p) { return Vector2d(p.x(), p.y() + 0.02 * p.x()); });
  EXPECT_TRUE(fails(other, 20));
}

/// Classifies grasps given by places.
class Witness {
 public:
  Witness(const object::Polygon& polygon, const ContourGraph& graph, double friction_angle)
      : polygon_(polygon), graph_(graph), friction_angle_(friction_angle) {}

  [[nodiscard]] bool Confirms(const std::array<FaceIndex, 2>& edges, const Vector2d& places,
                              bool stretching) const {
    const Boundary& boundary = graph_.boundary();
    const Sense sense = SenseOf(polygon_, friction_angle_, boundary.ContactAt(edges[0], places.x()),
                                boundary.ContactAt(edges[1], places.y()));
    return sense == (stretching ? Sense::kStretching : Sense::kSqueezing);
  }

  [[nodiscard]] bool ConfirmsPiece(PieceIndex piece) const {
    const std::vector<Vector2d> outline = PieceOutline(graph_, piece);
    if (outline.empty()) return false;
    Vector2d centre = Vector2d::Zero();
    for (const Vector2d& p : outline) centre += p / static_cast<double>(outline.size());
    const GraspPiece& p = graph_.pieces()[piece];
    return Confirms(p.edges, centre, p.stretching);
  }

  [[nodiscard]] bool ConfirmsPassage(const PiecePassage& passage) const {
    const PlaceRange range = PassageRange(graph_, passage);
    const Boundary& boundary = graph_.boundary();
    const double at = (range.low + range.high) / 2;
    const FaceIndex next = boundary.next(passage.edge);
    const bool stretching = graph_.pieces()[passage.pieces[0]].stretching;
    return Confirms({passage.edge, passage.other}, {boundary.end(passage.edge), at}, stretching) &&
           Confirms({next, passage.other}, {boundary.begin(next), at}, stretching);
  }

  /// Return whether two pieces of the sets share a contact, in the middle of the overlap of their
  /// outlines.
  [[nodiscard]] bool ConfirmsSwitch(sets::SetIndex v, sets::SetIndex w) const {
    for (const PieceIndex p : graph_.pieces_of(v)) {
      for (const PieceIndex q : graph_.pieces_of(w)) {
        for (const int k : {0, 1}) {
          for (const int l : {0, 1}) {
            if (ShareContact(p, k, q, l)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] bool ShareContact(PieceIndex p, int k, PieceIndex q, int l) const {
    if (graph_.pieces()[p].edges[k] != graph_.pieces()[q].edges[l]) return false;
    const std::vector<Vector2d> a = PieceOutline(graph_, p);
    const std::vector<Vector2d> b = PieceOutline(graph_, q);
    if (a.empty() || b.empty()) return false;
    const auto [a_low, a_high] = RangeOf(a, k);
    const auto [b_low, b_high] = RangeOf(b, l);
    const double at = (std::max(a_low, b_low) + std::min(a_high, b_high)) / 2;
    return HasGraspAt(p, a, k, at) && HasGraspAt(q, b, l, at);
  }

  static std::pair<double, double> RangeOf(const std::vector<Vector2d>& outline, int k) {
    double low = outline[0][k];
    double high = low;
    for (const Vector2d& p : outline) {
      low = std::min(low, p[k]);
      high = std::max(high, p[k]);
    }
    return {low, high};
  }

  /// Return whether the middle of the outline at a place of the k-th contact is a grasp.
  [[nodiscard]] bool HasGraspAt(PieceIndex piece, const std::vector<Vector2d>& outline, int k,
                                double at) const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2d& from = outline[i];
      const Vector2d& to = outline[(i + 1) % outline.size()];
      if ((from[k] < at) == (to[k] < at)) continue;
      const double crossing =
          from[1 - k] + (at - from[k]) / (to[k] - from[k]) * (to[1 - k] - from[1 - k]);
      low = std::min(low, crossing);
      high = std::max(high, crossing);
    }
    if (!(low < high)) return false;
    Vector2d place;
    place[k] = at;
    place[1 - k] = (low + high) / 2;
    const GraspPiece& p = graph_.pieces()[piece];
    return Confirms(p.edges, place, p.stretching);
  }

  const object::Polygon& polygon_;
  const ContourGraph& graph_;
  double friction_angle_;
};

TEST(ContourBruteForce, EveryPieceEveryPassageAndEverySwitchHasAWitness) {
  int pieces = 0;
  int passages = 0;
  int switches = 0;
  for (const auto& [name, polygon] : TwelveEdgePolygons()) {
    for (const double degrees : kAngles) {
      SCOPED_TRACE(name + " " + std::to_string(degrees));
      const ContourGraph graph(polygon, Radians(degrees));
      const Witness witness(polygon, graph, Radians(degrees));
      for (PieceIndex p{0}; p < std::ssize(graph.pieces()); ++p, ++pieces) {
        EXPECT_TRUE(witness.ConfirmsPiece(p)) << "piece " << p;
      }
      for (const PiecePassage& passage : graph.passages()) {
        EXPECT_TRUE(witness.ConfirmsPassage(passage))
            << "edges " << passage.edge << ' ' << passage.other;
        ++passages;
      }
      for (const auto& [v, w] : graph.switches()) {
        EXPECT_TRUE(witness.ConfirmsSwitch(v, w)) << "sets " << v << ' ' << w;
        ++switches;
      }
    }
  }
  EXPECT_GT(pieces, 600);
  EXPECT_GT(passages, 300);
  EXPECT_GT(switches, 300);
}

TEST(ContourBruteForce, WitnessesRefuseLessFriction) {
  const object::Polygon& blob = TwelveEdgePolygons()[4].polygon;
  const ContourGraph graph(blob, Radians(20));
  const Witness witness(blob, graph, Radians(2));
  int confirmed = 0;
  const int pieces = static_cast<int>(graph.pieces().size());
  for (PieceIndex p{0}; p < pieces; ++p) confirmed += witness.ConfirmsPiece(p) ? 1 : 0;
  EXPECT_GT(pieces, 0);
  EXPECT_LT(confirmed, pieces);
}

}  // namespace brute_force_test
}  // namespace regrasp::contour
