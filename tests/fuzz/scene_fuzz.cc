// Any bytes as 3MF, if they begin like a ZIP archive, or else as glTF, in this process: a surface
// or one line that says what is wrong. A child process that reads them would hide a crash.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hostile_input.h"
#include "planner/base/error.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_3mf.h"
#include "planner/object/read_gltf.h"

namespace {

using namespace regrasp;

/// The readers leave the file's name to their caller.
object::PolygonSoup ReadScene(std::string_view bytes) {
  try {
    return bytes.starts_with("PK") ? object::Read3mf(bytes) : object::ReadGltf(bytes);
  } catch (const InputError& error) {
    throw InputError(kHostileName + ": " + error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ReadHostileInput(
      [&] { ExpectSound(object::Polyhedron::FromSoup(ReadScene(bytes), kHostileName)); });
  return 0;
}
