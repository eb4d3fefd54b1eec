#include "report/page/data_uri.h"

#include <openssl/evp.h>

namespace regrasp::report {

std::string DataUri(std::string_view media_type, std::string_view bytes) {
  // Three bytes become four characters; the encoder adds a zero.
  std::string base64((bytes.size() + 2) / 3 * 4 + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(base64.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  base64.resize(size);
  return "data:" + std::string(media_type) + ";base64," + base64;
}

}  // namespace regrasp::report
