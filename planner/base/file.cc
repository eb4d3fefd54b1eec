#include "planner/base/file.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "planner/base/error.h"
#include "planner/base/hexadecimal.h"

namespace regrasp {

namespace fs = std::filesystem;

std::string ReadFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path.string() + ": no such file");
  if (fs::is_directory(status)) throw InputError(path.string() + ": is a folder, not a file");
  const auto fail_large = [&] {
    throw InputError(path.string() + ": larger than " + std::to_string(kMaxInputBytes) + " bytes");
  };
  if (fs::is_regular_file(status) && fs::file_size(path, error) > kMaxInputBytes && !error) {
    fail_large();
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
  // Read in pieces, so that a pipe or a device that never ends meets the limit too.
  std::string bytes;
  std::array<char, 1 << 16> piece;
  while (stream.read(piece.data(), piece.size()) || stream.gcount() > 0) {
    bytes.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > kMaxInputBytes) fail_large();
  }
  if (stream.bad()) throw InputError(path.string() + ": cannot be read");
  return bytes;
}

Sha256Sum::Sha256Sum() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
    throw EnvironmentError("SHA-256 is not available from OpenSSL");
  }
}

void Sha256Sum::Add(std::string_view bytes) {
  EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size());
}

std::string Sha256Sum::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
  return Hexadecimal({reinterpret_cast<const char*>(digest.data()), size});
}

std::string Sha256(std::string_view bytes) {
  Sha256Sum sum;
  sum.Add(bytes);
  return sum.Finish();
}

}  // namespace regrasp
