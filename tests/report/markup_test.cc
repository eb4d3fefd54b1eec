#include "report/markup.h"

#include <gtest/gtest.h>

namespace regrasp::report {
namespace markup_test {

TEST(MarkupTest, MarkupInATextIsEscaped) {
  EXPECT_EQ(EscapeMarkup("a<b&\"c\">'d'"), "a&lt;b&amp;&quot;c&quot;&gt;&#39;d&#39;");
  EXPECT_EQ(EscapeMarkup("θ = 20°\n"), "θ = 20°\n");
}

TEST(MarkupTest, BytesThatAreNoUtf8AndControlCharactersBecomeReplacements) {
  EXPECT_EQ(EscapeMarkup("a\xFFz"), "a\uFFFDz");
  EXPECT_EQ(EscapeMarkup(std::string("\x1B[2J\0\r\x7F", 7)), "\uFFFD[2J\uFFFD\uFFFD\uFFFD");
  // A truncated sequence at the end, and an overlong sequence.
  EXPECT_EQ(EscapeMarkup("\xE2\x82"), "\uFFFD");
  EXPECT_EQ(EscapeMarkup("\xC0\xBC").find('<'), std::string::npos);
}

TEST(MarkupTest, WhatIsLeftIsAllowedInXmlAndSeen) {
  EXPECT_EQ(EscapeMarkup("a\uFFFEb\uFFFFc"), "a\uFFFDb\uFFFDc");
  EXPECT_EQ(EscapeMarkup("\u0085\u009B\u202Egpj\u2066"), "\uFFFD\uFFFD\uFFFDgpj\uFFFD");
  EXPECT_EQ(EscapeMarkup("ü\u00A0漢\u2009🤏\uFFFD"), "ü\u00A0漢\u2009🤏\uFFFD");
}

TEST(ElementTest, ElementsHaveTheirAttributesAndChildrenInTheirOrder) {
  EXPECT_EQ(Element("p").Format(), "<p></p>");
  EXPECT_EQ(Element("p", {{"class", "y"}, {"id", "z"}}, "a ", Element("b", {}, "c"), " d").Format(),
            "<p class=\"y\" id=\"z\">a <b>c</b> d</p>");
}

TEST(ElementTest, ElementsSideBySideStandOnLinesOfTheirOwn) {
  const std::vector<Element> items = {Element("li", {}, "1"), Element("li", {}, "2")};
  EXPECT_EQ(Element("ul", {}, items).Format(), "<ul>\n<li>1</li>\n<li>2</li>\n</ul>");
  EXPECT_EQ(Element("ul", {}, std::vector<Element>()).Format(), "<ul></ul>");
  EXPECT_EQ(Element("ul", {}, items, items).Format(),
            "<ul>\n<li>1</li>\n<li>2</li>\n<li>1</li>\n<li>2</li>\n</ul>");
}

TEST(ElementTest, AnAttributeCannotBeLeft) {
  EXPECT_EQ(Element("img", {{"alt", "\" onload=\"x"}}).Format(),
            "<img alt=\"&quot; onload=&quot;x\" />");
}

TEST(ElementTest, ATextCannotBecomeMarkup) {
  const std::string evil = "</b><script>x</script>&amp;";
  EXPECT_EQ(Element("p", {}, Element("b", {}, evil)).Format(),
            "<p><b>&lt;/b&gt;&lt;script&gt;x&lt;/script&gt;&amp;amp;</b></p>");
  // Positive control: text that is added verbatim stays markup.
  Element style("style");
  style.AddVerbatim("a > b {}");
  EXPECT_EQ(style.Format(), "<style>a > b {}</style>");
}

TEST(ElementTest, OnlyVoidElementsAreClosedInTheirOwnTag) {
  EXPECT_EQ(Element("meta", {{"charset", "utf-8"}}).Format(), "<meta charset=\"utf-8\" />");
  EXPECT_EQ(Element("td").Format(), "<td></td>");
}

}  // namespace markup_test
}  // namespace regrasp::report
