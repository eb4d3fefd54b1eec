#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::tree {

/// Limits at which a search stops.
struct SearchLimits {
  std::int64_t most_tests = std::numeric_limits<std::int64_t>::max();
  Deadline deadline = {};
  /// Callback with the number of tests, called whenever the clock is read.
  std::function<void(std::int64_t tests)> on_check = [](std::int64_t) {};
};

/// Contacts and grasps of a search.
/// Contacts are numbered as they occur. A set of contacts is admitted if it is a grasp that a
/// sequence may contain, by the quick test of quality. Counts the tests, which are the search
/// budget.
class SearchSpace : public criteria::GraspMemory {
 public:
  /// @param object  object that outlives this space.
  SearchSpace(const object::Object& object, const criteria::GraspCriteria& criteria,
              const hand::Hand& hand = {});

  /// Number of usable fingers of the hand, at most the number that can hold at once.
  [[nodiscard]] int fingers() const { return fingers_; }

  /// Number of force-closure tests, including those of certificates and the cost of qualities.
  [[nodiscard]] std::int64_t tests() const;
  void CountTests(std::int64_t tests) { more_tests_ += tests; }
  void SetLimits(const SearchLimits& limits) { limits_ = limits; }
  /// Return whether the search must stop; reads the clock only occasionally.
  [[nodiscard]] bool IsSpent();
  [[nodiscard]] bool out_of_time() const { return out_of_time_; }

 private:
  int fingers_;
  std::int64_t more_tests_ = 0;  ///< tests that the memory does not count
  SearchLimits limits_;
  std::int64_t next_check_ = 0;  ///< number of tests at which the clock is read next
  bool out_of_time_ = false;
};

/// Motion of all contacts of a grasp along the surface, proved to keep force closure.
/// Between two waypoints, either every contact moves straight on its face, or one contact changes
/// to the adjacent face at a fixed point and the others do not move.
struct FaceAlign {
  /// Contact of the first grasp and its contact in the second grasp, by number.
  std::vector<std::pair<int, int>> contacts;
  /// Waypoints between the two grasps, in the order of `contacts`; empty if all contacts stay on
  /// their faces.
  std::vector<grasp::Grasp> between;
  /// Proof per pair of consecutive waypoints, ends included, in the order of `contacts`.
  std::vector<motion::MotionSegments> proof;
};

/// Return the grasps of a sliding step from the first to the last, in the order of its contacts.
[[nodiscard]] std::vector<grasp::Grasp> WaypointsOf(const FaceAlign& align,
                                                    const SearchSpace& space);

/// Return whether the grasps at the turns, and halfway between waypoints, meet the criteria.
/// AlignBetween returns only such sliding steps.
[[nodiscard]] bool AdmitsPath(const FaceAlign& align, SearchSpace& space);

/// Return the total travel of all contacts of a sliding step; changes of normals do not count.
[[nodiscard]] double TravelOf(const FaceAlign& align, const SearchSpace& space);

/// Faces of a grasp's contacts, ascending.
using FaceTuple = std::vector<FaceIndex>;
[[nodiscard]] FaceTuple TupleOf(const criteria::ContactSet& set, const SearchSpace& space);

/// Return whether a sliding step may move a contact to another face.
/// The face must be adjacent, or within kNear.
[[nodiscard]] bool MayHandOver(const grasp::Contact& from, const grasp::Contact& to,
                               const object::Object& object);
/// Distance to a face to which a contact may slide, over the diameter. On a fine mesh faces are
/// small, and nearby faces are a few edges away.
inline constexpr double kNear = 0.15;

using ContactPairs = std::vector<std::pair<int, int>>;

/// Pair the contacts of two grasps for a sliding step.
/// Common contacts stay. Others move to a contact on their own face, or on another face
/// (MayHandOver). The result has the fewest contacts that change their faces, then the least total
/// straight distance.
///
/// Takes well under a microsecond, least of all if there is no pairing.
[[nodiscard]] std::optional<ContactPairs> PairContacts(const criteria::ContactSet& from,
                                                       const criteria::ContactSet& to,
                                                       const SearchSpace& space);

/// Return the total straight distance of all contacts between two grasps.
/// Infinite if they cannot be paired.
[[nodiscard]] double DistanceBetween(const criteria::ContactSet& from,
                                     const criteria::ContactSet& to, const SearchSpace& space);

/// Find a sliding step between two grasps that is force closure throughout.
/// The friction angle is that of the space. Contacts move along their routes (FindSurfaceRoute), at
/// rates that let all arrive at once, and stop while one of them changes its face at an edge.
///
/// Law: symmetric in the two grasps if each route is reversed.
/// @returns the step; nullopt if the contacts cannot be paired, one has no route, or force closure
///     of the motion was not proved.
[[nodiscard]] std::optional<FaceAlign> AlignBetween(const criteria::ContactSet& from,
                                                    const criteria::ContactSet& to,
                                                    SearchSpace& space);

/// Step between two grasps of a SearchSpace: a sliding step if `align` is set, otherwise a finger
/// switch.
struct PathStep {
  criteria::ContactSet to;
  std::optional<FaceAlign> align;
};

/// Sequence of grasps.
struct GraspPath {
  criteria::ContactSet start;
  std::vector<PathStep> steps;

  [[nodiscard]] const criteria::ContactSet& end() const {
    return steps.empty() ? start : steps.back().to;
  }
};

/// Return the reversed sliding step.
[[nodiscard]] FaceAlign Reversed(FaceAlign align);

/// Return the reversed path.
[[nodiscard]] GraspPath Reversed(const GraspPath& path);

/// Append `more`, which begins with the last grasp of `path`.
void Append(const GraspPath& more, GraspPath& path);

}  // namespace regrasp::tree
