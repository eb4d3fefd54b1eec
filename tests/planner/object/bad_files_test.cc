// Corpus of files that must be rejected, and robustness of the readers against arbitrary bytes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <random>
#include <string>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_object.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::object {
namespace bad_files_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::filesystem::path kObjects = ProjectPath("tests/data/objects");

/// File in tests/data/objects/bad, and words that the message must contain after the file's name.
const std::map<std::string, std::string> kBadFiles = {
    {"bad_format.ply",
     "line 2: expected format ascii, binary_little_endian or binary_big_endian, found \"ebcdic\""},
    {"bad_type.ply", "line 6: expected a type of PLY, found \"quad\""},
    {"bent_quad.obj", "facet 1: not planar: a corner is 0.0025 off"},
    {"beside.obj", "facet 4: several solids"},
    {"bow_tie.obj", "facet 0: self-intersecting"},
    {"comma.obj", "line 3: vertex 2: expected a finite number, found \"1,5\""},
    {"components_in_a_ring.3mf", "components: too large, limit 64 levels; they may be recursive"},
    {"components_without_end.3mf", "components: too large, limit 100000 placed objects"},
    {"control_character.ply", "element \"a?b\": not supported, expected the surface in"},
    {"corner_twice.obj", "facet 0: not closed: no other facet"},
    {"crossing.obj", "self-intersecting: meets facet"},
    {"edge_of_1e-162.obj", "facet 0: the edge from vertex 0 to vertex 1: shorter (1e-162) than"},
    {"edge_of_1e-162.wkt", "ring 0: edge 0: shorter (1e-162) than 1e-30 of the diameter"},
    {"edge_of_three.obj", "not manifold: 3 facets meet"},
    {"empty.glb", ": not valid JSON"},
    {"empty.obj", "empty: facets not found"},
    {"empty.stl", "not an STL file"},
    {"far_away.obj", "too far from the origin"},
    {"flat.obj", "facet 0: self-intersecting: meets facet 1"},
    {"flipped_facet.obj", "facet 0: not consistently oriented with facet 3"},
    {"float_count.ply", "line 8: the length of a list must be an integer"},
    {"float_indices.ply", "requires an integer list"},
    {"four_corners.stl", "line 7: \"vertex\", expected \"endloop\""},
    {"fraction_count.off", "line 2: the number of vertices: expected an integer, found \"4.5\""},
    {"fraction_index.ply", "facet 3: expected an integer, found \"2.5\""},
    {"huge.obj", "vertex 2: the coordinate 1e+16"},
    {"huge_count.stl", "expected 214748364834 bytes for 4294967295 facets, found 284 bytes"},
    {"huge_counts.off", "truncated, expected vertex 1"},
    {"huge_counts.ply", "truncated inside vertex 4"},
    {"huge_facet.off", "truncated, expected facet 0"},
    {"huge_list_binary.ply", "truncated inside facet 0"},
    {"index_beyond.3mf",
     "3D/3dmodel.model: line 3: triangle: v3: expected an integer of at least 0"},
    {"index_beyond.gltf", "facet 3: vertex index 60000 must be less than 4, the number of"},
    {"index_beyond.obj", "facet 3: vertex index 99 must be at most 4, the number of"},
    {"index_beyond.off", "line 10: facet 3: vertex index 4 must be at least 0 and less than 4"},
    {"index_beyond.ply", "facet 3: vertex index 7 must be at least 0 and less than 4"},
    {"index_beyond_binary.ply", "facet 3: vertex index 4294967295 must be"},
    {"index_huge.obj",
     "line 5: facet 0: expected a corner such as 7, 7/1 or 7//3, found \"99999999999999999999\""},
    {"index_negative.off", "line 10: facet 3: vertex index -3 must be"},
    {"index_negative.ply", "facet 3: vertex index -1 must be"},
    {"index_negative_beyond.obj", "line 5: facet 0: vertex index -9 must be"},
    {"index_not_number.obj",
     "line 5: facet 0: expected a corner such as 7, 7/1 or 7//3, found \"x\""},
    {"index_over_int.obj", "line 5: facet 0: vertex index 4294967298 must be"},
    {"index_zero.obj", "line 5: facet 0: vertex index 0 must be"},
    {"inf.obj", "vertex 2: expected a finite number, found \"-inf\""},
    {"inward_beside.obj", "facet 4: several solids"},
    {"json.obj", "line 1: expected a statement of OBJ, found \"{\"format\":\""},
    {"list_in_vertex.ply", "vertex 0: lists not supported"},
    {"moved_vertex.stl", "not closed"},
    {"nan.obj", "line 3: vertex 2: expected a finite number, found \"nan\""},
    {"nan.off", "line 5: vertex 2: expected a finite number, found \"nan\""},
    {"nan.ply", "vertex 2: expected a finite number, found \"nan\""},
    {"nan.stl", "line 5: facet 0: expected a finite number, found \"nan\""},
    {"nan_binary.ply", "vertex 0: coordinates must be finite, found nan"},
    {"nan_binary.stl", "facet 0: coordinates must be finite, found inf"},
    {"needle.off", "facet 0: too thin"},
    {"negative_count.off", "line 2: numbers of elements must not"},
    {"negative_list.ply", "facet 0: length of a list not supported, found -3"},
    {"no_area.obj", "empty: no facet with an area above 0"},
    {"no_counts.off", "truncated, expected the number of vertices"},
    {"no_end.ply", "line 5: expected a statement of a PLY header, found \"prope\""},
    {"no_format.ply", "format not found"},
    {"no_format.unknown", "format: not supported, expected .obj"},
    {"word.xyz", "line 2: point 1: expected a finite number, found \"here\""},
    {"two_coordinates.xyz", "line 1: point 0: expected three coordinates, found fewer"},
    {"no_data.pcd", "line DATA not found"},
    {"compressed.pcd", "help: write it as ascii or binary"},
    {"short.pcd", "100 points of 12 bytes: truncated"},
    {"no_y.pcd", "expected a field y"},
    {"cloud.xyz", "facets not found, found only 4 points; help: reconstruct a surface with repair"},
    {"no_header.ply", "line 1: not a PLY file, expected \"ply\""},
    {"no_list.ply", "requires an integer list"},
    {"no_model.3mf", "3D/3dmodel.model: not found in the archive"},
    {"no_object.3mf", "object \"2\" not found"},
    {"no_properties.ply", "element \"nothing\": expected at least one property"},
    {"no_xml.3mf", "3D/3dmodel.model: line 1: expected the element \"model\" of 3MF"},
    {"no_z.ply", "requires the properties x, y and z"},
    {"noise.3mf", "noise.3mf"},
    {"noise.gltf", ": not valid JSON"},
    {"noise.obj", "line 1: expected a statement of OBJ, found \"0Uz????3X}????6[?????9^?…\""},
    {"only_vertices.obj", "empty: facets not found"},
    {"open.obj", "facet 0: not closed: no other facet at the edge from vertex 2 (0, 1, 0)"},
    {"other_dimension.off", "expected \"off\" at the start, found \"4off\""},
    {"overflow.obj", "vertex 2: expected a finite number, found \"1e999\""},
    {"property_first.ply", "line 3: a property must follow an element"},
    {"short.stl", "not an STL file"},
    {"solid_in_solid.obj", "facet 4: several solids: its shell is inside the largest shell"},
    {"solid_only.stl", "empty: facets not found"},
    {"tiny.obj", "within 1e-15 of each other"},
    {"too_many.off", "line 11: expected the end of the file, found \"3\""},
    {"too_many.ply", "unexpected data after the last element"},
    {"touching_edge.obj", "not manifold: 4 facets meet"},
    {"touching_vertex.obj", "vertex 3 (0, 0, 1): not manifold"},
    {"trailing_binary.ply", "unexpected data after the last element"},
    {"trailing_binary.stl", "expected 284 bytes for 4 facets, found 286 bytes"},
    {"truncated.dae", "truncated.dae"},
    {"truncated.off", "truncated, expected facet 3"},
    {"truncated.ply", "truncated inside facet 2"},
    {"truncated.stl", "line 27: \"v\", expected \"vertex\""},
    {"truncated_binary.ply", "truncated inside facet 3"},
    {"truncated_binary.stl", "expected 284 bytes for 4 facets, found 283 bytes"},
    {"two_coordinates.obj", "line 1: vertex 0: expected three coordinates, found fewer"},
    {"unknown_statement.obj", "line 1: expected a statement of OBJ, found \"hello\""},
    {"unknown_unit.3mf", "unit: not supported, found \"parsec\""},
    {"vertex_on_facet.obj", "self-intersecting: meets facet"},
    {"word.stl", "line 30: expected a facet, found \"hello\""},
    {"wrong_header.off", "expected \"off\" at the start, found \"ofg\""},
};

TEST(BadFiles, EachIsRefusedInOneLineThatNamesFileAndElement) {
  std::size_t refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kObjects / "bad")) {
    const std::string file = entry.path().filename().string();
    ASSERT_TRUE(kBadFiles.contains(file)) << file << " is not in the table";
    try {
      static_cast<void>(ReadObject(entry.path()));
      ADD_FAILURE() << file << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(entry.path().string() + ": "));
      EXPECT_THAT(error.what(), HasSubstr(kBadFiles.at(file)));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      EXPECT_THAT(error.what(), Not(EndsWith(" ")));
      ++refused;
    }
  }
  EXPECT_EQ(refused, kBadFiles.size());
}

TEST(BadFiles, TheirSoundRelativesAreRead) {
  std::size_t read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kObjects / "good")) {
    SCOPED_TRACE(entry.path().filename().string());
    const ObjectFile file = ReadObject(entry.path());
    EXPECT_EQ(file.object->face_count(), 4);
    const bool placed = file.file == "placed.gltf";  // twice as large, mirrored
    EXPECT_NEAR(file.object->mass_properties().volume, (placed ? 8 : 1) / 6.0, 1e-6);
    ++read;
  }
  EXPECT_EQ(read, 20u);
}

TEST(BadFiles, AFileThatIsMissingOrAFolderIsRefused) {
  EXPECT_THROW(static_cast<void>(ReadObject(kObjects / "nowhere.obj")), InputError);
  EXPECT_THROW(static_cast<void>(ReadObject(kObjects)), InputError);
}

/// Read bytes in this process as the format of `ending`. @returns whether they are an object.
bool IsObject(const std::string& ending, const std::string& bytes) {
  try {
    if (ending == ".wkt") {
      static_cast<void>(Polygon::FromWkt(bytes, "bytes"));
      return true;
    }
    const PolygonSoup soup = ending == ".obj"   ? ReadObj(bytes, "bytes")
                             : ending == ".off" ? ReadOff(bytes, "bytes")
                             : ending == ".ply" ? ReadPly(bytes, "bytes")
                                                : ReadStl(bytes, "bytes");
    static_cast<void>(Polyhedron::FromSoup(soup, "bytes"));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Return the valid files of formats that are read in this process.
std::map<std::string, std::string> SoundFiles() {
  std::map<std::string, std::string> files;
  for (const auto& folder : {kObjects / "good", ProjectPath("models")}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string ending = entry.path().extension().string();
      for (const std::string known : {".obj", ".off", ".ply", ".stl", ".wkt"}) {
        if (ending == known) files[entry.path().filename().string()] = ReadFile(entry.path());
      }
    }
  }
  return files;
}

/// Maximum number of truncations per file. A file of at most this size is truncated after every
/// byte.
constexpr std::size_t kMostCuts = 5000;

TEST(BadFiles, TruncatedAnywhereAFileIsReadOrRefused) {
  int refused = 0, files = 0;
  for (const auto& [file, bytes] : SoundFiles()) {
    const std::string ending = std::filesystem::path(file).extension().string();
    ASSERT_TRUE(IsObject(ending, bytes)) << file;
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / kMostCuts) {
      refused += !IsObject(ending, bytes.substr(0, size));
    }
    ++files;
  }
  EXPECT_GE(files, 20);
  EXPECT_GT(refused, 5000);
}

TEST(BadFiles, WithBytesChangedAFileIsReadOrRefused) {
  constexpr int kChangesPerFile = 400;
  std::mt19937 random(7);
  int refused = 0, read = 0;
  for (const auto& [file, bytes] : SoundFiles()) {
    const std::string ending = std::filesystem::path(file).extension().string();
    for (int i = 0; i < kChangesPerFile; ++i) {
      std::string changed = bytes;
      for (unsigned int k = 0; k <= random() % 3; ++k) {
        changed[random() % changed.size()] = static_cast<char>(random() % 256);
      }
      (IsObject(ending, changed) ? read : refused)++;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(read, 10);
}

TEST(BadFiles, NoiseIsRefused) {
  std::mt19937 random(11);
  int refused = 0;
  for (const std::string ending : {".obj", ".off", ".ply", ".stl", ".wkt"}) {
    for (int i = 0; i < 200; ++i) {
      std::string noise(random() % 400, '\0');
      for (char& c : noise) c = static_cast<char>(random() % 256);
      refused += !IsObject(ending, noise);
    }
  }
  EXPECT_EQ(refused, 1000);
}

TEST(BadFiles, DeepOrLongTextIsRefusedWithoutRecursion) {
  const std::string deep(1'000'000, '(');
  EXPECT_FALSE(IsObject(".wkt", "POLYGON" + deep));
  EXPECT_FALSE(IsObject(".obj", "v " + std::string(1'000'000, '1') + " 0 0\n"));
  EXPECT_FALSE(IsObject(".obj", std::string(1'000'000, '\\')));
  EXPECT_FALSE(IsObject(".off", "OFF\n" + std::string(1'000'000, ' ')));
}

}  // namespace bad_files_test
}  // namespace regrasp::object
