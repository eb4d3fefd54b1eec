#pragma once

#include <optional>
#include <vector>

#include "planner/general/search_space.h"
#include "planner/grasp/contact.h"
#include "planner/motion/motion_piece.h"

namespace regrasp {

/// A straight motion of all contacts of a grasp on their faces, proved to keep force closure.
struct FaceAlign {
  /// Which contact of the first grasp goes to which of the second, by number.
  std::vector<std::pair<int, int>> contacts;
  std::vector<MotionPiece> proof;  ///< in the order of `contacts`
};

/// The faces of a grasp's contacts, ascending: two grasps of one *tuple of faces* may be joined by
/// an align.
using FaceTuple = std::vector<int>;
[[nodiscard]] FaceTuple TupleOf(const ContactSet& set, const SearchSpace& space);

/// Pairs the contacts of two grasps of one tuple of faces: common ones stay, the others go to their
/// own face, where several are on one face with the least way in all.
[[nodiscard]] std::vector<std::pair<int, int>> PairContacts(const ContactSet& from,
                                                            const ContactSet& to,
                                                            const SearchSpace& space);

/// The way of all contacts together from one grasp to another of the same tuple of faces.
[[nodiscard]] double WayBetween(const ContactSet& from, const ContactSet& to,
                                const SearchSpace& space);

/// Aligns straight from one grasp to another of the same tuple of faces, force closure at the
/// space's half-angle all the way.
/// @returns nullopt where a way leaves its face or the motion was not proved to be force closure.
[[nodiscard]] std::optional<FaceAlign> AlignStraight(const ContactSet& from, const ContactSet& to,
                                                     SearchSpace& space);

}  // namespace regrasp
