#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "planner/base/text_table.h"

namespace regrasp::apps {

/// Number of grasps per claimed and measured success.
struct EvaluateCounts {
  /// Counts by claim (success, failure, none) and measured success (pass, fail).
  struct Confusion {
    std::array<std::array<std::int64_t, 2>, 3> counts = {};
  };
  std::map<std::string, Confusion> by_hand;       ///< by name of the hand
  std::map<std::string, Confusion> by_object;     ///< by object file
  std::map<std::string, Confusion> by_protocol;   ///< by name of the protocol
  std::map<std::string, std::int64_t> by_reason;  ///< by name of the reason
};

/// Count the reports of a file that `evaluate` wrote. Memory use does not depend on its size.
/// @throws InputError  if the file is not such a file.
[[nodiscard]] EvaluateCounts ReadEvaluateCounts(const std::filesystem::path& path);

/// Return the counts as tables: reasons, then the confusion table per protocol, per object and per
/// hand. The first row of a table has the names of its columns. Empty tables are omitted.
[[nodiscard]] std::vector<std::vector<TextRow>> EvaluateTables(const EvaluateCounts& counts);

/// Return the counts as text: reasons, then the confusion table per protocol and per object.
[[nodiscard]] std::string FormatEvaluateTable(const EvaluateCounts& counts);

}  // namespace regrasp::apps
