#include "apps/build_id.h"

#include <elf.h>
#include <link.h>

#include <cstddef>
#include <cstring>
#include <string_view>

#include "planner/base/file.h"

namespace regrasp::apps {

namespace {

constexpr std::string_view kOwner{ELF_NOTE_GNU, sizeof ELF_NOTE_GNU};

/// Return the build ID in the notes of an ELF segment; empty if there is none.
/// @param notes  consecutive notes: header, name of the owner and content, each padded.
std::string FindBuildId(std::string_view notes, std::size_t alignment) {
  const auto padded = [alignment](std::size_t size) {
    return (size + alignment - 1) / alignment * alignment;
  };
  ElfW(Nhdr) header;
  while (notes.size() >= sizeof header) {
    std::memcpy(&header, notes.data(), sizeof header);
    const std::size_t content = sizeof header + padded(header.n_namesz);
    const std::size_t end = content + padded(header.n_descsz);
    if (end > notes.size()) break;
    const bool is_id =
        header.n_type == NT_GNU_BUILD_ID && notes.substr(sizeof header, header.n_namesz) == kOwner;
    if (is_id) return Hexadecimal(notes.substr(content, header.n_descsz));
    notes.remove_prefix(end);
  }
  return "";
}

/// Take the build ID of the first object, which is the program, and stop.
int TakeProgram(dl_phdr_info* object, std::size_t /*size*/, void* id) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    const auto* notes = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    // Notes are padded to 4 bytes, or to 8 if their segment is aligned to 8.
    const std::string found = FindBuildId({notes, part.p_memsz}, part.p_align == 8 ? 8 : 4);
    if (!found.empty()) *static_cast<std::string*>(id) = found;
  }
  return 1;
}

}  // namespace

std::string BuildId() {
  std::string id;
  dl_iterate_phdr(TakeProgram, &id);
  // Different builds must not have the same ID.
  return id.empty() ? Sha256(ReadFile("/proc/self/exe")) : id;
}

}  // namespace regrasp::apps
