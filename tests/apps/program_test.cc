#include "apps/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::apps {
namespace build_id_test {

TEST(BuildIdTest, IsThatInTheFileOfTheRunningProgram) {
  const std::string id = BuildId();
  ASSERT_EQ(id.size(), 40u);
  std::string bytes;
  for (std::size_t i = 0; i < id.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(id.substr(i, 2), nullptr, 16));
  }
  EXPECT_NE(ReadFile("/proc/self/exe").find(bytes), std::string::npos);
  EXPECT_EQ(BuildId(), id);
}

}  // namespace build_id_test

namespace run_date_test {

class RunDateTest : public testing::Test {
 protected:
  ~RunDateTest() override { unsetenv("SOURCE_DATE_EPOCH"); }
  static std::string DateAt(const char* seconds) {
    setenv("SOURCE_DATE_EPOCH", seconds, /*overwrite=*/1);
    return RunDate();
  }
};

TEST_F(RunDateTest, IsTheDayInUtcOfTheSecondsGiven) {
  EXPECT_EQ(DateAt("0"), "1970-01-01");
  EXPECT_EQ(DateAt("1709164799"), "2024-02-28");
  EXPECT_EQ(DateAt("1709164800"), "2024-02-29");
  EXPECT_EQ(DateAt("253402300799"), "9999-12-31");
}

TEST_F(RunDateTest, IsOfTheClockWhereNothingIsGiven) {
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_THAT(RunDate(), testing::MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]"));
  EXPECT_EQ(DateAt(""), RunDate());
}

TEST_F(RunDateTest, RefusesWhatAreNoSeconds) {
  for (const char* bad : {"-1", "today", "12x", "253402300800", "99999999999999999999", " 1"}) {
    EXPECT_THROW((void)DateAt(bad), InputError) << bad;
  }
}

}  // namespace run_date_test

namespace colour_test {

TEST(PaintVerdicts, PaintsVerdictsAndNothingElse) {
  EXPECT_EQ(PaintVerdicts("step  kind  verdict\n0     hold  pass\n"),
            "step  kind  verdict\n0     hold  \x1b[32mpass\x1b[0m\n");
  EXPECT_EQ(PaintVerdicts("1     align  fail: slipped\n2     switch  skipped\n"),
            "1     align  \x1b[31mfail: slipped\x1b[0m\n2     switch  \x1b[2mskipped\x1b[0m\n");
  EXPECT_EQ(PaintVerdicts("mug  fail  6  3  12.40  slipped in step 2\n"),
            "mug  \x1b[31mfail\x1b[0m  6  3  12.40  slipped in step 2\n");
  EXPECT_EQ(PaintVerdicts("verdict: pass\n"), "verdict: \x1b[32mpass\x1b[0m\n");
  EXPECT_EQ(PaintVerdicts("verdict: fail, step 0\n"), "verdict: \x1b[31mfail, step 0\x1b[0m\n");
  EXPECT_EQ(PaintVerdicts("step 1 (align) fails: slipped\n"),
            "\x1b[31mstep 1 (align) fails: slipped\x1b[0m\n");
  const std::string plain = "weakest: step 1 (align), which needs more\nfiles: out/pass\n";
  EXPECT_EQ(PaintVerdicts(plain), plain);
}

TEST(TakesColour, IsNotForWhatIsNoTerminal) {
  testing::internal::CaptureStdout();
  const bool captured = TakesColour(1);
  testing::internal::GetCapturedStdout();
  EXPECT_FALSE(captured);
}

}  // namespace colour_test
}  // namespace regrasp::apps
