#pragma once

#include <optional>
#include <string>

#include "planner/plan/plan.h"

namespace regrasp::apps {

/// Return the number of a plan's entry for file names.
/// It has at least three digits, so that names sort.
[[nodiscard]] std::string EntryNumber(plan::EntryIndex index);

/// Return the part of a name after its leading entry number.
/// nullopt if the name does not start with one.
[[nodiscard]] std::optional<std::string> AfterEntryNumber(const std::string& name);

/// Return the name of an entry's image: "000_hold.png", "001_switch.png".
/// @param ending  file name extension: "png".
[[nodiscard]] std::string EntryFileName(plan::EntryIndex index, const std::string& kind,
                                        const std::string& ending);

/// Return whether EntryFileName returns this name for any entry.
[[nodiscard]] bool IsEntryFileName(const std::string& name, const std::string& ending);

}  // namespace regrasp::apps
