#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace regrasp::object {

/// How a child process ended.
enum class ChildEnd {
  kDone,         ///< it sent everything
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
  bool opens_files = false;  ///< otherwise it may use what is open already, and no more
};

/// Runs `task` in a forked child with limits and returns the bytes that it returned there.
///
/// For code that may crash, hang or exhaust memory. The child prints nothing, leaves no core
/// file and runs no destructor or exit handler of this process. Where the program is built
/// with the address sanitizer, neither memory nor files are limited: it reserves more than any
/// limit and opens pipes.
/// @throws EnvironmentError  the process or the pipe cannot be made.
[[nodiscard]] ChildResult RunInLimitedChild(const std::function<std::string()>& task,
                                            const ChildLimits& limits);

}  // namespace regrasp::object
