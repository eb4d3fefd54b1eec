#pragma once

#include <string>

namespace regrasp::apps {

/// Return the date of the results in UTC: "2026-11-23".
/// If the environment variable SOURCE_DATE_EPOCH is set, it replaces the clock. It is the number of
/// seconds since 1970, as for reproducible builds. The same results can then be made on another
/// day.
/// @throws InputError  if the variable is not a number of seconds up to the year 9999.
[[nodiscard]] std::string RunDate();

}  // namespace regrasp::apps
