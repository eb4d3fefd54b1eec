#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "render/frames/fault_marks.h"
#include "render/frames/frame.h"
#include "render/frames/overview_image.h"
#include "render/picture/animation.h"
#include "report/pictures/hand_picture.h"
#include "report/report.h"

namespace regrasp::report {

/// Options for drawing the images of a report.
struct DrawingOptions {
  render::FrameOptions frame;
  const HandPicture* hand = nullptr;  ///< hand of the plan; null: fingers without a hand
  int workers = 1;                    ///< number of drawing threads
  int sheet_width = render::kOverviewWidth;
  /// Callback after each image: number of finished images and of all images.
  std::function<void(int done, int all)> on_picture = [](int, int) {};
};

/// Frame of an entry.
struct DrawnFrame {
  plan::EntryIndex entry;
  const render::Image& image;
  const render::Image& page_image;  ///< the frame without a caption, which a page has as text
  bool own_view = false;            ///< whether its camera differs from that of the rest
};

/// Entry that has a frame: the displayed state, and marks at the fault if it failed.
struct ShownEntry {
  const ReportStep* step;
  plan::Snapshot snapshot;
  std::optional<render::FaultMarks> marks = std::nullopt;
};

/// Return the displayed states of all entries up to the failed one, which refer to the report.
/// The failed entry has the replayed state, or the planned state if it was not replayed.
/// @param hand     hand of the plan; null: fingers without a hand.
/// @param samples  recorded states of the hand. If they end in the failed entry, it has the last
///                 one instead of its planned state.
[[nodiscard]] std::vector<ShownEntry> ShowEntries(const object::Object& object,
                                                  const plan::Plan& plan, const HandPicture* hand,
                                                  const Report& report,
                                                  const std::vector<HandSample>& samples = {});

/// Return the caption of an entry's frame, with the reason if it failed.
/// @param finger_names  names of fingers by index; other fingers have their number.
[[nodiscard]] std::string EntryCaption(const plan::Plan& plan, const ReportStep& step,
                                       std::span<const std::string> finger_names);

/// Return the text that marks the step with the smallest friction margin in the overview image of a
/// plan that passes.
/// @returns an empty text for all other steps, a plan that fails, and a plan without steps.
[[nodiscard]] std::string OverviewNote(const Report& report, const ReportStep& step);

/// Return the number of entries that have a frame: all up to the failed entry.
[[nodiscard]] int CountFrames(const Report& report);

/// Draw a frame of every entry up to the failed entry.
/// The failed entry's frame shows the replayed state, or the planned state if the entry was not
/// replayed, with marks at the fault.
/// @param take  receives each frame, in order; its exceptions pass.
/// @returns the overview image: all frames, small, with the verdict in words and grey cells for the
///     steps after the failure.
/// @throws EnvironmentError  if there is no rendering context.
render::Image DrawFrames(const object::Object& object, const plan::Plan& plan,
                         const DrawingOptions& options, const Report& report,
                         const std::function<void(const DrawnFrame&)>& take);

/// Animation in several formats.
struct MovingPictures {
  std::vector<std::string> bytes;  ///< bytes of the file of each format
  int width = 0;                   ///< width and height, pixels
  int height = 0;
};

/// Draw the replay as an animation, with the view direction of the frames.
///
/// Its motion is that of the 3-D replay (MakeTimeline). It ends with the frame of the failed step.
/// @param options  options; the size is that of the animation.
/// @param samples  recorded states of the hand, ascending in time; may be empty.
/// @throws EnvironmentError  if there is no rendering context.
[[nodiscard]] MovingPictures DrawAnimation(const object::Object& object, const plan::Plan& plan,
                                           const DrawingOptions& options,
                                           const std::vector<HandSample>& samples,
                                           const std::vector<render::AnimationFormat>& formats,
                                           const Report& report);

}  // namespace regrasp::report
