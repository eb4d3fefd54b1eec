#include "apps/frame_files.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "planner/base/file.h"
#include "render/frames/contact_sheet.h"
#include "render/picture/caption.h"
#include "render/picture/webp.h"

namespace regrasp::apps {

namespace {

/// Steps are numbered with this many digits, so that names sort.
constexpr std::size_t kDigits = 3;

std::string FrameName(std::size_t index, const std::string& kind) {
  const std::string number = std::to_string(index);
  const std::size_t zeros = kDigits - std::min(kDigits, number.size());
  return std::string(zeros, '0') + number + "_" + kind + ".png";
}

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
  names.push_back(FrameName(0, "hold"));
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    names.push_back(FrameName(i + 1, plan::StepKind(plan.steps[i])));
  }
  return names;
}

bool IsPictureName(const std::string& name) {
  if (name == kOverviewName || name == kAnimationName) return true;
  const auto digits = std::find_if_not(name.begin(), name.end(),
                                       [](unsigned char c) { return std::isdigit(c) != 0; });
  const std::string rest(digits, name.end());
  return digits - name.begin() >= static_cast<std::ptrdiff_t>(kDigits) &&
         (rest == "_hold.png" || rest == "_switch.png" || rest == "_align.png");
}

bool IsValidationFile(const std::string& name) {
  return name == kReportName || name == kPageName || IsPictureName(name);
}

std::vector<report::PagePicture> WriteFrames(const object::Object& object, const plan::Plan& plan,
                                             const render::FrameOptions& options,
                                             const std::filesystem::path& folder,
                                             report::Report& report) {
  std::vector<report::PagePicture> pictures(report.steps.size());
  const std::vector<plan::Snapshot> snapshots = RestsOf(report);
  if (snapshots.empty()) return pictures;
  render::FrameOptions frame = options;
  if (object.dimension() == 2) frame.thickness = RelativeThickness(report);
  render::FrameRenderer renderer(object, report.scale, report.half_angle, snapshots, frame);
  const auto count = static_cast<int>(snapshots.size());
  render::ContactSheet sheet(count, frame.width, frame.height);
  for (report::ReportStep& step : report.steps) {
    if (!step.replay) continue;
    const std::string name = FrameName(step.check.index, step.check.kind);
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
