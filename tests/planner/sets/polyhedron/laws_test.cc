// Laws of the graph: invariants and monotonicity.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <random>
#include <set>

#include "bench/polyhedron_stone.h"
#include "tests/fixtures/moved.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace laws_test {

using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr double kDegrees[] = {8, 16, 30};
constexpr std::uint64_t kSeed = 4;

struct Counts {
  std::int64_t candidates;
  std::int64_t combinations;
  int vertices;
  std::size_t links;
  int components;

  bool operator==(const Counts&) const = default;
};

void PrintTo(const Counts& c, std::ostream* out) {
  *out << "candidates " << c.candidates << ", combinations " << c.combinations << ", vertices "
       << c.vertices << ", links " << c.links << ", components " << c.components;
}

Counts CountsOf(const object::Polyhedron& body, double degrees, planning::Spanning spanning) {
  const PolyhedronGraph graph(body, Radians(degrees), spanning);
  return {graph.candidate_count(), graph.combination_count(), graph.vertex_count(),
          graph.switches().size(), graph.components().count()};
}

const std::vector<NamedBody>& Bodies() {
  static const std::vector<NamedBody> bodies = [] {
    std::vector<NamedBody> result = SmallBodies();
    result.push_back({"stone of 24", MakeStone(24, {1.5, 1, 0.8}, 5)});
    return result;
  }();
  return bodies;
}

/// Compare counts before and after a change, for every object. @returns number of compared
/// vertices.
template <class Change>
int ExpectSameCounts(const Change& change) {
  int vertices = 0;
  for (const auto& [name, body] : Bodies()) {
    const object::Polyhedron changed = object::Polyhedron::FromSoup(change(body), "changed");
    EXPECT_EQ(changed.face_count(), body.face_count());
    for (const double degrees : kDegrees) {
      for (const planning::Spanning spanning : kBothSpannings) {
        SCOPED_TRACE(name + " " + std::to_string(degrees) + " " + Name(spanning));
        const Counts before = CountsOf(body, degrees, spanning);
        EXPECT_EQ(CountsOf(changed, degrees, spanning), before);
        vertices += before.vertices;
      }
    }
  }
  return vertices;
}

template <class Linear>
auto MapBy(const Linear& linear, const Vector3d& shift = Vector3d::Zero()) {
  Affine3d map = Affine3d::Identity();
  map.linear() = linear;
  map.translation() = shift;
  return [map](const object::Polyhedron& body) { return MappedSoup(body, map); };
}

TEST(PolyhedronLaws, CountsDoNotDependOnMotions) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3d(1, 2, -2).normalized()).toRotationMatrix();
  EXPECT_GT(ExpectSameCounts(MapBy(turn)), 300);
  EXPECT_GT(ExpectSameCounts(MapBy(turn, {7, -20, 13})), 300);
}

TEST(PolyhedronLaws, CountsDoNotDependOnTheUnitOfLength) {
  for (const double scale : {0.0009765625, 1024.0, 0.003, 77.0}) {
    EXPECT_GT(ExpectSameCounts(MapBy(scale * Eigen::Matrix3d::Identity())), 300);
  }
}

TEST(PolyhedronLaws, CountsDoNotDependOnMirroring) {
  EXPECT_GT(ExpectSameCounts(MapBy(Eigen::Matrix3d(Vector3d(1, -1, 1).asDiagonal()))), 300);
  EXPECT_GT(ExpectSameCounts(MapBy(Eigen::Matrix3d(Vector3d(-1, -1, -1).asDiagonal()))), 300);
}

TEST(PolyhedronLaws, CountsDoNotDependOnTheOrderOfFacetsAndVertices) {
  const auto shuffled = [](const object::Polyhedron& body) {
    std::mt19937 engine(kSeed);
    object::PolygonSoup soup = MappedSoup(body, Affine3d::Identity());
    std::shuffle(soup.facets.begin(), soup.facets.end(), engine);
    std::vector<int> order(soup.vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::shuffle(order.begin(), order.end(), engine);
    object::PolygonSoup result;
    result.vertices.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) result.vertices[order[i]] = soup.vertices[i];
    for (std::vector<int>& facet : soup.facets) {
      for (int& v : facet) v = order[v];
      result.facets.push_back(facet);
    }
    return result;
  };
  EXPECT_GT(ExpectSameCounts(shuffled), 300);
}

TEST(PolyhedronLaws, CountsDoDependOnStretching) {
  const object::Polyhedron body = MakeStone(24, {1.5, 1, 0.8}, 5);
  const auto stretch = MapBy(Eigen::Matrix3d(Vector3d(1, 1, 3).asDiagonal()));
  const object::Polyhedron stretched = object::Polyhedron::FromSoup(stretch(body), "stretched");
  EXPECT_FALSE(CountsOf(stretched, 10, planning::Spanning::kUniform) ==
               CountsOf(body, 10, planning::Spanning::kUniform));
}

/// Return the cell of each piece, by its halves.
std::map<Halves, int> CellsByPiece(const PolyhedronGraph& graph) {
  std::map<Halves, int> cell_of;
  for (int cell = 0; cell < graph.vertex_count(); ++cell) {
    for (const FocusPiece& piece : graph.cells()[cell].pieces) cell_of[piece.halves] = cell;
  }
  return cell_of;
}

TEST(PolyhedronLaws, UnderAdaptiveSpanningMoreFrictionKeepsPiecesComponentsAndLinks) {
  int pieces = 0, links = 0, grown = 0;
  for (const auto& [name, body] : Bodies()) {
    SCOPED_TRACE(name);
    const double degrees[] = {3, 8, 14, 22, 40, 70};
    for (std::size_t i = 0; i + 1 < std::size(degrees); ++i) {
      PolyhedronGraph less(body, Radians(degrees[i]), planning::Spanning::kAdaptive);
      PolyhedronGraph more(body, Radians(degrees[i + 1]), planning::Spanning::kAdaptive);
      const auto in_less = CellsByPiece(less);
      const auto in_more = CellsByPiece(more);
      std::map<int, int> image;  // image of each cell
      for (const auto& [halves, cell] : in_less) {
        const auto kept = in_more.find(halves);
        ASSERT_NE(kept, in_more.end());
        EXPECT_EQ(image.try_emplace(cell, kept->second).first->second, kept->second);
        const FocusCell& larger = more.cells()[kept->second];
        EXPECT_GE(larger.tangent, less.cells()[cell].tangent);
        ++pieces;
      }
      const std::set<sets::SetPair> more_links(more.switches().begin(), more.switches().end());
      for (const auto& [a, b] : less.switches()) {
        const auto [low, high] = std::minmax(image[a], image[b]);
        EXPECT_TRUE(more_links.contains({sets::SetIndex(low), sets::SetIndex(high)}));
        ++links;
      }
      if (in_more.size() > in_less.size()) ++grown;
    }
  }
  EXPECT_GT(pieces, 1000);
  EXPECT_GT(links, 1000);
  EXPECT_GT(grown, 8);
}

TEST(PolyhedronLaws, UniformCellsAreThoseAdaptiveCellsThatHaveTheWholeFriction) {
  int compared = 0;
  for (const auto& [name, body] : Bodies()) {
    SCOPED_TRACE(name);
    const PolyhedronGraph uniform(body, Radians(10), planning::Spanning::kUniform);
    const PolyhedronGraph adaptive(body, Radians(10), planning::Spanning::kAdaptive);
    std::set<Halves> of_uniform, of_adaptive;
    for (const auto& [halves, cell] : CellsByPiece(uniform)) of_uniform.insert(halves);
    for (const auto& [halves, cell] : CellsByPiece(adaptive)) {
      if (adaptive.cells()[cell].tangent == std::tan(Radians(10))) of_adaptive.insert(halves);
    }
    EXPECT_EQ(of_uniform, of_adaptive);
    compared += static_cast<int>(of_uniform.size());
  }
  EXPECT_GT(compared, 100);
}

TEST(PolyhedronLaws, FewDecisionsAreTooCloseToCall) {
  std::int64_t unclear = 0, combinations = 0;
  for (const auto& [name, body] : Bodies()) {
    for (const double degrees : kDegrees) {
      const PolyhedronGraph graph(body, Radians(degrees), planning::Spanning::kUniform);
      unclear += graph.unclear_count();
      combinations += graph.candidate_count();
    }
  }
  EXPECT_GT(combinations, 250);
  EXPECT_LT(20 * unclear, combinations);
}

TEST(PolyhedronLaws, NeighboursAreMutualAndTheSameTwice) {
  for (const auto& [name, body] : Bodies()) {
    const PolyhedronGraph graph(body, Radians(12), planning::Spanning::kAdaptive);
    const PolyhedronGraph again(body, Radians(12), planning::Spanning::kAdaptive);
    EXPECT_EQ(graph.switches(), again.switches());
    std::size_t ends = 0;
    std::vector<int> neighbours, back;
    for (int v = 0; v < graph.vertex_count(); ++v) {
      graph.GetNeighbours(v, neighbours);
      ends += neighbours.size();
      for (const int w : neighbours) {
        EXPECT_NE(w, v);
        graph.GetNeighbours(w, back);
        EXPECT_EQ(std::ranges::count(back, v), 1);
      }
    }
    EXPECT_EQ(ends, 2 * graph.switches().size());
  }
}

}  // namespace laws_test
}  // namespace regrasp::polyhedron
