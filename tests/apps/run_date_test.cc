#include "apps/run_date.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "planner/base/error.h"

namespace regrasp::apps {
namespace run_date_test {

class RunDateTest : public testing::Test {
 protected:
  ~RunDateTest() override { unsetenv("SOURCE_DATE_EPOCH"); }
  static std::string DateAt(const char* seconds) {
    setenv("SOURCE_DATE_EPOCH", seconds, /*overwrite=*/1);
    return RunDate();
  }
};

TEST_F(RunDateTest, IsTheDayInUtcOfTheSecondsGiven) {
  EXPECT_EQ(DateAt("0"), "1970-01-01");
  EXPECT_EQ(DateAt("1709164799"), "2024-02-28");
  EXPECT_EQ(DateAt("1709164800"), "2024-02-29");
  EXPECT_EQ(DateAt("253402300799"), "9999-12-31");
}

TEST_F(RunDateTest, IsOfTheClockWhereNothingIsGiven) {
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_THAT(RunDate(), testing::MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]"));
  EXPECT_EQ(DateAt(""), RunDate());
}

TEST_F(RunDateTest, RefusesWhatAreNoSeconds) {
  for (const char* bad : {"-1", "today", "12x", "253402300800", "99999999999999999999", " 1"}) {
    EXPECT_THROW((void)DateAt(bad), InputError) << bad;
  }
}

}  // namespace run_date_test
}  // namespace regrasp::apps
