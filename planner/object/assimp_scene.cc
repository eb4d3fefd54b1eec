#include "planner/object/assimp_scene.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/limited_child.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/read_object.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

namespace {

/// Elements of COLLADA that assimp misreads.
constexpr auto kMisread = std::to_array<std::string_view>(
    {"brep", "convex_mesh", "instance_controller", "lookat", "ph", "skew", "spline"});

/// Elements that refer to a surface by `url`.
constexpr auto kInstances = std::to_array<std::string_view>(
    {"instance_geometry", "instance_node", "instance_visual_scene"});

double UnitOfTag(const XmlTag& tag) {
  if (!tag.Find("meter")) return 1;  // the default
  const double metres = tag.Number("meter");
  if (metres > 0) return metres;
  throw InputError("unit: meter: expected a positive number, found " + FormatDouble(metres));
}

/// Check that a COLLADA document holds nothing that assimp would misread, before assimp reads it.
std::optional<double> CheckCollada(std::string_view bytes) {
  std::optional<double> unit;
  ScanXml(TextOf(bytes, "document"), "", [&](const XmlTag& tag) {
    if (std::ranges::find(kMisread, tag.name()) != kMisread.end()) {
      throw InputError("element " + Quoted(tag.name()) + ": not supported");
    }
    if (std::ranges::find(kInstances, tag.name()) != kInstances.end()) {
      const std::string url = tag.Text("url");
      if (!url.starts_with('#')) {
        throw InputError("surface in another file, " + Quoted(url) +
                         ": not supported; help: convert the object to .glb or .ply");
      }
    }
    if (tag.name() != "unit") return;
    const double metres = UnitOfTag(tag);
    if (unit && *unit != metres) {
      throw InputError("unit: expected one, found " + FormatDouble(*unit) + " and " +
                       FormatDouble(metres) + " m");
    }
    unit = metres;
  });
  return unit;
}

/// Extensions of secondary files that assimp's readers search for and that do not affect the
/// surface: images, palettes, materials, skeletons and animations.
constexpr auto kNothingOfSurface = std::to_array<std::string_view>(
    {".bmp",     ".dds",       ".exr",      ".gif",  ".hdr", ".jpeg", ".jpg",  ".ktx", ".ktx2",
     ".lmp",     ".mat",       ".material", ".mtl",  ".pal", ".pcx",  ".png",  ".psd", ".shader",
     ".md5anim", ".md5camera", ".skeleton", ".skin", ".tga", ".tif",  ".tiff", ".txt", ".webp"});

/// File system for assimp with one file in memory. Stores the first other requested file on which
/// the surface may depend.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  bool Exists(const char* path) const override {
    if (path == name_) return true;
    Note(path);
    return false;
  }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* /*mode*/) override {
    if (path == name_) {
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()),
                                        bytes_.size());
    }
    Note(path);
    return nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }
  bool ComparePaths(const char* one, const char* other) const override {
    return std::string_view(one) == other;
  }

  [[nodiscard]] const std::string& missed() const { return missed_; }

 private:
  void Note(const std::string& path) const {
    const std::string ending = LowerCase(std::filesystem::path(path).extension().string());
    const bool matters = std::ranges::find(kNothingOfSurface, ending) == kNothingOfSurface.end();
    if (matters && missed_.empty()) missed_ = path;
  }

  std::string_view bytes_;
  std::string name_;
  mutable std::string missed_;  // mutable because Exists is const
};

/// Add a mesh as placed by one node. If the node mirrors it, its polygons are reversed.
/// @throws InputError  if bones or morph targets would move its vertices, or an index is out of
///     range.
void AddMesh(const aiMesh& mesh, const aiMatrix4x4& placement, PolygonSoup& soup) {
  if (mesh.mNumBones > 0)
    throw InputError("mesh with bones (skin): not supported, expected a rigid mesh");
  if (mesh.mNumAnimMeshes > 0)
    throw InputError("mesh with morph targets: not supported, expected a rigid mesh");
  const std::size_t first = soup.vertices.size();
  for (unsigned int v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D p = placement * mesh.mVertices[v];
    soup.vertices.push_back({p.x, p.y, p.z});
  }
  const bool mirrors = aiMatrix3x3(placement).Determinant() < 0;
  for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices < 3) continue;  // a point or a line
    std::vector<int>& facet = soup.facets.emplace_back();
    for (unsigned int k = 0; k < face.mNumIndices; ++k) {
      const unsigned int index = face.mIndices[mirrors ? face.mNumIndices - 1 - k : k];
      if (index >= mesh.mNumVertices) {
        throw InputError("facet " + std::to_string(soup.facets.size() - 1) + ": vertex index " +
                         std::to_string(index) + " must be less than " +
                         std::to_string(mesh.mNumVertices) + ", the number of vertices");
      }
      facet.push_back(static_cast<int>(first + index));
    }
  }
}

struct FileUnit {
  std::string name;
  double metres = 1;
};

/// Return the unit with its name, or "units of 0.3 m" if it has none.
FileUnit UnitOf(double metres) {
  static const std::vector<FileUnit> kNamed = {{"metres", 1},
                                               {"centimetres", 0.01},
                                               {"millimetres", 0.001},
                                               {"inches", 0.0254},
                                               {"feet", 0.3048}};
  constexpr double kSame = 1e-6;  // because files contain rounded values
  for (const FileUnit& named : kNamed) {
    if (std::abs(metres - named.metres) <= kSame * named.metres) return named;
  }
  return {"units of " + FormatShort(metres) + " m", metres};
}

/// Return the unit of an FBX file, which states it in centimetres.
std::optional<FileUnit> FbxUnit(const aiScene& scene) {
  float centimetres = 0;
  if (scene.mMetaData == nullptr || !scene.mMetaData->Get("UnitScaleFactor", centimetres) ||
      !(centimetres > 0)) {
    return std::nullopt;
  }
  return UnitOf(double{centimetres} / 100);
}

/// Convert a surface to metres. For COLLADA, assimp does this itself.
void ApplyFbxUnit(const aiScene& scene, PolygonSoup& soup) {
  const std::optional<FileUnit> unit = FbxUnit(scene);
  if (!unit) return;
  soup.unit = unit->name;
  for (Eigen::Vector3d& vertex : soup.vertices) vertex *= unit->metres;
}

/// Return the surface of a scene, in the units of assimp.
PolygonSoup SoupOf(const aiScene& scene) {
  PolygonSoup soup;
  struct Visit {
    const aiNode* node;
    aiMatrix4x4 placement;
  };
  std::vector<Visit> stack;
  if (scene.mRootNode != nullptr) stack.push_back({scene.mRootNode, aiMatrix4x4()});
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const aiMatrix4x4 placement = visit.placement * visit.node->mTransformation;
    for (unsigned int m = 0; m < visit.node->mNumMeshes; ++m) {
      if (visit.node->mMeshes[m] >= scene.mNumMeshes) throw InputError("mesh of a node not found");
      AddMesh(*scene.mMeshes[visit.node->mMeshes[m]], placement, soup);
    }
    for (unsigned int c = visit.node->mNumChildren; c-- > 0;) {
      stack.push_back({visit.node->mChildren[c], placement});
    }
  }
  return soup;
}

/// Reject NURBS, because assimp ignores them.
void CheckFbx(std::string_view bytes) {
  if (bytes.find("NurbsSurface") == std::string_view::npos) return;
  throw InputError("geometry \"NurbsSurface\": not supported");
}

}  // namespace

PolygonSoup ReadAssimpScene(std::string_view bytes, const std::string& file) {
  const bool is_collada = LowerCase(std::filesystem::path(file).extension().string()) == ".dae";
  const std::optional<double> collada_unit = is_collada ? CheckCollada(bytes) : std::nullopt;
  if (!is_collada) CheckFbx(bytes);
  Assimp::Importer importer;
  auto* files = new OneFile(bytes, file);
  importer.SetIOHandler(files);  // takes ownership
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  constexpr unsigned int kNoPostProcessing = 0;
  const aiScene* scene = importer.ReadFile(file, kNoPostProcessing);
  if (const std::string& other = files->missed(); !other.empty()) {
    throw InputError("surface in another file, " + Quoted(other) +
                     ": not supported; help: convert the object to .glb or .ply");
  }
  if (scene == nullptr) throw InputError(importer.GetErrorString());
  PolygonSoup soup = SoupOf(*scene);
  // Vertices of lines are not a point cloud.
  if (soup.facets.empty()) throw InputError("scene: expected at least one polygon");
  if (!is_collada) ApplyFbxUnit(*scene, soup);
  if (collada_unit) soup.unit = UnitOf(*collada_unit).name;
  return soup;
}

namespace {

/// Convert a message of assimp to one printable line.
std::string Cleaned(std::string message) {
  if (message.empty()) return "cannot be read by assimp";
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return message;
}

/// Read in the child process. assimp selects its reader by the extension of the file name.
PolygonSoup ReadInChild(std::string_view bytes, SurfaceFormat format) {
  switch (format) {
    case SurfaceFormat::k3mf:
      return Read3mf(bytes);
    case SurfaceFormat::kGltf:
      return ReadGltf(bytes);
    case SurfaceFormat::kCollada:
      return ReadAssimpScene(TextOf(bytes, "document"), "object.dae");
    case SurfaceFormat::kFbx:
      return ReadAssimpScene(bytes, "object.fbx");
    default:
      throw InputError("format: not supported in a child process");
  }
}

}  // namespace

PolygonSoup ReadWithAssimp(std::string_view bytes, const std::filesystem::path& path,
                           const AssimpLimits& limits) {
  const std::string name = path.string();
  const SurfaceFormat format = FormatOf(path, bytes);
  const ChildResult result =
      RunInLimitedChild([&] { return SoupToBytes(ReadInChild(bytes, format)); },
                        {limits.memory_bytes, limits.processor, limits.wall});
  switch (result.end) {
    case ChildEnd::kDone:
      break;
    case ChildEnd::kThrew:
      throw InputError(name + ": " + Cleaned(result.bytes));
    case ChildEnd::kTookTooLong:
      throw InputError(name + ": time limit of assimp exceeded");
    case ChildEnd::kCrashed:
      throw InputError(name + ": assimp crashed or exceeded its memory limit");
  }
  auto soup = SoupFromBytes(result.bytes);
  if (!soup) throw InputError(name + ": read incompletely by assimp");
  return *std::move(soup);
}

}  // namespace regrasp::object
