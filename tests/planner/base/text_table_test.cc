#include "planner/base/text_table.h"

#include <gtest/gtest.h>

#include <string>

namespace regrasp {
namespace text_table_test {

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

TEST(TextTableTest, InvisibleCharactersOfALineAreShown) {
  EXPECT_EQ(OneLine("a\u009B2Jb"), "a\\u009b2Jb");
  EXPECT_EQ(OneLine("a\u202Etxt.b"), "a\\u202etxt.b");
  EXPECT_EQ(OneLine("\u200E\u2066x\u2069"), "\\u200e\\u2066x\\u2069");
  EXPECT_EQ(OneLine("\uFEFF\uFFFE\U000E0041"), "\\ufeff\\ufffe\\ue0041");
  EXPECT_EQ(OneLine("a\x9B\xFFz\xE2\x82"), "a\\x9b\\xffz\\xe2\\x82");
  EXPECT_EQ(OneLine("ü ≤ 20° 漢字 🤏"), "ü ≤ 20° 漢字 🤏");
}

TEST(TextTableTest, ALineOfAnyLengthIsCutInItsMiddle) {
  std::string longest = "a";
  for (std::size_t i = 1; i < kLongestLine; ++i) longest += "ü";
  EXPECT_EQ(OneLine(longest), longest);
  const std::string cut = OneLine("plan.json: " + std::string(1 << 16, 'x') + "é: too long");
  EXPECT_TRUE(cut.starts_with("plan.json: xxx"));
  EXPECT_TRUE(cut.ends_with("xxxé: too long"));
  EXPECT_NE(cut.find("x…x"), std::string::npos);
  EXPECT_EQ(cut.size(), kLongestLine + 3);  // "…" has three bytes and "é" two
  EXPECT_EQ(OneLine(longest + "ü").size(), 1 + 2 * (kLongestLine - 2) + 3);
}

}  // namespace text_table_test
}  // namespace regrasp
