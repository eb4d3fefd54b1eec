#include "mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace regrasp {

namespace {

/// Longest piece that one change deletes, duplicates or copies.
constexpr std::size_t kLongestPiece = 64;
constexpr std::size_t kMostChanges = 4;

/// Critical texts for readers: limits of ranges, overflowing numbers, brackets, line ends.
constexpr std::array<std::string_view, 22> kTokens = {
    "0",          "-0",
    "-1",         "1e308",
    "1e-308",     "1e15",
    "5e-324",     "89.999999999999999",
    "nan",        "-inf",
    "2147483648", "18446744073709551616",
    "[]",         "{}",
    "null",       "\"\"",
    "\n",         "\r",
    "(",          ")",
    ",",          std::string_view("\0\0\0\0", 4)};

/// std::uniform_int_distribution may differ between libraries; the slight bias does not matter.
std::size_t Below(std::size_t count, std::mt19937_64& random) { return random() % count; }

std::size_t PieceLength(std::size_t available, std::mt19937_64& random) {
  return 1 + Below(std::min(available, kLongestPiece), random);
}

/// Replace the digits at a random position, if there are any, by an extreme number.
void ReplaceNumber(std::string& bytes, std::string_view token, std::mt19937_64& random) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) || c == '.' || c == '-'; };
  const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(Below(bytes.size(), random));
  const auto first = std::find_if(from, bytes.end(), is_digit);
  bytes.replace(first, std::find_if_not(first, bytes.end(), is_digit), token);
}

void ChangeOnce(std::string& bytes, const std::string& other, std::mt19937_64& random) {
  if (bytes.empty()) bytes = "0";
  const std::size_t at = Below(bytes.size(), random);
  const std::size_t length = PieceLength(bytes.size() - at, random);
  const std::string_view token = kTokens[Below(kTokens.size(), random)];
  switch (Below(8, random)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << Below(8, random)));
      break;
    case 1:
      bytes[at] = static_cast<char>(Below(256, random));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 4:
      bytes.insert(at, token);
      break;
    case 5:
      ReplaceNumber(bytes, token, random);
      break;
    case 6:
      bytes.resize(at);
      break;
    default:
      if (other.empty()) break;
      bytes.replace(at, length, other.substr(Below(other.size(), random), kLongestPiece));
  }
}

}  // namespace

std::string Mutate(std::string input, std::span<const std::string> others,
                   std::mt19937_64& random) {
  // Half of the mutations have a single change, because few inputs are still accepted after more.
  const std::size_t changes = Below(2, random) == 0 ? 1 : 2 + Below(kMostChanges - 1, random);
  for (std::size_t k = 0; k < changes; ++k) {
    ChangeOnce(input, others[Below(others.size(), random)], random);
  }
  return input;
}

}  // namespace regrasp
