#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"
#include "planner/search/switching_graph.h"

namespace regrasp::roadmap {

/// n over K; 0 where n < K. A template, so that the divisions are by constants.
template <int K>
[[nodiscard]] constexpr std::int64_t Binomial(int n) {
  if constexpr (K == 0) {
    return 1;
  } else {
    return Binomial<K - 1>(n) * (n - K + 1) / K;
  }
}

/// The rank of an ascending triple among all triples in colexicographic order: Σ (c_i over i + 1),
/// the combinatorial number system (Knuth, TAOCP 4A, 7.2.1.3).
///
/// Law: a bijection between the triples of {0, …, n − 1} and {0, …, (n over 3) − 1}.
[[nodiscard]] constexpr std::int64_t CombinationRank(const std::array<int, 3>& ascending) {
  return Binomial<1>(ascending[0]) + Binomial<2>(ascending[1]) + Binomial<3>(ascending[2]);
}

/// Four contact points, indices in ascending order.
using Quadruple = std::array<int, 4>;

/// The plain roadmap (Kavraki and others 1996, of grasps: Phoka 2010, chapter VI): every
/// force-closure grasp of four of the contact points is a vertex; two grasps that share three
/// contacts are joined, as the fifth finger can take the new contact before the old one leaves.
///
/// Edges are not stored: grasps are listed by the triples of contacts that they contain, and two
/// different grasps share at most one triple. Contacts at the same point (two normals on an edge of
/// the solid, say) are never in one grasp nor take turns in one switch, for two fingers cannot
/// touch one point; nor do contacts where two fingers of a radius would overlap.
class Roadmap final : public search::SwitchingGraph {
 public:
  /// Tests all 4-subsets of the points.
  /// @param half_angle  radians.
  /// @param same_point  contacts no farther apart than this are at the same point.
  /// @param finger_radius  of fingers that are not points (reach.h).
  /// @param tell  told how much of the work is done.
  /// @throws std::invalid_argument  as TestForceClosure.
  /// @throws TimeUp  the deadline came.
  Roadmap(std::vector<grasp::Contact> points, const object::WrenchFrame& frame, double half_angle,
          double same_point, double finger_radius = 0, const Deadline& deadline = {},
          const Tell& tell = {});

  [[nodiscard]] const std::vector<grasp::Contact>& points() const { return points_; }
  [[nodiscard]] const Quadruple& vertex(int index) const { return vertices_[index]; }
  [[nodiscard]] grasp::Grasp grasp(int index) const;
  /// The vertex of four contact points in any order; nullopt where they are no vertex.
  [[nodiscard]] std::optional<int> Find(std::span<const int> points) const;

  [[nodiscard]] int vertex_count() const override { return static_cast<int>(vertices_.size()); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;
  /// The contacts of one grasp that the other lacks: a switch changes one.
  [[nodiscard]] int MinSwitches(int from, int to) const override;

  /// 4-subsets of the contact points, force closure or not.
  [[nodiscard]] std::int64_t candidate_count() const;
  /// Unordered pairs of vertices that share three contacts.
  /// @throws TimeUp  the deadline came.
  [[nodiscard]] std::int64_t CountEdges(const Deadline& deadline = {}) const;
  /// @throws TimeUp  the deadline came.
  [[nodiscard]] search::Components FindComponents(const Deadline& deadline = {}) const;

 private:
  void ListByTriples();
  [[nodiscard]] int triple_count() const;
  [[nodiscard]] std::span<const int> VerticesWith(int triple) const;
  /// Whether the switch between two grasps with a triple in common is between two contacts that
  /// exclude each other.
  [[nodiscard]] bool IsExcluded(int vertex, int other) const;
  [[nodiscard]] bool ExcludeEachOther(int a, int b) const {
    return excluded_[a * points_.size() + b];
  }
  [[nodiscard]] std::int64_t EdgesWith(int triple) const;

  std::vector<grasp::Contact> points_;
  std::vector<Quadruple> vertices_;  ///< in lexicographic order
  /// Vertices that contain a triple are at triple_begin_[triple] … triple_begin_[triple + 1].
  std::vector<int> triple_begin_;
  std::vector<int> triple_vertices_;
  std::vector<bool> excluded_;  ///< of any two points: two fingers cannot be at both
  bool any_excluded_ = false;   ///< with points for fingers hardly ever
};

}  // namespace regrasp::roadmap
