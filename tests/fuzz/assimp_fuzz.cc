// Any bytes as a file of a format that assimp reads, by the letter in front of them: a sound solid,
// or one line that says what is wrong. assimp may crash in its child process as it likes.

#include <unistd.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "hostile_input.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_with_assimp.h"

namespace {

using namespace regrasp;

constexpr std::array<const char*, 8> kEndings = {".gltf", ".glb", ".dae", ".3mf",
                                                 ".x3d",  ".3ds", ".fbx", ".ac"};

/// Far below a user's limits, for the sake of speed; files here are small.
constexpr AssimpLimits kLimits = {std::size_t{1} << 30, std::chrono::seconds(2),
                                  std::chrono::milliseconds(4000)};

/// Messages name the file by its path, which here stands for kHostileName.
[[noreturn]] void Rethrow(const InputError& error, const std::string& path) {
  const std::string message = error.what();
  if (!message.starts_with(path)) ReportFinding("the message does not name its file: " + message);
  throw InputError(kHostileName + message.substr(path.size()));
}

PolygonSoup ReadBytes(const char* ending, std::string_view bytes) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("regrasp_fuzz_" + std::to_string(getpid()) + ending);
  WriteFile(path, bytes);
  struct Removal {
    const std::filesystem::path& path;
    ~Removal() { std::filesystem::remove(path); }
  } const removal{path};
  try {
    return ReadWithAssimp(path, kLimits);
  } catch (const InputError& error) {
    Rethrow(error, path.string());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const char* ending = kEndings[data[0] % kEndings.size()];
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  ReadHostileInput(
      [&] { ExpectSound(Polyhedron::FromSoup(ReadBytes(ending, bytes), kHostileName)); });
  return 0;
}
