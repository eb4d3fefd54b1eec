#include "planner/base/npz.h"

#include <algorithm>
#include <bit>
#include <boost/crc.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "planner/base/utf8.h"

namespace regrasp {
namespace {

/// NPY headers end at a multiple of this.
constexpr std::size_t kAlignment = 64;
/// 1 January 1980, the first day that a ZIP archive knows: files do not depend on the clock.
constexpr std::uint16_t kDate = 0x21;
constexpr char32_t kNoCharacter = 0xfffd;
constexpr std::uint16_t kVersion = 20;  ///< of the ZIP format, 2.0

/// The lowest byte first.
template <typename Integer>
void Append(Integer value, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
  }
}

std::u32string Decode(std::string_view text) {
  std::u32string decoded;
  while (!text.empty()) {
    const Utf8Character character = TakeCharacter(text);
    decoded += character.is_valid ? character.code : kNoCharacter;
  }
  return decoded;
}

std::string FormatNpy(const NpzArray& array) {
  const std::size_t count =
      std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies());
  if (count != std::max(array.values.size(), array.texts.size())) {
    throw std::invalid_argument("the shape of the array " + array.name + " does not fit");
  }
  std::vector<std::u32string> texts;
  std::size_t width = 1;
  for (const std::string& text : array.texts) {
    width = std::max(width, texts.emplace_back(Decode(text)).size());
  }
  std::string header = "{'descr': '" +
                       (!array.texts.empty() ? "<U" + std::to_string(width)
                        : array.is_truth     ? "|b1"
                                             : "<f8") +
                       "', 'fortran_order': False, 'shape': (";
  for (const std::size_t length : array.shape) header += std::to_string(length) + ",";
  header += "), }";
  std::string bytes = "\x93NUMPY\x01";
  bytes += '\0';
  const std::size_t begin = bytes.size() + sizeof(std::uint16_t);
  header.append(kAlignment - 1 - (begin + header.size()) % kAlignment, ' ');
  header += '\n';
  Append(static_cast<std::uint16_t>(header.size()), bytes);
  bytes += header;
  for (const double value : array.values) {
    if (array.is_truth) {
      bytes += static_cast<char>(value != 0);
    } else {
      Append(std::bit_cast<std::uint64_t>(value), bytes);
    }
  }
  for (std::u32string& text : texts) {
    text.resize(width, U'\0');
    for (const char32_t character : text) Append(character, bytes);
  }
  return bytes;
}

/// What a file's own header and its place in the list of the archive have in common.
std::string FileHeader(const std::string& name, const std::string& bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::string header;
  Append(kVersion, header);
  Append(std::uint16_t{0}, header);  // flags
  Append(std::uint16_t{0}, header);  // not compressed
  Append(std::uint16_t{0}, header);  // midnight
  Append(kDate, header);
  Append(static_cast<std::uint32_t>(crc.checksum()), header);
  Append(size, header);
  Append(size, header);
  Append(static_cast<std::uint16_t>(name.size()), header);
  Append(std::uint16_t{0}, header);  // nothing more about it
  return header;
}

}  // namespace

std::string FormatNpz(const std::vector<NpzArray>& arrays) {
  std::string archive;
  std::string list;
  for (const NpzArray& array : arrays) {
    const std::string name = array.name + ".npy";
    const std::string bytes = FormatNpy(array);
    if (archive.size() + bytes.size() > std::numeric_limits<std::uint32_t>::max() / 2) {
      throw std::length_error("NPZ: the array " + array.name + " is too large");
    }
    const std::string header = FileHeader(name, bytes);
    list += "PK\x01\x02";
    Append(kVersion, list);
    list += header;
    list.append(2 + 2 + 2 + 4, '\0');  // comment, disk, attributes inside and outside
    Append(static_cast<std::uint32_t>(archive.size()), list);
    list += name;
    archive += "PK\x03\x04" + header + name + bytes;
  }
  std::string end = "PK\x05\x06";
  end.append(4, '\0');  // disks
  Append(static_cast<std::uint16_t>(arrays.size()), end);
  Append(static_cast<std::uint16_t>(arrays.size()), end);
  Append(static_cast<std::uint32_t>(list.size()), end);
  Append(static_cast<std::uint32_t>(archive.size()), end);
  Append(std::uint16_t{0}, end);
  return archive + list + end;
}

}  // namespace regrasp
