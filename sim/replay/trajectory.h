#pragma once

#include <string>
#include <vector>

#include "planner/plan/snapshot.h"

namespace regrasp::sim {

/// Format the samples of a replay as CSV for a real hand.
/// A header row with units precedes a row per sample and finger.
///
/// Columns: time_s, finger, role, fingertip position (m), contact point (m), inward normal, and
/// force on the object (N), all in the world frame of Snapshot. The path of a free finger between
/// two contacts is not included: its position jumps while its role is "free". Disturbance tests are
/// not included, since they are not motions. Lines end with CR LF as RFC 4180 requires.
[[nodiscard]] std::string FormatTrajectory(const std::vector<plan::Snapshot>& samples);

}  // namespace regrasp::sim
