#include "apps/terminal_text.h"

#include <gtest/gtest.h>

namespace regrasp::apps {
namespace terminal_text_test {

TEST(WrapForTerminal, IndentsFurtherLines) {
  EXPECT_EQ(WrapForTerminal("one two three", 10), "one two\n  three\n");
  EXPECT_EQ(WrapForTerminal("  why: one two", 12), "  why: one\n    two\n");
  EXPECT_EQ(WrapForTerminal("short", 80), "short\n");
  EXPECT_EQ(WrapForTerminal("", 80), "\n");
}

TEST(WrapForTerminal, LeavesRowsOfTables) {
  EXPECT_EQ(WrapForTerminal("0     hold  5.99  pass", 8), "0     hold  5.99  pass\n");
}

TEST(ArrangeForTerminal, StartsWithTheVerdictAndItsReasons) {
  EXPECT_EQ(ArrangeForTerminal("step 1 fails: slipped\n  why: limit\nstep  kind\n1     switch\n"
                               "files: out\nverdict: fail, step 1 fails: slipped\n",
                               80),
            "verdict: fail\nstep 1 fails: slipped\n  why: limit\n\nstep  kind\n1     switch\n"
            "files: out\n");
  EXPECT_EQ(ArrangeForTerminal("plan  verdict\na     pass\n1 plan: 1 pass\n", 80),
            "1 plan: 1 pass\n\nplan  verdict\na     pass\n");
}

TEST(ArrangeForTerminal, KeepsOneLineAndNoLine) {
  EXPECT_EQ(ArrangeForTerminal("verdict: pass\n", 80), "verdict: pass\n");
  EXPECT_EQ(ArrangeForTerminal("", 80), "");
}

}  // namespace terminal_text_test
}  // namespace regrasp::apps
