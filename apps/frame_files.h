#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/picture/animation.h"
#include "report/page/report_page.h"
#include "report/pictures/report_pictures.h"
#include "report/report.h"

namespace regrasp::apps {

/// Files in the folder of a validation, in addition to a frame for each step.
inline constexpr char kReportName[] = "report.json";
inline constexpr char kPageName[] = "report.html";
inline constexpr char kOverviewName[] = "overview.png";
inline constexpr char kAnimationName[] = "replay.webp";

/// Return the names of all files that a validation of the plan may write.
/// If steps are not replayed, it writes fewer.
[[nodiscard]] std::vector<std::string> ResultNames(const plan::Plan& plan, bool frames,
                                                   bool animation);

/// Return whether a validation writes or removes files of this name.
/// Such files are the report, the HTML report, the overview image, the animations and the frames of
/// entries.
[[nodiscard]] bool IsValidationFile(const std::string& name);

struct MovingFile {
  std::filesystem::path path;
  render::AnimationFormat format;
};

/// Draw a frame of each step up to the failed one, and the overview image.
/// The frames are written into `folder` and named in the report. The overview image is overview.png
/// (`report/pictures/report_pictures.h`).
/// @returns the same images in a smaller size, one for each entry of the report.
/// @throws EnvironmentError  if there is no rendering context, or the folder cannot be written.
[[nodiscard]] std::vector<report::PagePicture> WriteFrames(const object::Object& object,
                                                           const plan::Plan& plan,
                                                           const report::DrawingOptions& options,
                                                           const std::filesystem::path& folder,
                                                           report::Report& report);

/// Write the replay as animations, with the view of the frames.
/// The last pause shows the frame of the failed step, if a step failed.
/// @param options  drawing options with the size of the animations.
/// @param samples  recorded states of the hand, ascending in time; may be empty.
/// @param files    files to write, at least one.
/// @param folder   folder of the page. The page links to an animation larger than
///                 report::kLargestMoving.
/// @returns the first video, or the first animation without a video.
/// @throws EnvironmentError  as WriteFrames.
report::PagePicture WriteAnimation(const object::Object& object, const plan::Plan& plan,
                                   const report::DrawingOptions& options,
                                   const std::vector<report::HandSample>& samples,
                                   const std::vector<MovingFile>& files,
                                   const std::filesystem::path& folder,
                                   const report::Report& report);

}  // namespace regrasp::apps
