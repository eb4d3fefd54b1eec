#include "apps/batch/batch_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "report/markup.h"
#include "tests/apps/batch/plan_outcomes.h"

namespace regrasp::apps {
namespace batch_page_test {

using testing::HasSubstr;
using testing::Not;

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Return the row of a plan.
std::string RowOf(const std::string& page, const std::string& name) {
  const auto begin = page.find("id=\"plan=" + name + "\"");
  EXPECT_NE(begin, std::string::npos) << name;
  return page.substr(begin, page.find("</tr>", begin) - begin);
}

/// Return the body of the page. The script and the style sheet contain names of elements.
std::string BodyOf(const std::string& page) {
  const auto begin = page.find("<main>");
  return page.substr(begin, page.find("</main>") - begin);
}

TEST(BatchPageTest, WhatDidNotPassComesFirstTheWorstAtTheTop) {
  const std::string page = FormatBatchPage(
      {{Passed("good1"), Failed("weak1"),
        Broken("bad", PlanVerdict::kBadInput, "why \"bad\" is broken"), Passed("good2"),
        Broken("crash", PlanVerdict::kError, "crashed"), Failed("weak2")},
       {{"grasp.json", "is a regrasp-grasp file"}}});
  std::vector<std::size_t> places;
  for (const char* name : {"crash", "bad", "weak1", "weak2", "good1", "good2"}) {
    places.push_back(page.find(std::string(">") + name + "<"));
    ASSERT_NE(places.back(), std::string::npos) << name;
  }
  EXPECT_TRUE(std::ranges::is_sorted(places));
  EXPECT_THAT(page, HasSubstr("<strong>Fail</strong> 2 pass, 2 fail, 1 bad-input, 1 error."));
  EXPECT_THAT(page, HasSubstr("<li>grasp.json is a regrasp-grasp file</li>"));
}

TEST(BatchPageTest, ARowHasTheFailedFrameOrThatOfTheWeakestStep) {
  const std::string page = FormatBatchPage({{Failed("weak"), Passed("good")}, {}});
  const std::string weak = RowOf(page, "weak"), good = RowOf(page, "good");
  EXPECT_THAT(weak, HasSubstr("alt=\"Failure of weak\" loading=\"lazy\""));
  EXPECT_THAT(weak, HasSubstr("src=\"weak/001_switch.png\""));
  EXPECT_THAT(good, HasSubstr("src=\"good/001_switch.png\""));
  EXPECT_EQ(Count(weak, "href=\"weak/report.html\""), 2u);
  EXPECT_THAT(weak, HasSubstr("<td class=\"outcome\">Fail</td><td>slipped</td><td>" +
                              report::EscapeMarkup("Step 1 (switch): finger <2> slipped.") +
                              "<details><summary>Cause and remedy</summary>"
                              "<p>Why: it stays. Help: more friction.</p></details></td>"));
  EXPECT_THAT(good, HasSubstr("<td class=\"outcome\">Pass</td>"));
  EXPECT_THAT(good, HasSubstr("<small>10.4 cm across, 216 g</small>"));
  PlanOutcome first = Passed("first");
  first.report->weakest_step.reset();
  EXPECT_THAT(RowOf(FormatBatchPage({{first}, {}}), "first"), HasSubstr("first/000_hold.png"));
}

TEST(BatchPageTest, AFailedPlanHasNoMarginUnlessItIsMissing) {
  PlanOutcome lacking = Failed("lacking");
  lacking.report->required_friction_angle_deg = 21.5;
  const std::string page = FormatBatchPage({{Failed("slips"), lacking, Passed("good")}, {}});
  EXPECT_THAT(RowOf(page, "slips"), Not(HasSubstr("in step 1<")));
  EXPECT_THAT(RowOf(page, "lacking"),
              HasSubstr("data-value=\"-1.5\">−1.50°<small> in step 1</small></td>"));
  EXPECT_THAT(RowOf(page, "good"),
              HasSubstr("data-value=\"2.75\">2.75°<small> in step 1</small></td>"));
}

TEST(BatchPageTest, WithoutFramesOrReportThereIsNoImageAndNoLinkToAMissingFile) {
  PlanOutcome plain = Passed("plain");
  plain.report->files.clear();
  for (ReportSummary::Entry& entry : plain.report->entries) entry.frame.clear();
  const std::string page = BodyOf(FormatBatchPage(
      {{plain, Broken("bad", PlanVerdict::kBadInput, "why \"bad\" is broken")}, {}}));
  EXPECT_EQ(Count(page, "<img"), 0u);
  EXPECT_EQ(Count(page, "<a "), 1u);
  EXPECT_THAT(RowOf(page, "bad"), HasSubstr("Bad input</td>"));
  EXPECT_THAT(RowOf(page, "bad"), HasSubstr(report::EscapeMarkup("why \"bad\" is broken")));
}

TEST(BatchPageTest, NamesOfAnyBytesStayTextAndLinksStayLinks) {
  const std::string evil = "a:<script>#\"'&%\xFF";
  const std::string page = FormatBatchPage({{Passed(evil), Failed(evil)}, {{evil, evil}}});
  EXPECT_EQ(Count(BodyOf(page), "<script"), 0u);
  EXPECT_EQ(Count(page, "<script"), 1u);
  EXPECT_THAT(page, HasSubstr("href=\"a%3A%3Cscript%3E%23%22%27%26%25%FF/report.html\""));
  EXPECT_THAT(page, HasSubstr("id=\"plan=a%3A%3Cscript%3E%23%22%27%26%25%FF\""));
}

TEST(BatchPageTest, APageWithoutPlansHasAnEmptyTable) {
  const std::string page = FormatBatchPage({});
  EXPECT_THAT(page, HasSubstr("<h1>0 plans</h1>"));
  EXPECT_THAT(page, HasSubstr("data-count=\"0\""));
}

}  // namespace batch_page_test
}  // namespace regrasp::apps
