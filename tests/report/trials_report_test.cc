#include <gtest/gtest.h>

#include "report/report_table.h"

namespace regrasp::report {
namespace trials_report_test {

TEST(TrialsReportTest, TheJsonSaysWhatTheSummarySays) {
  sim::TrialSummary summary;
  summary.options.count = 12;
  summary.passed = 9;
  summary.reasons = {{plan::Reason::kSlipped, 2}, {plan::Reason::kContactLost, 1}};
  summary.steps = {{plan::EntryIndex(1), 3}};
  const Json json = TrialsJson(summary);
  EXPECT_EQ(json["count"], 12);
  EXPECT_EQ(json["passed"], 9);
  EXPECT_LE(json["interval"][0], summary.share());
  EXPECT_GE(json["interval"][1], summary.share());
  EXPECT_EQ(json["reasons"].size(), 2u);
  EXPECT_EQ(json["reasons"]["slipped"], 2);
  EXPECT_EQ(json["reasons"]["contact-lost"], 1);
  EXPECT_EQ(json["min_pass_rate"], 1);
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["steps"], Json::parse(R"([{"index": 1, "failed": 3}])"));
}

TEST(TrialsReportTest, TheShareThatIsRequiredIsEnough) {
  int checked = 0;
  for (const int count : {1, 3, 7, 20, 100, 999}) {
    for (int passed = 1; passed <= count; ++passed) {
      sim::TrialSummary summary;
      summary.options.count = count;
      summary.passed = passed;
      summary.options.min_pass_rate = static_cast<double>(passed) / count;
      EXPECT_TRUE(summary.enough());
      summary.passed = passed - 1;
      EXPECT_FALSE(summary.enough());
      EXPECT_EQ(TrialsJson(summary)["verdict"], "fail");
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
  sim::TrialSummary summary;
  summary.options.count = 100;
  summary.passed = 93;
  summary.options.min_pass_rate = 0.93;
  EXPECT_TRUE(summary.enough()) << "as it is typed";
}

TEST(TrialsReportTest, TheVerdictNamesTheRate) {
  sim::TrialSummary summary;
  summary.options.count = 20;
  summary.passed = 14;
  EXPECT_EQ(TrialsPassText(summary), "in 14 of 20 trials");
  EXPECT_EQ(TrialsRequiredText(summary),
            "14 of 20 trials pass (70 %), --min-pass-rate requires 100 %");
  summary.options.min_pass_rate = 0.7001;
  EXPECT_EQ(TrialsRequiredText(summary),
            "14 of 20 trials pass (70 %), --min-pass-rate requires 70.01 %");
}

}  // namespace trials_report_test
}  // namespace regrasp::report
