#include <gtest/gtest.h>

#include "report/page/html_page.h"

namespace regrasp::report {
namespace path_uri_test {

TEST(PathUriTest, OnlyWhatMeansNothingElseInALinkStaysAsItIs) {
  EXPECT_EQ(PathUri("cube_01/report.html"), "cube_01/report.html");
  EXPECT_EQ(PathUri("plan #1?/a"), "plan%20%231%3F/a");
  // No scheme, no earlier escape, no quote.
  EXPECT_EQ(PathUri("javascript:alert(1)"), "javascript%3Aalert%281%29");
  EXPECT_EQ(PathUri("100%25\"&<"), "100%2525%22%26%3C");
  EXPECT_EQ(PathUri("\xC3\xA9\xFF\n"), "%C3%A9%FF%0A");
  EXPECT_EQ(PathUri(""), "");
}

}  // namespace path_uri_test
}  // namespace regrasp::report
