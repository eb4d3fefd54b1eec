// Files that violate their format are rejected with their name. None is read as a different solid,
// and the vertices of a surface do not become a point cloud.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <string>

#include "planner/base/error.h"
#include "planner/object/object.h"
#include "planner/object/read_object.h"
#include "tests/fixtures/folder_test.h"
#include "tests/planner/object/known_gltf.h"
#include "tests/planner/object/known_solid.h"

namespace regrasp::object {
namespace misread_files_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class MisreadFilesTest : public FolderTest {
 protected:
  /// Return the message of the reader that `plan` and `repair` call; empty if it reads the file.
  [[nodiscard]] std::string Refusal(const std::string& file, const std::string& bytes) const {
    const std::filesystem::path path = Write(file, bytes);
    try {
      if (path.extension() == ".wkt") {
        static_cast<void>(ReadObject(path));
      } else {
        static_cast<void>(ReadSoup(path, Reading()));
      }
      return "";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(StartsWith(path.string() + ": "), Not(HasSubstr("\n"))));
      return error.what();
    }
  }

  void ExpectRefused(const std::string& file, const std::string& bytes,
                     const std::string& words) const {
    SCOPED_TRACE(file);
    EXPECT_THAT(Refusal(file, bytes), HasSubstr(words));
  }
};

/// Encode ASCII text as UTF-16 or UTF-32. @param place  position of the ASCII byte in `unit`.
std::string Widened(const std::string& text, const std::string& unit, std::size_t place) {
  std::string bytes;
  for (const char c : text) {
    bytes += unit;
    bytes[bytes.size() - unit.size() + place] = c;
  }
  return bytes;
}

std::string KnownPcd() {
  return "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 4\nDATA ascii\n" +
         VertexText("", "\n");
}

TEST_F(MisreadFilesTest, TextInOtherEncodings) {
  const std::string two(2, '\0'), four(4, '\0');
  const std::map<std::string, std::string> files = {
      {".obj", KnownObj()},          {".off", KnownOff()},
      {".ply", KnownPly()},          {".stl", KnownTextStl("a", false)},
      {".xyz", "0 0 0\n"},           {".pcd", KnownPcd()},
      {".pwn", "0 0 0\n"},           {".wkt", "POLYGON((0 0,1 0,0 1,0 0))"},
      {".gltf", KnownGltf().Gltf()}, {".dae", KnownCollada().Text()}};
  for (const auto& [ending, text] : files) {
    // Negative controls: ASCII, and UTF-8 with a byte order mark.
    EXPECT_EQ(Refusal("plain" + ending, text), "");
    EXPECT_EQ(Refusal("mark" + ending, "\xEF\xBB\xBF" + text), "");
    const std::string utf16 = "expected UTF-8, found UTF-16; help: save the file as UTF-8";
    ExpectRefused("little" + ending, "\xFF\xFE" + Widened(text, two, 0), utf16);
    ExpectRefused("big" + ending, "\xFE\xFF" + Widened(text, two, 1), utf16);
    ExpectRefused("no_mark" + ending, Widened(text, two, 0), utf16);
    ExpectRefused("big_no_mark" + ending, Widened(text, two, 1), utf16);
    ExpectRefused("wide" + ending, std::string("\xFF\xFE\0\0", 4) + Widened(text, four, 0),
                  "found UTF-32");
  }
}

TEST_F(MisreadFilesTest, BinaryStlOfAnotherSize) {
  for (const std::string header : {"", "solid of a modeller", "solid"}) {
    const std::string bytes = KnownBinaryStl(header);  // 84 + 4 · 50
    EXPECT_EQ(Refusal("whole.stl", bytes), "");
    ExpectRefused("short.stl", bytes.substr(0, bytes.size() - 10),
                  "expected 284 bytes for 4 facets, found 274 bytes");
    ExpectRefused("long.stl", bytes + "xy", "expected 284 bytes for 4 facets, found 286 bytes");
    ExpectRefused("facet_more.stl", bytes + bytes.substr(84, 50), "found 334 bytes");
    ExpectRefused("header.stl", bytes.substr(0, 84), "expected 284 bytes for 4 facets, found 84");
  }
}

TEST_F(MisreadFilesTest, SurfacesOfPlyInOtherElements) {
  const auto ply = [](const std::string& element, const std::string& rows) {
    return "ply\nformat ascii 1.0\n" + kPlyVertices + element + "end_header\n" +
           VertexText("", "\n") + rows;
  };
  const std::string list = "property list uchar int vertex_indices\n";
  ExpectRefused("faces.ply", ply("element faces 4\n" + list, FacetText("3 ", "\n")),
                "element \"faces\": not supported");
  ExpectRefused("grid.ply", ply("element range_grid 1\n" + list, "1 0\n"), "\"range_grid\"");
  ExpectRefused("corners.ply",
                ply("element triangle 4\nproperty int v1\nproperty int v2\nproperty int v3\n",
                    FacetText("", "\n")),
                "element \"triangle\": not supported");
  ExpectRefused("edges.ply",
                ply("element edge 1\nproperty int vertex1\nproperty int vertex2\n", "0 1\n"),
                "element \"edge\": not supported");
  ExpectRefused("beside.ply",
                ply("element face 4\n" + list + "element trifan 1\n" + list,
                    FacetText("3 ", "\n") + "3 0 1 2\n"),
                "element \"trifan\": not supported");
  ExpectRefused("strip_beyond.ply", StripPly("4 0 2 1 -2\n", 1),
                "vertex index -2 must be at least");
  ExpectRefused("two_lists.ply",
                ply("element face 1\n" + list + "property list uchar int vertex_index\n",
                    "3 0 1 2 3 0 2 1\n"),
                "expected one list of vertex indices, found two");
  ExpectRefused("two_faces.ply",
                ply("element face 2\n" + list + "element face 2\n" + list, FacetText("3 ", "\n")),
                "element \"face\": must be unique");
  ExpectRefused(
      "of_floats.ply",
      ply("element faces 4\nproperty list uchar float vertex_indices\n", FacetText("3 ", "\n")),
      "element \"faces\": not supported");
  ExpectRefused("no_triangle.ply", StripPly("6 0 2 -1 1 1 1\n", 1),
                "expected at least one triangle");
  // Negative controls: point clouds, and elements without a surface.
  EXPECT_EQ(Refusal("cloud.ply", ply("", "")), "");
  EXPECT_EQ(Refusal("no_faces.ply", ply("element face 0\n" + list, "")), "");
  EXPECT_EQ(
      Refusal("camera.ply",
              ply("element camera 1\nproperty float view_px\nproperty int viewportx\n", "0 640\n")),
      "");
  EXPECT_EQ(Refusal("face_and_edge.ply",
                    ply("element face 4\n" + list +
                            "element edge 1\nproperty int vertex1\nproperty int vertex2\n",
                        FacetText("3 ", "\n") + "0 1\n")),
            "");
}

TEST_F(MisreadFilesTest, SurfacesOfObjInOtherStatements) {
  const std::string vertices = VertexText("v ", "\n");
  const std::string surface =
      "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n";
  ExpectRefused("surf.obj", vertices + surface, "line 7: statement \"surf\": not supported");
  ExpectRefused("beside.obj", KnownObj() + surface, "statement \"surf\": not supported");
  ExpectRefused("patch.obj", vertices + "bzp 1 2 3 4\n", "statement \"bzp\"");
  ExpectRefused("call.obj", vertices + "call other.obj\n", "statement \"call\"");
  ExpectRefused("curve.obj", vertices + "cstype bezier\ncurv 0 1 1 2 3\nend\n",
                "statement \"curv\": not supported");
  ExpectRefused("lines.obj", vertices + "l 1 2 3\n", "statement \"l\": not supported");
  EXPECT_EQ(Refusal("cloud.obj", vertices + "p 1 2 3 4\n"), "");
  EXPECT_EQ(Refusal("statements.obj", KnownObj() + "s off\nusemtl a\no b\nvp 0 0\n"), "");
}

TEST_F(MisreadFilesTest, FormatsThatAreNotReadAsTheyAreMeant) {
  for (const std::string ending : {".3ds", ".ase", ".dxf", ".x", ".amf", ".x3d", ".ac", ".md2"}) {
    ExpectRefused("a" + ending, KnownObj(), "format: not supported, expected .obj");
    ExpectRefused("a" + ending, KnownObj(), "found \"" + ending + "\"; help: convert");
  }
  ExpectRefused("a", "hello", "found a file without an ending");
  EXPECT_EQ(Refusal("a", KnownObj()), "");
}

TEST_F(MisreadFilesTest, ColladaThatAssimpMisreads) {
  const auto with = [](const std::function<void(KnownCollada&)>& change) {
    KnownCollada collada;
    change(collada);
    return collada.Text();
  };
  using C = KnownCollada;
  EXPECT_EQ(Refusal("a.dae", with([](C&) {})), "");
  ExpectRefused("lookat.dae", with([](C& c) { c.node = "<lookat>1 2 3 0 0 0 0 0 1</lookat>"; }),
                "\"lookat\"");
  ExpectRefused("skew.dae", with([](C& c) { c.node = "<skew>45 0 1 0 1 0 0</skew>"; }), "\"skew\"");
  ExpectRefused("skin.dae", with([](C& c) { c.instance = "<instance_controller url=\"#g\"/>"; }),
                "\"instance_controller\"");
  ExpectRefused("hole.dae", with([](C& c) {
                  c.primitives =
                      "<polygons count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" "
                      "offset=\"0\"/><ph><p>0 2 1</p><h>0 1 3</h></ph></polygons>";
                }),
                "\"ph\"");
  ExpectRefused("elsewhere.dae",
                with([](C& c) { c.instance = "<instance_geometry url=\"other.dae#g\"/>"; }),
                "surface in another file, \"other.dae#g\"");
  ExpectRefused("lines.dae", with([](C& c) {
                  c.primitives =
                      "<lines count=\"2\"><input semantic=\"VERTEX\" source=\"#v\" "
                      "offset=\"0\"/><p>0 1 2 3</p></lines>";
                }),
                "scene: expected at least one polygon");
  ExpectRefused("units.dae", with([](C& c) { c.node = "<asset><unit meter=\"0.01\"/></asset>"; }),
                "unit: expected one, found");
  ExpectRefused("zero.dae", with([](C& c) { c.unit = "meter=\"0\""; }), "unit: meter");
}

TEST_F(MisreadFilesTest, FbxThatAssimpMisreads) {
  std::string nurbs = KnownFbx("");
  nurbs.insert(nurbs.find("\tModel:"),
               "\tGeometry: 1001, \"Geometry::n\", \"NurbsSurface\" {\n\t}\n");
  ExpectRefused("nurbs.fbx", nurbs, "\"NurbsSurface\": not supported");
}

TEST_F(MisreadFilesTest, GltfThatWouldBeAnotherSolid) {
  const std::map<std::string, std::function<void(KnownGltf&)>> variants = {
      {"required extension KHR_draco_mesh_compression: not supported",
       [](KnownGltf& g) { g.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }},
      {"required extension EXT_made_up: not supported",
       [](KnownGltf& g) {
         g.json["extensionsRequired"] = {"KHR_materials_unlit", "EXT_made_up"};
       }},
      {"/nodes/0: extension EXT_mesh_gpu_instancing: not supported",
       [](KnownGltf& g) {
         g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 0;
       }},
      {"/meshes/0/primitives/0: extension KHR_draco_mesh_compression",
       [](KnownGltf& g) {
         g.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"a", 1}};
       }},
      {"/meshes/0/weights/1: morph weight: not supported, expected 0, found 1",
       [](KnownGltf& g) {
         g.json["meshes"][0]["weights"] = {0, 1};
       }},
      {"/nodes/0/weights/0: morph weight",
       [](KnownGltf& g) {
         g.json["meshes"][0]["weights"] = {0};
         g.node()["weights"] = {0.5};
       }},
      {"/nodes/0/skin: not supported", [](KnownGltf& g) { g.node()["skin"] = 0; }},
      {"expected 5126 (float), found 5122",
       [](KnownGltf& g) { g.json["accessors"][0]["componentType"] = 5122; }},
      {"/scene: not found, expected the index of one of 2",
       [](KnownGltf& g) {
         g.json.erase("scene");
         g.json["scenes"].push_back({{"nodes", {0}}});
       }},
      {"vertex index 3 must be less than 3, the number of vertices",
       [](KnownGltf& g) { g.json["accessors"][0]["count"] = 3; }},
      {"/accessors/0: 5 elements with a stride of",
       [](KnownGltf& g) { g.json["accessors"][0]["count"] = 5; }},
      {"/accessors/0: too large, limit 3000000 elements",
       [](KnownGltf& g) {
         g.json["accessors"][0]["count"] = 900'000'000'000'000;
         g.json["accessors"][0].erase("bufferView");
       }},
      {"/bufferViews/0: byteOffset + byteLength: expected at most",
       [](KnownGltf& g) { g.json["bufferViews"][0]["byteLength"] = 1000; }},
      {"/asset/version: not supported, expected \"2.0\", found \"1.0\"",
       [](KnownGltf& g) { g.json["asset"]["version"] = "1.0"; }},
      {"must be a child of one node, found two parents",
       [](KnownGltf& g) { g.node()["children"] = {0}; }},
      {"scene: expected at least one triangle", [](KnownGltf& g) { g.primitive()["mode"] = 0; }},
      {"/nodes/0/rotation: expected a unit quaternion",
       [](KnownGltf& g) {
         g.node()["rotation"] = {0, 0, 0, 2};
       }},
      {"/nodes/0/matrix: expected 0, 0, 0, 1 in its last row",
       [](KnownGltf& g) {
         g.node()["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
       }},
  };
  for (const auto& [words, change] : variants) {
    KnownGltf gltf;
    change(gltf);
    ExpectRefused("a.gltf", gltf.Gltf(), words);
    ExpectRefused("a.glb", gltf.Glb(), words);
  }
  const std::string glb = KnownGltf().Glb();
  ExpectRefused("cut.glb", glb.substr(0, glb.size() - 4), "header: length: expected");
  ExpectRefused("magic.glb", "glTF", "header: truncated");
}

TEST_F(MisreadFilesTest, PackagesOf3mfThatAreAmbiguous) {
  const std::string item = "<item objectid=\"1\"/>", root = "3D/3dmodel.model";
  const std::string solid = "<object id=\"1\">" + MeshOf3mf() + "</object>";
  const std::string model = ModelOf3mf(solid, item);
  const auto refused = [&](const std::string& objects, const std::string& items,
                           const std::string& attributes, const std::string& words) {
    ExpectRefused("a.3mf", Package({{root, ModelOf3mf(objects, items, attributes)}}), words);
  };
  EXPECT_EQ(Refusal("a.3mf", Package({{root, model}})), "");
  ExpectRefused("no_rels.3mf", StoredZip({{root, model}}), "_rels/.rels: not found in the archive");
  ExpectRefused("empty_rels.3mf", StoredZip({{"_rels/.rels", RelationshipsTo({})}, {root, model}}),
                "_rels/.rels: relationship to a model not found");
  ExpectRefused("two_roots.3mf",
                StoredZip({{"_rels/.rels", RelationshipsTo({"/a.model", "/b.model"})},
                           {"a.model", model},
                           {"b.model", model}}),
                "expected one relationship to a model, found several");
  ExpectRefused(
      "two_of_a_name.3mf",
      StoredZip(
          {{"_rels/.rels", RelationshipsTo({"/a.model"})}, {"a.model", model}, {"A.model", model}}),
      "a.model: must be once in the archive, found twice or more");
  ExpectRefused("missing_part.3mf",
                Package({{root, ModelOf3mf("", "<item objectid=\"1\" p:path=\"/3D/b.model\"/>")}}),
                "3D/b.model: not found in the archive");
  ExpectRefused("other_unit.3mf",
                Package({{root, ModelOf3mf("", "<item objectid=\"1\" p:path=\"/3D/b.model\"/>")},
                         {"3D/b.model", ModelOf3mf(solid, "", "unit=\"inch\"")}}),
                "3D/b.model: unit: expected \"millimeter\"");
  const std::string lattice =
      "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\"";
  refused(solid, item, lattice + " requiredextensions=\"b\"", "required extension \"b\"");
  refused("<object id=\"1\">" + MeshOf3mf() + "<b:beamlattice/></object>", item, lattice,
          "\"beamlattice\": not supported");
  refused(solid + solid, item, "", "object \"1\": the id must be unique");
  refused("<object id=\"1\" type=\"surface\">" + MeshOf3mf() + "</object>", item, "",
          "type: not supported, expected \"model\", found \"surface\"");
  refused("<object id=\"1\" type=\"support\">" + MeshOf3mf() + "</object>", item, "",
          "build: object of type \"model\" not found");
  refused("<object id=\"1\"/>", item, "", "expected a mesh or components, found neither");
  refused(solid, "<item objectid=\"1\" printable=\"0\"/>", "", "item: printable");
  refused(solid, "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0\"/>", "", "transform");
}

/// Truncated and changed files of the formats that a child process reads must be read or rejected
/// in one line.
TEST_F(MisreadFilesTest, CutAndChangedFilesAreReadOrRefused) {
  const std::string model =
      ModelOf3mf("<object id=\"1\">" + MeshOf3mf() + "</object>", "<item objectid=\"1\"/>");
  const std::map<std::string, std::string> files = {
      {"a.gltf", KnownGltf().Gltf()},
      {"a.glb", KnownGltf().Glb()},
      {"a.dae", KnownCollada().Text()},
      {"a.3mf", Package({{"3D/3dmodel.model", model}})}};
  constexpr std::size_t kCuts = 20;
  constexpr int kChanges = 40;
  std::mt19937 random(5);
  int refused = 0;
  for (const auto& [file, bytes] : files) {
    for (std::size_t k = 0; k < kCuts; ++k) {
      refused += !Refusal(file, bytes.substr(0, bytes.size() * k / kCuts)).empty();
    }
    for (int k = 0; k < kChanges; ++k) {
      std::string changed = bytes;
      changed[random() % changed.size()] = static_cast<char>(random() % 256);
      refused += !Refusal(file, changed).empty();
    }
  }
  EXPECT_GE(refused, static_cast<int>(kCuts * files.size()));
}

}  // namespace misread_files_test
}  // namespace regrasp::object
