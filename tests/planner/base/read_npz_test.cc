#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/zip_archive.h"
#include "tests/fixtures/project_path.h"

namespace regrasp {
namespace read_npz_test {

using testing::ElementsAre;
using testing::HasSubstr;

/// Read files that numpy wrote, with the numbers 0 to 11 and their negatives.
std::vector<NpzArray> ReadSeed(const std::string& name) {
  const auto path = ProjectPath("tests/fuzz/corpus/npz") / name;
  return ReadNpz(ReadFile(path), name, {"points", "normals"});
}

std::string Complaint(const std::string& bytes) {
  try {
    static_cast<void>(ReadNpz(bytes, "file.npz", {"a"}));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Return the error for an array of two numbers in which a part of the bytes is replaced.
std::string NpyComplaint(const std::string& from, const std::string& to) {
  const std::string npz = FormatNpz({{"a", {2}, {1, 2}}});
  std::string bytes = ZipArchive(npz).Read("a.npy", 1000).value();
  EXPECT_EQ(from.size(), to.size());
  const std::size_t at = bytes.find(from);
  EXPECT_NE(at, std::string::npos);
  bytes.replace(at, from.size(), to);
  try {
    static_cast<void>(ReadNpy(bytes, "a"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReadNpzTest, GivesBackWhatWasWritten) {
  const std::vector<double> values = {1, -0.5, 1e300, 0, 2.25, -7};
  const std::string bytes = FormatNpz({{"a", {2, 3}, values}, {"b", {0, 3}}, {"c", {}, {4}}});
  const auto arrays = ReadNpz(bytes, "file.npz", {"c", "a", "b", "none"});
  ASSERT_EQ(arrays.size(), 3U);
  EXPECT_EQ(arrays[0].name, "c");
  EXPECT_THAT(arrays[0].values, ElementsAre(4));
  EXPECT_TRUE(arrays[0].shape.empty());
  EXPECT_EQ(arrays[1].values, values);
  EXPECT_THAT(arrays[1].shape, ElementsAre(2, 3));
  EXPECT_THAT(arrays[2].shape, ElementsAre(0, 3));
  EXPECT_TRUE(arrays[2].values.empty());
}

TEST(ReadNpzTest, ReadsTruthValues) {
  NpzArray truth{"a", {3}, {1, 0, 1}};
  truth.is_truth = true;
  EXPECT_THAT(ReadNpz(FormatNpz({truth}), "file.npz", {"a"}).front().values, ElementsAre(1, 0, 1));
}

TEST(ReadNpzTest, ReadsWhatNumpyWritesStoredPackedOfEveryTypeAndOrder) {
  int checked = 0;
  for (const std::string name : {"stored.npz", "packed.npz", "mixed.npz"}) {
    const auto arrays = ReadSeed(name);
    ASSERT_EQ(arrays.size(), 2U) << name;
    for (const NpzArray& array : arrays) {
      ASSERT_THAT(array.shape, ElementsAre(1, 4, 3));
      for (int i = 0; i < 12; ++i) {
        const double negative = name == "mixed.npz" ? i > 3 : -i;
        EXPECT_EQ(array.values[i], array.name == "points" ? i : negative) << name;
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 72);
}

/// Return an NPY file of half-precision numbers.
std::string Halves(const std::vector<std::uint16_t>& bits) {
  const std::string npz = FormatNpz({{"a", {bits.size()}, std::vector<double>(bits.size())}});
  std::string bytes = ZipArchive(npz).Read("a.npy", 1000).value();
  bytes.resize(bytes.size() - 8 * bits.size());
  bytes.replace(bytes.find("<f8"), 3, "<f2");
  for (const std::uint16_t half : bits) {
    bytes += static_cast<char>(half & 255);
    bytes += static_cast<char>(half >> 8);
  }
  return bytes;
}

TEST(ReadNpzTest, ReadsHalfPrecision) {
  const auto values =
      ReadNpy(
          Halves({0x3C00, 0xC000, 0x7BFF, 0x0001, 0x03FF, 0x0400, 0x3555, 0x7C00, 0xFC00, 0x7E00}),
          "a")
          .values;
  ASSERT_EQ(values.size(), 10U);
  EXPECT_EQ(values[0], 1);
  EXPECT_EQ(values[1], -2);
  EXPECT_EQ(values[2], 65504);
  EXPECT_EQ(values[3], std::ldexp(1, -24));
  EXPECT_EQ(values[4], std::ldexp(1023, -24));
  EXPECT_EQ(values[5], std::ldexp(1, -14));
  EXPECT_EQ(values[6], 0.333251953125);
  EXPECT_EQ(values[7], INFINITY);
  EXPECT_EQ(values[8], -INFINITY);
  EXPECT_TRUE(std::isnan(values[9]));
}

TEST(ReadNpzTest, WhatIsNoArrayIsNamed) {
  const std::string good = FormatNpz({{"a", {2}, {1, 2}}});
  EXPECT_EQ(Complaint(good), "");
  EXPECT_EQ(Complaint("nothing"), "file.npz: not a ZIP archive");
  EXPECT_EQ(Complaint(good.substr(0, good.size() / 2)), "file.npz: not a ZIP archive");
  // The archive has a checksum of its contents.
  std::string spoilt = good;
  spoilt[spoilt.find("<f8")] = '|';
  EXPECT_EQ(Complaint(spoilt), "file.npz: a.npy: compressed data: corrupt");
  EXPECT_EQ(NpyComplaint("<f8", "<f8"), "");
  EXPECT_THAT(NpyComplaint("<f8", "|O8"), HasSubstr("a: Python objects"));
  EXPECT_EQ(NpyComplaint("<f8", "<c8"), "a: expected an array of numbers, found type c8");
  EXPECT_EQ(NpyComplaint("(2,)", "(9,)"), "a: data: expected 72 bytes for the shape, found 16");
  EXPECT_EQ(NpyComplaint("(2,), }", "(9999,)"),
            "a: data: truncated, the shape requires more bytes than the array has");
  EXPECT_EQ(NpyComplaint("(2,)", "(-2)"), "a: header: expected type, order and shape of numbers");
  EXPECT_EQ(NpyComplaint("NUMPY", "NUMPX"), "a: not an NPY array");
  EXPECT_EQ(NpyComplaint("\n", "x"), "");  // the end of the header does not matter
}

TEST(ReadNpzTest, TextsAreRefused) {
  EXPECT_EQ(Complaint(FormatNpz({{"a", {2}, {}, {"x", "yz"}}})),
            "file.npz: a: expected an array of numbers, found type U2");
}

}  // namespace read_npz_test
}  // namespace regrasp
