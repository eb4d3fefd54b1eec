// Fuzz target: any bytes as a point cloud, XYZ and PCD. The result must be finite points or a
// one-line error.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "hostile_input.h"
#include "planner/object/read_object.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regrasp;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const auto read : {object::ReadXyz, object::ReadPcd}) {
    ReadHostileInput([&] {
      for (const auto& point : read(bytes, kHostileName).vertices) {
        if (!point.allFinite()) std::abort();
      }
    });
  }
  return 0;
}
