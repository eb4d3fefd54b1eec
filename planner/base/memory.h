#pragma once

#include <functional>
#include <string>

namespace regrasp {

/// Bytes that one structure may take without asking: half of the memory that there is, the least of
/// the machine's, the address space that the process may have (RLIMIT_AS) and that of its control
/// group.
[[nodiscard]] double UsableMemory();

/// Bytes for people: "11.6 GB".
[[nodiscard]] std::string FormatBytes(double bytes);

/// What a planner is about to build, and what that takes.
struct MemoryNeed {
  std::string what;                      ///< "the graph of the planner polygon"
  int count = 0;                         ///< of what it is built on
  std::string units;                     ///< "edges"
  std::function<double(int)> bytes_for;  ///< bytes for so many units, growing with them

  [[nodiscard]] double bytes() const { return bytes_for(count); }
};

/// Why so much is not to be built, and how many units would fit; empty where `limit` bytes are
/// enough.
[[nodiscard]] std::string MemoryComplaint(const MemoryNeed& need, double limit);

}  // namespace regrasp
