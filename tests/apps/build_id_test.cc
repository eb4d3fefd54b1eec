#include "apps/build_id.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/file.h"

namespace regrasp::apps {
namespace build_id_test {

TEST(BuildIdTest, IsThatInTheFileOfTheRunningProgram) {
  const std::string id = BuildId();
  ASSERT_EQ(id.size(), 40u);
  std::string bytes;
  for (std::size_t i = 0; i < id.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(id.substr(i, 2), nullptr, 16));
  }
  EXPECT_NE(ReadFile("/proc/self/exe").find(bytes), std::string::npos);
  EXPECT_EQ(BuildId(), id);
}

}  // namespace build_id_test
}  // namespace regrasp::apps
