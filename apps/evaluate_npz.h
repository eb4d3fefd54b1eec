#pragma once

#include <string>
#include <vector>

#include "apps/evaluate_rows.h"

namespace regrasp::apps {

/// Format N rows as an NPZ file for numpy.load (docs/evaluate_grasps.md).
/// Numbers that were not measured are NaN, texts are empty.
///
/// Law: equal rows give equal bytes.
/// @throws std::length_error  if the file would exceed 2 GB.
[[nodiscard]] std::string FormatGraspNpz(const std::vector<GraspRow>& rows);

}  // namespace regrasp::apps
