#include "apps/frame_files.h"

#include <string>
#include <vector>

#include "apps/entry_names.h"
#include "planner/base/file.h"
#include "render/frames/contact_sheet.h"
#include "render/picture/caption.h"
#include "render/picture/webp.h"

namespace regrasp::apps {

namespace {

constexpr char kFrameEnding[] = "png";

std::string Caption(const plan::Plan& plan, const report::ReportStep& step) {
  const std::string caption = render::FrameCaption(plan, step.check.index);
  const bool failed = step.verdict() == report::Verdict::kFail;
  return failed ? caption + " — " + std::string(plan::ReasonName(step.reason())) : caption;
}

render::SheetLabel MakeLabel(const report::ReportStep& step) {
  constexpr render::Color kGood = {29, 107, 60};
  constexpr render::Color kBad = {179, 38, 30};
  const bool failed = step.verdict() == report::Verdict::kFail;
  const std::string verdict(failed ? plan::ReasonName(step.reason())
                                   : report::VerdictName(step.verdict()));
  return {std::to_string(step.check.index) + "  " + step.check.kind, verdict,
          failed ? kBad : kGood};
}

std::vector<plan::Snapshot> RestsOf(const report::Report& report) {
  std::vector<plan::Snapshot> rests;
  for (const report::ReportStep& step : report.steps) {
    if (step.replay) rests.push_back(step.replay->snapshot);
  }
  return rests;
}

double RelativeThickness(const report::Report& report) {
  return report.settings->thickness_m / report.settings->diameter_m;
}

report::PagePicture MakePicture(const render::Image& image, int width) {
  return {render::EncodeWebp(image, width), image.width, image.height};
}

}  // namespace

std::vector<std::string> ResultNames(const plan::Plan& plan, bool frames, bool animation) {
  std::vector<std::string> names = {kReportName, kPageName};
  if (animation) names.emplace_back(kAnimationName);
  if (!frames) return names;
  names.emplace_back(kOverviewName);
  names.push_back(EntryFileName(0, "hold", kFrameEnding));
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    names.push_back(
        EntryFileName(static_cast<int>(i) + 1, plan::StepKind(plan.steps[i]), kFrameEnding));
  }
  return names;
}

bool IsValidationFile(const std::string& name) {
  const std::vector<std::string> always = {kReportName, kPageName, kOverviewName, kAnimationName};
  return std::ranges::find(always, name) != always.end() || IsEntryFileName(name, kFrameEnding);
}

std::vector<report::PagePicture> WriteFrames(const object::Object& object, const plan::Plan& plan,
                                             const render::FrameOptions& options,
                                             const std::filesystem::path& folder,
                                             report::Report& report) {
  std::vector<report::PagePicture> pictures(report.steps.size());
  const std::vector<plan::Snapshot> snapshots = RestsOf(report);
  if (snapshots.empty()) return pictures;
  render::FrameOptions frame = options;
  if (object.dimension() == 2) frame.body.thickness = RelativeThickness(report);
  frame.finger_radius = report.finger_radius;
  render::FrameRenderer renderer(object, report.scale, report.half_angle, snapshots, frame);
  const auto count = static_cast<int>(snapshots.size());
  render::ContactSheet sheet(count, frame.width, frame.height);
  for (report::ReportStep& step : report.steps) {
    if (!step.replay) continue;
    const std::string name = EntryFileName(step.check.index, step.check.kind, kFrameEnding);
    const render::Image image = renderer.Render(step.replay->snapshot, Caption(plan, step));
    render::WritePng(folder / name, image);
    step.frame = name;
    pictures[step.check.index] = MakePicture(image, report::PagePictureWidth(count));
    sheet.Add(image, MakeLabel(step));
  }
  render::WritePng(folder / kOverviewName, sheet.ToImage());
  return pictures;
}

void WriteAnimation(const object::Object& object, const plan::Plan& plan,
                    const std::vector<plan::Snapshot>& samples, render::AnimationOptions options,
                    const std::filesystem::path& folder, const report::Report& report) {
  const std::vector<plan::Snapshot> rests = RestsOf(report);
  if (rests.empty()) return;
  if (object.dimension() == 2) options.thickness = RelativeThickness(report);
  WriteFile(folder / kAnimationName,
            render::RenderAnimation(object, plan, report.half_angle, samples, rests, options),
            Durability::kCached);
}

}  // namespace regrasp::apps
