#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/inhand/row.h"
#include "bench/inhand/task.h"

namespace regrasp::bench {

/// The scoreboard in Markdown. For each group of tasks a table of hands: found, passes, medians of
/// those found, final pose errors of those that pass, and why the others failed; and a table of
/// every task in every hand.
/// @param tasks  give groups and rows their order; those of other tasks come last.
[[nodiscard]] std::string ScoreTables(const std::vector<Row>& rows, const std::vector<Task>& tasks);

/// A text with what stands between its markers replaced.
/// @param name  how messages call it.
/// @throws InputError  it lacks a marker.
[[nodiscard]] std::string ReplaceBetweenMarkers(std::string_view text, std::string_view between,
                                                const std::string& name);

}  // namespace regrasp::bench
