#pragma once

#include <map>
#include <vector>

#include "planner/plan/projection.h"
#include "render/frames/camera.h"
#include "render/frames/frame_model.h"

namespace regrasp::render {

/// The cameras of a sequence of frames: the common one, and the own ones of frames by index.
struct SequenceCameras {
  Camera common;
  std::map<int, Camera> own = {};
};

/// Choose the cameras of a sequence.
///
/// They show everything that is drawn of object and fingers, and the parts of a hand near the
/// object. Palm and forearm can exceed the image. A plan for a hand has one camera, in which the
/// palm is fixed.
[[nodiscard]] SequenceCameras MakeCameras(const FrameModel& model,
                                          const std::vector<plan::Snapshot>& snapshots);

}  // namespace regrasp::render
