#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/batch/line_records.h"

namespace regrasp::apps {

/// A file with a shard of a run.
struct ShardFile {
  std::filesystem::path path;
  LinesHeader header;
};

/// Looks at the headers of all shards of a run.
/// @returns them in the order of their entries.
/// @throws InputError  names the file: one has no header, is of another run, or a shard twice;
///                     or names the shards that are missing.
[[nodiscard]] std::vector<ShardFile> FindShards(const std::vector<std::filesystem::path>& files);

/// Joins shards into the file that one run over all entries writes, byte for byte. As a stream: it
/// takes no more memory for more entries. Goes on with a part that a merge left which was killed.
/// @param shards  as FindShards gives them.
/// @param fresh   throws away what is there of an earlier merge.
/// @returns what the entries came to.
/// @throws InputError        names the file and the line: a shard does not have the entries that it
///                           should, each on a line of its own, and nothing else.
/// @throws EnvironmentError  the output cannot be written.
Tally MergeLines(const std::vector<ShardFile>& shards, const std::filesystem::path& output,
                 bool fresh);

}  // namespace regrasp::apps
