#include "planner/base/zip_archive.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>

namespace regrasp {
namespace npz_test {

template <typename Integer>
Integer IntegerAt(const std::string& bytes, std::size_t at) {
  Integer value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    value |= static_cast<Integer>(static_cast<unsigned char>(bytes.at(at + i))) << (8 * i);
  }
  return value;
}

/// Return the files of an archive by its central directory.
std::map<std::string, std::string> Unpack(const std::string& archive) {
  std::map<std::string, std::string> files;
  const std::size_t end = archive.size() - 22;
  EXPECT_EQ(archive.substr(end, 4), "PK\x05\x06");
  std::size_t at = IntegerAt<std::uint32_t>(archive, end + 16);
  for (int i = 0; i < IntegerAt<std::uint16_t>(archive, end + 10); ++i) {
    EXPECT_EQ(archive.substr(at, 4), "PK\x01\x02");
    const auto size = IntegerAt<std::uint32_t>(archive, at + 24);
    const auto name = IntegerAt<std::uint16_t>(archive, at + 28);
    const auto local = IntegerAt<std::uint32_t>(archive, at + 42);
    EXPECT_EQ(archive.substr(local, 4), "PK\x03\x04");
    // Both headers are equal from the version to the lengths.
    EXPECT_EQ(archive.substr(local + 4, 26), archive.substr(at + 6, 26));
    files[archive.substr(at + 46, name)] = archive.substr(local + 30 + name, size);
    at += 46 + name;
  }
  EXPECT_EQ(at, end);
  return files;
}

TEST(NpzTest, NumbersAndTextsStandInTheArchiveAsTheyAre) {
  const std::vector<double> values = {1, -0.5, 1e300, 0, 2.25, -7};
  const auto files = Unpack(FormatNpz({{"grid", {2, 3}, values}, {"names", {2}, {}, {"a", "öl"}}}));
  ASSERT_EQ(files.size(), 2U);
  const std::string& grid = files.at("grid.npy");
  ASSERT_EQ(grid.substr(0, 8), std::string("\x93NUMPY\x01\0", 8));
  const std::size_t header = IntegerAt<std::uint16_t>(grid, 8);
  EXPECT_EQ((10 + header) % 64, 0U);
  EXPECT_EQ(grid.at(9 + header), '\n');
  EXPECT_NE(grid.find("{'descr': '<f8', 'fortran_order': False, 'shape': (2,3,), }"),
            std::string::npos);
  std::vector<double> read(values.size());
  ASSERT_EQ(grid.size(), 10 + header + sizeof(double) * values.size());
  std::memcpy(read.data(), grid.data() + 10 + header, sizeof(double) * read.size());
  EXPECT_EQ(read, values);
  const std::string& names = files.at("names.npy");
  EXPECT_NE(names.find("'<U2'"), std::string::npos);
  const std::size_t texts = 10 + IntegerAt<std::uint16_t>(names, 8);
  EXPECT_EQ(IntegerAt<std::uint32_t>(names, texts), U'a');
  EXPECT_EQ(IntegerAt<std::uint32_t>(names, texts + 4), 0U);
  EXPECT_EQ(IntegerAt<std::uint32_t>(names, texts + 8), U'ö');
  EXPECT_EQ(names.size(), texts + 16);
}

TEST(NpzTest, TheSameArraysGiveTheSameBytesAndOthersAnotherChecksum) {
  const std::string archive = FormatNpz({{"x", {1}, {1}}});
  EXPECT_EQ(archive, FormatNpz({{"x", {1}, {1}}}));
  constexpr std::size_t kChecksum = 14;
  EXPECT_NE(IntegerAt<std::uint32_t>(archive, kChecksum),
            IntegerAt<std::uint32_t>(FormatNpz({{"x", {1}, {2}}}), kChecksum));
}

TEST(NpzTest, AnEmptyArrayHasAHeaderAlone) {
  const auto files = Unpack(FormatNpz({{"none", {0, 7}}}));
  EXPECT_NE(files.at("none.npy").find("(0,7,)"), std::string::npos);
  EXPECT_EQ(files.at("none.npy").size() % 64, 0U);
}

TEST(NpzTest, AShapeThatDoesNotFitIsRefused) {
  EXPECT_THROW((void)FormatNpz({{"x", {2}, {1}}}), std::invalid_argument);
}

}  // namespace npz_test
}  // namespace regrasp
