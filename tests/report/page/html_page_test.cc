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

TEST(HtmlPageTest, TheHeaderSaysTheVerdict) {
  const std::string fail = PageHeader("Validation", "<plan>", false, "At step 1.").Format();
  EXPECT_THAT(fail, HasSubstr("<h1>&lt;plan&gt;</h1>"));
  EXPECT_THAT(fail, HasSubstr("class=\"verdict fail\"><strong>Fail</strong> At step 1.</p>"));
  EXPECT_THAT(PageHeader("", "", true, "").Format(), HasSubstr("<strong>Pass</strong>"));
}

}  // namespace html_page_test
}  // namespace regrasp::report
