#pragma once

#include <functional>
#include <span>
#include <string>

#include "planner/plan/snapshot.h"
#include "render/frames/frame.h"

namespace regrasp::render {

/// What FrameRenderer::Render is given; what it points to outlives it.
struct FrameTask {
  const plan::Snapshot* snapshot;
  std::string caption;
  const FaultMarks* fault = nullptr;
  int view = kCommonView;
};

/// Draws frames in several threads, each with a copy of the renderer, and hands them on in this one
/// in the order of the tasks, while further ones are drawn. The frames do not depend on the number
/// of workers.
/// @param workers  ≥ 1.
/// @param take     called with the index of a task and its frame.
/// @throws what Render or `take` throws.
void RenderInOrder(const FrameRenderer& renderer, std::span<const FrameTask> tasks, int workers,
                   const std::function<void(int index, const Image& image)>& take);

}  // namespace regrasp::render
