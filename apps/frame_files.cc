#include "apps/frame_files.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/output_files.h"
#include "planner/base/file.h"
#include "render/picture/animation.h"

namespace regrasp::apps {

namespace {

constexpr char kFrameEnding[] = "png";

report::PagePicture MakePicture(const render::Image& image, int width) {
  return {render::EncodeWebp(image, width), image.width, image.height};
}

}  // namespace

std::vector<std::string> ResultNames(const plan::Plan& plan, bool frames, bool animation) {
  std::vector<std::string> names = {kReportName, kPageName};
  if (animation) names.emplace_back(kAnimationName);
  if (!frames) return names;
  names.emplace_back(kOverviewName);
  names.push_back(EntryFileName(plan::EntryIndex(0), "hold", kFrameEnding));
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    names.push_back(EntryFileName(plan::EntryIndex(static_cast<int>(i) + 1),
                                  plan::StepKind(plan.steps[i]), kFrameEnding));
  }
  return names;
}

bool IsValidationFile(const std::string& name) {
  const std::vector<std::string> always = {kReportName, kPageName, kOverviewName, kAnimationName};
  return std::ranges::find(always, name) != always.end() || IsEntryFileName(name, kFrameEnding);
}

std::vector<report::PagePicture> WriteFrames(const object::Object& object, const plan::Plan& plan,
                                             const report::DrawingOptions& options,
                                             const std::filesystem::path& folder,
                                             report::Report& report) {
  std::vector<report::PagePicture> pictures(report.steps.size());
  const int width = report::PagePictureWidth(report::CountFrames(report));
  const auto take = [&](const report::DrawnFrame& frame) {
    report::ReportStep& step = report.steps[frame.entry];
    const std::string name = EntryFileName(step.check.index, step.check.kind, kFrameEnding);
    render::WritePng(folder / name, frame.image);
    step.frame = name;
    report::PagePicture& picture = pictures[frame.entry];
    picture = MakePicture(frame.page_image, width);
    picture.own_view = frame.own_view;
  };
  render::WritePng(folder / kOverviewName, report::DrawFrames(object, plan, options, report, take));
  return pictures;
}

report::PagePicture WriteAnimation(const object::Object& object, const plan::Plan& plan,
                                   const report::DrawingOptions& options,
                                   const std::vector<report::HandSample>& samples,
                                   const std::vector<MovingFile>& files,
                                   const std::filesystem::path& folder,
                                   const report::Report& report) {
  std::vector<render::AnimationFormat> formats;
  for (const MovingFile& file : files) formats.push_back(file.format);
  report::MovingPictures moving =
      report::DrawAnimation(object, plan, options, samples, formats, report);
  for (std::size_t i = 0; i < files.size(); ++i) {
    WriteFile(files[i].path, moving.bytes[i], Durability::kCached);
  }
  // A video has controls.
  const auto video = std::ranges::find(formats, render::AnimationFormat::kMp4);
  const auto shown = video == formats.end() ? 0 : video - formats.begin();
  report::PagePicture picture = {std::move(moving.bytes[shown]), moving.width, moving.height,
                                 render::MediaType(formats[shown])};
  if (picture.bytes.size() > report::kLargestMoving) {
    const auto absolute = [](const std::filesystem::path& path) {
      return std::filesystem::absolute(path).lexically_normal();
    };
    picture.file = absolute(files[shown].path).lexically_proximate(absolute(folder)).string();
  }
  return picture;
}

}  // namespace regrasp::apps
