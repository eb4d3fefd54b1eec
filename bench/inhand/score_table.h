#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/inhand/row.h"
#include "bench/inhand/task.h"

namespace regrasp::bench {

/// Format the scoreboard in Markdown.
/// Each group of tasks has a table of hands: number found, passes, medians of the found plans,
/// final pose errors of the passed plans, and reasons of failure. One more table has every task in
/// every hand.
/// @param tasks  tasks that define the order of groups and rows; results of other tasks come last.
[[nodiscard]] std::string ScoreTables(const std::vector<Row>& rows, const std::vector<Task>& tasks);

/// Return a text with the part between its markers replaced.
/// @param name  name of the text in messages.
/// @throws InputError  if a marker is missing.
[[nodiscard]] std::string ReplaceBetweenMarkers(std::string_view text, std::string_view between,
                                                const std::string& name);

}  // namespace regrasp::bench
