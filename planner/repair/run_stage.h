#pragma once

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

/// Runs a stage in a child process of limited time and memory.
/// @throws TimeUp  the deadline came.
/// @throws EnvironmentError  no process can be started.
[[nodiscard]] StageRun RunStage(const std::function<StageResult()>& stage,
                                const Deadline& deadline);

}  // namespace regrasp::repair
