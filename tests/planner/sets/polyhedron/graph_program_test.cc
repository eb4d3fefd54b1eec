// Comparison of pieces, components and links of the graph with linear programs for inscribed and
// circumscribed pyramids.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "bench/polyhedron_stone.h"
#include "planner/search/switching_graph.h"
#include "tests/planner/sets/polyhedron/bodies.h"
#include "tests/planner/sets/polyhedron/cone_program.h"

namespace regrasp::polyhedron {
namespace graph_program_test {

using Eigen::Vector3d;

constexpr double kDegrees[] = {10, 20, 35};
constexpr std::uint64_t kSeed = 7;
constexpr int kMostCandidates = 80;  // sampled candidates per graph
constexpr int kMostLinks = 250;

/// At most one of this many decisions may be between the pyramids.
constexpr int kFewBetween = 20;

struct Count {
  int meet = 0;
  int apart = 0;
  int touch = 0;  ///< at common vertices and edges of faces
  int between = 0;
  int several = 0;  ///< combinations with more than one piece
  int fallen = 0;   ///< combinations with more than one cell

  [[nodiscard]] int all() const { return meet + apart + touch + between; }
};

/// Return the set of points that see a part of a face from one side.
SeenFrom SetOf(const FaceParts& parts, HalfIndex half, double tangent) {
  const FacePart& part = parts.parts[half / 2];
  SeenFrom set;
  for (const auto& y : part.outline()) {
    set.corners.push_back(part.origin + y.x() * part.u + y.y() * part.v);
  }
  set.axis = half % 2 == 0 ? part.normal : Vector3d(-part.normal);
  set.tangent = tangent;
  return set;
}

class GraphOracle {
 public:
  GraphOracle(const object::Polyhedron& body, double degrees, planning::Spanning spanning)
      : graph_(body, Radians(degrees), spanning),
        parts_(graph_.finder().parts()),
        scale_(body.diameter()) {
    std::vector<Vector3d> normals;
    for (FaceIndex f{0}; f < body.face_count(); ++f) normals.push_back(body.inward_normal(f));
    candidates_ = FindQuadrupleCandidates(normals, std::tan(Radians(degrees)), spanning);
    std::shuffle(candidates_.begin(), candidates_.end(), random_);
    if (candidates_.size() > kMostCandidates) candidates_.resize(kMostCandidates);
  }

  /// Check every piece of the sampled combinations, and their components.
  void CheckPieces(Count& count) {
    for (const QuadrupleCandidate& candidate : candidates_) {
      std::vector<Halves> certain, possible;
      Halves halves;
      VisitHalves(candidate, 0, halves, [&] {
        const Verdict verdict = Decide(halves, candidate.tangent);
        const bool has = FindCell(candidate.faces, halves) >= 0;
        Tally(verdict, has, count);
        if (has) possible.push_back(halves);
        if (has && verdict == Verdict::kMeet) certain.push_back(halves);
      });
      if (possible.size() > 1) ++count.several;
      std::set<int> cells;
      for (const auto& halves : possible) cells.insert(FindCell(candidate.faces, halves));
      if (cells.size() > 1) ++count.fallen;
      CheckComponents(candidate, certain, possible);
    }
  }

  /// Check sampled pairs of cells with three common faces.
  void CheckLinks(Count& count) {
    const std::set<sets::SetPair> links(graph_.switches().begin(), graph_.switches().end());
    std::vector<sets::SetPair> pairs;
    const auto& cells = graph_.cells();
    for (sets::SetIndex a{0}; a < graph_.vertex_count(); ++a) {
      for (sets::SetIndex b(a + 1); b < graph_.vertex_count(); ++b) {
        if (CommonFaces(cells[a], cells[b]) == 3) pairs.push_back({a, b});
      }
    }
    std::shuffle(pairs.begin(), pairs.end(), random_);
    if (pairs.size() > kMostLinks) pairs.resize(kMostLinks);
    for (const auto& pair : pairs) {
      SCOPED_TRACE(testing::Message() << "cells " << pair[0] << " " << pair[1]);
      Tally(DecideLink(cells[pair[0]], cells[pair[1]]), links.contains(pair), count);
    }
  }

 private:
  template <class Visit>
  void VisitHalves(const QuadrupleCandidate& candidate, std::size_t depth, Halves& halves,
                   const Visit& visit) {
    if (depth == 4) {
      visit();
      return;
    }
    const int face = candidate.faces[depth];
    for (HalfIndex half(2 * parts_.first[face]); half < 2 * parts_.first[face + 1]; ++half) {
      halves[depth] = half;
      VisitHalves(candidate, depth + 1, halves, visit);
    }
  }

  [[nodiscard]] Verdict Decide(const Halves& halves, double tangent) const {
    std::vector<SeenFrom> sets;
    for (const HalfIndex half : halves) sets.push_back(SetOf(parts_, half, tangent));
    return DecideByPyramids(sets, scale_);
  }

  /// Expect that the graph agrees with the pyramids if they can decide.
  static void Tally(Verdict verdict, bool has, Count& count) {
    if (verdict == Verdict::kMeet) {
      EXPECT_TRUE(has);
      ++count.meet;
    } else if (verdict == Verdict::kApart) {
      EXPECT_FALSE(has);
      ++count.apart;
    } else if (verdict == Verdict::kTouch) {
      EXPECT_FALSE(has);
      ++count.touch;
    } else {
      ++count.between;
    }
  }

  /// Return the cell that contains a piece, or −1.
  [[nodiscard]] int FindCell(const FaceQuadruple& faces, const Halves& halves) const {
    const auto& cells = graph_.cells();
    auto cell =
        std::lower_bound(cells.begin(), cells.end(), faces,
                         [](const FocusCell& c, const FaceQuadruple& f) { return c.faces < f; });
    for (; cell != cells.end() && cell->faces == faces; ++cell) {
      for (const FocusPiece& piece : cell->pieces) {
        if (piece.halves == halves) return static_cast<int>(cell - cells.begin());
      }
    }
    return -1;
  }

  /// Decide whether two pieces meet: through the face that separates them, or over a joint of two
  /// of its parts.
  [[nodiscard]] Verdict DecideJunction(const Halves& a, const Halves& b, double tangent) const {
    std::vector<SeenFrom> sets;
    int changed = -1;
    for (int k = 0; k < 4; ++k) {
      if (a[k] == b[k]) {
        sets.push_back(SetOf(parts_, a[k], tangent));
      } else {
        changed = k;
      }
    }
    if (sets.size() != 3) return Verdict::kApart;
    if (a[changed] / 2 == b[changed] / 2) {
      sets.push_back({SetOf(parts_, a[changed], tangent).corners});
      return DecideByPyramids(sets, scale_);
    }
    if (a[changed] % 2 != b[changed] % 2) return Verdict::kApart;
    sets.push_back(SetOf(parts_, a[changed], tangent));
    sets.back().corners = CommonCorners(a[changed], b[changed]);
    if (sets.back().corners.size() != 2) return Verdict::kApart;
    return DecideByPyramids(sets, scale_);
  }

  /// Return the common corners of two parts of one face: two if they share a side.
  [[nodiscard]] std::vector<Vector3d> CommonCorners(HalfIndex half, HalfIndex other) const {
    const SeenFrom one = SetOf(parts_, half, 1);
    const SeenFrom two = SetOf(parts_, other, 1);
    std::vector<Vector3d> common;
    for (const Vector3d& corner : one.corners) {
      if (std::ranges::find(two.corners, corner) != two.corners.end()) common.push_back(corner);
    }
    return common;
  }

  /// Check components: certainly connected pieces are in one cell, and the pieces of one cell are
  /// connected by junctions that are not certainly closed.
  void CheckComponents(const QuadrupleCandidate& candidate, const std::vector<Halves>& certain,
                       const std::vector<Halves>& possible) const {
    for (std::size_t i = 0; i < certain.size(); ++i) {
      for (std::size_t j = i + 1; j < certain.size(); ++j) {
        if (DecideJunction(certain[i], certain[j], candidate.tangent) != Verdict::kMeet) continue;
        EXPECT_EQ(FindCell(candidate.faces, certain[i]), FindCell(candidate.faces, certain[j]));
      }
    }
    std::vector<std::array<int, 2>> open;
    for (std::size_t i = 0; i < possible.size(); ++i) {
      for (std::size_t j = i + 1; j < possible.size(); ++j) {
        if (DecideJunction(possible[i], possible[j], candidate.tangent) == Verdict::kApart)
          continue;
        open.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
    const search::Components hang =
        search::ComponentsOfEdges(static_cast<int>(possible.size()), open);
    for (std::size_t i = 1; i < possible.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (FindCell(candidate.faces, possible[i]) != FindCell(candidate.faces, possible[j])) {
          continue;
        }
        EXPECT_EQ(hang.of_vertex[i], hang.of_vertex[j]);
      }
    }
  }

  static int CommonFaces(const FocusCell& a, const FocusCell& b) {
    return static_cast<int>(std::ranges::count_if(
        a.faces, [&](int face) { return std::ranges::count(b.faces, face) > 0; }));
  }

  /// Decide whether pieces with equal halves of the common faces have a common focus point.
  [[nodiscard]] Verdict DecideLink(const FocusCell& a, const FocusCell& b) const {
    Verdict verdict = Verdict::kApart;
    for (const FocusPiece& of_a : a.pieces) {
      for (const FocusPiece& of_b : b.pieces) {
        std::set<HalfIndex> halves(of_a.halves.begin(), of_a.halves.end());
        halves.insert(of_b.halves.begin(), of_b.halves.end());
        if (halves.size() != 5) continue;
        std::vector<SeenFrom> sets;
        for (const HalfIndex half : halves) {
          const bool in_a = std::ranges::count(of_a.halves, half) > 0;
          const bool in_b = std::ranges::count(of_b.halves, half) > 0;
          const double tangent = in_a && in_b ? std::min(a.tangent, b.tangent)
                                 : in_a       ? a.tangent
                                              : b.tangent;
          sets.push_back(SetOf(parts_, half, tangent));
        }
        const Verdict of_pieces = DecideByPyramids(sets, scale_);
        if (of_pieces == Verdict::kMeet) return Verdict::kMeet;
        if (of_pieces == Verdict::kBetween) verdict = Verdict::kBetween;
      }
    }
    return verdict;
  }

  std::mt19937_64 random_{kSeed};
  PolyhedronGraph graph_;
  const FaceParts& parts_;
  double scale_;
  std::vector<QuadrupleCandidate> candidates_;
};

void Record(const Count& count) {
  ::testing::Test::RecordProperty("meet", count.meet);
  ::testing::Test::RecordProperty("apart", count.apart);
  ::testing::Test::RecordProperty("touch", count.touch);
  ::testing::Test::RecordProperty("between", count.between);
  ::testing::Test::RecordProperty("several", count.several);
  ::testing::Test::RecordProperty("fallen", count.fallen);
}

template <class Check>
Count CheckAll(const Check& check) {
  Count count;
  ForEachSmallBody(
      kDegrees, [&](const object::Polyhedron& body, double degrees, planning::Spanning spanning) {
        GraphOracle oracle(body, degrees, spanning);
        check(oracle, count);
      });
  return count;
}

TEST(GraphProgram, PiecesAndTheirComponentsAreThoseOfLinearPrograms) {
  const Count count = CheckAll([](GraphOracle& o, Count& c) { o.CheckPieces(c); });
  Record(count);
  EXPECT_GT(count.meet, 100);
  EXPECT_GT(count.apart, 1000);
  EXPECT_GT(count.several, 10);
  EXPECT_LT(count.between * kFewBetween, count.all());
}

TEST(GraphProgram, LinksAreThoseOfLinearPrograms) {
  const Count count = CheckAll([](GraphOracle& o, Count& c) { o.CheckLinks(c); });
  Record(count);
  EXPECT_GT(count.meet, 100);
  EXPECT_GT(count.apart, 20);
  EXPECT_LT(count.between * kFewBetween, count.all());
}

TEST(GraphProgram, PyramidsTellConesThatMeetFromConesThatTouchAndThatPart) {
  // A cone upwards from (0, 0, −1), compared with several other cones.
  const SeenFrom up{{Vector3d(0, 0, -1)}, Vector3d::UnitZ(), 0.5};
  const auto decide = [&](const Vector3d& from, const Vector3d& axis) {
    return DecideByPyramids(std::vector{up, {{from}, axis, 0.5}}, 1);
  };
  EXPECT_EQ(decide({0, 0, 1}, -Vector3d::UnitZ()), Verdict::kMeet);
  EXPECT_EQ(decide({0, 0, 1}, Vector3d::UnitZ()), Verdict::kMeet);
  EXPECT_EQ(decide({0, 0, -2}, -Vector3d::UnitZ()), Verdict::kApart);
  EXPECT_EQ(decide({0, 0, -1}, -Vector3d::UnitZ()), Verdict::kTouch);
  // A downward cone next to the first one: their border lines are parallel, 1 apart along x.
  EXPECT_EQ(decide({0.97, 0, 1}, -Vector3d::UnitZ()), Verdict::kMeet);
  EXPECT_EQ(decide({0.9999, 0.01, 1}, -Vector3d::UnitZ()), Verdict::kBetween);
  EXPECT_EQ(decide({1.03, 0, 1}, -Vector3d::UnitZ()), Verdict::kApart);
}

}  // namespace graph_program_test
}  // namespace regrasp::polyhedron
