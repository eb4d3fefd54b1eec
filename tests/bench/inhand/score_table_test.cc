#include "bench/inhand/score_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::bench {
namespace score_table_test {

using testing::HasSubstr;

Row Passing(const std::string& task, const std::string& hand, double mm) {
  Row row;
  row.task = task;
  row.group = "g";
  row.body = "b";
  row.hand = hand;
  row.limit_s = 8;
  row.seconds = 2.5;
  row.found = row.passed = true;
  row.switches = 3;
  row.moves = 4;
  row.error = {1e-3 * mm, Radians(0.5)};
  return row;
}

Row Failing(const std::string& task, const std::string& hand, const std::string& reason) {
  Row row = Passing(task, hand, 0);
  row.passed = false;
  row.found = reason != kNoPlan;
  row.reason = reason;
  row.error.reset();
  return row;
}

Task Named(const std::string& name) {
  Task task;
  task.name = name;
  task.group = "g";
  return task;
}

TEST(Rows, ReadBackAsTheyWereWritten) {
  Row row = Failing("t", "h", "slipped");
  row.detail = "a \"tip\"\nslid";
  for (const Row& given : {row, Passing("t", "h", 1.25)}) {
    const auto rows = ParseRows(FormatRow(given), "rows");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(FormatRow(rows.front()), FormatRow(given));
    EXPECT_EQ(rows.front().detail, given.detail);
  }
}

TEST(Rows, AreRefusedWithTheirLine) {
  const std::string good = FormatRow(Passing("t", "h", 1));
  EXPECT_THROW((void)ParseRows(good + "{}\n", "rows"), InputError);
  try {
    (void)ParseRows(good + "{}\n", "rows");
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("rows: line 2: not a row"));
  }
}

class RowFiles : public FolderTest {};

TEST_F(RowFiles, LastRowOfATaskHandAndPlannerCounts) {
  const auto path = folder_ / "rows.jsonl";
  EXPECT_TRUE(ReadRows(path).empty());
  Row other = Passing("t", "h", 3);
  other.planner = "other";
  AppendRows(path, FormatRow(Failing("t", "h", "slipped")));
  AppendRows(path, FormatRow(other) + FormatRow(Passing("t", "h", 1)));
  const auto rows = ReadRows(path);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].planner, "other");
  EXPECT_TRUE(rows[1].passed);
}

TEST(ScoreTables, CountPassesAndNameReasons) {
  const std::vector<Row> rows = {Passing("t2", "ring", 2), Passing("t1", "ring", 1),
                                 Failing("t3", "ring", "slipped"), Failing("t1", "leap", kNoPlan)};
  const std::string text = ScoreTables(rows, {Named("t1"), Named("t2"), Named("t3")});
  EXPECT_THAT(text, HasSubstr("| ring | 3 of 3 | 2 of 3 | 2.5 | 3.0 | 4.0 | 1.500, 2.000 | "
                              "0.500, 0.500 | slipped 1 |"));
  EXPECT_THAT(text, HasSubstr("### g\n\nAt most 8 s of processor time"));
  EXPECT_THAT(text, HasSubstr("| leap | 0 of 1 | 0 of 1 | – | – | – | – | – | no-plan 1 |"));
  EXPECT_THAT(text, HasSubstr("| task | ring | leap |\n| --- | --- | --- |\n"
                              "| t1 | pass | no-plan |\n| t2 | pass |  |\n| t3 | slipped |  |\n"));
}

TEST(ScoreTables, HaveARowForPlansOfOthers) {
  Row other = Passing("t1", "ring", 1);
  other.planner = "other";
  other.seconds.reset();
  EXPECT_THAT(ScoreTables({Passing("t1", "ring", 2), other}, {Named("t1")}),
              HasSubstr("| ring, other | 1 of 1 | 1 of 1 | – | 3.0 |"));
}

TEST(ScoreTables, StandBetweenMarkers) {
  const std::string text = "a\n<!-- scoreboard: begin -->\nold\n<!-- scoreboard: end -->\nb\n";
  const std::string made = ReplaceBetweenMarkers(text, "new\n", "x.md");
  EXPECT_EQ(made, "a\n<!-- scoreboard: begin -->\n\nnew\n<!-- scoreboard: end -->\nb\n");
  EXPECT_EQ(ReplaceBetweenMarkers(made, "new\n", "x.md"), made);
  EXPECT_THROW((void)ReplaceBetweenMarkers("no markers", "new", "x.md"), InputError);
}

}  // namespace score_table_test
}  // namespace regrasp::bench
