#include "report/page/data_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace regrasp::report {
namespace data_table_test {

using testing::HasSubstr;
using testing::Not;

std::string Format(int rows) {
  DataTable table{"things", "things", Element("tr", {}, Element("th", {}, "Name")), {}};
  for (int i = 0; i < rows; ++i) {
    table.rows.emplace_back("tr", Attributes(), Element("td", {}, "row " + std::to_string(i)));
  }
  std::string text;
  for (const Element& part : MakeDataTable(table)) text += part.Format();
  return text;
}

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(DataTableTest, ASmallTableHasOneBody) {
  const std::string text = Format(static_cast<int>(kFirstRows));
  EXPECT_EQ(Count(text, "<tbody>"), 1u);
  EXPECT_THAT(text, Not(HasSubstr("<noscript")));
  EXPECT_THAT(text, HasSubstr("data-count=\"500\""));
  EXPECT_THAT(text, HasSubstr(">row 499<"));
}

TEST(DataTableTest, EachRowOfALargeTableOccursOnceAndInOrder) {
  const int count = 2 * static_cast<int>(kFirstRows) + 1;
  const std::string text = Format(count);
  EXPECT_EQ(Count(text, "<td>"), static_cast<std::size_t>(count));
  EXPECT_EQ(Count(text, "<tbody>"), 3u);
  const auto rest = text.find("<noscript id=\"things-rest\">");
  ASSERT_NE(rest, std::string::npos);
  EXPECT_LT(text.find(">row 499<"), rest);
  EXPECT_GT(text.find(">row 500<"), rest);
  EXPECT_EQ(Count(text, "<thead>"), 2u);
}

TEST(DataTableTest, AnEmptyTableHasItsHead) {
  const std::string text = Format(0);
  EXPECT_EQ(Count(text, "<thead>"), 1u);
  EXPECT_EQ(Count(text, "<td>"), 0u);
}

TEST(DataTableTest, TheScriptReadsAsManyRowsPerPart) {
  EXPECT_THAT(std::string(DataTableScript()),
              HasSubstr("const part = " + std::to_string(kFirstRows) + ";"));
}

TEST(DataTableTest, AValueIsEscaped) {
  EXPECT_EQ(ValueCell("\"<", "<b>").Format(),
            "<td class=\"number\" data-value=\"&quot;&lt;\">&lt;b&gt;</td>");
}

}  // namespace data_table_test
}  // namespace regrasp::report
