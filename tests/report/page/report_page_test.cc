#include "report/page/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/base/number.h"
#include "report/page/step_table.h"

namespace regrasp::report {
namespace report_page_test {

using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;
using testing::Optional;

plan::FingerContact MakeContact(int finger) {
  return {FingerIndex(finger), {{0.01 * finger, 0, 0}, {0, 0, 1}}};
}

/// Initial grasp and two steps, the last of which fails in the replay if requested.
struct Scene {
  plan::Plan plan;
  Report report;

  explicit Scene(bool fails) {
    plan.friction_angle = Radians(20);
    for (int finger = 0; finger < 4; ++finger) plan.initial.push_back(MakeContact(finger));
    plan.steps = {plan::Switch{{MakeContact(4)}, {FingerIndex(0)}},
                  plan::Switch{{MakeContact(0)}, {FingerIndex(1)}}};
    report.object_file = "cube.obj";
    report.plan_file = "plan.json";
    report.planner = "roadmap";
    report.friction_angle = plan.friction_angle;
    report.settings.emplace();
    report.settings->diameter_m = 0.06;
    report.settings->tolerance = 1e-3;
    report.settings->disturbance_ratio = 0.01;
    for (int index = 0; index < 3; ++index) AddStep(index);
    if (fails) {
      report.steps[1].replay->reason = plan::Reason::kSlipped;
      report.steps[1].replay->detail = "finger 2 slips 3 mm";
      report.steps[2].replay.reset();
      report.steps[2].skipped = true;
    }
  }

  void AddStep(int index) {
    ReportStep& step = report.steps.emplace_back();
    step.check.index = plan::EntryIndex(index);
    step.check.kind = index == 0 ? "hold" : "switch";
    step.check.force_closure = true;
    step.check.required = grasp::RequiredFrictionAngle{Radians(12.4), Radians(12.5)};
    step.replay.emplace();
    step.replay->index = step.check.index;
    step.replay->displacement_m = 4.14e-6;
    step.replay->rotation_deg = Degrees(1e-4);
    step.replay->moved_m = 6e-6;
    step.replay->slip_m = 2e-9;
  }
};

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ReportPageTest, APlanThatPassesSaysSoAndHasALineForEachStep) {
  const Scene scene(/*fails=*/false);
  const std::string page = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_THAT(page, HasSubstr("<strong>Pass</strong>"));
  EXPECT_EQ(Count(page, "<tr class=\"pass\">"), 3);
  EXPECT_THAT(page, HasSubstr("Switch: place 4, release 0"));
  EXPECT_THAT(page, HasSubstr("12.50°"));
  EXPECT_THAT(page, HasSubstr("7.50°"));
  EXPECT_THAT(page, HasSubstr("4.14\u00a0µm"));
  EXPECT_THAT(page, HasSubstr("&lt;\u00a01\u00a0µm"));
  EXPECT_EQ(Count(page, "<svg"), 2);
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_EQ(page, FormatReportHtml(scene.report, scene.plan, {}));
}

TEST(ReportPageTest, AReportOfABatchLinksToItsRowAndToItsNeighbours) {
  const Scene scene(/*fails=*/false);
  const std::string page =
      FormatReportHtml(scene.report, scene.plan, {}, {}, "", {}, {"../index.html", "a%22b"});
  EXPECT_THAT(page, HasSubstr("<a href=\"../index.html#plan=a%22b\">All plans</a>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"../index.html#before=a%22b\">Previous</a>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"../index.html#after=a%22b\">Next</a>"));
  EXPECT_THAT(FormatReportHtml(scene.report, scene.plan, {}), Not(HasSubstr("<nav")));
}

TEST(ReportPageTest, APlanThatFailsSaysWhereAndWhy) {
  const Scene scene(/*fails=*/true);
  const std::string page = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_THAT(page, HasSubstr("<strong>Fail</strong>"));
  EXPECT_THAT(page, Not(HasSubstr("<strong>Pass</strong>")));
  EXPECT_THAT(page, HasSubstr("Finger 2 slips 3 mm."));
  EXPECT_EQ(Count(page, "<tr class=\"fail\">"), 1);
  EXPECT_EQ(Count(page, "<tr class=\"skipped\">"), 1);
  EXPECT_THAT(page, HasSubstr("fail: slipped"));
}

TEST(ReportPageTest, APlanThatFailsTheAnalysisHasNoPlotOfWhatWasNotReplayed) {
  Scene scene(/*fails=*/true);
  for (ReportStep& step : scene.report.steps) step.replay.reset();
  scene.report.settings.reset();
  scene.report.steps[0].check.reason = plan::Reason::kNotForceClosure;
  scene.report.steps[0].check.required.reset();
  scene.report.steps[1].skipped = true;
  for (int index : {1, 2}) scene.report.steps[index].check.skipped = true;
  const std::string page = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_EQ(Count(page, "<svg"), 0);
  EXPECT_THAT(page, HasSubstr("At the hold: not-force-closure"));
  EXPECT_THAT(page, HasSubstr("<td class=\"number\" data-name=\"Required friction\">none</td>"));
}

TEST(ReportPageTest, NothingFromOutsideCanBecomeMarkup) {
  Scene scene(/*fails=*/true);
  const std::string evil = "</title><script>alert('&\"')</script>.json\xFF";
  scene.report.plan_file = scene.report.object_file = scene.report.planner = evil;
  scene.report.object_sha256 = scene.report.plan_sha256 = evil;
  scene.report.steps[1].replay->detail = evil;
  const std::string page = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_EQ(Count(page, "<script"), 0);
  EXPECT_EQ(Count(page, "</title>"), 3);  // page and two plots
  EXPECT_GE(Count(page, "&lt;script&gt;"), 6);
}

TEST(ReportPageTest, ASingleGraspHasALineForEachFingerAndNoPlots) {
  Scene scene(/*fails=*/false);
  scene.plan.steps.clear();
  scene.report.steps.resize(1);
  scene.report.grasp = GraspReport{
      {0.1234, 0.1235}, {{Radians(3), true, std::nullopt}, {Radians(11), true, Radians(30)}}};
  const std::string page = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_THAT(page, HasSubstr("Validation of a grasp"));
  EXPECT_THAT(page, HasSubstr("<dd>finger 1</dd>"));
  EXPECT_THAT(page, HasSubstr("<dd>0.123</dd>"));
  EXPECT_THAT(page, HasSubstr("9.00°"));
  EXPECT_EQ(Count(page, "<svg"), 0);
  EXPECT_EQ(Count(page, "<table"), 2);
}

TEST(ReportPageTest, PicturesStandInThePage) {
  const Scene scene(/*fails=*/true);
  const std::vector<PagePicture> pictures = {{"abc", 640, 480}, {"defg", 640, 480}, {}};
  const std::string page = FormatReportHtml(scene.report, scene.plan, pictures);
  EXPECT_EQ(Count(page, "<img"), 2);
  EXPECT_THAT(page, HasSubstr("src=\"data:image/webp;base64,YWJj\""));
  EXPECT_THAT(page, HasSubstr("href=\"#frame1\""));
  EXPECT_THAT(page, Not(HasSubstr("href=\"#frame2\"")));
  EXPECT_THAT(page, HasSubstr("id=\"frame1\" class=\"fail\""));
}

TEST(ReportPageTest, TheInteractiveReplayFollowsTheVerdict) {
  for (const bool fails : {false, true}) {
    const Scene scene(fails);
    const std::vector<PagePicture> pictures = {{"abc", 640, 480}, {"defg", 640, 480}, {}};
    const std::string page = FormatReportHtml(scene.report, scene.plan, pictures, {}, "{\"a\":1}");
    EXPECT_EQ(Count(page, "<script>"), 4);
    EXPECT_THAT(page, HasSubstr("<script type=\"application/json\" id=\"viewer-data\">{\"a\":1}"));
    const auto place = [&](const char* part) { return page.find(part); };
    EXPECT_LT(place("class=\"verdict"), place("id=\"viewer\""));
    EXPECT_LT(place("id=\"viewer\""), place("<img"));
    EXPECT_LT(place("<img"), place("<table"));
    EXPECT_LT(place("<table"), place("<svg"));
    EXPECT_LT(place("<svg"), place("<dl"));
    EXPECT_LT(place("<details>"), place("SHA-256"));
    EXPECT_EQ(Count(page, "<img"), 2);  // each image once
    EXPECT_EQ(Count(page, "class=\"still\""), fails ? 0 : 1);
    const std::string only = FormatViewerHtml(scene.report, scene.plan, "{}");
    EXPECT_EQ(Count(only, "<script>"), 4);
    EXPECT_EQ(Count(only, "<table"), 0);
  }
}

TEST(ReportPageTest, TheReplayMovesOnThePageWhereItWasMade) {
  const Scene scene(/*fails=*/false);
  const std::string page = FormatReportHtml(scene.report, scene.plan, {}, {"abc", 320, 240});
  EXPECT_EQ(Count(page, "<div class=\"replay\">"), 1);
  EXPECT_EQ(Count(page, "src=\"data:image/webp;base64,YWJj\""), 1);
  const std::string without = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_EQ(Count(without, "<div class=\"replay\">"), 0);
  EXPECT_EQ(Count(without, "<img"), 0);
}

TEST(ReportPageTest, AVideoPlaysOnThePageAndAnImageOfAnotherTypeIsOne) {
  const Scene scene(/*fails=*/false);
  const std::string video =
      FormatReportHtml(scene.report, scene.plan, {}, {"abc", 320, 240, "video/mp4"});
  EXPECT_EQ(Count(video, "<video"), 1);
  EXPECT_EQ(Count(video, "</video>"), 1);
  EXPECT_EQ(Count(video, "src=\"data:video/mp4;base64,YWJj\""), 1);
  EXPECT_EQ(Count(video, "<img"), 0);
  EXPECT_EQ(Count(video, "Play the animation"), 0);
  const std::string image =
      FormatReportHtml(scene.report, scene.plan, {}, {"abc", 320, 240, "image/gif"});
  EXPECT_EQ(Count(image, "src=\"data:image/gif;base64,YWJj\""), 1);
  EXPECT_EQ(Count(image, "<video"), 0);
  // It plays only while the reader has opened it.
  EXPECT_EQ(Count(image, "<details><summary>Play the animation</summary><img"), 1);
}

TEST(ReportPageTest, ALargeAnimationIsLinkedAndNotContained) {
  const Scene scene(/*fails=*/false);
  const PagePicture moving = {
      std::string(31'000'000, 'a'), 320, 240, "image/webp", false, "re#play.webp"};
  const std::string page = FormatReportHtml(scene.report, scene.plan, {}, moving);
  EXPECT_EQ(Count(page, "<a href=\"re%23play.webp\">re#play.webp</a> (31 MB"), 1);
  EXPECT_EQ(Count(page, "data:image/webp"), 0);
  EXPECT_LT(page.size(), 1'000'000);
}

TEST(ReportPageTest, TheSizeStatesAnUnknownUnitAndTheScale) {
  Scene scene(/*fails=*/false);
  EXPECT_THAT(FormatReportHtml(scene.report, scene.plan, {}), Not(HasSubstr("<dt>Size")));
  scene.report.measures = "10.4 cm across, 216 g";
  const auto page = [&] { return FormatReportHtml(scene.report, scene.plan, {}); };
  EXPECT_THAT(page(), HasSubstr("<dd>10.4 cm across, 216 g</dd>"));
  scene.report.has_no_unit = true;
  scene.report.scale = 1;
  EXPECT_THAT(page(), HasSubstr("216 g; no unit in the file, read as metres</dd>"));
  scene.report.scale = 1e-3;
  EXPECT_THAT(page(), HasSubstr("no unit in the file, read as 1\u00a0mm per unit</dd>"));
}

TEST(ReportPageTest, ThePictureOfTheFailureComesFirstAndOnce) {
  const std::vector<PagePicture> pictures = {{"abc", 640, 480}, {"defg", 640, 480}, {}};
  const Scene failing(/*fails=*/true), passing(/*fails=*/false);
  const std::string page = FormatReportHtml(failing.report, failing.plan, pictures);
  EXPECT_EQ(Count(page, "class=\"failure\""), 1);
  EXPECT_EQ(Count(page, "id=\"frame1\""), 1);
  EXPECT_LT(page.find("id=\"frame1\""), page.find("class=\"facts\""));
  EXPECT_GT(page.find("id=\"frame0\""), page.find("class=\"facts\""));
  EXPECT_THAT(page, HasSubstr("Slipped: finger 2 slips 3 mm"));
  EXPECT_EQ(Count(FormatReportHtml(passing.report, passing.plan, pictures), "class=\"failure\""),
            0);
}

TEST(ReportPageTest, ValuesThatAreNotFiniteBreakNothing) {
  Scene scene(/*fails=*/true);
  scene.report.steps[1].replay->reason = plan::Reason::kSimulationUnstable;
  scene.report.steps[1].replay->displacement_m = std::numeric_limits<double>::infinity();
  scene.report.steps[1].replay->moved_m = std::numeric_limits<double>::infinity();
  scene.report.steps[1].replay->slip_m = std::nan("");
  const std::string page = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_THAT(page, HasSubstr("simulation-unstable"));
  EXPECT_EQ(Count(page, "<svg"), 2);
}

TEST(ReportPageTest, ManyPicturesAreSmaller) {
  EXPECT_GT(PagePictureWidth(20), PagePictureWidth(50));
  EXPECT_GT(PagePictureWidth(50), PagePictureWidth(500));
  EXPECT_GE(PagePictureWidth(100000), 200);
}

TEST(StepMeasuresTest, MotionIsWhatTheToleranceIsAbout) {
  const Scene scene(/*fails=*/true);
  const std::vector<StepMeasures> measures = MeasureSteps(scene.report);
  ASSERT_EQ(measures.size(), 3u);
  EXPECT_THAT(measures[0].moved_m, Optional(DoubleNear(6e-6, 1e-12)));
  EXPECT_THAT(measures[0].margin_deg, Optional(DoubleNear(7.5, 1e-9)));
  EXPECT_THAT(measures[0].slip_m, Optional(2e-9));
  EXPECT_FALSE(measures[2].moved_m || measures[2].margin_deg || measures[2].slip_m);
}

/// Each limit of a replay by a hand is that of its own quantity.
TEST(StepMeasuresTest, OfAHandAreSharesOfItsLimits) {
  Scene scene(/*fails=*/false);
  EXPECT_FALSE(MeasureSteps(scene.report)[1].deviation_percent);
  EXPECT_THAT(FormatReportHtml(scene.report, scene.plan, {}), HasSubstr("Motion of the object."));
  scene.report.settings->hand.emplace();
  for (ReportStep& step : scene.report.steps) step.replay->hand.emplace();
  sim::HandMeasures& hand = *scene.report.steps[1].replay->hand;
  hand.off_m = 1e-3;       // 50 % of 2 mm
  hand.rest_off_m = 8e-4;  // 80 % of 1 mm
  hand.slip_m = 1.5e-3;    // 150 % of 1 mm
  const StepMeasures measures = MeasureSteps(scene.report)[1];
  EXPECT_THAT(measures.deviation_percent, Optional(DoubleNear(80, 1e-9)));
  EXPECT_THAT(measures.slip_percent, Optional(DoubleNear(150, 1e-9)));
  const std::string page = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_THAT(page, HasSubstr("Deviation of the object."));
  EXPECT_THAT(page, Not(HasSubstr("Motion of the object.")));
}

TEST(StepMeasuresTest, TheMarginAtRestIsThatOfTheForceThatLeansMost) {
  Scene scene(/*fails=*/false);
  EXPECT_FALSE(MeasureSteps(scene.report)[1].static_margin_deg);
  scene.report.steps[1].replay->static_margins = {{FingerIndex(0), Radians(11)},
                                                  {FingerIndex(3), Radians(8)}};
  EXPECT_THAT(MeasureSteps(scene.report)[1].static_margin_deg, Optional(DoubleNear(8, 1e-12)));
}

TEST(ReportPageTest, TheVerdictOfTrialsNamesTheirNumbers) {
  Scene scene(/*fails=*/false);
  sim::TrialSummary& trials = scene.report.trials.emplace();
  trials.options.count = 20;
  trials.passed = 14;
  trials.reasons = {{plan::Reason::kSlipped, 6}};
  const std::string fails = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_THAT(fails, HasSubstr("<title>Fail in 6 of 20 trials: plan.json</title>"));
  EXPECT_THAT(fails, HasSubstr("<strong>Fail in 6 of 20 trials</strong>"));
  EXPECT_THAT(fails, HasSubstr("6 of 20 trials with noise fail: 6 slipped."));
  EXPECT_THAT(fails,
              HasSubstr("<span class=\"option\">--trials</span> min-pass-rate requires 100 %"));
  EXPECT_THAT(fails, Not(HasSubstr("<strong>Pass")));
  trials.options.min_pass_rate = 0.5;
  const std::string passes = FormatReportHtml(scene.report, scene.plan, {});
  EXPECT_THAT(passes, HasSubstr("<title>Pass in 14 of 20 trials: plan.json</title>"));
  EXPECT_THAT(passes, HasSubstr("<strong>Pass in 14 of 20 trials</strong>"));
  EXPECT_THAT(passes, Not(HasSubstr("<strong>Pass</strong>")));
}

}  // namespace report_page_test
}  // namespace regrasp::report
