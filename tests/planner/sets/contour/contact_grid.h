#pragma once

#include <string>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_graph.h"

namespace regrasp::contour {

enum class Sense { kNone, kSqueezing, kStretching, kTooClose };

/// What two contacts of a polygon are, by the general force-closure test and the direction from one
/// to the other.
[[nodiscard]] Sense SenseOf(const object::Polygon& polygon, double half_angle,
                            const grasp::Contact& a, const grasp::Contact& b);

/// All pairs of sampled contacts of a polygon, each classified by itself, and the components that
/// they fall into: a graph's sets as far as a grid can tell.
///
/// The lines of the grid are contacts spread over all rings, `lines` in all and at least a few on
/// every edge, each drawn within its part of the edge. Two pairs of contacts belong together where
/// both are on the same edges in the same sense (the differences p_b − p_a that squeeze are a
/// convex cone), and where one contact goes to the next line across a vertex of the polygon while
/// the pair is a grasp in the same sense with either normal there. So a component is never more
/// than one set; a set that is thin may be several components or none.
class ContactGrid {
 public:
  ContactGrid(const object::Polygon& polygon, double half_angle, int lines, std::uint64_t seed);

  [[nodiscard]] int line_count() const { return static_cast<int>(lines_.size()); }
  [[nodiscard]] const grasp::Contact& line(int i) const { return lines_[i]; }
  [[nodiscard]] Sense sense(int i, int j) const { return sense_[i * line_count() + j]; }
  /// The component of a pair; −1 where it is no grasp.
  [[nodiscard]] int component(int i, int j) const { return component_[i * line_count() + j]; }
  [[nodiscard]] int component_count() const { return component_count_; }

 private:
  void JoinCells();

  const object::Polygon& polygon_;
  double half_angle_;
  std::vector<grasp::Contact> lines_;
  std::vector<int> next_;  ///< the line that follows on the ring
  std::vector<Sense> sense_;
  std::vector<int> component_;
  int component_count_ = 0;
};

/// A grid held against a graph.
struct GridComparison {
  std::int64_t pairs = 0;   ///< classified
  std::int64_t grasps = 0;  ///< of them, force closure
  int too_close = 0;
  int sets = 0;         ///< with one component or more
  int split_sets = 0;   ///< with several
  int missed_sets = 0;  ///< with none
  int switches = 0;     ///< found: two sets share a line
  int missed_switches = 0;
  std::vector<std::string> failures;
};

/// Every grasp of the grid must lie in exactly one piece, of its sense; every other pair in none;
/// a component in one set; sets that share a line must be joined.
[[nodiscard]] GridComparison CompareWithGrid(const object::Polygon& polygon,
                                             const ContourGraph& graph, const ContactGrid& grid);

}  // namespace regrasp::contour
