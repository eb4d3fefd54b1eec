#include "apps/batch/line_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace line_input_test {

using testing::ElementsAre;
using testing::HasSubstr;

class LineInputTest : public FolderTest {
 protected:
  static std::vector<std::pair<std::int64_t, std::string>> All(LinesInput input) {
    std::vector<std::pair<std::int64_t, std::string>> all;
    while (const auto line = input.Next()) all.emplace_back(line->entry, line->text);
    return all;
  }

  std::string Refusal(const std::string& bytes, const Shard& shard = {}) const {
    try {
      (void)LinesInput(Write("a.jsonl", bytes), shard);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

TEST_F(LineInputTest, EveryLineIsAnEntryNumberedFromOne) {
  const std::string bytes = "one\ntwo\n\nfour";
  LinesInput input(Write("a.jsonl", bytes));
  EXPECT_EQ(input.entries(), 4);
  EXPECT_EQ(input.source(), Sha256(bytes));
  EXPECT_FALSE(input.header());
  const auto first = input.Next();
  EXPECT_EQ(first->name, (folder_ / "a.jsonl").string() + ": line 1");
  EXPECT_THAT(All(std::move(input)),
              ElementsAre(std::pair(2, "two"), std::pair(3, ""), std::pair(4, "four")));
  EXPECT_TRUE(All(LinesInput(Write("empty.jsonl", ""))).empty());
}

TEST_F(LineInputTest, AHeaderMayFollowAByteOrderMark) {
  const std::string header = FormatHeader({"plans", 2, {1, 1}, std::string(64, 'a')});
  const LinesInput input(Write("a.jsonl", "\xEF\xBB\xBF" + header + "one\ntwo\n"));
  ASSERT_TRUE(input.header());
  EXPECT_EQ(input.entries(), 2);
  EXPECT_THAT(Refusal(std::string("\xFF\xFE{\0}\0\n\0", 8)),
              HasSubstr("a.jsonl: line 1: text encoding: not supported, expected UTF-8, found "
                        "UTF-16"));
}

TEST_F(LineInputTest, LinesMayEndAsOnWindows) {
  EXPECT_THAT(All(LinesInput(Write("a.jsonl", "one\r\n\r\ntwo\r"))),
              ElementsAre(std::pair(1, "one"), std::pair(2, ""), std::pair(3, "two")));
  std::string header = FormatHeader({"plans", 1, {}, "run"});
  header.insert(header.size() - 1, "\r");
  const LinesInput input(Write("b.jsonl", header + "a\r\n"));
  ASSERT_TRUE(input.header());
  EXPECT_EQ(input.header()->run, "run");
}

TEST_F(LineInputTest, AShardKeepsTheNumbersOfTheWhole) {
  const auto path = Write("a.jsonl", "a\nb\nc\nd\ne\n");
  EXPECT_THAT(All(LinesInput(path, {1, 2})), ElementsAre(std::pair(1, "a"), std::pair(2, "b")));
  EXPECT_THAT(All(LinesInput(path, {2, 2})),
              ElementsAre(std::pair(3, "c"), std::pair(4, "d"), std::pair(5, "e")));
  LinesInput later(path, {2, 2});
  later.SkipTo(5);
  EXPECT_THAT(All(std::move(later)), ElementsAre(std::pair(5, "e")));
}

TEST_F(LineInputTest, AHeaderSaysWhichEntriesFollow) {
  const std::string header = FormatHeader({"plans", 6, {2, 3}, "run"});
  LinesInput input(Write("a.jsonl", header + "c\nd\n"));
  EXPECT_EQ(input.entries(), 6);
  EXPECT_EQ(input.shard(), (Shard{2, 3}));
  EXPECT_EQ(input.source(), "run");
  const auto first = input.Next();
  EXPECT_EQ(first->entry, 3);
  EXPECT_THAT(first->name, HasSubstr("line 2"));
  EXPECT_THAT(All(std::move(input)), ElementsAre(std::pair(4, "d")));
  // A whole file can be split, a shard cannot be split again.
  const std::string whole = FormatHeader({"plans", 2, {}, "run"}) + "a\nb\n";
  EXPECT_THAT(All(LinesInput(Write("b.jsonl", whole), {2, 2})), ElementsAre(std::pair(2, "b")));
  EXPECT_THAT(Refusal(header + "c\nd\n", {1, 2}),
              HasSubstr("a.jsonl: --shard cannot be used with a file that is shard 2 of 3"));
}

TEST_F(LineInputTest, AFileWithMoreOrFewerEntriesThanItsHeaderSaysIsRefused) {
  const std::string header = FormatHeader({"plans", 2, {}, "run"});
  EXPECT_EQ(Refusal(header + "a\nb\n"), "nothing was refused");
  EXPECT_THAT(Refusal(header + "a\n"), HasSubstr("a.jsonl: line 2: truncated after this line"));
  EXPECT_THAT(Refusal(header + "a\nb"), HasSubstr("line 3: truncated inside this line"));
  EXPECT_THAT(Refusal(header + "a\nb\nc\n"), HasSubstr("line 4"));
}

TEST_F(LineInputTest, WhatIsNoFileIsRefused) {
  for (const auto& [path, why] :
       {std::pair(folder_ / "gone", "no such file"), {folder_, "expected a regular file"}}) {
    try {
      (void)LinesInput(path);
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  }
}

TEST_F(LineInputTest, AFileThatShrinksMeanwhileIsNoticed) {
  // Longer than the read-ahead of a stream.
  const std::string line(std::size_t{1} << 16, 'x');
  const auto path = Write("a.jsonl", line + "\n" + line + "\n");
  LinesInput input(path);
  EXPECT_TRUE(input.Next());
  std::filesystem::resize_file(path, 10);
  EXPECT_THROW((void)input.Next(), InputError);
}

}  // namespace line_input_test
}  // namespace regrasp::apps
