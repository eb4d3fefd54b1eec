#pragma once

#include <string>

namespace regrasp::apps {

/// The linker's digest of the running program (the ELF note NT_GNU_BUILD_ID), hexadecimal: builds
/// of other sources, by another compiler or with other options have another one. If the linker
/// wrote none, the SHA-256 of the program's file.
[[nodiscard]] std::string BuildId();

}  // namespace regrasp::apps
