#pragma once

#include <string>
#include <string_view>

#include "planner/base/json.h"
#include "tests/planner/object/known_solid.h"

namespace regrasp::object {

inline std::string Base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      bits = bits << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0U);
    }
    for (const int shift : {18, 12, 6, 0}) text += kDigits[bits >> shift & 63];
    if (k + 1 >= bytes.size()) text[text.size() - 2] = '=';
    if (k + 2 >= bytes.size()) text.back() = '=';
  }
  return text;
}

/// Document in glTF whose parts a test can change before writing it.
struct KnownGltf {
  Json json = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
    "indices": 1}]}], "bufferViews": [], "accessors": []})");
  std::string buffer;

  /// Make a document with vertices as floats and the indices of the triangles.
  KnownGltf() {
    std::string positions, indices;
    for (const auto& p : kKnownVertices) {
      for (const double x : p) positions += BytesOf(static_cast<float>(x));
    }
    for (const auto& facet : kKnownFacets) {
      for (const int v : facet) indices += LittleEndian(static_cast<std::uint64_t>(v), 2);
    }
    AddAccessor(positions, {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    AddAccessor(indices, {{"componentType", 5123}, {"count", 12}, {"type", "SCALAR"}});
  }

  /// Append bytes to the buffer with a view. @returns index of the view.
  std::size_t AddView(const std::string& bytes) {
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer += bytes;
    return json["bufferViews"].size() - 1;
  }

  std::size_t AddAccessor(const std::string& bytes, Json accessor) {
    accessor["bufferView"] = AddView(bytes);
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
  Json& node() { return json["nodes"][0]; }

  /// Replace the indices of the triangles by indices of another primitive mode.
  void SetIndices(const std::vector<int>& indices, int mode) {
    std::string bytes;
    for (const int v : indices) bytes += static_cast<char>(v);
    primitive()["mode"] = mode;
    primitive()["indices"] = AddAccessor(
        bytes, {{"componentType", 5121}, {"count", indices.size()}, {"type", "SCALAR"}});
  }

  [[nodiscard]] std::string Gltf() const {
    Json document = json;
    document["buffers"] = Json::parse("[{}]");
    document["buffers"][0] = {{"byteLength", buffer.size()},
                              {"uri", "data:application/octet-stream;base64," + Base64(buffer)}};
    return document.dump();
  }

  [[nodiscard]] std::string Glb() const {
    Json document = json;
    document["buffers"] = Json::parse("[{}]");
    document["buffers"][0] = {{"byteLength", buffer.size()}};
    std::string text = document.dump(), binary = buffer;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    return "glTF" + LittleEndian(2, 4) + LittleEndian(28 + text.size() + binary.size(), 4) +
           LittleEndian(text.size(), 4) + "JSON" + text + LittleEndian(binary.size(), 4) +
           std::string("BIN\0", 4) + binary;
  }
};

}  // namespace regrasp::object
