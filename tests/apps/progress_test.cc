#include "apps/progress.h"

#include <gtest/gtest.h>

namespace regrasp::apps {
namespace progress_test {

using std::chrono::seconds;

/// Return the log of 100 progress reports, one per second. Captured standard error is not a
/// terminal.
std::string ShownOf100Seconds(bool quiet) {
  ProgressLog::Clock::time_point now{};
  testing::internal::CaptureStderr();
  ProgressLog log("validate", quiet, [&] { return now; });
  for (int i = 0; i <= 100; ++i) {
    log.Report(std::to_string(i) + " of 100 plans");
    now += seconds(1);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(ProgressLogTest, ALogGetsALineNowAndThenAndNoneAtOnce) {
  EXPECT_EQ(ShownOf100Seconds(false),
            "validate: 30 of 100 plans\n"
            "validate: 60 of 100 plans\n"
            "validate: 90 of 100 plans\n");
}

TEST(ProgressLogTest, QuietMeansNone) { EXPECT_EQ(ShownOf100Seconds(true), ""); }

}  // namespace progress_test
}  // namespace regrasp::apps
