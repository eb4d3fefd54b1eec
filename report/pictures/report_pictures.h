#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frames/frame.h"
#include "render/frames/overview_image.h"
#include "render/picture/animation.h"
#include "report/pictures/hand_picture.h"
#include "report/report.h"

namespace regrasp::report {

struct DrawingOptions {
  render::FrameOptions frame;
  const HandPicture* hand = nullptr;  ///< of a plan for a hand; null: fingers without one
  int workers = 1;                    ///< threads that draw
  int sheet_width = render::kOverviewWidth;
  /// Called with the number of pictures drawn and of all, after each.
  std::function<void(int done, int all)> on_picture = [](int, int) {};
};

/// The picture of an entry.
struct DrawnFrame {
  plan::EntryIndex entry;
  const render::Image& image;
  bool own_view = false;  ///< not taken from where the others are
};

/// How many entries of a report have a frame: up to the one that failed.
[[nodiscard]] int CountFrames(const Report& report);

/// Draws a frame of every entry up to the one that failed. The frame of the one that failed shows
/// what the replay saw, or what is planned where it was not replayed, with what is wrong.
/// @param take  called with each frame, in order.
/// @returns the contact sheet: all of them, small, with the verdict in words and grey cells for the
///          steps after the failure.
/// @throws EnvironmentError  no rendering context.
/// @throws what `take` throws.
render::Image DrawFrames(const object::Object& object, const plan::Plan& plan,
                         const DrawingOptions& options, const Report& report,
                         const std::function<void(const DrawnFrame&)>& take);

/// The same moving picture in several formats.
struct MovingPictures {
  std::vector<std::string> bytes;  ///< of the file of each format
  int width = 0;                   ///< pixels, as is the height
  int height = 0;
};

/// Draws what was replayed as moving pictures, from where the frames are seen; the last rest is the
/// frame of the step that failed.
/// @param options  the size is that of the moving pictures.
/// @param samples  states during the replay, ascending in time.
/// @throws EnvironmentError  no rendering context.
[[nodiscard]] MovingPictures DrawAnimation(const object::Object& object, const plan::Plan& plan,
                                           const DrawingOptions& options,
                                           const std::vector<plan::Snapshot>& samples,
                                           const std::vector<render::AnimationFormat>& formats,
                                           const Report& report);

}  // namespace regrasp::report
