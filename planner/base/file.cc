#include "planner/base/file.h"

#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "planner/base/error.h"

namespace regrasp {

namespace fs = std::filesystem;

namespace {

/// Before the number of the process that writes.
constexpr char kAsideMark[] = ".tmp";

}  // namespace

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

void WriteFile(const fs::path& path, std::string_view bytes) {
  fs::path aside = path;
  aside += kAsideMark + std::to_string(getpid());
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    fs::remove(aside, ignored);
    throw EnvironmentError(path.string() + ": cannot be written: " + why);
  };
  {
    std::ofstream stream(aside, std::ios::binary | std::ios::trunc);
    if (!stream) fail(std::strerror(errno));
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.flush();
    if (!stream) fail(std::strerror(errno));
  }
  std::error_code error;
  fs::rename(aside, path, error);
  if (error) fail(error.message());
}

std::string NameBesideAside(const std::string& name) {
  const std::size_t mark = name.rfind(kAsideMark);
  if (mark == std::string::npos) return "";
  const std::size_t digits = mark + std::strlen(kAsideMark);
  const bool number =
      digits < name.size() && name.find_first_not_of("0123456789", digits) == std::string::npos;
  return number ? name.substr(0, mark) : "";
}

std::string Sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw EnvironmentError("SHA-256 is not available from OpenSSL");
  }
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

}  // namespace regrasp
