#include "planner/base/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace regrasp {
namespace memory_test {

using ::testing::HasSubstr;

/// Return whether UsableMemory is half of `bytes` if these limit the address space of the process.
bool HalvesItsAddressSpace(rlim_t bytes) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_AS, &limit);
    _exit(UsableMemory() == static_cast<double>(bytes) / 2 ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Memory, HalfOfWhatThereIsMayBeUsed) {
  const double installed =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(UsableMemory(), 0);
  EXPECT_LE(UsableMemory(), installed / 2);
  if (!kSanitizer) {
    EXPECT_TRUE(HalvesItsAddressSpace(rlim_t{1} << 29));
  }
}

TEST(Memory, BytesAreSaidInTheirUnits) {
  EXPECT_EQ(FormatBytes(15.83e9), "15.8 GB");
  EXPECT_EQ(FormatBytes(2e13), "20 TB");
  EXPECT_EQ(FormatBytes(12), "12 bytes");
}

TEST(Memory, WhatDoesNotFitIsRefusedWithWhatWould) {
  const MemoryNeed need{"the graph", 1000, "edges", [](double n) { return 8 * n * n * n; }};
  EXPECT_EQ(need.bytes(), 8e9);
  EXPECT_EQ(MemoryComplaint(need, 8e9), "");
  EXPECT_THAT(MemoryComplaint(need, 1e9), HasSubstr("the graph: 1000 edges require about 8 GB"));
  EXPECT_THAT(MemoryComplaint(need, 1e9), HasSubstr("limit 1 GB"));
  EXPECT_THAT(MemoryComplaint(need, 1e9), HasSubstr("about 500 edges fit"));
  EXPECT_THAT(MemoryComplaint(need, 1), HasSubstr("about 0 edges fit"));
}

}  // namespace memory_test
}  // namespace regrasp
