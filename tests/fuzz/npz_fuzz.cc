// Fuzz target: any bytes as an NPZ or an NPY file. The result must be arrays whose shapes match
// their numbers, or a one-line error.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string_view>

#include "hostile_input.h"
#include "planner/base/zip_archive.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regrasp;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto check = [](const NpzArray& array) {
    const std::size_t count =
        std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies());
    if (count != array.values.size()) ReportFinding(array.name + ": the shape does not fit");
  };
  ReadHostileInput([&] {
    for (const NpzArray& array : ReadNpz(bytes, kHostileName, {"points", "normals"})) check(array);
  });
  // An archive has a checksum of each array, which is wrong for almost every mutation.
  ReadHostileInput([&] { check(ReadNpy(bytes, kHostileName)); });
  return 0;
}
