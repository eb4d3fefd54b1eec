#include "planner/base/markup.h"

#include <gtest/gtest.h>

namespace regrasp {
namespace {

TEST(MarkupTest, MarkupInATextIsEscaped) {
  EXPECT_EQ(EscapeMarkup("a<b&\"c\">'d'"), "a&lt;b&amp;&quot;c&quot;&gt;&#39;d&#39;");
  EXPECT_EQ(EscapeMarkup("θ = 20°\n"), "θ = 20°\n");
}

TEST(MarkupTest, BytesThatAreNoUtf8AndControlCharactersBecomeReplacements) {
  EXPECT_EQ(EscapeMarkup("a\xFFz"), "a\uFFFDz");
  EXPECT_EQ(EscapeMarkup(std::string("\x1B[2J\0\r\x7F", 7)), "\uFFFD[2J\uFFFD\uFFFD\uFFFD");
  // A sequence that breaks off at the end, and one that is longer than it need be.
  EXPECT_EQ(EscapeMarkup("\xE2\x82"), "\uFFFD");
  EXPECT_EQ(EscapeMarkup("\xC0\xBC").find('<'), std::string::npos);
}

TEST(MarkupTest, WhatIsLeftIsAllowedInXmlAndSeen) {
  EXPECT_EQ(EscapeMarkup("a\uFFFEb\uFFFFc"), "a\uFFFDb\uFFFDc");
  EXPECT_EQ(EscapeMarkup("\u0085\u009B\u202Egpj\u2066"), "\uFFFD\uFFFD\uFFFDgpj\uFFFD");
  EXPECT_EQ(EscapeMarkup("ü\u00A0漢\u2009🤏\uFFFD"), "ü\u00A0漢\u2009🤏\uFFFD");
}

TEST(MarkupTest, AnAttributeCannotBeLeft) {
  EXPECT_EQ(Attribute("alt", "\" onload=\"x"), "alt=\"&quot; onload=&quot;x\"");
}

TEST(MarkupTest, ElementsHaveTheirAttributesAndContent) {
  EXPECT_EQ(Element("p", "", "x"), "<p>x</p>");
  EXPECT_EQ(Element("p", "class=\"y\"", Element("b", "", "")), "<p class=\"y\"><b></b></p>");
}

}  // namespace
}  // namespace regrasp
