#include "tests/planner/sets/contour/exact_oracle.h"

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/planner/sets/exact_region.h"

namespace regrasp::contour {
namespace {

using Number = CGAL::Gmpq;
using Vec = exact::Vec<Number>;
using Edge = exact::Edge<Number>;
using Region = exact::Region<Number>;

/// Error of doubles in the decision that a rectangle is full, divided by the square of an edge's
/// length.
constexpr double kRounding = 1e-12;

/// Open interval; empty if low >= high.
struct Range {
  Number low = 1;
  Number high = 0;

  void Include(const Number& u) {
    if (low > high) {
      low = high = u;
    } else {
      low = std::min(low, u);
      high = std::max(high, u);
    }
  }
  [[nodiscard]] bool empty() const { return low >= high; }
};

bool Overlap(const Range& a, const Range& b) {
  return !a.empty() && !b.empty() && a.low < b.high && b.low < a.high;
}

struct Piece {
  std::array<FaceIndex, 2> edges;
  bool stretching = false;
  bool covers = false;           ///< its closure is the whole rectangle
  bool touches_a_line = false;   ///< in doubles, a corner of the rectangle is on a cone's border
  std::array<Range, 4> sides;    ///< see GraspPiece::reaches
  std::array<Range, 2> contact;  ///< projections on the two edges
};

Piece MakePiece(int e, int f, bool stretching, const Edge& a, const Edge& b, const Region& region) {
  Piece piece = {{FaceIndex(e), FaceIndex(f)}, stretching, false, false, {}, {}};
  for (const exact::Corner<Number>& corner : region) {
    for (int k = 0; k < 2; ++k) {
      piece.contact[k].Include(corner[k]);
      if (corner[k] == 0) piece.sides[2 * k].Include(corner[1 - k]);
      if (corner[k] == 1) piece.sides[2 * k + 1].Include(corner[1 - k]);
    }
  }
  piece.covers = exact::TwiceArea(region) == 2;
  const Number length = Dot(a.along, a.along);
  for (const int ua : {0, 1}) {
    for (const int ub : {0, 1}) {
      const Vec v = (b.a - a.a) + Number(ub) * b.along - Number(ua) * a.along;
      for (const Vec& border : {a.right, a.left, b.right, b.left}) {
        if (abs(Cross(border, v)) <= kRounding * length) piece.touches_a_line = true;
      }
    }
  }
  return piece;
}

class Oracle {
 public:
  Oracle(const object::Polygon& polygon, double tangent) {
    int first = 0;
    for (const auto& ring : polygon.rings()) {
      const int count = static_cast<int>(ring.size());
      for (int k = 0; k < count; ++k) next_.push_back(first + (k + 1) % count);
      first += count;
    }
    for (int e = 0; e < first; ++e) edges_.push_back(exact::MakeEdge<Number>(polygon, e, tangent));
    FindPieces();
    FindPassages();
    FindSwitches();
  }

  std::vector<Piece> pieces;
  std::set<std::array<int, 4>> passages;   ///< pieces before and after, edge, other
  std::vector<int> root;                   ///< first piece of each piece's set
  std::set<std::pair<int, int>> switches;  ///< pairs of roots
  int candidates = 0;
  int combinations = 0;

 private:
  void FindPieces() {
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      for (int f = e + 1; f < static_cast<int>(edges_.size()); ++f) {
        const Edge& a = edges_[e];
        const Edge& b = edges_[f];
        if (ConesOppose(a, b)) ++candidates;
        const std::size_t before = pieces.size();
        for (const int sign : {1, -1}) {
          const Region region = exact::TwoFingerRegion(a, b, sign);
          if (exact::TwiceArea(region) == 0) continue;
          number_[{e, f, sign < 0}] = static_cast<int>(pieces.size());
          pieces.push_back(MakePiece(e, f, sign < 0, a, b, region));
        }
        if (pieces.size() > before) ++combinations;
      }
    }
  }

  void FindPassages() {
    root.resize(pieces.size());
    std::iota(root.begin(), root.end(), 0);
    for (int before = 0; before < static_cast<int>(pieces.size()); ++before) {
      const Piece& p = pieces[before];
      for (int k = 0; k < 2; ++k) {
        const int edge = p.edges[k];
        const int other = p.edges[1 - k];
        const int next = next_[edge];
        const auto found =
            number_.find({std::min(next, other), std::max(next, other), p.stretching});
        if (found == number_.end()) continue;
        const Piece& q = pieces[found->second];
        const int at = q.edges[0] == next ? 0 : 1;
        if (!Overlap(p.sides[2 * k + 1], q.sides[2 * at])) continue;
        passages.insert({before, found->second, edge, other});
        Join(before, found->second);
      }
    }
    for (int p = 0; p < static_cast<int>(pieces.size()); ++p) root[p] = Root(p);
  }

  void FindSwitches() {
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q) {
        if (root[p] == root[q]) continue;
        for (const int k : {0, 1}) {
          for (const int l : {0, 1}) {
            if (pieces[p].edges[k] != pieces[q].edges[l]) continue;
            if (!Overlap(pieces[p].contact[k], pieces[q].contact[l])) continue;
            switches.insert(std::minmax(root[p], root[q]));
          }
        }
      }
    }
  }

  int Root(int p) const { return root[p] == p ? p : Root(root[p]); }
  void Join(int p, int q) {
    const int a = Root(p);
    const int b = Root(q);
    root[std::max(a, b)] = std::min(a, b);
  }

  std::vector<int> next_;
  std::vector<Edge> edges_;
  std::map<std::array<int, 3>, int> number_;  ///< number of a piece by edges and stretching
};

std::string Text(const Piece& p) {
  return std::to_string(p.edges[0]) + (p.stretching ? "<>" : "><") + std::to_string(p.edges[1]);
}

/// Compare pieces one by one. @returns false if their lists differ.
bool ComparePieces(const Oracle& oracle, const ContourGraph& graph, std::ostream& out) {
  const auto& pieces = graph.pieces();
  for (std::size_t i = 0; i < std::min(pieces.size(), oracle.pieces.size()); ++i) {
    const GraspPiece& p = pieces[i];
    const Piece& q = oracle.pieces[i];
    if (p.edges != q.edges || p.stretching != q.stretching) {
      out << "piece " << i << ": " << p.edges[0] << ' ' << p.edges[1] << ", rational " << Text(q)
          << '\n';
      return false;
    }
    for (int side = 0; side < 4; ++side) {
      if (p.reaches[side] == q.sides[side].empty()) {
        out << Text(q) << " side " << side << ": " << p.reaches[side] << '\n';
      }
    }
    if (p.full ? !q.covers : q.covers && !q.touches_a_line) {
      out << Text(q) << " full: " << p.full << '\n';
    }
  }
  if (pieces.size() == oracle.pieces.size()) return true;
  out << "pieces: " << pieces.size() << ", rational " << oracle.pieces.size() << '\n';
  return false;
}

template <class T>
void CompareSets(const char* what, const std::set<T>& ours, const std::set<T>& theirs,
                 std::ostream& out) {
  std::vector<T> difference;
  std::ranges::set_symmetric_difference(ours, theirs, std::back_inserter(difference));
  if (difference.empty()) return;
  out << what << ": " << difference.size() << " differ\n";
}

}  // namespace

OracleCounts& OracleCounts::operator+=(const OracleCounts& other) {
  candidates += other.candidates;
  combinations += other.combinations;
  pieces += other.pieces;
  full += other.full;
  passages += other.passages;
  sets += other.sets;
  switches += other.switches;
  components += other.components;
  return *this;
}

OracleCounts CompareWithRationals(const object::Polygon& polygon, const ContourGraph& graph,
                                  double friction_angle, std::string& difference) {
  std::ostringstream out;
  const Oracle oracle(polygon, std::tan(friction_angle));
  OracleCounts counts;
  counts.candidates = oracle.candidates;
  counts.combinations = oracle.combinations;
  counts.pieces = static_cast<int>(oracle.pieces.size());
  counts.passages = static_cast<int>(oracle.passages.size());
  counts.switches = static_cast<int>(oracle.switches.size());
  for (int p = 0; p < counts.pieces; ++p) {
    if (oracle.root[p] == p) ++counts.sets;
    if (oracle.pieces[p].covers) ++counts.full;
  }
  const auto compare = [&](const char* what, std::int64_t ours, std::int64_t theirs) {
    if (ours != theirs) out << what << ' ' << ours << ", rational " << theirs << '\n';
  };
  compare("candidates", graph.candidate_count(), counts.candidates);
  compare("combinations", graph.combination_count(), counts.combinations);
  compare("sets", graph.vertex_count(), counts.sets);
  compare("switches", std::ssize(graph.switches()), counts.switches);
  if (ComparePieces(oracle, graph, out)) {
    std::set<std::array<int, 4>> passages;
    for (const PiecePassage& p : graph.passages()) {
      if (!passages.insert({p.pieces[0], p.pieces[1], p.edge, p.other}).second) {
        out << "a passage is listed twice\n";
      }
    }
    CompareSets("passages", passages, oracle.passages, out);
    std::vector<int> first(graph.vertex_count(), -1);
    for (int p = counts.pieces - 1; p >= 0; --p) first[graph.set_of(PieceIndex(p))] = p;
    for (int p = 0; p < counts.pieces; ++p) {
      if (first[graph.set_of(PieceIndex(p))] != oracle.root[p]) {
        out << "piece " << Text(oracle.pieces[p]) << " is in another set\n";
      }
    }
    std::set<std::pair<int, int>> switches;
    for (const auto& [v, w] : graph.switches()) switches.insert(std::minmax(first[v], first[w]));
    CompareSets("switches", switches, oracle.switches, out);
    // Components of sets: those of pieces, connected by passages and switches.
    std::vector<int> label(oracle.root);
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [v, w] : oracle.switches) {
        const int low = std::min(label[v], label[w]);
        changed = changed || label[v] != label[w];
        label[v] = label[w] = low;
      }
    }
    std::set<int> labels;
    for (int p = 0; p < counts.pieces; ++p) labels.insert(label[oracle.root[p]]);
    counts.components = static_cast<int>(labels.size());
    compare("components", graph.components().count(), counts.components);
  }
  difference = out.str();
  return counts;
}

}  // namespace regrasp::contour
