#include "report/page/html_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace regrasp::report {
namespace html_page_test {

using testing::HasSubstr;
using testing::Not;

TEST(HtmlPageTest, APageRunsNothingAndLoadsPicturesFromWhereItSays) {
  const std::vector<Element> parts = {Element("p", {}, "text")};
  const std::string own = FormatHtmlPage("a < b", parts);
  EXPECT_THAT(own, HasSubstr("default-src &#39;none&#39;"));
  EXPECT_THAT(own, HasSubstr("img-src data:\""));
  EXPECT_THAT(own, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(own, HasSubstr("<main>\n<p>text</p>\n</main>"));
  const std::string beside = FormatHtmlPage("a", parts, PictureSource::kOwnSite);
  EXPECT_THAT(beside, HasSubstr("img-src data: &#39;self&#39; file:\""));
  EXPECT_THAT(beside, Not(HasSubstr("script-src")));
}

TEST(HtmlPageTest, ItsPolicyNamesTheDigestOfEachScript) {
  const std::vector<std::string_view> scripts = {"alert('Hello, world.');", "1 < 2"};
  const std::string page = FormatHtmlPage("a", {}, PictureSource::kInPage, scripts);
  // Known answers, computed with openssl dgst -sha256 from the text between the tags.
  EXPECT_THAT(page, HasSubstr("sha256-QsH3GJ7sU0EkUKxZDt9e6m5C1z3eSL+mbbq50vONYWk="));
  EXPECT_THAT(page, HasSubstr("sha256-3GE0R05LzWmzBOQIBIN2oo8RXB9+IpDKGhpuNFwrHsg="));
  EXPECT_THAT(page, HasSubstr("<script>//<![CDATA[\nalert('Hello, world.');\n//]]></script>"));
  EXPECT_THAT(page, HasSubstr("<script>//<![CDATA[\n1 < 2\n//]]></script>"));
}

TEST(HtmlPageTest, TheHeaderSaysTheVerdict) {
  const std::string fail = PageHeader("Validation", "<plan>", false, "At step 1.").Format();
  EXPECT_THAT(fail, HasSubstr("<h1>&lt;plan&gt;</h1>"));
  EXPECT_THAT(fail, HasSubstr("class=\"verdict fail\"><strong>Fail</strong> At step 1.</p>"));
  EXPECT_THAT(PageHeader("", "", true, "").Format(), HasSubstr("<strong>Pass</strong>"));
}

TEST(HtmlPageTest, NamesOfOptionsDoNotBreakAcrossLines) {
  const auto text = [](std::string_view said) { return WithOptions(Element("p"), said).Format(); };
  EXPECT_EQ(text("Use --friction-angle 30, or --view=0 <x"),
            "<p>Use <span class=\"option\">--friction-angle</span> 30, or "
            "<span class=\"option\">--view</span>=0 &lt;x</p>");
  // Other words with hyphens may break.
  EXPECT_EQ(text("well--known force-closure"), "<p>well--known force-closure</p>");
  EXPECT_EQ(text("--seed"), "<p><span class=\"option\">--seed</span></p>");
  EXPECT_EQ(text("(--seed 3)"), "<p>(<span class=\"option\">--seed</span> 3)</p>");
  EXPECT_EQ(text(""), "<p></p>");
}

}  // namespace html_page_test
}  // namespace regrasp::report
