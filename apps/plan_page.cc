#include "apps/plan_page.h"

#include <optional>

#include "apps/output_files.h"
#include "planner/base/error.h"
#include "render/viewer/viewer_scene.h"
#include "report/page/report_page.h"
#include "report/pictures/hand_picture.h"
#include "report/pictures/replay_viewer.h"
#include "report/report.h"

namespace regrasp::apps {

PlanOutputs SortPlanOutputs(const std::vector<std::string>& outputs) {
  PlanOutputs sorted;
  for (const std::string& file : outputs) {
    const bool is_page = IsHtmlFile(file);
    std::string& place = is_page ? sorted.page : sorted.plan;
    if (!place.empty()) {
      throw InputError("--output: expected one " + std::string(is_page ? "HTML" : "plan") +
                       " file, found " + place + " and " + file);
    }
    place = file;
  }
  return sorted;
}

std::string FormatPlanPage(const object::ObjectFile& object, const plan::Plan& plan,
                           const plan::PlanCheck& check, const kinematics::HandFile* hand,
                           const std::string& name) {
  report::Report report;
  report.object_file = object.file;
  report.plan_file = name;
  report.planner = plan.planner;
  report.scale = plan.scale;
  report.dimension = plan.dimension;
  report.friction_angle = plan.friction_angle;
  report.torsion = plan.torsion;
  report.finger_radius = plan.finger_radius;
  for (const plan::StepCheck& step : check.steps) {
    report::ReportStep& entry = report.steps.emplace_back();
    entry.check = step;
    entry.skipped = step.skipped;
  }
  std::optional<report::HandPicture> picture;
  if (hand != nullptr) {
    picture.emplace(*hand, plan, plan.scale * object.object->mass_properties().centroid);
  }
  const render::ViewerScene scene = report::MakeViewerScene(
      *object.object, plan, {.frame = {}, .hand = picture ? &*picture : nullptr}, {}, report);
  return report::FormatPlanHtml(report, render::FormatViewerScene(scene));
}

}  // namespace regrasp::apps
