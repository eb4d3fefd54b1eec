#pragma once

#include <functional>
#include <string>

namespace regrasp {

/// Return the memory that one data structure may use, in bytes.
/// It is half of the minimum of the machine's memory, the address space limit of the process
/// (RLIMIT_AS) and the limit of its control group.
[[nodiscard]] double UsableMemory();

/// Format a number of bytes for users: "11.6 GB".
[[nodiscard]] std::string FormatBytes(double bytes);

/// Memory required by a data structure that a planner is about to build.
struct MemoryNeed {
  std::string what;                      ///< "the graph of the planner polygon"
  int count = 0;                         ///< size of the input in `units`
  std::string units;                     ///< "edges"
  std::function<double(int)> bytes_for;  ///< bytes required for a number of units, increasing

  [[nodiscard]] double bytes() const { return bytes_for(count); }
};

/// Describe why a data structure is too large, and how many units fit.
/// @returns empty if `limit` bytes suffice.
[[nodiscard]] std::string MemoryComplaint(const MemoryNeed& need, double limit);

/// Whether this is a build for the address or thread sanitizer.
/// Both require more address space than any limit, and the address sanitizer opens a pipe to test
/// memory. GCC defines macros for them, clang features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kSanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitizer = false;
#endif

}  // namespace regrasp
