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

/// The files in the folder of a validation, besides a frame for each step.
inline constexpr char kReportName[] = "report.json";
inline constexpr char kPageName[] = "report.html";
inline constexpr char kOverviewName[] = "overview.png";
inline constexpr char kAnimationName[] = "replay.webp";

/// The names of all files that a validation of the plan may write into its folder; fewer where
/// steps are not replayed.
[[nodiscard]] std::vector<std::string> ResultNames(const plan::Plan& plan, bool frames,
                                                   bool animation);

/// Whether a validation writes, or removes as an earlier one's, a file of this name in its folder:
/// report, page, contact sheet, moving picture, or the frame of an entry.
[[nodiscard]] bool IsValidationFile(const std::string& name);

struct MovingFile {
  std::filesystem::path path;
  render::AnimationFormat format;
};

/// Draws a frame of every step up to the one that failed into `folder` and names it in the report,
/// and the contact sheet overview.png (report/pictures/report_pictures.h).
/// @returns the same pictures, smaller, one for each entry of the report.
/// @throws EnvironmentError  no rendering context, or the folder cannot be written.
[[nodiscard]] std::vector<report::PagePicture> WriteFrames(const object::Object& object,
                                                           const plan::Plan& plan,
                                                           const report::DrawingOptions& options,
                                                           const std::filesystem::path& folder,
                                                           report::Report& report);

/// Writes what was replayed as moving pictures, from where the frames are seen; the last rest is
/// the frame of the step that failed.
/// @param options  the size is that of the moving pictures.
/// @param samples  states during the replay, ascending in time.
/// @param files    at least one.
/// @returns the first of them.
/// @throws EnvironmentError  as WriteFrames.
report::PagePicture WriteAnimation(const object::Object& object, const plan::Plan& plan,
                                   const report::DrawingOptions& options,
                                   const std::vector<plan::Snapshot>& samples,
                                   const std::vector<MovingFile>& files,
                                   const report::Report& report);

}  // namespace regrasp::apps
