// Fuzz target: any bytes as 3MF, if they begin like a ZIP archive, and as glTF if not. The result
// must be a surface or a one-line error. It runs in this process, because a child process would
// hide a crash.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hostile_input.h"
#include "planner/base/error.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_object.h"

namespace {

using namespace regrasp;

/// The readers leave the file name to their caller.
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
