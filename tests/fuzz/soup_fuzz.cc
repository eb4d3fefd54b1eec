// Fuzz target: any bytes as the output of the child process that runs assimp. The result must be a
// valid solid or a rejection.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hostile_input.h"
#include "planner/base/error.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regrasp;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ReadHostileInput([&] {
    const auto soup = object::SoupFromBytes(bytes);
    if (!soup) throw InputError(kHostileName + ": not a soup");
    ExpectSound(object::Polyhedron::FromSoup(*soup, kHostileName));
  });
  return 0;
}
