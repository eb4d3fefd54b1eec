#include "planner/base/utf8.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace regrasp {

namespace {

struct Range {
  char32_t first, last;
};

constexpr auto kInvisible = std::to_array<Range>({{0x0000, 0x001F},
                                                  {0x007F, 0x009F},
                                                  {0x00AD, 0x00AD},
                                                  {0x061C, 0x061C},
                                                  {0x180E, 0x180E},
                                                  {0x200B, 0x200F},
                                                  {0x2028, 0x202E},
                                                  {0x2060, 0x206F},
                                                  {0xFDD0, 0xFDEF},
                                                  {0xFEFF, 0xFEFF},
                                                  {0xFFF9, 0xFFFB},
                                                  {0xE0000, 0xE007F}});

/// What a leading byte says: how many bytes follow, and between which the first of them lies, so
/// that no character is written longer than need be, none is a surrogate or beyond U+10FFFF.
struct Lead {
  std::size_t following = 0;
  unsigned char least = 0x80, most = 0xBF;
};

Lead LeadOf(unsigned char byte) {
  if (byte >= 0xC2 && byte <= 0xDF) return {1};
  if (byte == 0xE0) return {2, 0xA0, 0xBF};
  if (byte == 0xED) return {2, 0x80, 0x9F};
  if (byte >= 0xE1 && byte <= 0xEF) return {2};
  if (byte == 0xF0) return {3, 0x90, 0xBF};
  if (byte == 0xF4) return {3, 0x80, 0x8F};
  if (byte >= 0xF1 && byte <= 0xF3) return {3};
  return {};
}

}  // namespace

Utf8Character TakeCharacter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const Lead lead = LeadOf(byte(0));
  std::size_t size = 1;
  char32_t code = lead.following == 0 ? byte(0) : byte(0) & (0x3F >> lead.following);
  for (; size <= lead.following && size < text.size(); ++size) {
    const unsigned char least = size == 1 ? lead.least : 0x80, most = size == 1 ? lead.most : 0xBF;
    if (byte(size) < least || byte(size) > most) break;
    code = code << 6 | (byte(size) & 0x3F);
  }
  const bool is_valid = size == lead.following + 1 && (size > 1 || code < 0x80);
  const Utf8Character character{is_valid ? code : 0, text.substr(0, size), is_valid};
  text.remove_prefix(size);
  return character;
}

bool IsInvisible(char32_t code) {
  if ((code & 0xFFFE) == 0xFFFE) return true;  // the last two of every plane are noncharacters
  return std::ranges::any_of(
      kInvisible, [&](const Range& range) { return code >= range.first && code <= range.last; });
}

}  // namespace regrasp
