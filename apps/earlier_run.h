#pragma once

#include "apps/validate_options.h"

namespace regrasp {

/// Whether the folder of a plan holds the complete results of an earlier run that would come out
/// the same: a report with this run's digest, the page, and every picture that is named or asked
/// for. A report is written last, so what stands beside it is whole.
[[nodiscard]] bool HasSameRun(const ValidateOptions& options);

/// Removes report, page and pictures of an earlier run, and what a killed one left half-written.
/// Other files stay.
/// @throws EnvironmentError  one of them cannot be removed.
void RemoveEarlierRun(const std::filesystem::path& folder);

}  // namespace regrasp
