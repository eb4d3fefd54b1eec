// Fuzz target: any bytes as a WKT file. The result must be a valid polygon or a one-line error.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hostile_input.h"
#include "planner/object/polygon.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regrasp;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ReadHostileInput([&] { ExpectSound(object::Polygon::FromWkt(text, kHostileName)); });
  return 0;
}
