#include "apps/colour.h"

#include <gtest/gtest.h>

namespace regrasp::apps {
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
