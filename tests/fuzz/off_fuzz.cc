// Fuzz target: any bytes as an OFF file. The result must be a valid solid or a one-line error.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hostile_input.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_object.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regrasp;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ReadHostileInput([&] {
    ExpectSound(object::Polyhedron::FromSoup(object::ReadOff(bytes, kHostileName), kHostileName));
  });
  return 0;
}
