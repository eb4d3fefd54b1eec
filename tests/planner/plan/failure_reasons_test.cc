#include "planner/plan/failure_reasons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planner/plan/reason.h"

namespace regrasp::plan {

namespace failure_reasons_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

using Entries = std::vector<FailureReason>;

/// Return the names of all reasons of the report that have no complete entry, in report order.
std::vector<std::string> MissingFrom(const Entries& entries) {
  std::vector<std::string> missing;
  for (Reason reason = Reason::kOffSurface; reason <= Reason::kGoalNotReached;
       reason = static_cast<Reason>(static_cast<int>(reason) + 1)) {
    const auto found = std::ranges::find(entries, ReasonName(reason), &FailureReason::name);
    if (found == entries.end() || found->check == FailureCheck::kCause || found->meaning.empty() ||
        found->causes.empty() || found->remedies.empty()) {
      missing.emplace_back(ReasonName(reason));
    }
  }
  return missing;
}

Entries AllEntries() { return {FailureReasons().begin(), FailureReasons().end()}; }

TEST(FailureReasons, HaveACompleteEntryForEveryReason) {
  EXPECT_THAT(MissingFrom(AllEntries()), IsEmpty());
}

TEST(FailureReasons, WithoutAnEntryOrAFieldAreFoundMissing) {
  Entries entries = AllEntries();
  std::erase_if(entries, [](const FailureReason& entry) { return entry.name == "slipped"; });
  std::ranges::find(entries, "joint-limit", &FailureReason::name)->remedies = "";
  std::ranges::find(entries, "off-point", &FailureReason::name)->check = FailureCheck::kCause;
  EXPECT_THAT(MissingFrom(entries), ElementsAre("off-point", "joint-limit", "slipped"));
}

TEST(FailureReasons, AreInTheOrderOfTheReport) {
  std::vector<std::string_view> table, report;
  for (const FailureReason& entry : FailureReasons()) {
    if (entry.check != FailureCheck::kCause && entry.check != FailureCheck::kTrials) {
      table.push_back(entry.name);
    }
  }
  for (int i = 1; i <= static_cast<int>(Reason::kGoalNotReached); ++i) {
    report.push_back(ReasonName(static_cast<Reason>(i)));
  }
  EXPECT_EQ(table, report);
}

TEST(FailureReasons, HaveUniqueNamesAndAreFoundByThem) {
  for (const FailureReason& entry : FailureReasons()) {
    EXPECT_EQ(FindFailureReason(entry.name), &entry) << entry.name;
  }
  EXPECT_EQ(FindFailureReason("slippd"), nullptr);
  EXPECT_EQ(FindFailureReason(""), nullptr);
}

TEST(FailureReasons, BecomeSectionsWithTheirNameAsHeading) {
  const std::string text = FailureReasonMarkdown(*FindFailureReason("torque-limit"));
  const std::string linked = FailureReasonMarkdown(*FindFailureReason("tip-penetrates"));
  EXPECT_THAT(text, StartsWith("### `torque-limit`\n\nWith"));
  EXPECT_THAT(text, HasSubstr("\n\nUsual causes:\n\n- The grasp force"));
  EXPECT_THAT(text,
              HasSubstr("\n\nRemedies:\n\n- Use a smaller grasp force (--squeeze).\n- Use a"));
  EXPECT_THAT(text, Not(HasSubstr("See [")));
  EXPECT_THAT(linked, HasSubstr("\nSee [fingertip geometry](fingertip_geometry.md).\n"));
}

}  // namespace failure_reasons_test

}  // namespace regrasp::plan
