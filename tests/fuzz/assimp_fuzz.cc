// Fuzz target: any bytes as a file of a format that assimp reads, selected by the first letter. The
// result must be a valid solid or a one-line error. assimp may crash in its child process.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "hostile_input.h"
#include "planner/base/error.h"
#include "planner/object/assimp_scene.h"
#include "planner/object/polyhedron.h"

namespace {

using namespace regrasp;

constexpr std::array<const char*, 8> kEndings = {".gltf", ".glb", ".dae", ".3mf",
                                                 ".x3d",  ".3ds", ".fbx", ".ac"};

/// Limits far below those of a user, for speed: the files here are small.
constexpr object::AssimpLimits kLimits = {std::size_t{1} << 30, std::chrono::seconds(2),
                                          std::chrono::milliseconds(4000)};

/// Messages name the file with its ending; without it the name is kHostileName.
object::PolygonSoup ReadBytes(const std::string& ending, std::string_view bytes) {
  const std::string file = kHostileName + ending;
  try {
    return object::ReadWithAssimp(bytes, file, kLimits);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (!message.starts_with(file)) ReportFinding("the message does not name its file: " + message);
    throw InputError(kHostileName + message.substr(file.size()));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const char* ending = kEndings[data[0] % kEndings.size()];
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  ReadHostileInput(
      [&] { ExpectSound(object::Polyhedron::FromSoup(ReadBytes(ending, bytes), kHostileName)); });
  return 0;
}
