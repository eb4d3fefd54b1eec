#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Number of 4-subsets by method of decision. The first five sum to `subsets`.
struct SubsetCounts {
  std::int64_t rejected_by_lines = 0;    ///< PairLineVerdict::kNo
  std::int64_t accepted_by_pairs = 0;    ///< PairLineVerdict::kYes
  std::int64_t accepted_by_triples = 0;  ///< three of the four are force closure alone
  std::int64_t rejected_by_twists = 0;   ///< held off by the twist that refuted another subset
  std::int64_t by_simplex = 0;           ///< decided by a linear program
  std::int64_t subsets = 0;
  /// Part of by_simplex that is too close to call, not among the results.
  std::int64_t too_close = 0;
};

/// Enumerate all force-closure 4-subsets of contact points in space.
/// The subsets are those for which TestForceClosure decides kYes, but are found much faster.
///
/// The directions in which every contact turns the object about the line through every pair
/// (TurnAboutLine) are stored as bit rows. The pair lines thus decide up to 64 subsets in a few
/// word operations, and the simplex decides only the remainder.
///
/// @param counts  output if not null.
/// @param tell    callback for progress.
/// @returns ascending indices, in lexicographic order.
/// @throws std::invalid_argument  as TestForceClosure, for a frame in the plane, and for soft
///     fingers.
/// @throws TimeUp  if the deadline passes.
[[nodiscard]] std::vector<std::array<int, 4>> ForceClosureSubsets(
    std::span<const Contact> points, const object::WrenchFrame& frame, double friction_angle,
    SubsetCounts* counts = nullptr, const Deadline& deadline = {}, const Tell& tell = {});

}  // namespace regrasp::grasp
