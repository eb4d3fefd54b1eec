#include "apps/run_date.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <system_error>

#include "planner/base/error.h"

namespace regrasp::apps {
namespace {

constexpr const char* kVariable = "SOURCE_DATE_EPOCH";
constexpr std::time_t kLatest = 253402300799;  // last second of the year 9999

std::time_t Seconds() {
  const char* value = std::getenv(kVariable);
  if (value == nullptr || *value == '\0') {
    return std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  }
  const std::string_view text = value;
  std::time_t seconds = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size() || seconds < 0 ||
      seconds > kLatest) {
    throw InputError(std::string(kVariable) +
                     ": must be seconds since 1970-01-01 (date +%s), found \"" + value + "\"");
  }
  return seconds;
}

}  // namespace

std::string RunDate() {
  const std::time_t seconds = Seconds();
  std::tm day = {};
  gmtime_r(&seconds, &day);
  std::array<char, sizeof "2026-11-23"> text = {};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%d", &day);
  return {text.data(), size};
}

}  // namespace regrasp::apps
