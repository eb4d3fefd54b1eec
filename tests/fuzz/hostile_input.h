#pragma once

#include <functional>
#include <string>

#include "planner/object/object.h"

namespace regrasp {

/// What messages call the bytes that a fuzzer made up.
inline const std::string kHostileName = "hostile";

/// How many inputs were read and how many refused since the program started.
struct HostileTally {
  int read = 0;
  int refused = 0;
};
[[nodiscard]] HostileTally TallyOfHostileInputs();

/// Runs `read` on one input and demands what holds of every input: it returns, or it throws
/// InputError with one line that starts with kHostileName. Anything else aborts the program, which
/// is what a fuzzer takes for a finding.
void ReadHostileInput(const std::function<void()>& read);

/// Aborts the program with a message; for whatever a target finds wrong with what it has read.
[[noreturn]] void ReportFinding(const std::string& what);

/// Demands of an object that was read what the rest of the program relies on: a finite size, a
/// positive volume, faces with unit normals and an area, and each face found where it is.
void ExpectSound(const object::Object& object);

}  // namespace regrasp
