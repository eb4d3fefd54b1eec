#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace regrasp::object {

/// Result of a child process.
enum class ChildEnd {
  kDone,         ///< it returned all bytes
  kThrew,        ///< `task` threw; `bytes` is the message
  kTookTooLong,  ///< killed at the limit of wall or processor time
  kCrashed,      ///< killed by a signal, or out of memory
};

struct ChildResult {
  ChildEnd end = ChildEnd::kCrashed;
  std::string bytes;
};

struct ChildLimits {
  std::size_t memory_bytes;
  std::chrono::seconds processor;
  std::chrono::milliseconds wall;
  bool opens_files = false;  ///< whether the child can open files
};

/// Run `task` in a forked child process with limits and return its bytes.
///
/// Use it for code that may crash, hang or exhaust memory. The child prints nothing, writes no core
/// file and runs no destructor or exit handler of this process. In a build with the address
/// sanitizer, memory and files are not limited, because the sanitizer allocates more address space
/// than any limit and opens pipes.
/// @throws EnvironmentError  if the process or the pipe cannot be created.
[[nodiscard]] ChildResult RunInLimitedChild(const std::function<std::string()>& task,
                                            const ChildLimits& limits);

}  // namespace regrasp::object
