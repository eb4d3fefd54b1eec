#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/report.h"

namespace regrasp::report {

/// The direction of a report in which a rest resists least, by the replay.
struct WeakestPush {
  plan::EntryIndex step{0};
  sim::DirectionStress stress;
};

/// Nullopt where no entry has been searched for it.
[[nodiscard]] std::optional<WeakestPush> FindWeakestPush(const Report& report);

/// For each entry the largest push in each direction in percent of the squeeze, by the replay, the
/// smallest of all and what the analysis says of it; empty where there is none.
[[nodiscard]] std::string FormatStressTable(const Report& report);

}  // namespace regrasp::report
