#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// A motion of all contacts of a grasp along the surface, proved to keep force closure: between two
/// waypoints every contact moves straight on its face, or one keeps its point and turns to the next
/// face, and the others stand still.
struct FaceAlign {
  /// Which contact of the first grasp goes to which of the second, by number.
  std::vector<std::pair<int, int>> contacts;
  /// Waypoints between the two grasps, in the order of `contacts`; none where all of them stay on
  /// their faces.
  std::vector<grasp::Grasp> between;
  /// By pair of waypoints that follow each other, the ends included; in the order of `contacts`.
  std::vector<motion::MotionSegments> proof;
};

/// The grasps of an align from the first to the last, in the order of its contacts.
[[nodiscard]] std::vector<grasp::Grasp> WaypointsOf(const FaceAlign& align,
                                                    const SearchSpace& space);

/// Whether the grasps at the turns of an align and half-way between its waypoints are as good as
/// the space asks. AlignBetween only returns such aligns.
[[nodiscard]] bool AdmitsPath(const FaceAlign& align, SearchSpace& space);

/// The travel of all contacts of an align together; turns of normals add nothing.
[[nodiscard]] double TravelOf(const FaceAlign& align, const SearchSpace& space);

/// The faces of a grasp's contacts, ascending.
using FaceTuple = std::vector<FaceIndex>;
[[nodiscard]] FaceTuple TupleOf(const criteria::ContactSet& set, const SearchSpace& space);

/// Whether an align may take a contact to another face: to a neighbouring one, or near by (kNear).
[[nodiscard]] bool MayHandOver(const grasp::Contact& from, const grasp::Contact& to,
                               const object::Object& object);
/// Of the diameter. On a fine mesh faces are small, and what is near is few edges away.
inline constexpr double kNear = 0.15;

using ContactPairs = std::vector<std::pair<int, int>>;

/// Pairs the contacts of two grasps for an align: common ones stay, the others go to one on their
/// own face, or go over to another one (MayHandOver). Of all pairings the one with the fewest
/// contacts that change their faces, of those the one with the least straight distance in all.
///
/// Takes well under a microsecond, most of all where there is none.
[[nodiscard]] std::optional<ContactPairs> PairContacts(const criteria::ContactSet& from,
                                                       const criteria::ContactSet& to,
                                                       const SearchSpace& space);

/// The straight distance of all contacts together from one grasp to another; infinite where they
/// can't be paired.
[[nodiscard]] double DistanceBetween(const criteria::ContactSet& from,
                                     const criteria::ContactSet& to, const SearchSpace& space);

/// Aligns from one grasp to another, force closure at the space's half-angle throughout: contacts
/// go along their routes (FindSurfaceRoute), all at rates that bring them to their ends at once,
/// and stop while one of them turns at an edge.
///
/// Law: between the same grasps in exchange, with each route turned round, the same holds.
/// @returns nullopt where the contacts can't be paired, one has no route, or the motion was not
///          proved to be force closure.
[[nodiscard]] std::optional<FaceAlign> AlignBetween(const criteria::ContactSet& from,
                                                    const criteria::ContactSet& to,
                                                    SearchSpace& space);

}  // namespace regrasp::tree
