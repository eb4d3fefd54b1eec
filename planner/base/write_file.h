#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace regrasp {

/// Whether WriteFile waits for the disk before it renames, so that a machine that stops then leaves
/// the old file or the new one, never an empty one. That takes 3 ms a file (measured on ext4, a
/// virtual disk): in a batch of 500 of the smallest plans 3 s, beside 14 s of computing. The folder
/// is not waited for: that would take as long again, and an old file is no harm.
enum class Durability { kSynced, kCached };

/// Writes a file as a whole: bytes go into a new file aside, which is renamed into place, so that
/// a reader never sees half of it and a failure leaves what was there.
///
/// Links are followed; the file that they end at is replaced, or made where it is missing. Mode and
/// owner of a replaced file stay (the owner as far as the process may), a new one has those of any
/// new file. A path that is neither a file nor free (a terminal, a pipe, /dev/null) is not replaced
/// but written to, and one that stands for a descriptor of this process (/dev/stdout, /dev/fd/3)
/// is that descriptor, at its place.
///
/// SIGINT, SIGTERM and SIGHUP wait while a file stands aside: only SIGKILL leaves one.
/// @throws EnvironmentError  the file cannot be written: its folder does not exist, is full or is
///                           not open to this process; it is write-protected, a folder or a disk.
void WriteFile(const std::filesystem::path& path, std::string_view bytes,
               Durability durability = Durability::kSynced);

/// Writes all of the bytes to an open file, whatever interrupts.
/// @throws std::system_error  it takes no more.
void WriteAll(int descriptor, std::string_view bytes);

/// Finds out whether WriteFile could write there now, and leaves everything as it is.
/// @throws EnvironmentError  as WriteFile.
void CheckWritable(const std::filesystem::path& path);

/// Finds out whether files could be written into a folder now or, where it does not exist, whether
/// it could be made with the folders above it; leaves everything as it is.
/// @throws EnvironmentError  they could not, or it is no folder.
void CheckFolderWritable(const std::filesystem::path& folder);

/// What WriteFile(path) replaces or makes: the end of the path's links, whether it exists or not.
/// `path` itself where that cannot be told.
[[nodiscard]] std::filesystem::path EndOfLinks(const std::filesystem::path& path);

/// The name of the file that WriteFile was writing when it left this one aside, killed before it
/// could rename it; empty where `name` is not of such a file. Of a name near the file system's
/// limit it is the beginning.
[[nodiscard]] std::string NameBesideAside(const std::string& name);

}  // namespace regrasp
