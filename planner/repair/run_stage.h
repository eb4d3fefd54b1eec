#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "planner/base/deadline.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

/// How a stage ended: with a surface, or with why it has none.
struct StageRun {
  std::optional<StageResult> result;
  std::string failure;
};

/// Of processor time: a stage takes seconds on a scan, a minute on a million facets.
inline constexpr std::chrono::seconds kStageTime{300};

/// Runs a stage in a child process of limited time and memory.
/// @throws TimeUp  the deadline came.
/// @throws EnvironmentError  no process can be started.
[[nodiscard]] StageRun RunStage(const std::function<StageResult()>& stage, const Deadline& deadline,
                                std::chrono::seconds processor = kStageTime);

}  // namespace regrasp::repair
