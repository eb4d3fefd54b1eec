#include "planner/base/zip_archive.h"

#include <minizip/unzip.h>

#include <array>
#include <cstring>

#include "planner/base/error.h"

namespace regrasp {

namespace {

/// File callbacks of minizip for bytes in memory.
struct MemoryFile {
  std::string_view bytes;
  ZPOS64_T at = 0;

  static MemoryFile& Of(void* opaque) { return *static_cast<MemoryFile*>(opaque); }
  static void* Open(void* opaque, const void*, int) { return opaque; }
  static uLong Read(void* opaque, void*, void* to, uLong size) {
    MemoryFile& file = Of(opaque);
    if (file.at >= file.bytes.size()) return 0;
    const std::string_view piece = file.bytes.substr(file.at, size);
    std::memcpy(to, piece.data(), piece.size());
    file.at += piece.size();
    return static_cast<uLong>(piece.size());
  }
  static ZPOS64_T Tell(void* opaque, void*) { return Of(opaque).at; }
  static long Seek(void* opaque, void*, ZPOS64_T offset, int origin) {
    MemoryFile& file = Of(opaque);
    const ZPOS64_T from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? file.at
                          : origin == ZLIB_FILEFUNC_SEEK_END ? file.bytes.size()
                                                             : 0;
    file.at = from + offset;
    return file.at <= file.bytes.size() ? 0 : -1;
  }
  static int Close(void*, void*) { return 0; }
  static int Error(void*, void*) { return 0; }
};

}  // namespace

class ZipArchive::Impl {
 public:
  explicit Impl(std::string_view bytes)
      : memory_{bytes},
        functions_{MemoryFile::Open, MemoryFile::Read,  nullptr,           MemoryFile::Tell,
                   MemoryFile::Seek, MemoryFile::Close, MemoryFile::Error, &memory_},
        zip_(unzOpen2_64("", &functions_), unzClose) {
    if (!zip_) throw InputError("not a ZIP archive");
  }
  [[nodiscard]] unzFile zip() const { return zip_.get(); }

 private:
  MemoryFile memory_;
  zlib_filefunc64_def functions_;
  std::unique_ptr<void, int (*)(unzFile)> zip_;
};

ZipArchive::ZipArchive(std::string_view bytes) : impl_(std::make_unique<Impl>(bytes)) {}
ZipArchive::~ZipArchive() = default;

std::vector<std::string> ZipArchive::names() {
  std::vector<std::string> names;
  int state = unzGoToFirstFile(impl_->zip());
  for (; state == UNZ_OK; state = unzGoToNextFile(impl_->zip())) {
    std::array<char, 1 << 10> name{};
    if (unzGetCurrentFileInfo64(impl_->zip(), nullptr, name.data(), name.size() - 1, nullptr, 0,
                                nullptr, 0) != UNZ_OK) {
      break;
    }
    names.emplace_back(name.data());
  }
  if (state != UNZ_END_OF_LIST_OF_FILE && !(names.empty() && state == UNZ_PARAMERROR)) {
    throw InputError("archive: list of files: corrupt");
  }
  return names;
}

std::optional<std::string> ZipArchive::Read(const std::string& name, std::size_t most) {
  constexpr int kAnyCase = 2;
  if (unzLocateFile(impl_->zip(), name.c_str(), kAnyCase) != UNZ_OK) return std::nullopt;
  if (unzOpenCurrentFile(impl_->zip()) != UNZ_OK) {
    throw InputError(name +
                     ": header in the archive: corrupt, or its compression is not supported");
  }
  std::string text;
  std::array<char, 1 << 16> piece;
  int count = 0;
  while ((count = unzReadCurrentFile(impl_->zip(), piece.data(), piece.size())) > 0) {
    text.append(piece.data(), static_cast<std::size_t>(count));
    if (text.size() > most) throw InputError(name + ": too large");
  }
  if (count < 0 || unzCloseCurrentFile(impl_->zip()) != UNZ_OK) {
    throw InputError(name + ": compressed data: corrupt");
  }
  return text;
}

}  // namespace regrasp
