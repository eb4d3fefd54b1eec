#include "planner/base/text_table.h"

#include <gtest/gtest.h>

namespace regrasp {
namespace {

TEST(TextTableTest, ColumnsAreAsWideAsTheirWidestCell) {
  EXPECT_EQ(FormatRows({{"a", "long", "z"}, {"abc", "b", "zz"}}), "a    long  z\nabc  b     zz\n");
  EXPECT_EQ(FormatRows({}), "");
}

TEST(TextTableTest, CharactersCountAndNotBytes) {
  EXPECT_EQ(FormatRows({{"12°", "x"}, {"123", "y"}}), "12°  x\n123  y\n");
}

TEST(TextTableTest, ACellIsOneLine) {
  EXPECT_EQ(FormatRows({{"a\nb", "c\x1B[2J\n"}}), "a b  c [2J\n");
  EXPECT_EQ(OneLine("a\tb\r\n"), "a b");
}

}  // namespace
}  // namespace regrasp
