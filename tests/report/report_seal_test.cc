#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "report/report_json.h"

namespace regrasp::report {
namespace report_seal_test {

Json MakeReport() {
  return Json::parse(R"({"format": "regrasp-report", "numbers": [1e22, 0.1, -0.0, 5e-324, 7],
    "run": {"sha256": "abc", "files": [{"file": "report.html", "sha256": "def"}]},
    "text": "\u0001 \"quoted\" \u00e9", "verdict": "pass"})");
}

TEST(ReportSealTest, AReportAsItWasWrittenIsSealed) {
  const std::string text = SealReport(MakeReport());
  EXPECT_TRUE(IsSealed(text));
  EXPECT_EQ(SealReport(Json::parse(text)), text);
}

TEST(ReportSealTest, NoByteCanBeChangedAddedOrLeftOut) {
  const std::string text = SealReport(MakeReport());
  const auto holds = [](const std::string& edited) {
    try {
      return IsSealed(edited);
    } catch (const InputError&) {
      return false;
    }
  };
  int edits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_FALSE(holds(changed)) << i;
    EXPECT_FALSE(holds(text.substr(0, i) + text.substr(i + 1))) << i;
    EXPECT_FALSE(holds(text.substr(0, i) + " " + text.substr(i))) << i;
    EXPECT_FALSE(holds(text.substr(0, i))) << i;
    edits += 4;
  }
  EXPECT_GT(edits, 1000);
  EXPECT_FALSE(holds(text + "\n"));
}

TEST(ReportSealTest, TheDigestIsOfTheTextWithoutItself) {
  Json report = Json::parse(SealReport(MakeReport()));
  const std::string digest = report["run"]["report_sha256"];
  report["run"].erase("report_sha256");
  EXPECT_EQ(digest, Sha256(report.dump(1) + "\n"));
}

TEST(ReportSealTest, AReportThatDoesNotTellItsRunHasNoSeal) {
  Json report = MakeReport();
  report.erase("run");
  EXPECT_FALSE(IsSealed(SealReport(report)));
  report["run"] = 3;
  EXPECT_FALSE(IsSealed(report.dump(1) + "\n"));
  EXPECT_FALSE(IsSealed("[]\n"));
  EXPECT_THROW((void)IsSealed("{ half"), InputError);
}

}  // namespace report_seal_test
}  // namespace regrasp::report
