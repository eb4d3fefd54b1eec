#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "planner/base/deadline.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

/// Outcome of a stage: a surface, or the reason why there is none.
struct StageRun {
  std::optional<StageResult> result;
  std::string failure;
};

/// Limit of processor time of a stage.
/// A stage takes seconds for a scan and a minute for a million triangles.
inline constexpr std::chrono::seconds kStageTime{300};

/// Run a stage in a child process of limited time and memory.
/// @throws TimeUp  if the deadline passes.
/// @throws EnvironmentError  if no process can be started.
[[nodiscard]] StageRun RunStage(const std::function<StageResult()>& stage, const Deadline& deadline,
                                std::chrono::seconds processor = kStageTime);

}  // namespace regrasp::repair
