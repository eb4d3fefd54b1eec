#pragma once

#include <string>
#include <string_view>

#include "planner/base/json.h"

namespace regrasp::report {

/// The text of a report; where the report has the member `run`, with `run/report_sha256` in it, the
/// SHA-256 of the text without that.
///
/// It tells an edited report from one as it was written. It is no signature: who edits can compute
/// it anew.
/// @param report  `run`, where it is there, is an object.
[[nodiscard]] std::string SealReport(Json report);

/// Whether a text is what SealReport returned for a report with `run`, to the byte.
/// @throws InputError  it is not JSON.
[[nodiscard]] bool IsSealed(std::string_view text);

}  // namespace regrasp::report
