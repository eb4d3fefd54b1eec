#include "report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "planner/base/json.h"
#include "planner/base/number.h"
#include "report/markup.h"
#include "sim/validation/validation.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::report {
namespace report_test {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

ReportStep MakeStep(int index, const std::string& kind, double required_deg) {
  ReportStep step;
  step.check.index = plan::EntryIndex(index);
  step.check.kind = kind;
  step.check.force_closure = true;
  step.check.required = grasp::RequiredFrictionAngle{Radians(required_deg), Radians(required_deg)};
  step.replay = sim::StepReplay();
  step.replay->index = step.check.index;
  step.replay->displacement_m = 1e-6 * (index + 1);
  step.frame = "frame" + std::to_string(index) + ".png";
  return step;
}

Report MakeReport() {
  Report report;
  report.object_file = "cube.obj";
  report.plan_file = "plan.json";
  report.friction_angle = Radians(20);
  report.settings = sim::ReplaySettings();
  report.steps = {MakeStep(0, "hold", 12), MakeStep(1, "switch", 17.5), MakeStep(2, "align", 15)};
  report.steps[2].replay->align_mode = sim::AlignMode::kImitated;
  report.steps[2].check.undecided = 3;
  return report;
}

/// Return a report whose step 1 fails in the replay, so that step 2 is skipped.
Report MakeFailedReport() {
  Report report = MakeReport();
  report.steps[1].replay->reason = plan::Reason::kSlipped;
  report.steps[1].replay->detail = "finger 2 slid by 1 mm <under> \"shake\" & push";
  report.steps[2].replay.reset();
  report.steps[2].frame.clear();
  report.steps[2].skipped = true;
  return report;
}

TEST(ReportTest, JsonHasTheFieldsOfTheFormat) {
  const Json json = ParseJson(FormatReportJson(MakeReport()), "report");
  EXPECT_EQ(json["format"], "regrasp-report");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["verdict"], "pass");
  EXPECT_EQ(json["object"]["file"], "cube.obj");
  EXPECT_EQ(json["weakest_step"], 1);
  ASSERT_EQ(json["steps"].size(), 3U);
  const Json& step = json["steps"][2];
  EXPECT_EQ(step["index"], 2);
  EXPECT_EQ(step["kind"], "align");
  EXPECT_EQ(step["verdict"], "pass");
  EXPECT_TRUE(step["reason"].is_null());
  EXPECT_EQ(step["force_closure"]["holds"], true);
  EXPECT_NEAR(step["force_closure"]["required_half_angle_deg"].get<double>(), 15, 1e-12);
  EXPECT_EQ(step["simulation"]["displacement_m"], 3e-6);
  EXPECT_EQ(step["simulation"]["contact_lost"], false);
  EXPECT_EQ(step["align_mode"], "imitated");
  EXPECT_EQ(step["undecided"], 3);
  EXPECT_EQ(step["frame"], "frame2.png");
  EXPECT_TRUE(json["steps"][1]["align_mode"].is_null());
}

TEST(ReportTest, JsonOfAFailureNamesTheReasonAndSkipsTheRest) {
  const Json json = ParseJson(FormatReportJson(MakeFailedReport()), "report");
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["steps"][0]["verdict"], "pass");
  EXPECT_EQ(json["steps"][1]["verdict"], "fail");
  EXPECT_EQ(json["steps"][1]["reason"], "slipped");
  EXPECT_EQ(json["steps"][2]["verdict"], "skipped");
  EXPECT_TRUE(json["steps"][2]["reason"].is_null());
  EXPECT_TRUE(json["steps"][2]["simulation"].is_null());
  EXPECT_TRUE(json["steps"][2]["frame"].is_null());
}

TEST(ReportTest, ContactRegionsAreInTheJsonTheTableAndTheWarningsWhereThereAreAny) {
  Report report = MakeReport();
  EXPECT_THAT(FormatReportJson(report), Not(HasSubstr("region")));
  EXPECT_THAT(FormatReportTable(report), Not(HasSubstr("region")));
  report.steps[1].region = plan::SwitchRegion{0.125, std::nullopt, true};
  Json json = ParseJson(FormatReportJson(report), "report");
  EXPECT_EQ(json["steps"][1]["region"]["half_width"], 0.125);
  EXPECT_TRUE(json["steps"][1]["region"]["claimed"].is_null());
  EXPECT_EQ(json["steps"][1]["region"]["holds"], true);
  EXPECT_FALSE(json["steps"][2].contains("region"));
  EXPECT_THAT(FormatReportTable(report), HasSubstr("0.12"));
  EXPECT_TRUE(Warnings(report).empty());
  report.steps[1].region = plan::SwitchRegion{0.125, 0.25, false};
  json = ParseJson(FormatReportJson(report), "report");
  EXPECT_EQ(json["steps"][1]["region"]["claimed"], 0.25);
  EXPECT_EQ(json["steps"][1]["region"]["holds"], false);
  EXPECT_EQ(json["verdict"], "pass");
  ASSERT_EQ(Warnings(report).size(), 1u);
  EXPECT_EQ(Warnings(report)[0],
            "step 1: contact region: expected 0.25 as in the plan, found 0.125");
}

TEST(ReportTest, JsonSurvivesFileNamesThatAreNotUtf8) {
  Report report = MakeReport();
  report.plan_file = "caf\xe9.json";
  const Json json = ParseJson(FormatReportJson(report), "report");
  EXPECT_THAT(json["plan"]["file"].get<std::string>(), HasSubstr("caf"));
}

TEST(ReportTest, JunitTellsHowLongTheSuiteAndItsCasesTook) {
  JunitSuite suite = MakeJunitSuite(MakeFailedReport(), "out");
  ASSERT_EQ(suite.cases.size(), 3u);
  suite.seconds = 2.5;
  SetCaseTimes({0.25, 1.0004}, suite);
  const std::string xml = FormatJunit({suite});
  EXPECT_THAT(xml, HasSubstr("skipped=\"1\" time=\"2.500\">"));
  EXPECT_THAT(xml, HasSubstr("name=\"step 0 hold\" time=\"0.250\""));
  EXPECT_THAT(xml, HasSubstr("name=\"step 1 switch\" time=\"1.000\""));
  EXPECT_THAT(xml, HasSubstr("name=\"step 2 align\" time=\"0.000\""));
}

TEST(ReportTest, JunitHasTheTotalsOfAllSuites) {
  JunitSuite failed = MakeJunitSuite(MakeFailedReport(), "out");
  JunitSuite passed = MakeJunitSuite(MakeReport(), "out");
  passed.name = "other.json";
  failed.seconds = 2.5;
  passed.seconds = 1.25;
  const std::string xml = FormatJunit({failed, passed});
  EXPECT_THAT(xml, HasSubstr("<testsuites tests=\"6\" failures=\"1\" errors=\"0\" skipped=\"1\" "
                             "time=\"3.750\">"));
  EXPECT_THAT(xml, HasSubstr("classname=\"other.json\" file=\"other.json\" name=\"step 0 hold\""));
}

TEST(ReportTest, JunitHasACaseForEachStepAndEscapesText) {
  const std::string xml = FormatJunit({MakeJunitSuite(MakeFailedReport(), "out")});
  EXPECT_THAT(xml, HasSubstr("tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"slipped\">finger 2 slid by 1 mm &lt;under&gt; "
                             "&quot;shake&quot; &amp; push\nwhy: "));
  EXPECT_THAT(xml, HasSubstr("\npicture: out/frame1.png</failure>"
                             "<system-out>[[ATTACHMENT|out/frame1.png]]</system-out></testcase>"));
  EXPECT_THAT(xml, HasSubstr("name=\"step 2 align\" time=\"0.000\"><skipped></skipped>"));
  EXPECT_THAT(FormatJunit({MakeJunitSuite(MakeReport(), "out")}),
              AllOf(Not(HasSubstr("<failure")), Not(HasSubstr("ATTACHMENT"))));
}

TEST(ReportTest, TheTableNamesEveryStepTheWeakestAndTheVerdict) {
  const std::string table = FormatReportTable(MakeReport());
  EXPECT_THAT(table, HasSubstr("hold"));
  EXPECT_THAT(table, HasSubstr("17.5"));
  EXPECT_THAT(table, HasSubstr("weakest: step 1 (switch)"));
  EXPECT_THAT(table, HasSubstr("undecided: 3"));
  EXPECT_THAT(table, HasSubstr("verdict: pass"));
  EXPECT_THAT(table, HasSubstr("displacement_mm"));
  EXPECT_THAT(table, HasSubstr(" 0.002 "));
  EXPECT_THAT(table, HasSubstr(" <0.001 ")) << "below a micrometre";
  EXPECT_THAT(table, Not(testing::ContainsRegex("[0-9]e-")));
  const std::string failed = FormatReportTable(MakeFailedReport());
  EXPECT_THAT(failed, HasSubstr("fail: slipped"));
  EXPECT_THAT(failed, StartsWith("step 1 (switch) fails: slipped: finger 2 slid by 1 mm"));
  EXPECT_THAT(failed, Not(HasSubstr("weakest")));
  EXPECT_THAT(failed, HasSubstr("skipped"));
  EXPECT_THAT(failed, EndsWith("verdict: fail, " + failed.substr(0, failed.find('\n') + 1)));
}

TEST(ReportTest, TheTableSaysHowLargeAndHeavyTheObjectIsAndWhyTheSqueezeIsWhatItIs) {
  Report report = MakeReport();
  report.measures = "10.4 cm across, 216 g";
  report.settings->mass_kg = 0.216;
  report.settings->grasp_force_N = 2119;
  const std::string usual = FormatReportTable(report);
  EXPECT_THAT(usual, HasSubstr("object: 10.4 cm across, 216 g\n"));
  EXPECT_THAT(usual, HasSubstr("grasp force: 2119 N, 1000 × weight; see --grasp"));
  EXPECT_THAT(usual, HasSubstr("--grasp-force realistic"));
  report.settings->grasp_force_source = sim::GraspForceSource::kHand;
  EXPECT_THAT(FormatReportTable(report), Not(HasSubstr("--grasp-force realistic")));
}

Report Validated(const sim::CubeCase& cube, const plan::Plan& plan,
                 const validation::ValidationOptions& options) {
  return validation::Validate({.object = cube.object, .plan = plan, .options = options}).report;
}

TEST(ReportTest, TheReportOfAPlanNamesWhatItsExaminationsDisagreeAbout) {
  const sim::CubeCase cube;
  plan::Plan plan = sim::MakePlan(cube.Start(), 25);
  plan.goal = plan::ContactsOf(plan.initial);
  validation::ValidationOptions options;
  options.replay.protocol = sim::Protocol::kBoth;
  const Report agreed = Validated(cube, plan, options);
  EXPECT_TRUE(agreed.passed());
  EXPECT_FALSE(agreed.steps.at(0).disagreement);

  options.replay.disturbance_ratio = 0.1;
  const Report fixed = Validated(cube, plan, options);
  EXPECT_TRUE(fixed.passed()) << "the adapted response decides";
  ASSERT_TRUE(fixed.steps.at(0).disagreement);
  EXPECT_EQ(fixed.steps[0].disagreement->between, sim::Between::kFixedFails);
  EXPECT_EQ(fixed.steps[0].disagreement->cause, sim::Cause::kConeReached);
  EXPECT_THAT(FormatReportTable(fixed), HasSubstr("a fixed grasp force fails, likely cause: "));

  options.replay.disturbance_ratio = 0.01;
  options.friction_angle = Radians(5.6);
  const Report weak = Validated(cube, plan, options);
  EXPECT_FALSE(weak.passed());
  ASSERT_TRUE(weak.steps.at(0).disagreement);
  EXPECT_EQ(weak.steps[0].disagreement->between, sim::Between::kReplayFails);
  EXPECT_EQ(weak.steps[0].disagreement->cause, sim::Cause::kQuality);
  EXPECT_THAT(FormatReportJson(weak), HasSubstr("\"quality-below-shake\""));
}

TEST(ReportTest, TheReportOfAPlanNamesEveryStepOnWhichTwoEnginesDiffer) {
  const sim::CubeCase cube;
  plan::Plan plan = sim::MakePlan(cube.Start(), 25);
  plan.goal = plan::ContactsOf(plan.initial);
  validation::ValidationOptions options;
  EXPECT_THAT(FormatReportTable(Validated(cube, plan, options)), Not(HasSubstr("engines")));
  options.replay.engine = sim::EngineChoice::kBoth;
  Report report = Validated(cube, plan, options);
  EXPECT_TRUE(report.passed());
  EXPECT_FALSE(report.steps.at(0).engines);
  EXPECT_THAT(FormatReportTable(report), HasSubstr("engines: MuJoCo and ODE agree on 1 step\n"));

  report.steps[0].replay->ode->reason = plan::Reason::kSlipped;
  report.steps[0].replay->ode->detail = "finger 2 slipped";
  report.steps[0].engines =
      sim::Disagreement{sim::Between::kOdeFails, sim::Cause::kQuality, "a weak grasp"};
  EXPECT_TRUE(report.passed()) << "MuJoCo decides";
  const std::string table = FormatReportTable(report);
  EXPECT_THAT(table, HasSubstr("step 0: MuJoCo passes, ODE fails (finger 2 slipped); likely cause: "
                               "a weak grasp\n"));
  EXPECT_THAT(table, HasSubstr("engines: MuJoCo and ODE agree on 0 steps\n"));
  EXPECT_THAT(FormatReportJson(report), HasSubstr("\"ode-fails\""));
}

TEST(VerdictText, OfAFailedStepSaysWhy) {
  ReportStep step;
  EXPECT_EQ(VerdictText(step), "pass");
  step.replay.emplace().reason = plan::Reason::kSlipped;
  EXPECT_EQ(VerdictText(step), "fail: slipped");
  step.skipped = true;
  EXPECT_EQ(VerdictText(step), "skipped");
}

/// Return a report whose steps all pass, with 20 trials of which some pass.
Report MakeTrialsReport(int passed, double min_pass_rate) {
  Report report = MakeReport();
  sim::TrialSummary& trials = report.trials.emplace();
  trials.options.count = 20;
  trials.options.min_pass_rate = min_pass_rate;
  trials.passed = passed;
  if (passed < 20) {
    trials.reasons = {{plan::Reason::kSlipped, 20 - passed}};
    trials.steps = {{plan::EntryIndex(1), 20 - passed}};
  }
  return report;
}

TEST(ReportTest, NoVerdictOnTrialsIsAPlainPass) {
  int checked = 0;
  for (int passed = 0; passed <= 20; ++passed) {
    for (const double rate : {0.05, 0.5, 0.7, 1.0}) {
      const Report report = MakeTrialsReport(passed, rate);
      const bool enough = passed >= std::round(20 * rate);
      EXPECT_EQ(report.passed(), enough) << passed << " " << rate;
      const Json json = Json::parse(FormatReportJson(report));
      EXPECT_EQ(json["verdict"], enough ? "pass" : "fail");
      EXPECT_EQ(json["trials"]["verdict"], json["verdict"]);
      EXPECT_EQ(json["trials"]["min_pass_rate"], rate);
      EXPECT_EQ(json["trials"].contains("why"), !enough);
      const std::string table = FormatReportTable(report);
      const std::string numbers = std::to_string(passed) + " of 20 trials";
      const std::string failed = std::to_string(20 - passed) + " of 20 trials with noise fail: ";
      EXPECT_THAT(table, Not(HasSubstr("verdict: pass\n")));
      EXPECT_THAT(
          table, EndsWith(enough ? "verdict: pass in " + numbers + "\n"
                                 : "verdict: fail, trials-failed: " + failed +
                                       std::to_string(20 - passed) + " slipped; first in step 1: " +
                                       std::to_string(20 - passed) + "\n"));
      if (!enough) {
        EXPECT_THAT(table, StartsWith("trials-failed: " + failed));
      }
      const JunitSuite suite = MakeJunitSuite(report, "out");
      ASSERT_EQ(suite.cases.size(), 4u);
      EXPECT_EQ(suite.cases.back().outcome == JunitOutcome::kFailed, !enough);
      EXPECT_EQ(suite.cases.back().message, enough ? "" : "trials-failed");
      ++checked;
    }
  }
  EXPECT_EQ(checked, 84);
}

}  // namespace report_test
}  // namespace regrasp::report
