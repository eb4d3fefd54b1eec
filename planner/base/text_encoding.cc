#include "planner/base/text_encoding.h"

#include <array>
#include <optional>

#include "planner/base/error.h"

namespace regrasp {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF"sv;

struct EncodingMark {
  std::string_view mark;
  std::string_view encoding;
};

/// The marks of UTF-32 come first because the little-endian one begins with that of UTF-16.
constexpr auto kMarks = std::to_array<EncodingMark>({{"\xFF\xFE\0\0"sv, "UTF-32"sv},
                                                     {"\0\0\xFE\xFF"sv, "UTF-32"sv},
                                                     {"\xFF\xFE"sv, "UTF-16"sv},
                                                     {"\xFE\xFF"sv, "UTF-16"sv}});

/// Return the encoding of text in UTF-16 or UTF-32, otherwise nullopt.
/// ASCII text has no zero bytes; in UTF-16 every second byte of it is zero.
std::optional<std::string_view> WideEncoding(std::string_view bytes) {
  for (const auto& [mark, encoding] : kMarks) {
    if (bytes.starts_with(mark)) return encoding;
  }
  constexpr std::size_t kTwoCharacters = 4;
  if (bytes.size() < kTwoCharacters) return std::nullopt;
  const auto is_zero = [&](std::size_t k) { return bytes[k] == '\0'; };
  const bool low_first = !is_zero(0) && is_zero(1) && !is_zero(2) && is_zero(3);
  const bool high_first = is_zero(0) && !is_zero(1) && is_zero(2) && !is_zero(3);
  if (low_first || high_first) return "UTF-16"sv;
  const bool low_of_four = !is_zero(0) && is_zero(1) && is_zero(2) && is_zero(3);
  const bool high_of_four = is_zero(0) && is_zero(1) && is_zero(2) && !is_zero(3);
  if (low_of_four || high_of_four) return "UTF-32"sv;
  return std::nullopt;
}

}  // namespace

std::string_view TextOf(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with(kUtf8Mark)) return bytes.substr(kUtf8Mark.size());
  if (const auto encoding = WideEncoding(bytes)) {
    throw InputError(name + ": text encoding: not supported, expected UTF-8, found " +
                     std::string(*encoding) + "; help: save the file as UTF-8");
  }
  return bytes;
}

}  // namespace regrasp
