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

/// How the 4-subsets were settled. The first five sum to `subsets`.
struct SubsetCounts {
  std::int64_t rejected_by_lines = 0;    ///< PairLineVerdict::kNo
  std::int64_t accepted_by_pairs = 0;    ///< PairLineVerdict::kYes
  std::int64_t accepted_by_triples = 0;  ///< three of the four are force closure alone
  std::int64_t rejected_by_twists = 0;   ///< held off by the twist that refuted another subset
  std::int64_t by_simplex = 0;           ///< one linear program each
  std::int64_t subsets = 0;
  std::int64_t too_close = 0;  ///< of by_simplex: too close to call, not among the results
};

/// All 4-subsets of contact points in space that are force closure, as ascending indices in
/// lexicographic order: what TestForceClosure says yes to, found far faster than by asking it.
///
/// The ways in which every contact turns the object about the line through every pair
/// (TurnAboutLine) are kept as bit rows, so that the pair lines decide up to 64 subsets in a few
/// word operations; the simplex sees only what is left.
///
/// @param counts  filled where not null.
/// @param tell    told how much of the work is done.
/// @throws std::invalid_argument  as TestForceClosure; also for a frame in the plane and for soft
///                                fingers.
/// @throws TimeUp  the deadline came.
[[nodiscard]] std::vector<std::array<int, 4>> ForceClosureSubsets(
    std::span<const Contact> points, const object::WrenchFrame& frame, double half_angle,
    SubsetCounts* counts = nullptr, const Deadline& deadline = {}, const Tell& tell = {});

}  // namespace regrasp::grasp
