#pragma once

#include <vector>

#include "report/markup.h"
#include "report/report.h"

namespace regrasp::report {

/// Make the section with the results of a hand replay in each engine; empty for other replays.
[[nodiscard]] std::vector<Element> MakeEngineSection(const Report& report);

}  // namespace regrasp::report
