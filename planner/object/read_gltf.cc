#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/gltf_document.h"
#include "planner/object/read_object.h"
#include "planner/object/text_scanner.h"
#include "planner/object/weld.h"

namespace regrasp::object {

namespace {

using Eigen::Affine3d;

/// Prefixes of required extensions that do not affect the geometry, and the supported extensions.
constexpr auto kHarmless = std::to_array<std::string_view>(
    {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_lights_",
     "KHR_technique", "EXT_lights_", "KHR_xmp", "KHR_mesh_quantization"});

/// Extensions of a node, mesh or primitive that change its geometry, required or not.
constexpr auto kShaping = std::to_array<std::string_view>(
    {"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression", "KHR_node_visibility"});

void CheckRequired(const GltfValue& root) {
  for (const GltfValue& required : root.Items("extensionsRequired")) {
    const std::string name = required.Text();
    const bool harmless = std::ranges::any_of(
        kHarmless, [&](std::string_view beginning) { return name.starts_with(beginning); });
    if (!harmless) required.Fail("required extension " + name + ": not supported");
  }
}

void CheckExtensions(const GltfValue& value) {
  const auto extensions = value.Find("extensions");
  if (!extensions) return;
  for (const std::string& name : extensions->Keys()) {
    if (std::ranges::find(kShaping, name) == kShaping.end()) continue;
    value.Fail("extension " + name + ": not supported");
  }
}

/// Reject morph targets unless all their weights are 0.
void CheckWeights(const GltfValue& value) {
  for (const GltfValue& weight : value.Items("weights")) {
    if (weight.Number() == 0) continue;
    weight.Fail("morph weight: not supported, expected 0, found " + FormatShort(weight.Number()));
  }
}

GltfValue SceneOf(const GltfValue& root) {
  const std::vector<GltfValue> scenes = root.Items("scenes");
  if (const auto scene = root.Find("scene")) return root.Item("scenes", scene->Count());
  if (scenes.size() == 1) return scenes.front();
  throw InputError("/scene: not found, expected the index of one of " +
                   std::to_string(scenes.size()) + " scenes");
}

Affine3d TransformOfNode(const GltfValue& node) {
  Affine3d transform = Affine3d::Identity();
  if (const auto matrix = node.Numbers("matrix", 16)) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix->data());  // column-major
    const std::array<double, 4> last = {(*matrix)[3], (*matrix)[7], (*matrix)[11], (*matrix)[15]};
    if (last != std::array<double, 4>{0, 0, 0, 1}) {
      node.Member("matrix").Fail("expected 0, 0, 0, 1 in its last row");
    }
    return transform;
  }
  if (const auto t = node.Numbers("translation", 3))
    transform.translate(Eigen::Vector3d(t->data()));
  if (const auto r = node.Numbers("rotation", 4)) {
    const Eigen::Quaterniond rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
    constexpr double kUnit = 1e-3;
    if (std::abs(rotation.norm() - 1) > kUnit) {
      node.Member("rotation")
          .Fail("expected a unit quaternion, found length " + FormatShort(rotation.norm()));
    }
    transform.rotate(rotation.normalized());
  }
  if (const auto s = node.Numbers("scale", 3)) transform.scale(Eigen::Vector3d(s->data()));
  return transform;
}

using Triangle = std::array<long long, 3>;

/// Return the triangles of a primitive; empty for points and lines.
std::vector<Triangle> TrianglesOf(const GltfValue& primitive, const std::vector<long long>& v) {
  enum Mode : long long { kTriangles = 4, kStrip = 5, kFan = 6 };
  const long long mode = primitive.CountOr("mode", kTriangles);
  std::vector<Triangle> triangles;
  if (mode > kFan) primitive.Fail("mode: unknown, found " + std::to_string(mode));
  if (mode < kTriangles) return triangles;
  if (mode == kTriangles && v.size() % 3 != 0) {
    primitive.Fail("triangles: expected three indices each, found " + std::to_string(v.size()));
  }
  for (std::size_t k = 2; k < v.size(); k += mode == kTriangles ? 3 : 1) {
    if (mode == kFan) {
      triangles.push_back({v[0], v[k - 1], v[k]});
    } else if (mode == kStrip && k % 2 == 1) {
      triangles.push_back({v[k - 1], v[k - 2], v[k]});
    } else {
      triangles.push_back({v[k - 2], v[k - 1], v[k]});
    }
  }
  return triangles;
}

class SceneReader {
 public:
  explicit SceneReader(std::string_view bytes) : document_(bytes), root_(document_.root()) {}

  PolygonSoup Read() {
    CheckRequired(root_);
    visited_.resize(root_.Items("nodes").size());
    std::vector<Visit> stack;
    Push(SceneOf(root_), "nodes", Affine3d::Identity(), stack);
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const GltfValue node = root_.Item("nodes", visit.node);
      const auto place = static_cast<std::size_t>(visit.node);
      if (visited_[place]) {
        node.Fail("must be a child of one node, found two parents");
      }
      visited_[place] = true;
      CheckExtensions(node);
      const Affine3d placement = visit.placement * TransformOfNode(node);
      if (const auto mesh = node.Find("mesh")) AddMesh(node, mesh->Count(), placement);
      Push(node, "children", placement, stack);
    }
    if (soup_.facets.empty()) throw InputError("scene: expected at least one triangle, found none");
    soup_.unit = "metres";
    return std::move(soup_);
  }

 private:
  struct Visit {
    long long node;
    Affine3d placement;
  };

  static void Push(const GltfValue& parent, const std::string& key, const Affine3d& placement,
                   std::vector<Visit>& stack) {
    const std::vector<GltfValue> nodes = parent.Items(key);
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      stack.push_back({node->Count(), placement});
    }
  }

  void AddMesh(const GltfValue& node, long long index, const Affine3d& placement) {
    if (const auto skin = node.Find("skin"))
      skin->Fail("not supported, expected a mesh without a skin");
    const GltfValue mesh = root_.Item("meshes", index);
    CheckExtensions(mesh);
    CheckWeights(node.Find("weights") ? node : mesh);
    for (const GltfValue& primitive : mesh.Items("primitives")) AddPrimitive(primitive, placement);
  }

  void AddPrimitive(const GltfValue& primitive, const Affine3d& placement) {
    CheckExtensions(primitive);
    const auto position = primitive.Member("attributes").Find("POSITION");
    if (!position) return;
    const std::vector<Eigen::Vector3d> vertices = document_.Positions(position->Count());
    std::vector<long long> indices;
    if (const auto accessor = primitive.Find("indices")) {
      indices = document_.Indices(accessor->Count());
    } else {
      for (long long k = 0; k < std::ssize(vertices); ++k) indices.push_back(k);
    }
    const std::vector<Triangle> triangles = TrianglesOf(primitive, indices);
    if (triangles.empty()) return;
    if (soup_.facets.size() + triangles.size() > kMaxFacets ||
        soup_.vertices.size() + vertices.size() > 3 * kMaxFacets) {
      throw InputError("too large, limit " + std::to_string(kMaxFacets) + " facets");
    }
    const int first = static_cast<int>(soup_.vertices.size());
    for (const Eigen::Vector3d& vertex : vertices) soup_.vertices.push_back(placement * vertex);
    const bool mirrors = placement.linear().determinant() < 0;
    for (const auto& [a, b, c] : triangles) {
      for (const long long corner : {a, b, c}) CheckIndex(primitive, corner, vertices.size());
      std::vector<int>& facet = soup_.facets.emplace_back();
      for (const long long corner : {a, mirrors ? c : b, mirrors ? b : c}) {
        facet.push_back(first + static_cast<int>(corner));
      }
    }
  }

  void CheckIndex(const GltfValue& primitive, long long index, std::size_t vertices) const {
    if (index < static_cast<long long>(vertices)) return;
    primitive.Fail("facet " + std::to_string(soup_.facets.size()) + ": vertex index " +
                   std::to_string(index) + " must be less than " + std::to_string(vertices) +
                   ", the number of vertices");
  }

  GltfDocument document_;
  GltfValue root_;
  std::vector<bool> visited_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup ReadGltf(std::string_view bytes) { return SceneReader(bytes).Read(); }

}  // namespace regrasp::object
