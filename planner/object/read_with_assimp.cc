#include "planner/object/read_with_assimp.h"

#include "planner/base/error.h"
#include "planner/base/text_encoding.h"
#include "planner/object/assimp_scene.h"
#include "planner/object/limited_child.h"
#include "planner/object/read_3mf.h"
#include "planner/object/read_gltf.h"
#include "planner/object/soup_bytes.h"
#include "planner/object/surface_format.h"

namespace regrasp::object {

namespace {

/// assimp's words in one printable line.
std::string Cleaned(std::string message) {
  if (message.empty()) return "assimp cannot read it";
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return message;
}

/// assimp chooses its reader by the ending of a name.
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
      throw InputError("format: not read in a child process");
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
      throw InputError(name + ": assimp took longer than allowed to read it");
    case ChildEnd::kCrashed:
      throw InputError(name + ": assimp crashed or ran out of memory reading it");
  }
  auto soup = SoupFromBytes(result.bytes);
  if (!soup) throw InputError(name + ": assimp did not read it to its end");
  return *std::move(soup);
}

}  // namespace regrasp::object
