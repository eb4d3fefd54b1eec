#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "tests/fixtures/stored_zip.h"

namespace regrasp::object {

// A solid of known volume, centroid, bounding box and vertices, written in each format. It has no
// symmetry and does not contain the origin. A rotated, mirrored, moved or scaled solid therefore
// differs in its vertices. Lengths are in metres.

/// Corner (1, 2, 3) cm of a box, and its neighbours at 10 cm along x, 6 cm along y and 4 cm along
/// z.
inline const std::vector<Eigen::Vector3d> kKnownVertices = {
    {0.01, 0.02, 0.03}, {0.11, 0.02, 0.03}, {0.01, 0.08, 0.03}, {0.01, 0.02, 0.07}};
inline const std::vector<std::array<int, 3>> kKnownFacets = {
    {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
/// The same triangles as a strip.
inline const std::vector<int> kKnownStrip = {0, 2, 1, 3, 0, 2};
inline constexpr double kKnownVolume = 0.1 * 0.06 * 0.04 / 6;
inline const Eigen::Vector3d kKnownCentroid{0.035, 0.035, 0.04};

template <class T>
std::string BytesOf(T value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  return {bytes.data(), bytes.size()};
}

/// Write one text per vertex, with coordinates multiplied by `factor`.
inline std::string VertexText(const std::string& before, const std::string& behind,
                              double factor = 1) {
  std::string text;
  for (const auto& p : kKnownVertices) {
    text += before + FormatDouble(factor * p.x()) + " " + FormatDouble(factor * p.y()) + " " +
            FormatDouble(factor * p.z()) + behind;
  }
  return text;
}

/// Write one text per triangle; indices begin at `first`.
inline std::string FacetText(const std::string& before, const std::string& behind, int first = 0) {
  std::string text;
  for (const auto& [a, b, c] : kKnownFacets) {
    text += before + std::to_string(a + first) + " " + std::to_string(b + first) + " " +
            std::to_string(c + first) + behind;
  }
  return text;
}

inline std::string KnownObj() { return VertexText("v ", "\n") + FacetText("f ", "\n", 1); }

inline std::string KnownOff() {
  return "OFF\n4 4 0\n" + VertexText("", "\n") + FacetText("3 ", "\n");
}

inline const std::string kPlyVertices =
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n";

inline std::string KnownPly() {
  return "ply\nformat ascii 1.0\n" + kPlyVertices +
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n" +
         VertexText("", "\n") + FacetText("3 ", "\n");
}

/// Write a PLY file with triangle strips.
/// @param strips  rows of the element, each with its length first.
/// @param count   number of rows.
inline std::string StripPly(const std::string& strips, int count) {
  return "ply\nformat ascii 1.0\n" + kPlyVertices + "element tristrips " + std::to_string(count) +
         "\nproperty list int int vertex_indices\nend_header\n" + VertexText("", "\n") + strips;
}

/// Write an ASCII STL file.
/// @param glued  whether names follow their keywords without a blank.
inline std::string KnownTextStl(const std::string& name, bool glued) {
  const std::string blank = glued ? "" : " ";
  std::string text = "solid" + blank + name + "\n";
  for (const auto& facet : kKnownFacets) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : facet) {
      const auto& p = kKnownVertices[static_cast<std::size_t>(v)];
      text += "vertex " + FormatDouble(p.x()) + " " + FormatDouble(p.y()) + " " +
              FormatDouble(p.z()) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid" + blank + name + "\n";
}

/// Write a binary STL file.
/// @param header  text of the header, padded with zeros to 80 bytes.
inline std::string KnownBinaryStl(std::string header) {
  header.resize(80, '\0');
  std::string bytes = header + LittleEndian(kKnownFacets.size(), 4);
  for (const auto& facet : kKnownFacets) {
    bytes += std::string(12, '\0');
    for (const int v : facet) {
      for (const double x : kKnownVertices[static_cast<std::size_t>(v)]) {
        bytes += BytesOf(static_cast<float>(x));
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

/// COLLADA document.
struct KnownCollada {
  std::string up = "Y_UP";
  std::string unit = "meter=\"1\"";
  double factor = 1;  ///< factor of the coordinates
  std::string primitives =
      "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" "
      "offset=\"0\"/><p>" +
      FacetText("", " ") + "</p></triangles>";
  std::string node = "";  ///< transformations of the node, as XML
  std::string instance = "<instance_geometry url=\"#g\"/>";

  [[nodiscard]] std::string Text() const {
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
           "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
           "<!-- <unit meter=\"7\"/> --><asset><unit name=\"u\" " +
           unit + "/><up_axis>" + up +
           "</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
           "<float_array id=\"pa\" count=\"12\">" +
           VertexText("", " ", factor) +
           "</float_array><technique_common><accessor source=\"#pa\" count=\"4\" stride=\"3\">"
           "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
           "type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input "
           "semantic=\"POSITION\" source=\"#p\"/></vertices>" +
           primitives +
           "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\">"
           "<node id=\"n\">" +
           node + instance +
           "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#s\"/></scene></COLLADA>\n";
  }
};

/// Write an ASCII FBX file in metres with the given axes.
inline std::string KnownFbx(const std::string& settings) {
  std::string vertices, indices;
  for (const auto& p : kKnownVertices) {
    for (const double x : p) vertices += (vertices.empty() ? "" : ",") + FormatDouble(x);
  }
  for (const auto& [a, b, c] : kKnownFacets) {
    indices += (indices.empty() ? "" : ",") + std::to_string(a) + "," + std::to_string(b) + "," +
               std::to_string(-1 - c);
  }
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: "
         "1003\n\tFBXVersion: "
         "7400\n}\nGlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n\t\tP: "
         "\"UnitScaleFactor\", \"double\", \"Number\", \"\",100\n" +
         settings +
         "\t}\n}\nObjects:  {\n\tGeometry: 1000, \"Geometry::t\", \"Mesh\" {\n\t\tVertices: "
         "*12 {\n\t\t\ta: " +
         vertices + "\n\t\t}\n\t\tPolygonVertexIndex: *12 {\n\t\t\ta: " + indices +
         "\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n\tModel: 2000, \"Model::t\", \"Mesh\" "
         "{\n\t\tVersion: 232\n\t}\n}\nConnections:  {\n\tC: \"OO\",1000,2000\n\tC: "
         "\"OO\",2000,0\n}\n";
}

// 3MF packages, in millimetres.

inline const std::string kModelNamespaces =
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"";

/// Write a mesh of the solid. @param factor  factor of its coordinates: 1000 for millimetres.
inline std::string MeshOf3mf(double factor = 1000) {
  std::string text = "<mesh><vertices>";
  for (const auto& p : kKnownVertices) {
    text += "<vertex x=\"" + FormatDouble(factor * p.x()) + "\" y=\"" +
            FormatDouble(factor * p.y()) + "\" z=\"" + FormatDouble(factor * p.z()) + "\"/>";
  }
  text += "</vertices><triangles>";
  for (const auto& [a, b, c] : kKnownFacets) {
    text += "<triangle v1=\"" + std::to_string(a) + "\" v2=\"" + std::to_string(b) + "\" v3=\"" +
            std::to_string(c) + "\"/>";
  }
  return text + "</triangles></mesh>";
}

inline std::string ModelOf3mf(const std::string& objects, const std::string& items,
                              const std::string& attributes = "") {
  return "<?xml version=\"1.0\"?><model " + kModelNamespaces + " " + attributes + "><resources>" +
         objects + "</resources><build>" + items + "</build></model>";
}

inline std::string RelationshipsTo(const std::vector<std::string>& targets) {
  std::string text =
      "<?xml version=\"1.0\"?><Relationships "
      "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">";
  for (const std::string& target : targets) {
    text += "<Relationship Target=\"" + target + "\" Id=\"r" + std::to_string(text.size()) +
            "\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>";
  }
  return text + "</Relationships>";
}

/// Make a package of parts; the first one is its root model.
inline std::string Package(std::vector<std::pair<std::string, std::string>> parts) {
  parts.insert(parts.begin(), {"_rels/.rels", RelationshipsTo({"/" + parts.front().first})});
  return StoredZip(parts);
}

}  // namespace regrasp::object
