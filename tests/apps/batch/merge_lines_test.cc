#include "apps/batch/merge_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace merge_lines_test {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::int64_t kEntries = 10;

class MergeLinesTest : public FolderTest {
 protected:
  static std::string Text(const LinesHeader& header) {
    std::string text = FormatHeader(header);
    for (std::int64_t entry = header.range().first; entry <= header.range().last; ++entry) {
      text += FormatNoResult(entry, Outcome::kNoPlan, "none") + "\n";
    }
    return text;
  }

  static LinesHeader HeaderOf(const Shard& shard) { return {"plans", kEntries, shard, "run"}; }

  fs::path WriteShard(int number, int count) const {
    return Write("shard" + std::to_string(number) + "of" + std::to_string(count),
                 Text(HeaderOf({number, count})));
  }

  std::vector<fs::path> WriteShards(int count) const {
    std::vector<fs::path> files;
    for (int number = 1; number <= count; ++number) files.push_back(WriteShard(number, count));
    return files;
  }

  std::string Refusal(const std::vector<fs::path>& files) const {
    try {
      (void)MergeLines(FindShards(files), merged(), false);
    } catch (const InputError& error) {
      EXPECT_FALSE(fs::exists(merged()));
      EXPECT_FALSE(fs::exists(merged().string() + ".part"));
      return error.what();
    }
    return "nothing was refused";
  }

  [[nodiscard]] fs::path merged() const { return folder_ / "merged"; }
};

TEST_F(MergeLinesTest, ShardsInAnyOrderGiveTheBytesOfOneRun) {
  int checked = 0;
  for (const int count : {1, 3, 4, 10, 13}) {
    std::vector<fs::path> files = WriteShards(count);
    std::rotate(files.begin(), files.begin() + count / 2, files.end());
    EXPECT_EQ(MergeLines(FindShards(files), merged(), false),
              (OutcomeCounts{{Outcome::kNoPlan, kEntries}}));
    EXPECT_EQ(ReadFile(merged()), Text(HeaderOf({})));
    fs::remove(merged());
    ++checked;
  }
  EXPECT_EQ(checked, 5);
}

TEST_F(MergeLinesTest, AShardThatIsMissingIsNamed) {
  std::vector<fs::path> files = WriteShards(4);
  files.erase(files.begin() + 3);
  EXPECT_EQ(Refusal(files), "--shards: 1 of 4 shards not found: numbers 4");
  files.erase(files.begin());
  EXPECT_EQ(Refusal(files), "--shards: 2 of 4 shards not found: numbers 1, 4");
}

TEST_F(MergeLinesTest, ShardsThatOverlapAreNamed) {
  std::vector<fs::path> files = WriteShards(4);
  files.push_back(Write("again", Text(HeaderOf({2, 4}))));
  EXPECT_THAT(Refusal(files), AllOf(HasSubstr("again: line 1: shard 2 of 4 must be given once"),
                                    HasSubstr("shard2of4")));
  files.back() = WriteShard(2, 3);
  EXPECT_THAT(Refusal(files),
              HasSubstr("shard2of3: line 1: expected a shard of 4, found shard 2 of 3"));
}

TEST_F(MergeLinesTest, ShardsOfDifferentRunsDoNotMix) {
  std::vector<fs::path> files = WriteShards(2);
  LinesHeader other = HeaderOf({2, 2});
  other.run = "other";
  files[1] = Write("other", Text(other));
  EXPECT_THAT(Refusal(files), HasSubstr("other: line 1: belongs to a run with different input"));
  other = HeaderOf({2, 2});
  other.entries = kEntries + 1;
  files[1] = Write("other", Text(other));
  EXPECT_THAT(Refusal(files), HasSubstr("other: line 1: belongs to a run with different input"));
  other = HeaderOf({2, 2});
  other.content = "reports";
  files[1] = Write("other", Text(other));
  EXPECT_THAT(Refusal(files), HasSubstr("other: line 1: expected plans, found reports"));
}

TEST_F(MergeLinesTest, AShardThatWasCutOrEditedIsNamedWithItsLine) {
  std::vector<fs::path> files = WriteShards(2);
  const std::string whole = ReadFile(files[0]);
  const std::size_t line = FormatNoResult(1, Outcome::kNoPlan, "none").size() + 1;
  const auto refusal_of = [&](const std::string& bytes) {
    WriteFile(files[0], bytes);
    return Refusal(files);
  };
  EXPECT_THAT(refusal_of(whole.substr(0, whole.size() - line)),
              HasSubstr("shard1of2: line 6: entry 5 not found"));
  EXPECT_THAT(refusal_of(whole.substr(0, whole.size() - 1)),
              HasSubstr("shard1of2: line 6: truncated"));
  EXPECT_THAT(refusal_of(whole.substr(0, whole.size() - 4) + "\n"),
              HasSubstr("shard1of2: line 6: expected the result of entry 5"));
  EXPECT_THAT(refusal_of(whole + "\n"), HasSubstr("shard1of2: line 7: follows the last entry"));
  EXPECT_THAT(refusal_of(whole.substr(FormatHeader(HeaderOf({1, 2})).size())),
              HasSubstr("shard1of2: line 1: expected a header"));
  EXPECT_EQ(refusal_of(whole), "nothing was refused");
}

TEST_F(MergeLinesTest, WhatIsNoFileIsRefused) {
  EXPECT_THAT(Refusal({folder_ / "gone"}), HasSubstr("gone: no such file"));
  EXPECT_THAT(Refusal({folder_}), HasSubstr("found a folder"));
}

}  // namespace merge_lines_test
}  // namespace regrasp::apps
