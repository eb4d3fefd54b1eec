// Any bytes as a file of a format that assimp reads, by the letter in front of them: a sound solid,
// or one line that says what is wrong. assimp may crash in its child process as it likes.

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

/// Far below a user's limits, for the sake of speed; files here are small.
constexpr object::AssimpLimits kLimits = {std::size_t{1} << 30, std::chrono::seconds(2),
                                          std::chrono::milliseconds(4000)};

/// Messages name the file with its ending, without which it is kHostileName.
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
