#pragma once

#include <optional>
#include <string>

#include "planner/plan/plan.h"

namespace regrasp::apps {

/// The number of a plan's entry in file names: three digits, so that names sort, or more.
[[nodiscard]] std::string EntryNumber(plan::EntryIndex index);

/// What follows such a number at the beginning of a name; nullopt where there is none.
[[nodiscard]] std::optional<std::string> AfterEntryNumber(const std::string& name);

/// The name of an entry's picture: "000_hold.png", "001_switch.png".
/// @param ending  "png".
[[nodiscard]] std::string EntryFileName(plan::EntryIndex index, const std::string& kind,
                                        const std::string& ending);

/// Whether a name is one that EntryFileName gives.
[[nodiscard]] bool IsEntryFileName(const std::string& name, const std::string& ending);

}  // namespace regrasp::apps
