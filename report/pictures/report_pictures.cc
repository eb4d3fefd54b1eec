#include "report/pictures/report_pictures.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/plan/projection.h"
#include "render/frames/fault_marks.h"
#include "render/frames/overview_image.h"
#include "render/frames/replay_animation.h"
#include "render/picture/caption.h"
#include "report/failure.h"

namespace regrasp::report {

namespace {

/// Suffix of the caption of a frame whose camera differs from that of the rest.
constexpr char kOwnView[] = " (seen from another side)";

constexpr render::Color kGood = {29, 107, 60};
constexpr render::Color kBad = {179, 38, 30};
constexpr render::Color kSkipped = {112, 120, 134};

/// Largest number of cells in the overview image for steps after a failure.
constexpr int kMostSkipped = 24;

bool Failed(const ReportStep& step) { return step.verdict() == Verdict::kFail; }

std::string Caption(const plan::Plan& plan, const ReportStep& step) {
  const std::string caption = render::FrameCaption(plan, step.check.index);
  return Failed(step) ? caption + " — " + std::string(plan::ReasonName(step.reason())) : caption;
}

render::OverviewLabel MakeLabel(const ReportStep& step) {
  const bool failed = Failed(step);
  const std::string verdict(failed ? plan::ReasonName(step.reason()) : VerdictName(step.verdict()));
  return {std::to_string(step.check.index) + "  " + step.check.kind, verdict,
          failed         ? kBad
          : step.skipped ? kSkipped
                         : kGood,
          failed};
}

/// Make a line with the verdict.
render::OverviewLabel MakeHeading(const Report& report) {
  return {HeadingText(report), "", report.passed() ? kGood : kBad};
}

/// Return the replayed state at the failure, or the planned state if the replay did not reach it.
ShownEntry ShowFailure(const object::Object& object, const plan::Plan& plan, const ReportStep& step,
                       const Report& report, const HandPicture* hand,
                       const plan::HandState* actual) {
  const plan::Reason reason = step.reason();
  const bool seen = step.replay && !step.replay->snapshot.fingers.empty() &&
                    reason != plan::Reason::kUnreachable &&
                    reason != plan::Reason::kSimulationUnstable;
  const double radius = report.settings ? report.settings->fingertip_radius_m : 0;
  plan::Fault fault = step.fault();
  plan::Snapshot snapshot = seen ? step.replay->snapshot
                                 : plan::MakePlannedSnapshot(plan::ProjectPlan(object, plan),
                                                             step.check.index, fault, radius);
  if (hand != nullptr) hand->Place(step.check.index, snapshot, fault, actual);
  render::FaultScene picture =
      render::MakeFaultScene(object, report.scale, reason, fault, snapshot, step.detail());
  return {&step, std::move(picture.snapshot), std::move(picture.marks)};
}

ShownEntry ShowSound(const ReportStep& step, const HandPicture* hand) {
  ShownEntry shown{&step, step.replay->snapshot};
  plan::Fault none;
  if (hand != nullptr) hand->Place(step.check.index, shown.snapshot, none);
  return shown;
}

/// Return the states of a hand during each entry; none for a failed entry.
std::vector<std::vector<plan::Snapshot>> ShowMotions(const HandPicture& hand,
                                                     const Report& report) {
  std::vector<std::vector<plan::Snapshot>> motions;
  for (std::size_t i = 0; i < report.steps.size(); ++i) {
    const ReportStep& step = report.steps[i];
    if (step.skipped) break;
    motions.emplace_back();
    if (i == 0 || Failed(step)) continue;
    motions.back() =
        hand.Between(step.check.index, report.steps[i - 1].replay->snapshot, step.replay->snapshot);
  }
  return motions;
}

/// Add grey cells for the steps after a failure. The last cell represents all further steps.
void AddSkipped(const Report& report, int cells, render::OverviewImage& sheet) {
  const auto first = std::ranges::find_if(report.steps, &ReportStep::skipped);
  const auto skipped = static_cast<int>(report.steps.end() - first);
  for (int i = 0; i < cells; ++i) {
    const bool more = i + 1 == cells && skipped > cells;
    sheet.AddEmpty(
        MakeLabel(first[i]),
        more ? "not replayed, and " + std::to_string(skipped - cells) + " more" : "not replayed");
  }
}

/// Make the renderer of the frames and the animation of a report, which share a camera.
render::FrameRenderer MakeRenderer(const object::Object& object, const Report& report,
                                   const std::vector<ShownEntry>& shown,
                                   render::FrameOptions options) {
  std::vector<plan::Snapshot> snapshots;
  for (const ShownEntry& entry : shown) {
    snapshots.push_back(entry.snapshot);
    if (!entry.marks) continue;
    options.also_seen = render::ExtentOf(*entry.marks, report.scale * object.diameter());
  }
  if (object.dimension() == 2 && report.settings) {
    options.body.thickness = report.settings->thickness_m / report.settings->diameter_m;
  }
  options.finger_radius = report.finger_radius;
  options.has_heading = !report.steps_passed();
  return {object, report.scale, report.friction_angle, snapshots, options};
}

}  // namespace

std::vector<ShownEntry> ShowEntries(const object::Object& object, const plan::Plan& plan,
                                    const HandPicture* hand, const Report& report,
                                    const plan::HandState* actual) {
  std::vector<ShownEntry> shown;
  for (const ReportStep& step : report.steps) {
    if (step.skipped) continue;
    shown.push_back(Failed(step) ? ShowFailure(object, plan, step, report, hand, actual)
                                 : ShowSound(step, hand));
  }
  return shown;
}

int CountFrames(const Report& report) {
  return static_cast<int>(std::ranges::count(report.steps, false, &ReportStep::skipped));
}

render::Image DrawFrames(const object::Object& object, const plan::Plan& plan,
                         const DrawingOptions& options, const Report& report,
                         const std::function<void(const DrawnFrame&)>& take) {
  const std::vector<ShownEntry> shown = ShowEntries(object, plan, options.hand, report);
  const auto count = static_cast<int>(shown.size());
  const int skipped = std::min(static_cast<int>(report.steps.size()) - count, kMostSkipped);
  render::FrameOptions frame = options.frame;
  if (options.hand != nullptr) frame.hand = options.hand->view();
  const render::FrameRenderer renderer = MakeRenderer(object, report, shown, frame);
  render::OverviewImage sheet(count + skipped, renderer.width(), renderer.height(),
                              options.sheet_width, MakeHeading(report),
                              render::GroundOf(options.frame.background));
  std::vector<render::FrameTask> tasks;
  for (const auto& [step, snapshot, marks] : shown) {
    const int view = static_cast<int>(tasks.size());
    const char* note = renderer.HasOwnView(view) ? kOwnView : "";
    tasks.push_back({&snapshot, Caption(plan, *step) + note, marks ? &*marks : nullptr, view});
  }
  const auto draw = [&](int index, const render::Image& image) {
    const ReportStep& step = *shown[index].step;
    take({step.check.index, image, renderer.HasOwnView(index)});
    sheet.Add(image, MakeLabel(step));
    options.on_picture(index + 1, count);
  };
  render::RenderInOrder(renderer, tasks, options.workers, draw);
  AddSkipped(report, skipped, sheet);
  return sheet.ToImage();
}

MovingPictures DrawAnimation(const object::Object& object, const plan::Plan& plan,
                             const DrawingOptions& options,
                             const std::vector<plan::Snapshot>& samples,
                             const std::vector<render::AnimationFormat>& formats,
                             const Report& report) {
  const std::vector<ShownEntry> shown = ShowEntries(object, plan, options.hand, report);
  std::vector<std::vector<plan::Snapshot>> motions;
  if (options.hand != nullptr) motions = ShowMotions(*options.hand, report);
  std::vector<render::AnimationPause> rests;
  for (const auto& [step, snapshot, marks] : shown) {
    rests.push_back(
        {snapshot, render::FrameCaption(plan, step->check.index), Caption(plan, *step), marks});
  }
  const std::vector<render::AnimationFrame> pictures =
      options.hand != nullptr
          ? render::JoinAnimation(motions, rests)
          : render::CutAnimation(samples, rests, report.scale * object.diameter());
  render::FrameOptions frame = options.frame;
  if (options.hand != nullptr) frame.hand = options.hand->view();
  for (const auto& motion : motions) {
    for (const plan::Snapshot& snapshot : motion) {
      const std::vector<Eigen::Vector3d> points = options.hand->Reached(snapshot);
      frame.reached.insert(frame.reached.end(), points.begin(), points.end());
    }
  }
  frame.gaps = render::GapView::kShown;
  if (frame.background == render::Background::kTransparent) {
    frame.background = render::Background::kWhite;
  }
  const render::FrameRenderer renderer = MakeRenderer(object, report, shown, frame);
  const auto count = static_cast<int>(pictures.size());
  std::vector<std::string> bytes =
      render::RenderAnimation(renderer, pictures, formats, options.workers,
                              [&](int done) { options.on_picture(done, count); });
  return {std::move(bytes), renderer.width(), renderer.height()};
}

}  // namespace regrasp::report
