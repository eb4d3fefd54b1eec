#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <clocale>
#include <filesystem>
#include <fstream>
#include <locale>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/limited_child.h"
#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_object.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::object {
namespace mesh_readers_test {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::filesystem::path kGood = ProjectPath("tests/data/objects/good");

TEST(MeshReaders, CoordinatesAreDoubles) {
  const PolygonSoup soup = ReadObj("v 0.1 -1e-300 12345678.901234567\nf 1 1 1\n", "t");
  EXPECT_EQ(soup.vertices.at(0), Vector3d(0.1, -1e-300, 12345678.901234567));
}

TEST(MeshReaders, ObjKeepsPolygonsAndResolvesIndices) {
  const PolygonSoup soup = ReadObj(
      "v 0 0 0\nv 1 0 0\nf -2 2/7 3//9 4/1/2\nv 1 1 0 0.5\nv 0 1 0 1 1 1 # white\nf -1 -4 \\\n 3",
      "t");
  EXPECT_EQ(soup.vertices.size(), 4u);
  EXPECT_THAT(soup.facets, ElementsAre(ElementsAre(0, 1, 2, 3), ElementsAre(3, 0, 2)));
}

TEST(MeshReaders, ObjIsReadWithAnyLineEnds) {
  for (const std::string end : {"\n", "\r\n", "\r", " \n\n"}) {
    const PolygonSoup soup =
        ReadObj("# c" + end + "v 0 0 0" + end + "v 1 0 0" + end + "v 0 1 0" + end + "f 1 2 3", "t");
    EXPECT_EQ(soup.vertices.size(), 3u);
    EXPECT_THAT(soup.facets, ElementsAre(ElementsAre(0, 1, 2)));
  }
}

TEST(MeshReaders, StlFacetsAreMergedByCoordinates) {
  const PolygonSoup soup = ReadStl(ReadFile(kGood / "binary.stl"), "t");
  EXPECT_EQ(soup.vertices.size(), 12u);
  EXPECT_EQ(Polyhedron::FromSoup(soup, "t").vertices().size(), 4u);
}

TEST(MeshReaders, BinaryPlySwapsBytesAndSkipsWhatItNeedsNot) {
  const PolygonSoup big = ReadPly(ReadFile(kGood / "big.ply"), "big");
  const PolygonSoup little = ReadPly(ReadFile(kGood / "little.ply"), "little");
  EXPECT_EQ(big.vertices, little.vertices);
  EXPECT_EQ(big.facets, little.facets);
}

TEST(MeshReaders, AllFormatsGiveTheSameBody) {
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kGood)) {
    if (entry.path().filename() == "placed.gltf") continue;
    const ObjectFile file = ReadObject(entry.path());
    EXPECT_NEAR((file.object->mass_properties().centroid - Vector3d::Constant(0.25)).norm(), 0,
                1e-7)
        << entry.path();
    ++compared;
  }
  EXPECT_EQ(compared, 19);
}

/// Number format that writes 1.5 as 1,5 and 1000 as 1.000.
class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(MeshReaders, ReadTheSameUnderAnyLocale) {
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;  // if the machine has one
  }
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kGood)) {
    EXPECT_NO_THROW({
      const ObjectFile file = ReadObject(entry.path());
      EXPECT_EQ(file.object->face_count(), 4);
    }) << entry.path();
    ++read;
  }
  EXPECT_EQ(ReadObj("v 0.5 1.25 1000.5\n", "t").vertices.at(0), Vector3d(0.5, 1.25, 1000.5));
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
  EXPECT_EQ(read, 20);
}

constexpr ChildLimits kLimits{std::size_t{4} << 30, std::chrono::seconds(5),
                              std::chrono::milliseconds(20000)};

TEST(LimitedChild, ReturnsWhatTheTaskReturns) {
  const std::string large(1 << 20, 'x');  // larger than the capacity of a pipe
  const ChildResult result = RunInLimitedChild([&] { return large; }, kLimits);
  EXPECT_EQ(result.end, ChildEnd::kDone);
  EXPECT_EQ(result.bytes, large);
}

TEST(LimitedChild, ReturnsTheMessageOfAnException) {
  const ChildResult result =
      RunInLimitedChild([]() -> std::string { throw std::runtime_error("no"); }, kLimits);
  EXPECT_EQ(result.end, ChildEnd::kThrew);
  EXPECT_EQ(result.bytes, "no");
}

#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer opens pipes
TEST(LimitedChild, OpensNoFile) {
  const auto open_file = [] {
    const bool opened = std::ifstream(kGood / "plain.off").is_open();
    return std::string(opened ? "opened" : "not opened");
  };
  EXPECT_EQ(open_file(), "opened");
  EXPECT_EQ(RunInLimitedChild(open_file, kLimits).bytes, "not opened");
}
#endif

TEST(LimitedChild, SurvivesACrash) {
  const ChildResult result = RunInLimitedChild([]() -> std::string { std::abort(); }, kLimits);
  EXPECT_EQ(result.end, ChildEnd::kCrashed);
}

TEST(LimitedChild, EndsATaskThatHangs) {
  ChildLimits limits = kLimits;
  limits.wall = std::chrono::milliseconds(200);
  const ChildResult asleep = RunInLimitedChild(
      []() -> std::string {
        for (;;) pause();
      },
      limits);
  EXPECT_EQ(asleep.end, ChildEnd::kTookTooLong);
  limits = kLimits;
  limits.processor = std::chrono::seconds(1);
  const ChildResult busy = RunInLimitedChild(
      []() -> std::string {
        for (std::atomic<int> i = 0;; ++i) {
        }
      },
      limits);
  EXPECT_EQ(busy.end, ChildEnd::kTookTooLong);
}

#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer allocates more address space than any limit
TEST(LimitedChild, EndsATaskThatTakesAllMemory) {
  const ChildResult result = RunInLimitedChild(
      []() -> std::string { return std::string(std::size_t{1} << 40, 'x'); }, kLimits);
  EXPECT_EQ(result.end, ChildEnd::kCrashed);
}
#endif

TEST(SoupBytes, ComeBackAsTheyWereAndAreRefusedWhenCut) {
  const PolygonSoup soup{{{1, 2, 3}, {4, 5, 6}}, {{0, 1, 0, 1}, {}, {1}}};
  const std::string bytes = SoupToBytes(soup);
  const auto back = SoupFromBytes(bytes);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->vertices, soup.vertices);
  EXPECT_EQ(back->facets, soup.facets);
  int refused = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    refused += !SoupFromBytes(bytes.substr(0, size)).has_value();
  }
  EXPECT_EQ(refused, static_cast<int>(bytes.size()));
  EXPECT_FALSE(SoupFromBytes(bytes + "x").has_value());
}

}  // namespace mesh_readers_test
}  // namespace regrasp::object
