#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frames/contact_sheet.h"
#include "render/frames/frame.h"
#include "render/picture/moving_picture.h"
#include "report/pictures/hand_picture.h"
#include "report/report.h"

namespace regrasp::report {

struct DrawingOptions {
  render::FrameOptions frame;
  const HandPicture* hand = nullptr;  ///< hand of the plan; null: fingers without a hand
  int workers = 1;                    ///< number of threads that draw
  int sheet_width = render::kSheetWidth;
  /// Function that is called with the number of drawn images and of all images, after each.
  std::function<void(int done, int all)> on_picture = [](int, int) {};
};

/// The image of an entry.
struct DrawnFrame {
  plan::EntryIndex entry;
  const render::Image& image;
  bool own_view = false;  ///< whether the camera differs from that of the other images
};

/// Return the number of entries with a frame: all up to the first that failed.
[[nodiscard]] int CountFrames(const Report& report);

/// Draw a frame of each entry, up to the first that failed.
/// The frame of a failed entry shows the state of the replay, or the plan if there was no replay,
/// and marks the failure.
/// @param take  function that is called with each frame, in order.
/// @returns the overview image: all frames at a small size, the verdict in words, and grey cells
///     for the steps after the failure.
/// @throws EnvironmentError  if there is no rendering context.
/// @throws exceptions of `take`.
render::Image DrawFrames(const object::Object& object, const plan::Plan& plan,
                         const DrawingOptions& options, const Report& report,
                         const std::function<void(const DrawnFrame&)>& take);

/// One animation in several formats.
struct MovingPictures {
  std::vector<std::string> bytes;  ///< bytes of the file of each format
  int width = 0;                   ///< width and height, pixels
  int height = 0;
};

/// Draw the replay as an animation from the camera of the frames; it ends with the last static
/// grasp.
/// If a step failed, its frame is the last image.
/// @param options  options of the frames; the size is that of the animation.
/// @param samples  states during the replay, ascending in time.
/// @throws EnvironmentError  if there is no rendering context.
[[nodiscard]] MovingPictures DrawAnimation(const object::Object& object, const plan::Plan& plan,
                                           const DrawingOptions& options,
                                           const std::vector<plan::Snapshot>& samples,
                                           const std::vector<render::MovingFormat>& formats,
                                           const Report& report);

}  // namespace regrasp::report
