#pragma once

#include <functional>
#include <string>

#include "planner/object/object.h"

namespace regrasp {

/// Name of the fuzzed bytes in messages.
inline const std::string kHostileName = "hostile";

/// Number of accepted and rejected inputs since the start of the program.
struct HostileTally {
  int read = 0;
  int refused = 0;
};
[[nodiscard]] HostileTally TallyOfHostileInputs();

/// Run `read` on one input and check the common property: it returns, or it throws InputError with
/// one line that starts with kHostileName. Any other behaviour aborts the program, which a fuzzer
/// reports as a finding.
void ReadHostileInput(const std::function<void()>& read);

/// Abort the program with a message. A target calls it for any fault in the data that it has read.
[[noreturn]] void ReportFinding(const std::string& what);

/// Check the properties of an object that the program relies on: a finite size, a positive volume,
/// faces with unit normals and an area, and each face found at its own points.
void ExpectSound(const object::Object& object);

}  // namespace regrasp
