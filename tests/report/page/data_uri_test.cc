#include <gtest/gtest.h>

#include "report/page/html_page.h"

namespace regrasp::report {
namespace data_uri_test {

TEST(DataUriTest, BytesBecomeAUriOfBase64) {
  // Test vectors of RFC 4648.
  EXPECT_EQ(DataUri("image/webp", ""), "data:image/webp;base64,");
  EXPECT_EQ(DataUri("image/webp", "f"), "data:image/webp;base64,Zg==");
  EXPECT_EQ(DataUri("image/webp", "foobar"), "data:image/webp;base64,Zm9vYmFy");
  EXPECT_EQ(DataUri("a/b", std::string("\0\xFF", 2)), "data:a/b;base64,AP8=");
}

}  // namespace data_uri_test
}  // namespace regrasp::report
