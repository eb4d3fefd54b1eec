#include "report/page/condition_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace regrasp::report {
namespace condition_section_test {

using testing::HasSubstr;

std::string SectionOf(const Report& report) {
  std::string text;
  for (const Element& element : MakeConditionSection(report)) text += element.Format();
  return text;
}

TEST(ConditionSectionTest, EachConditionHasABarAndARow) {
  Report report;
  EXPECT_EQ(SectionOf(report), "");
  sim::ConditionSummary& summary = report.conditions.emplace();
  summary.results.resize(3);
  summary.results[0].condition = {"a&b", R"({"mass_factor":0.5})"};
  summary.results[0].margin = 0.5;
  summary.results[1].condition.name = "icy";
  summary.results[1].reason = plan::Reason::kSlipped;
  summary.results[1].margin = -100;
  summary.results[2].condition.name = "torsion";
  summary.results[2].reason = plan::Reason::kSlipped;
  summary.results[2].ends_within = true;
  const std::string text = SectionOf(report);
  EXPECT_THAT(text, HasSubstr("class=\"bar pass\""));
  EXPECT_THAT(text, HasSubstr("class=\"bar fail\""));
  EXPECT_THAT(text, HasSubstr("class=\"bar partly\""));
  EXPECT_THAT(text, HasSubstr("a&amp;b"));
  // The first bar has half of the length at the limit. A bar has a largest length.
  EXPECT_THAT(text, HasSubstr("width=\"120\""));
  EXPECT_THAT(text, HasSubstr("width=\"432\""));
  EXPECT_THAT(text, HasSubstr("1 of 3 pass, 1 of 3 end within the tolerance"));
}

}  // namespace condition_section_test
}  // namespace regrasp::report
