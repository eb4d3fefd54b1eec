#include "planner/base/zip_archive.h"

#include <minizip/unzip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/crc.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string_view>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/text_table.h"

namespace regrasp {

namespace {

/// File callbacks of minizip for bytes in memory.
struct MemoryFile {
  std::string_view bytes;
  ZPOS64_T at = 0;

  static MemoryFile& Of(void* opaque) { return *static_cast<MemoryFile*>(opaque); }
  static void* Open(void* opaque, const void*, int) { return opaque; }
  static uLong Read(void* opaque, void*, void* to, uLong size) {
    MemoryFile& file = Of(opaque);
    if (file.at >= file.bytes.size()) return 0;
    const std::string_view piece = file.bytes.substr(file.at, size);
    std::memcpy(to, piece.data(), piece.size());
    file.at += piece.size();
    return static_cast<uLong>(piece.size());
  }
  static ZPOS64_T Tell(void* opaque, void*) { return Of(opaque).at; }
  static long Seek(void* opaque, void*, ZPOS64_T offset, int origin) {
    MemoryFile& file = Of(opaque);
    const ZPOS64_T from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? file.at
                          : origin == ZLIB_FILEFUNC_SEEK_END ? file.bytes.size()
                                                             : 0;
    file.at = from + offset;
    return file.at <= file.bytes.size() ? 0 : -1;
  }
  static int Close(void*, void*) { return 0; }
  static int Error(void*, void*) { return 0; }
};

}  // namespace

class ZipArchive::Impl {
 public:
  explicit Impl(std::string_view bytes)
      : memory_{bytes},
        functions_{MemoryFile::Open, MemoryFile::Read,  nullptr,           MemoryFile::Tell,
                   MemoryFile::Seek, MemoryFile::Close, MemoryFile::Error, &memory_},
        zip_(unzOpen2_64("", &functions_), unzClose) {
    if (!zip_) throw InputError("not a ZIP archive");
  }
  [[nodiscard]] unzFile zip() const { return zip_.get(); }

 private:
  MemoryFile memory_;
  zlib_filefunc64_def functions_;
  std::unique_ptr<void, int (*)(unzFile)> zip_;
};

ZipArchive::ZipArchive(std::string_view bytes) : impl_(std::make_unique<Impl>(bytes)) {}
ZipArchive::~ZipArchive() = default;

std::vector<std::string> ZipArchive::names() {
  std::vector<std::string> names;
  int state = unzGoToFirstFile(impl_->zip());
  for (; state == UNZ_OK; state = unzGoToNextFile(impl_->zip())) {
    std::array<char, 1 << 10> name{};
    if (unzGetCurrentFileInfo64(impl_->zip(), nullptr, name.data(), name.size() - 1, nullptr, 0,
                                nullptr, 0) != UNZ_OK) {
      break;
    }
    names.emplace_back(name.data());
  }
  if (state != UNZ_END_OF_LIST_OF_FILE && !(names.empty() && state == UNZ_PARAMERROR)) {
    throw InputError("archive: list of files: corrupt");
  }
  return names;
}

std::optional<std::string> ZipArchive::Read(const std::string& name, std::size_t most) {
  constexpr int kAnyCase = 2;
  if (unzLocateFile(impl_->zip(), name.c_str(), kAnyCase) != UNZ_OK) return std::nullopt;
  if (unzOpenCurrentFile(impl_->zip()) != UNZ_OK) {
    throw InputError(name +
                     ": header in the archive: corrupt, or its compression is not supported");
  }
  std::string text;
  std::array<char, 1 << 16> piece;
  int count = 0;
  while ((count = unzReadCurrentFile(impl_->zip(), piece.data(), piece.size())) > 0) {
    text.append(piece.data(), static_cast<std::size_t>(count));
    if (text.size() > most) throw InputError(name + ": too large");
  }
  if (count < 0 || unzCloseCurrentFile(impl_->zip()) != UNZ_OK) {
    throw InputError(name + ": compressed data: corrupt");
  }
  return text;
}

namespace {

/// Alignment of the end of NPY headers.
constexpr std::size_t kAlignment = 64;
/// 1 January 1980, the earliest date of ZIP archives. Files must not depend on the clock.
constexpr std::uint16_t kDate = 0x21;
constexpr char32_t kNoCharacter = 0xfffd;
constexpr std::uint16_t kVersion = 20;  ///< version 2.0 of the ZIP format

/// Append an integer in little-endian order.
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

/// Return the common part of a file's local header and its entry in the central directory.
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
  Append(std::uint16_t{0}, header);  // no extra field
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
    list.append(2 + 2 + 2 + 4, '\0');  // comment, disk, internal and external attributes
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

namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

/// Header of an NPY file.
struct Header {
  std::string type;  ///< kind and number of bytes: "f8"
  bool big_endian = false;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t begin = 0;  ///< position of the numbers in the file
};

std::uint64_t UnsignedAt(std::string_view bytes, std::size_t size, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t at = big_endian ? i : size - 1 - i;
    value = value << 8 | static_cast<unsigned char>(bytes[at]);
  }
  return value;
}

std::vector<std::size_t> ParseShape(const std::string& text) {
  std::vector<std::size_t> shape;
  static const std::regex kNumber("[0-9]+");
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it) {
    if (it->str().size() > 15) throw InputError("the shape (" + text + ") is too large");
    shape.push_back(std::stoull(it->str()));
  }
  return shape;
}

/// Parse the dictionary that numpy writes; other dictionaries are not supported.
Header ParseDictionary(const std::string& text) {
  static const std::regex kDescription(R"('descr':\s*'([<>|=])([a-zA-Z]\d*)')");
  static const std::regex kOrder(R"('fortran_order':\s*(True|False))");
  static const std::regex kShape(R"('shape':\s*\(([0-9, ]*)\))");
  std::smatch description, order, shape;
  if (!std::regex_search(text, description, kDescription) ||
      !std::regex_search(text, order, kOrder) || !std::regex_search(text, shape, kShape)) {
    throw InputError("header: expected type, order and shape of numbers");
  }
  Header header;
  header.type = description[2];
  header.big_endian = description[1] == ">";
  header.fortran_order = order[1] == "True";
  header.shape = ParseShape(shape[1]);
  return header;
}

Header ParseHeader(std::string_view bytes) {
  constexpr std::size_t kMostHeader = 4096;  // numpy writes about 100 bytes
  if (bytes.size() < 12 || !bytes.starts_with(kMagic)) throw InputError("not an NPY array");
  const bool is_short = bytes[6] == 1;
  const std::size_t width = is_short ? 2 : 4;
  const std::size_t begin = 8 + width;
  const std::uint64_t size = UnsignedAt(bytes.substr(8), width, false);
  if (size > std::min(bytes.size() - begin, kMostHeader)) throw InputError("header: truncated");
  Header header = ParseDictionary(std::string(bytes.substr(begin, size)));
  header.begin = begin + size;
  return header;
}

/// Conversion of a number from its bytes.
using Number = double (*)(std::uint64_t);

template <typename Integer>
double FromInteger(std::uint64_t bits) {
  return static_cast<double>(static_cast<Integer>(bits));
}

/// Convert a half-precision number (IEEE 754-2008, binary16): sign, 5 bits of exponent, 10 of
/// fraction.
double FromHalf(std::uint64_t bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31);
  const auto fraction = static_cast<double>(bits & 1023);
  double size = std::ldexp(1024 + fraction, exponent - 25);
  if (exponent == 0) size = std::ldexp(fraction, -24);
  if (exponent == 31) {
    size = fraction == 0 ? std::numeric_limits<double>::infinity()
                         : std::numeric_limits<double>::quiet_NaN();
  }
  return (bits >> 15 & 1) != 0 ? -size : size;
}

Number NumberOf(const std::string& type) {
  if (type == "f8") return [](std::uint64_t bits) { return std::bit_cast<double>(bits); };
  if (type == "f4") {
    return [](std::uint64_t bits) -> double {
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    };
  }
  if (type == "f2") return FromHalf;
  if (type == "i8") return FromInteger<std::int64_t>;
  if (type == "i4") return FromInteger<std::int32_t>;
  if (type == "i2") return FromInteger<std::int16_t>;
  if (type == "i1") return FromInteger<std::int8_t>;
  if (type == "u8" || type == "u4" || type == "u2" || type == "u1" || type == "b1") {
    return FromInteger<std::uint64_t>;
  }
  if (type.starts_with("O")) {
    throw InputError("Python objects are not supported, because reading them can run code");
  }
  throw InputError("expected an array of numbers, found type " + type);
}

/// Convert column-major to row-major order.
std::vector<double> Transpose(const std::vector<double>& values,
                              const std::vector<std::size_t>& shape) {
  std::vector<double> result(values.size());
  std::vector<std::size_t> index(shape.size(), 0);
  for (const double value : values) {
    std::size_t place = 0;
    for (std::size_t axis = 0; axis < shape.size(); ++axis)
      place = place * shape[axis] + index[axis];
    result[place] = value;
    for (std::size_t axis = 0; axis < shape.size() && ++index[axis] == shape[axis]; ++axis) {
      index[axis] = 0;
    }
  }
  return result;
}

NpzArray ParseNpy(std::string_view bytes, const std::string& name) {
  Header header = ParseHeader(bytes);
  const Number number = NumberOf(header.type);
  const std::size_t width = std::stoul(header.type.substr(1));
  const std::string_view data = bytes.substr(header.begin);
  std::size_t count = 1;
  for (const std::size_t length : header.shape) {
    if (length > 0 && count > data.size() / length) {
      throw InputError("data: truncated, the shape requires more bytes than the array has");
    }
    count *= length;
  }
  if (data.size() != count * width) {
    throw InputError("data: expected " + std::to_string(count * width) +
                     " bytes for the shape, found " + std::to_string(data.size()));
  }
  NpzArray array{name, header.shape};
  array.values.resize(count);
  const bool plain = header.type == "f8" && !header.big_endian;
  if (plain && std::endian::native == std::endian::little) {
    if (count > 0) std::memcpy(array.values.data(), data.data(), data.size());
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      array.values[i] = number(UnsignedAt(data.substr(i * width), width, header.big_endian));
    }
  }
  if (header.fortran_order) array.values = Transpose(array.values, array.shape);
  return array;
}

}  // namespace

NpzArray ReadNpy(std::string_view bytes, const std::string& name) {
  try {
    return ParseNpy(bytes, name);
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

std::vector<NpzArray> ReadNpz(std::string_view bytes, const std::string& file,
                              const std::vector<std::string>& wanted) {
  std::vector<NpzArray> arrays;
  try {
    ZipArchive archive(bytes);
    for (const std::string& name : wanted) {
      const std::optional<std::string> npy = archive.Read(name + ".npy", kMaxInputBytes);
      if (npy) arrays.push_back(ReadNpy(*npy, name));
    }
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
  return arrays;
}

}  // namespace regrasp
