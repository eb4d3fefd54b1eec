// The same solid in every format and variant must have the same vertices, volume, centroid and
// bounding box. A reader that rotates, mirrors, moves or scales it, or omits a part of it, fails
// here.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/folder_test.h"
#include "tests/planner/object/known_gltf.h"
#include "tests/planner/object/known_solid.h"

namespace regrasp::object {
namespace same_solid_test {

using Eigen::Vector3d;

/// Formats with 32-bit coordinates round them by 1e-8.
constexpr double kRounding = 1e-7;

class SameSolidTest : public FolderTest {
 protected:
  /// Return the largest distance of a known vertex from the solid's vertices, whose number must be
  /// equal.
  static double FarthestVertex(const Polyhedron& solid) {
    if (solid.vertices().size() != kKnownVertices.size()) return INFINITY;
    double farthest = 0;
    for (const Vector3d& known : kKnownVertices) {
      double nearest = INFINITY;
      for (const Vector3d& vertex : solid.vertices()) {
        nearest = std::min(nearest, (vertex - known).norm());
      }
      farthest = std::max(farthest, nearest);
    }
    return farthest;
  }

  void ExpectKnown(const std::string& file, const std::string& bytes) const {
    SCOPED_TRACE(file);
    try {
      const ObjectFile object = ReadObject(Write(file, bytes));
      const auto& solid = dynamic_cast<const Polyhedron&>(*object.object);
      EXPECT_LT(FarthestVertex(solid), kRounding);
      EXPECT_NEAR(solid.mass_properties().volume, kKnownVolume, 1e-5 * kKnownVolume);
      EXPECT_LT((solid.mass_properties().centroid - kKnownCentroid).norm(), kRounding);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }

  void ExpectKnown(const std::map<std::string, std::string>& files) const {
    for (const auto& [file, bytes] : files) ExpectKnown(file, bytes);
  }
};

const std::string kUtf8Mark = "\xEF\xBB\xBF";

TEST_F(SameSolidTest, TextFormats) {
  ExpectKnown({{"a.obj", KnownObj()},
               {"mark.obj", kUtf8Mark + KnownObj()},
               {"latin_comment.obj", "# caf\xE9\n" + KnownObj()},
               {"curve_beside.obj", KnownObj() + "l 1 2\n"},
               {"a.off", KnownOff()},
               {"mark.off", kUtf8Mark + KnownOff()},
               {"a.ply", KnownPly()},
               {"mark.ply", kUtf8Mark + KnownPly()},
               {"no_ending", KnownPly()},
               {"a.stl", KnownTextStl("part 7", false)},
               {"mark.stl", kUtf8Mark + KnownTextStl("part 7", false)},
               {"glued.stl", KnownTextStl("AssimpScene", true)},
               {"several.stl", KnownTextStl("AssimpScene", true) + "solid\nendsolidAgain\n"}});
}

TEST_F(SameSolidTest, BinaryStl) {
  ExpectKnown({{"a.stl", KnownBinaryStl("")},
               {"solid.stl", KnownBinaryStl("solid of a modeller")},
               {"mark.stl", KnownBinaryStl("\xFF\xFEsolid")},
               {"padded.stl", KnownBinaryStl("solid") + std::string(2, '\0')},
               {"padded_by_a_facet.stl", KnownBinaryStl("") + std::string(50, '\0')}});
}

TEST_F(SameSolidTest, StripsOfPly) {
  // Strips that end with -1, in one row or in several. A repeated vertex connects two parts.
  ExpectKnown({{"strip.ply", StripPly("6 0 2 1 3 0 2\n", 1)},
               {"ended.ply", StripPly("7 0 2 1 3 0 2 -1\n", 1)},
               {"triangles.ply", StripPly("16 0 2 1 -1 0 1 3 -1 1 2 3 -1 0 3 2 -1\n", 1)},
               {"rows.ply", StripPly("4 0 2 1 3\n5 0 3 2 -1 -1\n3 0 1 3\n", 3)},
               {"joined.ply", StripPly("11 0 2 1 1 1 0 0 1 3 2 0\n", 1)}});
  ExpectKnown("faces_and_strips.ply",
              "ply\nformat ascii 1.0\n" + kPlyVertices +
                  "element tristrips 1\nproperty list int int vertex_index\nelement face "
                  "2\nproperty list uchar int vertex_indices\nend_header\n" +
                  VertexText("", "\n") + "4 0 2 1 3\n3 0 1 3\n3 0 3 2\n");
}

TEST_F(SameSolidTest, StripsOfBinaryPly) {
  for (const bool big : {false, true}) {
    const auto ordered = [&](std::string bytes) {
      if (big) std::ranges::reverse(bytes);
      return bytes;
    };
    std::string body;
    for (const auto& p : kKnownVertices) {
      for (const double x : p) body += ordered(BytesOf(x));
    }
    body += ordered(BytesOf(7));
    for (const int v : {0, 2, 1, 3, 0, 2, -1}) body += ordered(BytesOf(v));
    ExpectKnown(big ? "big.ply" : "little.ply",
                kUtf8Mark + "ply\nformat binary_" + (big ? "big" : "little") + "_endian 1.0\n" +
                    kPlyVertices +
                    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                    body);
  }
}

TEST_F(SameSolidTest, ColladaWhateverItsAxisAndUnit) {
  for (const std::string up : {"X_UP", "Y_UP", "Z_UP"}) {
    KnownCollada collada;
    collada.up = up;
    ExpectKnown(up + ".dae", collada.Text());
    collada.unit = "meter=\"0.001\"";
    collada.factor = 1000;
    ExpectKnown(up + "_mm.dae", collada.Text());
    ExpectKnown(up + "_mark.dae", kUtf8Mark + collada.Text());
  }
  KnownCollada spaced;
  spaced.unit = "meter = '0.01'";
  spaced.factor = 100;
  ExpectKnown("spaced.dae", spaced.Text());
  KnownCollada strip;
  strip.primitives =
      "<tristrips count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 2 1 3 0 "
      "2</p></tristrips>";
  ExpectKnown("strip.dae", strip.Text());
  KnownCollada there_and_back;
  there_and_back.node =
      "<translate>0.1 0.2 0.3</translate><rotate>0 0 1 90</rotate><rotate>0 0 1 -90</rotate>"
      "<translate>-0.1 -0.2 -0.3</translate>";
  ExpectKnown("moved.dae", there_and_back.Text());
}

TEST_F(SameSolidTest, FbxWhateverItsAxes) {
  ExpectKnown("a.fbx", KnownFbx(""));
  ExpectKnown("z_up.fbx", KnownFbx("\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",2\n\t\tP: "
                                   "\"UpAxisSign\", \"int\", \"Integer\", \"\",1\n"));
}

/// Return the vertices of the known solid as fractions of the box from (0.01, 0.02, 0.03) of width
/// 0.1.
std::string QuantizedPositions(double most, const std::function<std::string(double)>& bytes_of) {
  std::string bytes;
  for (const Vector3d& p : kKnownVertices) {
    const Vector3d share = (p - kKnownVertices[0]) / 0.1;
    for (const double x : share) bytes += bytes_of(std::round(most * x));
    bytes += bytes_of(0);  // pads a vertex to four components
  }
  return bytes;
}

TEST_F(SameSolidTest, GltfInItsVariants) {
  const std::map<std::string, std::function<void(KnownGltf&)>> variants = {
      {"plain", [](KnownGltf&) {}},
      {"strip", [](KnownGltf& g) { g.SetIndices(kKnownStrip, 5); }},
      {"fan_and_triangle",
       [](KnownGltf& g) {
         g.SetIndices({0, 2, 1, 3, 2}, 6);
         g.json["meshes"][0]["primitives"].push_back(g.primitive());
         g.SetIndices({1, 2, 3}, 4);
       }},
      {"lines_beside",
       [](KnownGltf& g) {
         g.json["meshes"][0]["primitives"].push_back(
             {{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
       }},
      {"matrix",
       [](KnownGltf& g) {  // a rotation by 180° about z, reversed by the child
         g.node() = {{"children", {1}},
                     {"matrix", {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}};
         g.json["nodes"].push_back(
             {{"mesh", 0}, {"rotation", {0, 0, 1, 0}}, {"translation", {5, 6, -7}}});
       }},
      {"second_scene",
       [](KnownGltf& g) {
         g.json["scenes"] = Json::parse(R"([{"nodes": [1]}, {"nodes": [0]}])");
         g.json["nodes"].push_back({{"mesh", 0}, {"translation", {1, 0, 0}}});
         g.json["scene"] = 1;
       }},
      {"sparse",
       [](KnownGltf& g) {  // the last vertex becomes a sparse value
         std::string moved = g.buffer.substr(36, 12);
         g.buffer.replace(36, 12, std::string(12, '\0'));
         g.json["accessors"][0]["sparse"] = {
             {"count", 1},
             {"indices", {{"bufferView", g.AddView("\x03")}, {"componentType", 5121}}},
             {"values", {{"bufferView", g.AddView(moved)}}}};
       }},
      {"morph_of_no_weight",
       [](KnownGltf& g) {
         g.primitive()["targets"] = Json::parse(R"([{"POSITION": 0}])");
         g.json["meshes"][0]["weights"] = {0};
       }},
      {"required_material",
       [](KnownGltf& g) {
         g.json["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform"};
       }},
  };
  for (const auto& [name, change] : variants) {
    KnownGltf gltf;
    change(gltf);
    ExpectKnown(name + ".gltf", gltf.Gltf());
    ExpectKnown(name + ".glb", gltf.Glb());
  }
  ExpectKnown("mark.gltf", kUtf8Mark + KnownGltf().Gltf());
}

TEST_F(SameSolidTest, QuantizedGltf) {
  struct Kind {
    int component_type;
    bool normalized;
    double most, scale;
    int bytes;
  };
  // The fractions 0, 0.4, 0.6 and 1 are integer numbers of steps.
  for (const Kind& kind :
       {Kind{5121, true, 255, 0.1, 1}, Kind{5123, true, 65535, 0.1, 2},
        Kind{5120, false, 125, 0.1 / 125, 1}, Kind{5122, false, 100, 0.001, 2}}) {
    KnownGltf gltf;
    gltf.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    gltf.node()["scale"] = {kind.scale, kind.scale, kind.scale};
    gltf.node()["translation"] = {0.01, 0.02, 0.03};
    const std::string bytes = QuantizedPositions(kind.most, [&](double x) {
      return LittleEndian(static_cast<std::uint64_t>(x), kind.bytes);
    });
    const std::size_t accessor = gltf.AddAccessor(bytes, {{"componentType", kind.component_type},
                                                          {"normalized", kind.normalized},
                                                          {"count", 4},
                                                          {"type", "VEC3"}});
    gltf.json["bufferViews"].back()["byteStride"] = 4 * kind.bytes;
    gltf.primitive()["attributes"]["POSITION"] = accessor;
    ExpectKnown("quantized_" + std::to_string(kind.component_type) + ".glb", gltf.Glb());
  }
}

TEST_F(SameSolidTest, PackagesOf3mf) {
  const std::string item = "<item objectid=\"1\"/>", part = "3D/Objects/part_1.model";
  const std::string solid = "<object id=\"1\" type=\"model\">" + MeshOf3mf() + "</object>";
  const std::string other = "<object id=\"1\" type=\"model\">" + MeshOf3mf(400) + "</object>";
  const std::string support = "<object id=\"9\" type=\"support\">" + MeshOf3mf(5000) + "</object>";
  const std::string of_part = "<component objectid=\"1\" p:path=\"/" + part + "\"/>";
  const std::string shell = "<object id=\"2\"><components>" + of_part + "</components></object>";
  const std::string required = "requiredextensions=\"p\"";
  const std::pair<std::string, std::string> parts{part, ModelOf3mf(solid, "")};
  ExpectKnown({
      {"a.3mf", Package({{"3D/3dmodel.model", ModelOf3mf(solid, item)}})},
      {"inches.3mf", Package({{"3D/3dmodel.model",
                               ModelOf3mf("<object id=\"1\">" + MeshOf3mf(1 / 0.0254) + "</object>",
                                          item, "unit=\"inch\"")}})},
      {"other_name.3mf", Package({{"Geometry/root.model", ModelOf3mf(solid, item)},
                                  {"3D/3dmodel.model", ModelOf3mf(other, item)}})},
      {"escaped_name.3mf", StoredZip({{"_rels/.rels", RelationshipsTo({"/3D/my%20model.model"})},
                                      {"3D/my model.model", ModelOf3mf(solid, item)}})},
      {"component.3mf",
       Package(
           {{"3D/3dmodel.model", ModelOf3mf(shell, "<item objectid=\"2\"/>", required)}, parts})},
      {"component_of_the_same_number.3mf",
       Package({{"3D/3dmodel.model", ModelOf3mf(other + shell, "<item objectid=\"2\"/>", required)},
                parts})},
      {"item_of_the_same_number.3mf",
       Package({{"3D/3dmodel.model",
                 ModelOf3mf(other, "<item objectid=\"1\" p:path=\"/" + part + "\"/>", required)},
                parts})},
      {"other_prefix.3mf",
       Package({{"3D/3dmodel.model",
                 ModelOf3mf(other,
                            "<item objectid=\"1\" xmlns:q=\"http://schemas.microsoft.com/"
                            "3dmanufacturing/production/2015/06\" q:path=\"/" +
                                part + "\"/>")},
                parts})},
      {"support.3mf", Package({{"3D/3dmodel.model",
                                ModelOf3mf(solid + support, item + "<item objectid=\"9\"/>")}})},
      {"support_in_components.3mf",
       Package({{"3D/3dmodel.model",
                 ModelOf3mf(solid + support +
                                "<object id=\"3\"><components><component objectid=\"1\"/>"
                                "<component objectid=\"9\"/></components></object>",
                            "<item objectid=\"3\"/>")}})},
      {"foreign_elements.3mf",
       Package({{"3D/3dmodel.model",
                 ModelOf3mf(solid, "<x:item xmlns:x=\"urn:x\" objectid=\"77\"/>" + item)}})},
  });
}

/// Negative control: the comparison detects each of the errors listed above.
TEST_F(SameSolidTest, TheComparisonFailsForTurnedMirroredAndScaledSolids) {
  const auto distance = [&](const std::function<Vector3d(const Vector3d&)>& change) {
    std::string text;
    for (const Vector3d& p : kKnownVertices) {
      const Vector3d q = change(p);
      text +=
          "v " + FormatDouble(q.x()) + " " + FormatDouble(q.y()) + " " + FormatDouble(q.z()) + "\n";
    }
    const ObjectFile object = ReadObject(Write("changed.obj", text + FacetText("f ", "\n", 1)));
    return FarthestVertex(dynamic_cast<const Polyhedron&>(*object.object));
  };
  EXPECT_LT(distance([](const Vector3d& p) { return p; }), kRounding);
  EXPECT_GT(distance([](const Vector3d& p) { return Vector3d(p.x(), -p.z(), p.y()); }), 0.01);
  EXPECT_GT(distance([](const Vector3d& p) { return Vector3d(p.x(), p.y(), -p.z()); }), 0.01);
  EXPECT_GT(distance([](const Vector3d& p) { return Vector3d(-p.y(), p.x(), p.z()); }), 0.01);
  EXPECT_GT(distance([](const Vector3d& p) { return Vector3d(1.001 * p); }), 10 * kRounding);
}

}  // namespace same_solid_test
}  // namespace regrasp::object
