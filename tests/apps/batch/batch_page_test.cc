#include "apps/batch/batch_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

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

/// Return the page from the heading of a plan to that of the next.
std::string CardOf(const std::string& page, const std::string& name) {
  const auto begin = page.find(">" + name + "<");
  EXPECT_NE(begin, std::string::npos);
  return page.substr(begin, page.find("<h3>", begin) - begin);
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

TEST(BatchPageTest, APlanThatFailsShowsWhatFailedAndOneThatPassesItsSheet) {
  const std::string page = FormatBatchPage({{Failed("weak"), Passed("good")}, {}});
  EXPECT_THAT(page, HasSubstr("alt=\"What fails in weak\""));
  EXPECT_THAT(page, HasSubstr("src=\"weak/001_switch.png\""));
  EXPECT_THAT(page, HasSubstr("src=\"good/overview.png\""));
  EXPECT_EQ(Count(page, "<img"), 2u);
  EXPECT_EQ(Count(page, "href=\"weak/report.html\""), 2u);
  EXPECT_THAT(page, HasSubstr("<strong>Fail</strong> Step 1 (switch): slipped. Finger &lt;2&gt; "
                              "slipped. Why: it stays. Help: more friction.</p>"));
  EXPECT_THAT(page, HasSubstr("<strong>Pass</strong> The hold and 1 step pass."));
  EXPECT_THAT(page, HasSubstr("<dd>10.4 cm across, 216 g</dd>"));
}

TEST(BatchPageTest, WhatIsToSpareIsNotToldOfAPlanThatFailsElsewhere) {
  PlanOutcome lacking = Failed("lacking");
  lacking.report->required_friction_angle_deg = 21.5;
  const std::string page = FormatBatchPage({{Failed("slips"), lacking, Passed("good")}, {}});
  EXPECT_THAT(CardOf(page, "slips"), Not(HasSubstr("Weakest")));
  EXPECT_THAT(CardOf(page, "lacking"), HasSubstr("<dd>1.50° missing in step 1</dd>"));
  EXPECT_THAT(CardOf(page, "good"), HasSubstr("<dd>2.75° margin in step 1</dd>"));
}

TEST(BatchPageTest, WithoutFramesOrReportThereIsNoPictureAndNoLinkThatLeadsNowhere) {
  PlanOutcome plain = Passed("plain");
  plain.report->files.clear();
  for (ReportSummary::Entry& entry : plain.report->entries) entry.frame.clear();
  const std::string page = FormatBatchPage(
      {{plain, Broken("bad", PlanVerdict::kBadInput, "why \"bad\" is broken")}, {}});
  EXPECT_EQ(Count(page, "<img"), 0u);
  EXPECT_EQ(Count(page, "<a "), 1u);
  EXPECT_THAT(page, HasSubstr("<strong>Bad input</strong> why &quot;bad&quot; is broken"));
}

TEST(BatchPageTest, NamesOfAnyBytesStayTextAndLinksStayLinks) {
  const std::string evil = "a:<script>#\"'&%\xFF";
  const std::string page = FormatBatchPage({{Passed(evil), Failed(evil)}, {{evil, evil}}});
  EXPECT_EQ(Count(page, "<script"), 0u);
  EXPECT_THAT(page, HasSubstr("href=\"a%3A%3Cscript%3E%23%22%27%26%25%FF/report.html\""));
}

}  // namespace batch_page_test
}  // namespace regrasp::apps
