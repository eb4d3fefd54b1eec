#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>
#include <thread>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/assimp_scene.h"
#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"
#include "tests/planner/object/known_solid.h"

namespace regrasp::object {
namespace read_with_assimp_test {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

const fs::path kGood = ProjectPath("tests/data/objects/good");

PolygonSoup Read(const fs::path& path, const AssimpLimits& limits = {}) {
  return ReadWithAssimp(ReadFile(path), path, limits);
}

TEST(ReadWithAssimp, PlacesMeshesByTheirNodesAndTurnsMirroredOnes) {
  const Polyhedron body = Polyhedron::FromSoup(Read(kGood / "placed.gltf"), "placed.gltf");
  EXPECT_EQ(body.face_count(), 4);
  // Rotated by 90° about z, then scaled by (2, 2, −2), then moved to x = 5.
  EXPECT_NEAR((body.mass_properties().centroid - Vector3d(4.5, 0.5, -0.5)).norm(), 0, 1e-6);
}

TEST(ReadWithAssimp, GivesUpAtItsLimits) {
  AssimpLimits limits;
  limits.wall = std::chrono::milliseconds(0);
  EXPECT_THROW(static_cast<void>(Read(kGood / "placed.gltf", limits)), InputError);
}

/// Write a glTF document with its numbers at `uri`.
std::string GltfWithBuffer(const std::string& uri) {
  std::string text = ReadFile(kGood / "placed.gltf");
  const std::size_t first = text.find("data:");
  return text.replace(first, text.find('"', first) - first, uri);
}

/// Return the message of reading bytes as a file of that name; empty if they are read.
std::string Complaint(const std::string& bytes, const fs::path& path) {
  try {
    static_cast<void>(ReadWithAssimp(bytes, path));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

class FilesBesideTest : public FolderTest {};

TEST_F(FilesBesideTest, ASurfaceThatComesFromAnotherFileIsRefused) {
  static_cast<void>(Write("body.bin", std::string(72, '\0')));
  KnownCollada scene;
  scene.instance = "<instance_geometry url=\"body.dae#g\"/>";
  static_cast<void>(Write("body.dae", KnownCollada().Text()));
  struct Case {
    std::string name, bytes, other;
  };
  const std::vector<Case> cases = {
      {"a.gltf", GltfWithBuffer("body.bin"), "body.bin"},
      {"b.gltf", GltfWithBuffer("missing.bin"), "missing.bin"},
      {"c.gltf", GltfWithBuffer("../c.gltf"), "../c.gltf"},
      {"d.dae", scene.Text(), "body.dae#g"},
  };
  for (const auto& [name, bytes, other] : cases) {
    const fs::path path = Write(name, bytes);
    try {
      static_cast<void>(ReadObject(path));
      ADD_FAILURE() << name << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(StartsWith(path.string() + ": "),
                                      HasSubstr("surface in another file, \"" + other)));
      EXPECT_THAT(error.what(), HasSubstr("help: convert"));
    }
  }
}

TEST_F(FilesBesideTest, WhatDoesNotMatterForTheSurfaceMayBeMissing) {
  std::string textured = ReadFile(kGood / "placed.gltf");
  textured.insert(1, R"("images": [{"uri": "wood.png"}], )");
  EXPECT_EQ(Complaint(textured, folder_ / "textured.gltf"), "");
  std::string painted = KnownCollada().Text();
  painted.insert(painted.find("<library_geometries>"),
                 "<library_images><image id=\"i\"><init_from>wood.png</init_from></image>"
                 "</library_images>");
  EXPECT_EQ(Complaint(painted, folder_ / "painted.dae"), "");
}

TEST_F(FilesBesideTest, AnObjectIsReadFromItsFileOnce) {
  const std::string bytes = ReadFile(kGood / "placed.gltf");
  const fs::path pipe = folder_ / "pipe.gltf";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
  const ObjectFile file = ReadObject(pipe);
  writer.join();
  EXPECT_EQ(file.object->face_count(), 4);
  EXPECT_EQ(file.sha256, Sha256(bytes));
}

}  // namespace read_with_assimp_test
}  // namespace regrasp::object
