#include "report/pictures/report_pictures.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/plan/projection.h"
#include "render/frames/fault_marks.h"
#include "render/frames/overview_image.h"
#include "render/frames/replay_animation.h"
#include "render/picture/caption.h"
#include "report/failure.h"
#include "report/pictures/animation_frames.h"
#include "report/pictures/object_progress.h"
#include "report/pictures/replay_timeline.h"

namespace regrasp::report {

namespace {

/// Suffix of the caption of a frame whose camera differs from that of the rest.
constexpr char kOwnView[] = " (seen from another side)";

constexpr render::Color kGood = {29, 107, 60};
constexpr render::Color kBad = {179, 38, 30};
constexpr render::Color kSkipped = {112, 120, 134};

/// Size of texts in the images of a page, relative to those of a frame: pages show images at a
/// fraction of their size.
constexpr double kPageText = 1.5;

bool Failed(const ReportStep& step) { return step.verdict() == Verdict::kFail; }

/// @param progress  motion of the object up to the end of the entry; may be empty.
render::OverviewLabel MakeLabel(const ReportStep& step, const std::string& progress = "") {
  const bool failed = Failed(step);
  const std::string verdict(failed ? plan::ReasonName(step.reason()) : VerdictName(step.verdict()));
  return {std::to_string(step.check.index) + "  " + step.check.kind +
              (progress.empty() ? "" : " · " + progress),
          verdict,
          failed         ? kBad
          : step.skipped ? kSkipped
                         : kGood,
          failed};
}

/// Return what happens in an entry, without its number and kind, which are in the label above it.
std::string OverviewCaption(const plan::Plan& plan, const ReportStep& step,
                            std::span<const std::string> finger_names) {
  const std::string caption = render::FrameCaption(plan, step.check.index, finger_names);
  const std::size_t colon = caption.find(": ");
  return colon == std::string::npos ? "" : caption.substr(colon + 2);
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

/// @param planned  plan on the object; required for a step that was not replayed.
ShownEntry ShowSound(const ReportStep& step, const HandPicture* hand,
                     const std::optional<plan::Plan>& planned) {
  ShownEntry shown{&step, step.replay ? step.replay->snapshot
                                      : plan::MakePlannedSnapshot(*planned, step.check.index, {},
                                                                  /*fingertip_radius_m=*/0)};
  plan::Fault none;
  if (hand == nullptr) return shown;
  hand->MarkActions(step.check.index, shown.snapshot);
  hand->Place(step.check.index, shown.snapshot, none);
  return shown;
}

/// Return the last recorded state if it belongs to the failed entry; null otherwise.
const plan::HandState* StateAtFailure(const Report& report,
                                      const std::vector<HandSample>& samples) {
  if (samples.empty()) return nullptr;
  const bool fails = std::ranges::any_of(report.steps, [&](const ReportStep& step) {
    return Failed(step) && step.check.index == samples.back().entry;
  });
  return fails ? &samples.back().state : nullptr;
}

/// Add a grey cell for all steps after a failure.
void AddSkipped(const Report& report, render::OverviewImage& sheet) {
  const auto first = std::ranges::find_if(report.steps, &ReportStep::skipped);
  if (first == report.steps.end()) return;
  render::OverviewLabel label = MakeLabel(*first);
  const plan::EntryIndex from = first->check.index, to = report.steps.back().check.index;
  if (to > from) label.title = std::to_string(from) + " to " + std::to_string(to);
  sheet.AddEmpty(label, "not replayed");
}

/// Return the options of frames with the hand and the names of its fingers.
render::FrameOptions WithHand(const DrawingOptions& options) {
  render::FrameOptions frame = options.frame;
  if (options.hand == nullptr) return frame;
  frame.hand = options.hand->view();
  frame.finger_names = options.hand->FingerNames();
  return frame;
}

/// Return the motion of the object up to the end of each entry; empty texts without a hand.
std::vector<std::string> ProgressOf(const HandPicture* hand, const std::vector<ShownEntry>& shown) {
  std::vector<std::string> texts(shown.size());
  if (hand == nullptr) return texts;
  ObjectProgress progress(hand->PlannedPoses());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    for (const plan::HandState& state : hand->StatesAlong(shown[i].step->check.index)) {
      if (!shown[i].marks) progress.Follow(hand->X_WP() * state.pose);
    }
    if (shown[i].marks) progress.Follow(shown[i].snapshot.X_WO);
    texts[i] = progress.Text();
  }
  return texts;
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
    for (const auto& dimension : entry.marks->dimensions) {
      const Eigen::Vector3d along = dimension.to - dimension.from;
      if (along.norm() > 0) options.shown_lengths.push_back(along.normalized());
    }
    for (const auto& normal : entry.marks->normals) {
      options.shown_lengths.push_back(normal.along.normalized());
    }
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
                                    const std::vector<HandSample>& samples) {
  const plan::HandState* actual = StateAtFailure(report, samples);
  const auto is_planned = [](const ReportStep& step) { return !step.replay && !step.skipped; };
  std::optional<plan::Plan> planned;
  if (std::ranges::any_of(report.steps, is_planned)) planned = plan::ProjectPlan(object, plan);
  std::vector<ShownEntry> shown;
  for (const ReportStep& step : report.steps) {
    if (step.skipped) continue;
    shown.push_back(Failed(step) ? ShowFailure(object, plan, step, report, hand, actual)
                                 : ShowSound(step, hand, planned));
  }
  return shown;
}

std::string OverviewNote(const Report& report, const ReportStep& step) {
  if (report.steps.size() < 2 || !report.steps_passed()) return "";
  if (step.check.index != report.weakest_step() || !step.check.required) return "";
  return "smallest friction margin: " +
         FormatDegrees(Degrees(report.friction_angle - step.check.required->upper));
}

std::string EntryCaption(const plan::Plan& plan, const ReportStep& step,
                         std::span<const std::string> finger_names) {
  const std::string caption = render::FrameCaption(plan, step.check.index, finger_names);
  return Failed(step) ? caption + " — " + std::string(plan::ReasonName(step.reason())) : caption;
}

int CountFrames(const Report& report) {
  return static_cast<int>(std::ranges::count(report.steps, false, &ReportStep::skipped));
}

render::Image DrawFrames(const object::Object& object, const plan::Plan& plan,
                         const DrawingOptions& options, const Report& report,
                         const std::function<void(const DrawnFrame&)>& take) {
  const std::vector<ShownEntry> shown = ShowEntries(object, plan, options.hand, report);
  const auto count = static_cast<int>(shown.size());
  const int skipped = count < static_cast<int>(report.steps.size()) ? 1 : 0;
  const render::FrameOptions frame = WithHand(options);
  const render::FrameRenderer renderer = MakeRenderer(object, report, shown, frame);
  const std::vector<std::string> progress = ProgressOf(options.hand, shown);
  render::OverviewImage sheet(count + skipped, renderer.width(), renderer.height(),
                              options.sheet_width, MakeHeading(report),
                              render::GroundOf(options.frame.background));
  std::vector<render::FrameTask> tasks;
  for (const auto& [step, snapshot, marks] : shown) {
    const int view = static_cast<int>(tasks.size());
    const char* note = renderer.HasOwnView(view) ? kOwnView : "";
    tasks.push_back({&snapshot,
                     {EntryCaption(plan, *step, frame.finger_names) + note, progress[tasks.size()]},
                     marks ? &*marks : nullptr,
                     view});
  }
  const double sheet_text = sheet.TextSize();
  const auto draw = [&](render::FrameRenderer& drawer, int index) {
    const render::FrameTask& task = tasks[index];
    const std::string title = OverviewCaption(plan, *shown[index].step, frame.finger_names);
    const char* note = renderer.HasOwnView(index) ? kOwnView : "";
    // The label in the overview has the progress.
    const std::array texts = {
        task.text, render::FrameText{"", task.text.progress, /*is_on_page=*/true, kPageText},
        render::FrameText{title + note, "", /*is_on_page=*/true, sheet_text}};
    return drawer.RenderWithTexts(*task.snapshot, texts, task.fault, task.view);
  };
  const auto pass_on = [&](int index, const std::vector<render::Image>& images) {
    const ReportStep& step = *shown[index].step;
    take({step.check.index, images[0], images[1], renderer.HasOwnView(index)});
    render::OverviewLabel label = MakeLabel(step, progress[index]);
    label.note = OverviewNote(report, step);
    sheet.Add(images[2], label);
    options.on_picture(index + 1, count);
  };
  render::DrawInOrder(renderer, count, options.workers, draw, pass_on);
  AddSkipped(report, sheet);
  return sheet.ToImage();
}

MovingPictures DrawAnimation(const object::Object& object, const plan::Plan& plan,
                             const DrawingOptions& options, const std::vector<HandSample>& samples,
                             const std::vector<render::AnimationFormat>& formats,
                             const Report& report) {
  const std::vector<ShownEntry> shown = ShowEntries(object, plan, options.hand, report, samples);
  const std::vector<FingerIndex> fingers = FingersOf(shown);
  const ReplayTimeline timeline =
      MakeTimeline(object, report, shown, fingers, options.hand, samples);
  const AnimationFrames moving = MakeAnimationFrames(plan, shown, timeline, fingers, options.hand,
                                                     report.scale * object.diameter());
  render::FrameOptions frame = WithHand(options);
  frame.animated = true;
  if (frame.background == render::Background::kTransparent) {
    frame.background = render::Background::kWhite;
  }
  for (const plan::Snapshot& snapshot : moving.snapshots) {
    if (!snapshot.links_W.empty()) frame.links_W.push_back(snapshot.links_W);
    for (const plan::FingerState& finger : snapshot.fingers) {
      if (finger.role == plan::FingerRole::kFree) frame.reached.push_back(finger.contact_W);
    }
  }
  const render::FrameRenderer renderer = MakeRenderer(object, report, shown, frame);
  const auto count = static_cast<int>(moving.frames.size());
  std::vector<std::string> bytes =
      render::RenderAnimation(renderer, moving.frames, formats, options.workers,
                              [&](int done) { options.on_picture(done, count); });
  return {std::move(bytes), renderer.width(), renderer.height()};
}

}  // namespace regrasp::report
