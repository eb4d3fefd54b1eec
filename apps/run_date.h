#pragma once

#include <string>

namespace regrasp::apps {

/// The day on which results are made, in UTC: "2026-11-23". Of the environment variable
/// SOURCE_DATE_EPOCH where it is set, seconds since 1970 as reproducible builds have it, so that
/// the same results can be made on another day; otherwise of the clock.
/// @throws InputError  the variable is no number of seconds until the year 9999.
[[nodiscard]] std::string RunDate();

}  // namespace regrasp::apps
