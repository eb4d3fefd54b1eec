#pragma once

#include <string>
#include <vector>

#include "planner/plan/snapshot.h"

namespace regrasp::sim {

/// The samples of a replay as CSV for a real hand: a header row with units, then a row per sample
/// and finger.
///
/// Columns: time_s, finger, role, tip position (m), contact point (m), inward normal, and force on
/// the object (N), all in the world frame of Snapshot. The path of a free finger from one place to
/// the next is left to the hand: its position jumps while its role is "free". Shakes are tests, no
/// motion, and are not part of it. Lines end with CR LF as RFC 4180 has it.
[[nodiscard]] std::string FormatTrajectory(const std::vector<plan::Snapshot>& samples);

}  // namespace regrasp::sim
