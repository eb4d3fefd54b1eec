#include "apps/page/html.h"

#include <gtest/gtest.h>

namespace regrasp {
namespace {

TEST(HtmlTest, MarkupInATextIsEscaped) {
  EXPECT_EQ(EscapeHtml("a<b&\"c\">'d'"), "a&lt;b&amp;&quot;c&quot;&gt;&#39;d&#39;");
  EXPECT_EQ(EscapeHtml("θ = 20°\n"), "θ = 20°\n");
}

TEST(HtmlTest, BytesThatAreNoUtf8AndControlCharactersBecomeReplacements) {
  EXPECT_EQ(EscapeHtml("a\xFFz"), "a\uFFFDz");
  EXPECT_EQ(EscapeHtml(std::string("\x1B[2J\0\r\x7F", 7)), "\uFFFD[2J\uFFFD\uFFFD\uFFFD");
  // A sequence that breaks off at the end, and one that is longer than it need be.
  EXPECT_EQ(EscapeHtml("\xE2\x82"), "\uFFFD");
  EXPECT_EQ(EscapeHtml("\xC0\xBC").find('<'), std::string::npos);
}

TEST(HtmlTest, AnAttributeCannotBeLeft) {
  EXPECT_EQ(Attribute("alt", "\" onload=\"x"), "alt=\"&quot; onload=&quot;x\"");
}

TEST(HtmlTest, ElementsHaveTheirAttributesAndContent) {
  EXPECT_EQ(Element("p", "", "x"), "<p>x</p>");
  EXPECT_EQ(Element("p", "class=\"y\"", Element("b", "", "")), "<p class=\"y\"><b></b></p>");
}

TEST(HtmlTest, BytesBecomeAUriOfBase64) {
  // The vectors of RFC 4648.
  EXPECT_EQ(DataUri("image/webp", ""), "data:image/webp;base64,");
  EXPECT_EQ(DataUri("image/webp", "f"), "data:image/webp;base64,Zg==");
  EXPECT_EQ(DataUri("image/webp", "foobar"), "data:image/webp;base64,Zm9vYmFy");
  EXPECT_EQ(DataUri("a/b", std::string("\0\xFF", 2)), "data:a/b;base64,AP8=");
}

}  // namespace
}  // namespace regrasp
