#include "report/trials_report.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(json["steps"], Json::parse(R"([{"index": 1, "failed": 3}])"));
}

}  // namespace trials_report_test
}  // namespace regrasp::report
