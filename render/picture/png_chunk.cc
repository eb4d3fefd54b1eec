#include "render/picture/png_chunk.h"

#include <zlib.h>

namespace regrasp::render {

std::string PngInteger(std::uint32_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

std::string PngChunk(const std::string& type, const std::string& data) {
  const std::string typed = type + data;
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(typed.data()), typed.size());
  return PngInteger(static_cast<std::uint32_t>(data.size())) + typed +
         PngInteger(static_cast<std::uint32_t>(sum));
}

}  // namespace regrasp::render
