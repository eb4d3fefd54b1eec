#include "report/page/path_uri.h"

namespace regrasp::report {

std::string PathUri(std::string_view path) {
  constexpr std::string_view kAsTheyAre =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri;
  for (const char byte : path) {
    if (kAsTheyAre.find(byte) != std::string_view::npos) {
      uri += byte;
      continue;
    }
    const auto value = static_cast<unsigned char>(byte);
    uri += {'%', kHex[value / 16], kHex[value % 16]};
  }
  return uri;
}

}  // namespace regrasp::report
