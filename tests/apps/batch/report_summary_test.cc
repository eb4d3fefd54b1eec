#include "apps/batch/report_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"

namespace regrasp::apps {
namespace report_summary_test {

using testing::HasSubstr;

Json FailedReport() {
  return Json::parse(R"({"format": "regrasp-report", "version": 1, "verdict": "fail",
    "weakest_step": 1, "run": {"sha256": "abc"}, "plan": {"planner": "roadmap"},
    "object": {"file": "cube.obj", "measures": "10.4 cm across, 216 g"},
    "settings": {"friction_half_angle_deg": 20},
    "steps": [
      {"kind": "hold", "verdict": "pass", "reason": null, "detail": null, "frame": "000_hold.png",
       "force_closure": {"holds": true, "required_half_angle_deg": 12.5}},
      {"kind": "switch", "verdict": "fail", "reason": "slipped", "detail": "finger 2 slipped",
       "why": "nothing may slip", "mend": "more friction", "frame": null, "force_closure": {"holds": true, "required_half_angle_deg": 17.5}},
      {"kind": "align", "verdict": "skipped", "reason": null, "force_closure": null}]})");
}

TEST(ReportSummaryTest, TellsWhatTheReportSays) {
  const ReportSummary summary = SummarizeReport(FailedReport(), "report.json");
  EXPECT_FALSE(summary.passed);
  EXPECT_EQ(summary.run, "abc");
  ASSERT_EQ(summary.entries.size(), 3u);
  EXPECT_EQ(summary.entries[0].frame, "000_hold.png");
  EXPECT_EQ(summary.entries[1].reason, "slipped");
  EXPECT_EQ(summary.entries[1].detail, "finger 2 slipped");
  EXPECT_EQ(summary.entries[1].why, "nothing may slip");
  EXPECT_EQ(summary.entries[1].suggested_fix, "more friction");
  EXPECT_EQ(summary.entries[0].suggested_fix, "");
  EXPECT_EQ(summary.entries[2].verdict, "skipped");
  EXPECT_EQ(summary.failed_step(), 1);
  EXPECT_EQ(summary.object, "cube.obj");
  EXPECT_EQ(summary.size, "10.4 cm across, 216 g");
  EXPECT_EQ(summary.planner, "roadmap");
  EXPECT_EQ(summary.friction_angle_deg, 20);
  EXPECT_EQ(summary.weakest_step, 1);
  EXPECT_EQ(summary.required_friction_angle_deg, 17.5);
}

TEST(ReportSummaryTest, WhatAReportLeavesOutIsLeftOut) {
  Json json = FailedReport();
  json.erase("run");
  json.erase("object");
  json.erase("settings");
  json["plan"] = nullptr;
  json["weakest_step"] = nullptr;
  const ReportSummary summary = SummarizeReport(json, "report.json");
  EXPECT_EQ(summary.run, "");
  EXPECT_EQ(summary.object + summary.size + summary.planner, "");
  EXPECT_FALSE(summary.friction_angle_deg);
  EXPECT_FALSE(summary.weakest_step);
  EXPECT_FALSE(summary.required_friction_angle_deg);
}

TEST(ReportSummaryTest, WhatIsNoReportIsRefusedWithItsPlace) {
  const auto refusal = [](const Json& json) {
    try {
      (void)SummarizeReport(json, "report.json");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  const std::vector<std::pair<const char*, Json>> changes = {
      {"/format", "regrasp-plan"},
      {"/version", 2},
      {"/verdict", "skipped"},
      {"/run", 3},
      {"/run/sha256", 3},
      {"/object/measures", 3},
      {"/plan/planner", 3},
      {"/settings/friction_half_angle_deg", "20"},
      {"/steps", Json::array()},
      {"/steps", nullptr},
      {"/weakest_step", 3},
      {"/weakest_step", "1"},
      {"/steps/0/kind", "jump"},
      {"/steps/1/reason", 4},
      {"/steps/2/verdict", nullptr},
      {"/steps/1/force_closure", 1},
  };
  for (const auto& [place, value] : changes) {
    Json json = FailedReport();
    json[Json::json_pointer(place)] = value;
    const std::string said = refusal(json);
    EXPECT_THAT(said, HasSubstr("report.json: ")) << place;
    EXPECT_THAT(said, HasSubstr(place)) << place;
  }
  EXPECT_THAT(refusal(Json::array()), HasSubstr("report.json: "));
  EXPECT_EQ(refusal(FailedReport()), "nothing was refused");
}

}  // namespace report_summary_test
}  // namespace regrasp::apps
