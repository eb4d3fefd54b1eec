#pragma once

#include <string>

namespace regrasp::apps {

/// Return the linker's digest of the running program, hexadecimal.
/// It is the ELF note NT_GNU_BUILD_ID. Builds from different sources, by a different compiler or
/// with different options have different digests. If the linker wrote none, it is the SHA-256 of
/// the program's file.
[[nodiscard]] std::string BuildId();

}  // namespace regrasp::apps
