#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/batch/line_records.h"

namespace regrasp::apps {

/// File with one shard of a run.
struct ShardFile {
  std::filesystem::path path;
  LinesHeader header;
};

/// Read the headers of all shards of a run.
/// @returns the shards in the order of their entries.
/// @throws InputError  if a file has no header or is of another run, or if a shard occurs twice or
///     is missing. The message names the file or the missing shards.
[[nodiscard]] std::vector<ShardFile> FindShards(const std::vector<std::filesystem::path>& files);

/// Merge shards into the file that a single run over all entries writes, byte for byte.
/// Shards are read as a stream: memory use does not depend on the number of entries. The function
/// continues the part of an earlier merge that was killed.
/// @param shards  result of FindShards.
/// @param fresh   true: discard the part of an earlier merge.
/// @returns the outcome counts of the entries.
/// @throws InputError        if a shard does not contain exactly its entries, one per line. The
///     message names the file and the line.
/// @throws EnvironmentError  if the output cannot be written.
OutcomeCounts MergeLines(const std::vector<ShardFile>& shards, const std::filesystem::path& output,
                         bool fresh);

}  // namespace regrasp::apps
