#include "render/figures/region_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "render/picture/caption.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector2i;

/// Steps along sides: right, down, left, up.
constexpr std::array<std::array<int, 2>, 4> kSteps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

Vector2i Next(const Vector2i& node, int direction) {
  return {node.x() + kSteps[direction][0], node.y() + kSteps[direction][1]};
}

/// Keep the points in [first, last] that a simplified line needs (Douglas and Peucker 1973).
void Simplify(const Polyline& line, std::size_t first, std::size_t last, double tolerance,
              std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double most = tolerance;
    std::size_t farthest = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double distance = DistanceToSegment(line[i], line[from], line[to]);
      if (distance <= most) continue;
      most = distance;
      farthest = i;
    }
    if (farthest == from) continue;
    kept[farthest] = true;
    open.emplace_back(from, farthest);
    open.emplace_back(farthest, to);
  }
}

}  // namespace

Polyline Simplified(const Polyline& line, double tolerance) {
  const std::size_t last = line.size() - 1;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  std::size_t middle = last;
  if (line.front() == line.back()) {
    // The halves of a closed line end at its farthest point.
    const auto farthest = std::ranges::max_element(
        line, {}, [&](const Vector2d& p) { return (p - line.front()).squaredNorm(); });
    middle = farthest - line.begin();
    kept[middle] = true;
  }
  Simplify(line, 0, middle, tolerance, kept);
  Simplify(line, middle, last, tolerance, kept);
  Polyline simple;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) simple.push_back(line[i]);
  }
  return simple;
}

namespace {

/// Return a line through the middles of a chain's sides. An open one keeps its ends.
Polyline ThroughMiddles(const std::vector<Vector2i>& nodes) {
  Polyline line;
  const bool closed = nodes.front() == nodes.back();
  if (!closed) line.push_back(nodes.front().cast<double>());
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    line.push_back((nodes[i - 1] + nodes[i]).cast<double>() / 2);
  }
  line.push_back(closed ? line.front() : nodes.back().cast<double>());
  return Simplified(line);
}

/// Return the moving average of a closed chain.
Polyline Smoothed(const std::vector<Vector2i>& nodes) {
  constexpr int kReach = 5;
  const auto count = static_cast<int>(nodes.size()) - 1;
  Polyline line;
  for (int i = 0; i < count; ++i) {
    Vector2d sum = Vector2d::Zero();
    for (int k = -kReach; k <= kReach; ++k) {
      sum += nodes[((i + k) % count + count) % count].cast<double>();
    }
    line.emplace_back(sum / (2 * kReach + 1));
  }
  line.push_back(line.front());
  return line;
}

}  // namespace

SampleSides::SampleSides(int width, int height)
    : width_(width), height_(height), sides_(std::size_t(width + 1) * (height + 1), 0) {}

void SampleSides::AddBetween(const std::function<bool(int, int, int, int)>& differs) {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      if (y > 0 && differs(x, y - 1, x, y)) Set({x, y}, 0, true, sides_);
      if (x > 0 && differs(x - 1, y, x, y)) Set({x, y}, 1, true, sides_);
    }
  }
}

bool SampleSides::Has(const Sides& sides, const Vector2i& node, int direction) const {
  return (sides[Index(node.x(), node.y())] >> direction & 1) != 0;
}

void SampleSides::Set(const Vector2i& node, int direction, bool value, Sides& sides) const {
  const Vector2i next = Next(node, direction);
  for (const auto& [at, along] :
       {std::pair(node, direction), std::pair(next, (direction + 2) % 4)}) {
    unsigned char& bits = sides[Index(at.x(), at.y())];
    const int bit = 1 << along;
    bits = static_cast<unsigned char>(value ? bits | bit : bits & ~bit);
  }
}

int SampleSides::Degree(const Vector2i& node) const {
  return std::popcount(sides_[Index(node.x(), node.y())]);
}

/// Walk along the remaining sides, and remove them.
/// @param through  whether to continue at junctions, up to a node without remaining sides.
SampleSides::Chain SampleSides::Walk(Vector2i node, int direction, bool through,
                                     Sides& left) const {
  Chain nodes = {node};
  while (Has(left, node, direction)) {
    Set(node, direction, false, left);
    node = Next(node, direction);
    nodes.push_back(node);
    if (!through && Degree(node) != 2) break;
    direction = 0;
    while (direction < 3 && !Has(left, node, direction)) ++direction;
  }
  return nodes;
}

/// Walk all chains.
/// @param from_ends  whether to start only at ends and junctions.
void SampleSides::WalkAll(bool from_ends, bool through, Sides& left,
                          std::vector<Chain>& chains) const {
  for (int y = 0; y <= height_; ++y) {
    for (int x = 0; x <= width_; ++x) {
      const Vector2i node(x, y);
      if (left[Index(x, y)] == 0) continue;
      if (from_ends && Degree(node) == 2) continue;
      for (int direction = 0; direction < 4; ++direction) {
        if (!Has(left, node, direction)) continue;
        chains.push_back(Walk(node, direction, through, left));
      }
    }
  }
}

std::vector<Polyline> SampleSides::TraceLoops() const {
  Sides left = sides_;
  std::vector<Chain> chains;
  WalkAll(/*from_ends=*/false, /*through=*/true, left, chains);
  std::vector<Polyline> loops;
  for (const Chain& chain : chains) loops.push_back(Simplified(Smoothed(chain)));
  return loops;
}

/// Remove short sides between two junctions, as between two nearly coinciding lines, and short
/// lines with a free end.
void SampleSides::Prune(std::size_t shortest_end) {
  constexpr std::size_t kRung = 3;
  Sides left = sides_;
  std::vector<Chain> chains;
  WalkAll(/*from_ends=*/true, /*through=*/false, left, chains);
  for (const Chain& chain : chains) {
    const bool has_end = Degree(chain.front()) == 1 || Degree(chain.back()) == 1;
    if (chain.size() - 1 >= (has_end ? shortest_end : kRung)) continue;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const Vector2i step = chain[i] - chain[i - 1];
      int direction = 0;
      while (Next({0, 0}, direction) != step) ++direction;
      Set(chain[i - 1], direction, false, sides_);
    }
  }
}

std::vector<Polyline> SampleSides::Trace(double shortest) const {
  SampleSides pruned = *this;
  // Lines that were between junctions can end freely afterwards.
  for (int i = 0; i < 2; ++i) pruned.Prune(static_cast<std::size_t>(shortest / 4));
  return pruned.TraceAll(shortest);
}

std::vector<Polyline> SampleSides::TraceAll(double shortest) const {
  Sides left = sides_;
  std::vector<Chain> chains;
  WalkAll(/*from_ends=*/true, /*through=*/false, left, chains);
  WalkAll(/*from_ends=*/false, /*through=*/false, left, chains);  // closed ones
  boost::disjoint_sets_with_storage<> joined(sides_.size());
  const auto index = [this](const Vector2i& node) { return Index(node.x(), node.y()); };
  for (const Chain& chain : chains) joined.union_set(index(chain.front()), index(chain.back()));
  std::map<std::size_t, std::size_t> lengths;
  for (const Chain& chain : chains) {
    lengths[joined.find_set(index(chain.front()))] += chain.size() - 1;
  }
  std::vector<Polyline> lines;
  for (const Chain& chain : chains) {
    const std::size_t length = lengths[joined.find_set(index(chain.front()))];
    if (static_cast<double>(length) < shortest) continue;
    lines.push_back(ThroughMiddles(chain));
  }
  return lines;
}

std::vector<Polyline> OutlineOf(int width, int height, double smallest,
                                const std::function<bool(int, int)>& selects) {
  // A border of one sample, so that regions end at the border of the image.
  SampleSides sides(width + 2, height + 2);
  const auto at = [&](int x, int y) {
    return x > 0 && y > 0 && x <= width && y <= height && selects(x - 1, y - 1);
  };
  sides.AddBetween([&](int x, int y, int x2, int y2) { return at(x, y) != at(x2, y2); });
  std::vector<Polyline> outlines = sides.TraceLoops();
  std::erase_if(outlines, [smallest](const Polyline& outline) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : outline) box.extend(p);
    return box.sizes().maxCoeff() < smallest;
  });
  for (Polyline& outline : outlines) {
    for (Vector2d& p : outline) p -= Vector2d(1, 1);
  }
  return outlines;
}

}  // namespace regrasp::render
