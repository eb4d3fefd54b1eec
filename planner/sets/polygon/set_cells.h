#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/base/index.h"
#include "planner/grasp/contact.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/object/polygon.h"
#include "planner/planning/plan_request.h"  // IWYU pragma: export
#include "planner/sets/candidate_search.h"
#include "planner/sets/polygon/slack_program.h"

namespace regrasp::polygon {

/// The kinds of force-closure grasps of a polygon (Phoka 2010, section 3.2).
enum class GraspType {
  kConcurrent,  ///< three contacts whose cones see one focus point, normals φ-positively spanning
  kTwoFinger,   ///< two contacts, the line through them inside both cones
  kParallel,    ///< three contacts with parallel forces, the middle one opposing the others
};

/// A vertex of the switching graph: a connected component of the grasps of one type on distinct
/// edges. Contacts are a + u (b − a), 0 < u < 1, on an edge from a to b, material on the left.
///
/// A set is a union of convex parts, each given by linear inequalities once `part` is fixed:
/// - concurrent: bit k of a part is set iff the focus point lies on the outer side of the line of
///   edges[k]. A part holds the focus points x and contacts p_k with ±(x − p_k) in the cone of
///   half-angle φ about the inward normal (+ on the inner side);
/// - two-finger: part 0 squeezes, p_1 − p_0 in the cone at p_0 and p_0 − p_1 in the one at p_1;
///   part 1 stretches, the mirror image;
/// - parallel: a part is the position in `edges` of the centre contact, whose force opposes the
///   other two (more than one only where θ ≥ 45°). It is a union of convex polytopes itself
///   (planner/sets/polygon/parallel.h), always connected.
struct GraspSet {
  GraspType type = GraspType::kConcurrent;
  std::vector<FaceIndex> edges;  ///< ascending; three, or two of a two-finger set
  double tangent = 0;      ///< tan φ of a concurrent set, tan θ of the others; exact as it stands
  std::vector<int> parts;  ///< ascending
};

/// Whether a part of a concurrent set has its focus points on the outer side of the k-th edge.
[[nodiscard]] inline bool IsOuter(int part, int k) { return (part >> k & 1) != 0; }

/// The positions of the contacts of a parallel grasp that are not its centre, ascending.
[[nodiscard]] inline std::array<int, 2> OuterOf(int centre) {
  return {centre == 0 ? 1 : 0, centre == 2 ? 1 : 2};
}

inline constexpr int kGraspTypes = 3;

/// How many of a type, as tables 3.1 and 3.2 of Phoka 2010 count them.
struct GraspTypeCounts {
  std::int64_t candidates = 0;    ///< combinations of edges that pass the test on normals alone
  std::int64_t combinations = 0;  ///< those with a set whose interior is not empty
  std::int64_t vertices = 0;      ///< connected components of these interiors
  std::int64_t components = 0;    ///< of the graph, were there only this type
};

/// Edges of a polygon that two sets have in common, by their positions in the first and in the
/// second.
using CommonEdges = boost::container::static_vector<std::pair<int, int>, 3>;
/// @param a, b  ascending.
[[nodiscard]] CommonEdges FindCommonEdges(std::span<const FaceIndex> a,
                                          std::span<const FaceIndex> b);

/// A convex set of grasps, given by linear inequalities. The variables are the contacts' parameters
/// (0 to 1 along their edges), one for each edge of the set in its order, and after them, of a
/// concurrent set, the focus point about the centroid over D. Slacks are lengths over D: the focus
/// point's or the contact's distance to the border of a cone, a contact's distance to the ends of
/// its edge. Straight lines between points of a cell are aligns that stay inside it.
struct GraspCell {
  int part = 0;  ///< of the set, see GraspSet::parts
  Inequalities inequalities;
  SlackSolution centre;  ///< of largest slack
};

/// A grasp set as cells, all with an interior.
class SetCells {
 public:
  /// In doubles: existence was decided when the set was found, and what is too thin for doubles is
  /// left out here. Polygon and set must outlive the cells.
  SetCells(const object::Polygon& polygon, const GraspSet& set);

  [[nodiscard]] const std::vector<GraspCell>& cells() const { return cells_; }

  /// The grasp of largest slack where an align can pass from one cell to another: in what the cells
  /// have in common, or with the focus point on the edge that parts them.
  /// @returns its contacts' parameters; nullopt where the cells don't meet.
  [[nodiscard]] std::optional<Eigen::VectorXd> Passage(sets::PieceIndex from,
                                                       sets::PieceIndex to) const;

  /// The largest slack of a grasp in the set.
  [[nodiscard]] double width() const;

  /// The length of the set's k-th edge over D.
  [[nodiscard]] double edge_length(int k) const {
    return polygon_.face_measure(set_.edges[k]) / polygon_.diameter();
  }

 private:
  const object::Polygon& polygon_;
  const GraspSet& set_;
  std::vector<GraspCell> cells_;
};

/// The largest slack of a parallel set's grasps whose outer contacts are on different sides of the
/// whole common cone; 0 where there are none. Two linear programs a centre instead of eight.
[[nodiscard]] double ClearWidth(const object::Polygon& polygon, const GraspSet& parallel);

/// Slacks up to this, over D, count as none: a few hundred roundings of the inequalities.
inline constexpr double kNoSlack = 1e-12;

/// The slack of a grasp in a cell, with the best focus point where there is one.
/// @param parameters  of the contacts, in the order of the set's edges.
[[nodiscard]] double SlackInCell(const GraspCell& cell, const Eigen::VectorXd& parameters);

/// True iff a grasp has more than `slack` in one of the cells.
[[nodiscard]] bool IsInSet(const SetCells& set, const Eigen::VectorXd& parameters,
                           double slack = kNoSlack);

}  // namespace regrasp::polygon
